#include "window/controllers/cases/case_control.h"

#include <algorithm>
#include <utility>

#include "cases/felt_choice.h"
#include "osteon/base/file.h"
#include "osteon/session/session.h"
#include "window/controllers/cases/case_browser.h"
#include "window/controllers/cases/open_bones.h"
#include "window/ui_model.h"

namespace osteon {
namespace {

std::vector<Vec3> bone_middles(const Case& the_case) {
  std::vector<Vec3> middles;
  for (const Bone& bone : the_case.bones) {
    Aabb box;
    for (const Vec3& p : bone.mesh.vertices) box.include(p);
    middles.push_back(box.empty() ? Vec3(Vec3::Zero()) : box.center());
  }
  return middles;
}

// By ToolState::portal of a live run.
std::vector<Portal> portals_of_run(const Case& the_case, const RunSofts& softs) {
  SessionSettings settings;
  if (softs.setup) settings.soft = softs.names;
  auto portals = open_portals(the_case, settings);
  return portals ? std::move(*portals) : std::vector<Portal>();
}

}  // namespace

void CaseControl::open(LoadOrder order, bool as_ordered) {
  if (live_.recording()) {
    host_.note(ToastKind::kWarning, "Stop the recording before opening something else.");
    return;
  }
  failure_.clear();
  order.instruments = live_.wanted_instruments();
  order.at_s = host_.order.at_s;
  if (order.softs.empty()) order.softs = host_.order.give_way;
  order.needs_softs = !scene_.the_case && order.recording.empty();
  // What is measured, recorded, judged or edited from the start is the case as it was ordered.
  const WindowOrder& line = host_.order;
  const bool ordered = line.frames > 0 || !line.record.empty() || !line.edit.empty() || as_ordered;
  order.at_once = line.at_once || !ordered;
  job_ = std::make_unique<SideJob<Loaded>>(
      [order = std::move(order)](const Progress& tell) { return load(order, tell); });
}

void CaseControl::cancel() {
  if (job_) job_->cancel();
}

bool CaseControl::poll(std::optional<Loaded>& loaded) {
  if (!job_ || !job_->done()) return false;
  Result<Loaded> result = job_->take();
  job_.reset();
  if (result)
    loaded = std::move(*result);
  else
    fail_loading(result.error().message());
  return true;
}

// With a case on show, a failure to open another thing is a message beside it.
void CaseControl::fail_loading(const std::string& message) {
  if (scene_.renderer)
    host_.note(ToastKind::kError, message);
  else
    failure_ = message;
}

bool CaseControl::show(Loaded& loaded) {
  const bool same_case = scene_.the_case && source_without_choice(scene_.source) ==
                                                source_without_choice(loaded.case_source);
  if (loaded.prepared) {
    const auto data = find_data_dir();
    if (!data) {
      fail_loading(data.error().message());
      return false;
    }
    live_.drop();
    replay_.end();
    auto renderer = Renderer::create(*loaded.the_case, make_wrist_probe(), *data, *loaded.prepared);
    if (!renderer) {
      fail_loading(renderer.error().message());
      return false;
    }
    // From here on nothing fails: the case on show and its name change together.
    scene_.renderer = std::move(*renderer);
    scene_.views.begin(loaded.the_case, *scene_.renderer, same_case);
    scene_.source = loaded.case_source;
    scene_.the_case = loaded.the_case;
    scene_.bone_middles_B = bone_middles(*scene_.the_case);
    scene_.demo = loaded.demo;
    scene_.carving = loaded.carving.setup;
    scene_.carve = loaded.carve;
    scene_.softs = loaded.softs.softs;
    scene_.portals = portals_of_run(*scene_.the_case, scene_.softs);
    felt_job_.reset();
    felt_known_ = false;
    prepared_ = std::move(loaded.prepared);
    if (!loaded.carving.problem.empty()) host_.note(ToastKind::kWarning, loaded.carving.problem);
    if (!loaded.softs.problem.empty()) host_.note(ToastKind::kWarning, loaded.softs.problem);
    open_bones_ = open_bones(*scene_.the_case);
    if (const std::string notice = open_bones_notice(*scene_.the_case);
        !notice.empty() && !same_case)
      host_.note(ToastKind::kWarning, notice);
    if (loaded.tray) live_.take_tray(std::move(*loaded.tray));
    begin_finer(loaded);
    sight_.begin_case(same_case);
  }
  scene_.source = loaded.case_source;
  host_.settings.recent = with_recent(
      host_.settings.recent, loaded.replay ? loaded.replay->file.string() : scene_.wanted_source());
  live_.drop();
  replay_.end();
  scene_.renderer->clear_cubes();
  return true;
}

void CaseControl::begin_finer(const Loaded& loaded) {
  lighting_.reset();
  refining_.reset();
  scene_.finer_source = loaded.finer_source;
  if (!loaded.lit) lighting_ = std::make_unique<SideJob<PreparedCase>>(light_case(scene_.the_case));
  if (scene_.finer_source.empty()) return;
  refining_ = std::make_unique<SideJob<FinerCase>>(refine_case(
      scene_.finer_source, live_.wanted_instruments(), scene_.softs.names, scene_.carve));
  if (scene_.finer_source == scene_.source)
    return host_.note(ToastKind::kInfo, "You can touch the bones now. Carving will be ready soon.");
  host_.note(ToastKind::kInfo,
             "You can touch the bones now. They feel like their hulls until finer pieces are "
             "ready, in a minute or two.");
}

bool CaseControl::poll_finer(bool at_rest) {
  bool redraw = poll_light();
  if (at_rest) poll_pieces();
  redraw = poll_felt() || redraw;
  return redraw;
}

bool CaseControl::poll_light() {
  if (!lighting_ || !lighting_->done()) return false;
  Result<PreparedCase> lit = lighting_->take();
  lighting_.reset();
  if (!lit) {
    host_.note(ToastKind::kWarning, "Soft shadows: " + lit.error().message());
    return false;
  }
  scene_.renderer->set_surfaces(*lit);
  prepared_ = std::move(*lit);
  return true;
}

void CaseControl::poll_pieces() {
  if (!refining_ || !refining_->done()) return;
  Result<FinerCase> finer = refining_->take();
  refining_.reset();
  if (finer) return exchange(std::move(*finer));
  host_.note(ToastKind::kWarning,
             "Some bones still feel like their hulls. " + finer.error().message());
}

void CaseControl::exchange(FinerCase finer) {
  const bool was_felt = scene_.source == scene_.finer_source;
  // A path that the command line gave is played on.
  if (!host_.order.path.empty()) finer.demo = scene_.demo;
  if (LiveRun* const run = live_.run()) {
    const auto exchanged = run->exchange_case(finer.the_case, finer.source, finer.demo,
                                              finer.carving.setup, finer.softs);
    if (!exchanged) return host_.note(ToastKind::kError, exchanged.error().message());
  }
  scene_.the_case = std::move(finer.the_case);
  scene_.source = std::move(finer.source);
  scene_.demo = std::move(finer.demo);
  scene_.carving = std::move(finer.carving.setup);
  scene_.softs = std::move(finer.softs);
  scene_.portals = portals_of_run(*scene_.the_case, scene_.softs);
  scene_.finer_source.clear();
  scene_.renderer->set_pieces(*scene_.the_case);
  pieces_after_s_ = host_.age_s();
  if (!finer.carving.problem.empty())
    host_.note(ToastKind::kWarning, finer.carving.problem);
  else
    host_.note(ToastKind::kInfo, was_felt ? "Bone can be carved now."
                                          : "The bones now feel like their visible surface.");
}

// Measured when it is first shown: it would double the time that opening takes.
bool CaseControl::poll_felt() {
  bool redraw = false;
  if (felt_job_ && felt_job_->done()) {
    const Result<PreparedCase> measured = felt_job_->take();
    if (!measured)
      host_.note(ToastKind::kWarning,
                 "The felt surface could not be measured: " + measured.error().message());
    else
      scene_.renderer->set_surfaces(*measured);
    felt_job_.reset();
    felt_known_ = redraw = true;
  }
  // What is felt, and the light, may still change.
  if (!ready() || !sight_.view().show_felt || !prepared_ || refining_ || lighting_) return redraw;
  felt_job_ =
      std::make_unique<SideJob<PreparedCase>>(measure_felt(scene_.the_case, std::move(*prepared_)));
  prepared_.reset();
  return redraw;
}

void CaseControl::choose_felt(const FeltWish& wish) {
  if (!scene_.the_case || wish.bone.index >= scene_.the_case->bones.size()) return;
  auto choice = parse_felt_choice(scene_.wanted_source());
  if (!choice) return host_.note(ToastKind::kError, choice.error().message());
  choice->of_bone[scene_.the_case->bone(wish.bone).name] = wish.felt;
  open({to_text(*choice), {}, nullptr});
}

void CaseControl::describe_loading(UiModel& model) const {
  model.phase = failure_.empty() ? UiPhase::kLoading : UiPhase::kFailed;
  model.loading.failure = failure_;
  if (!job_) return;
  const LoadProgress progress = job_->progress();
  model.loading.what = progress.what;
  model.loading.fraction = progress.fraction;
  model.loading.seconds_left = progress.seconds_left;
  model.loading.can_cancel = true;
}

void CaseControl::describe(UiModel& model) const {
  model.bone_open = open_bones_;
  if (felt_job_) model.felt_measured = felt_job_->progress().fraction;
  if (refining_ || lighting_) model.felt_measured = 0;
  if (refining_ && live_.run() && !live_.recording())
    model.activity += (scene_.source == scene_.finer_source ? "; preparing bones for carving, "
                                                            : "; bones feel like hulls, pieces ") +
                      std::to_string(static_cast<int>(100 * refining_->progress().fraction)) + " %";
}

}  // namespace osteon
