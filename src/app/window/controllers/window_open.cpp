#include <utility>

#include "cases/felt_choice.h"
#include "osteon/base/file.h"
#include "osteon/scene/path.h"
#include "window/window_app.h"

namespace osteon {
namespace fs = std::filesystem;

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

}  // namespace

void WindowApp::open(LoadOrder order) {
  if (live_ && live_->recording()) {
    note(ToastKind::kWarning, "Stop the recording before opening something else.");
    return;
  }
  load_failure_.clear();
  order.instruments = instruments_;
  // What is measured, recorded, judged or edited from the start is the case as it was ordered.
  const bool ordered = order_.frames > 0 || !order_.record.empty() || !order_.edit.empty() ||
                       exercise_.page() == ExercisePage::kOpening;
  order.at_once = order_.at_once || !ordered;
  job_ = std::make_unique<SideJob<Loaded>>(
      [order = std::move(order)](const Progress& tell) { return load(order, tell); });
}

void WindowApp::poll_loading() {
  if (!job_ || !job_->done()) return;
  Result<Loaded> loaded = job_->take();
  job_.reset();
  if (!loaded) {
    end_bend();
    return fail_loading(loaded.error().message());
  }
  install(std::move(*loaded));
  end_bend();
  if (!order_.film.empty()) begin_film(std::exchange(order_.film, {}));
  if (std::exchange(order_.new_patient, false)) apply_patient({.toggle = true});
  if (!order_.exercise.empty()) show_exercise(std::exchange(order_.exercise, {}));
  if (!std::exchange(order_.checkup, false)) return;
  checkup_open_ = true;
  begin_checkup(false);
}

// With a case on show, a failure to open another thing is a message beside it.
void WindowApp::fail_loading(const std::string& message) {
  if (renderer_)
    note(ToastKind::kError, message);
  else
    load_failure_ = message;
}

void WindowApp::install(Loaded loaded) {
  end_checkup();
  end_edit();
  remember_looks();
  if (case_) remember_view();  // a light that was turned is not turned back
  // The same case felt otherwise: the user goes on looking at what he looked at.
  const bool same_case =
      case_ && source_without_choice(case_source_) == source_without_choice(loaded.case_source);
  if (loaded.prepared) {
    const auto data = find_data_dir();
    if (!data) return fail_loading(data.error().message());
    live_.reset();
    replay_.reset();
    auto renderer = Renderer::create(*loaded.the_case, make_wrist_probe(), *data, *loaded.prepared);
    if (!renderer) return fail_loading(renderer.error().message());
    renderer_ = std::move(*renderer);
    views_.begin(loaded.the_case, *renderer_);
    // From here on nothing fails: the case on show and its name change together.
    case_source_ = loaded.case_source;
    felt_job_.reset();
    felt_known_ = false;
    prepared_ = std::move(loaded.prepared);
    case_ = loaded.the_case;
    portals_ = find_portals(*case_);
    tip_.begin(case_);
    bone_middles_B_ = bone_middles(*case_);
    demo_ = loaded.demo;
    carving_ = loaded.carving;
    if (!loaded.carving_problem.empty()) note(ToastKind::kWarning, loaded.carving_problem);
    begin_refining(loaded);
    const ViewState before = view_;
    const BoneId picked = picked_;
    recall_view();
    if (same_case) {
      view_ = before;
      picked_ = picked;
    }
  }
  case_source_ = loaded.case_source;
  settings_.recent =
      with_recent(settings_.recent, loaded.replay ? loaded.replay->file.string() : wanted_source());
  live_.reset();
  replay_ = std::move(loaded.replay);
  player_.reset();
  carved_.reset();
  carved_place_ = 0;
  renderer_->clear_cubes();
  aimed_.reset();
  marks_.clear();
  marks_told_ = 0;
  if (!replay_ && exercise_.page() == ExercisePage::kOpening) return begin_exercise();
  if (!replay_) return begin_live();
  renderer_->set_tray(replay_->tray);
  if (replay_->carving) carved_.emplace(replay_->carving);
  tell_tray(replay_->instruments, replay_->tray);
  player_.emplace(replay_->track.duration_s());
  player_->seek(order_.at_s);
  if (order_.frames > 0 && order_.at_s > 0) player_->toggle();  // the ordered moment stands still
  if (!replay_->complete)
    note(ToastKind::kWarning,
         "This recording was cut short, by a crash or a power cut; all that was saved is here.");
}

// The first run after something was opened: what the command line ordered counts once.
void WindowApp::begin_live() {
  if (!order_.path.empty()) {
    const auto path = load_path(order_.path);
    if (path) demo_ = *path;
    if (!path) note(ToastKind::kError, path.error().message());
  }
  const std::vector<std::string> devices = std::exchange(order_.devices, {});
  if (devices.empty() || !start_hands(devices))
    start_live(order_.demo ? "virtual" : settings_.device);
  if (live_ && !order_.edit.empty()) {
    picked_ = case_->find(std::exchange(order_.edit, {}));
    begin_edit();
  }
  if (!live_ || order_.record.empty()) return;
  const Result<void> started = live_->start_recording(std::exchange(order_.record, {}));
  if (!started) note(ToastKind::kError, started.error().message());
}

MappingSettings WindowApp::mapping_for(const DeviceChoice& choice) const {
  return mapping_of(settings_.mappings, mapping_key(choice.info, case_->name));
}

void WindowApp::make_live() {
  remember_feel();
  const FeelSettings feel{settings_.stiffness_n_per_m, settings_.friction_scale,
                          settings_.bones_held};
  RunTray tray = tray_.run();
  tray.carving = carving_;
  live_ = std::make_unique<LiveRun>(case_, case_source_, tray_.sized(demo_), feel, std::move(tray));
  carved_run_ = 0;
  live_->keep_force_log(order_.force_log);
  pedals_.set_map(settings_.pedals);
}

void WindowApp::start_live(const std::string& device) {
  if (choices_.empty() || !case_) return;
  make_tray();
  make_live();
  const DeviceChoice& choice = choices_[static_cast<std::size_t>(find_choice(choices_, device))];
  const Result<void> started = live_->start(choice, offered_probe(view_.camera, case_->bounds_W()),
                                            mapping_for(choice), view_.camera.q_WC);
  if (!started) note(ToastKind::kError, started.error().message());
}

// The case is opened again: what is felt is part of it, and of what a recording names.
void WindowApp::choose_felt(const FeltWish& wish) {
  if (!case_ || wish.bone.index >= case_->bones.size()) return;
  auto choice = parse_felt_choice(wanted_source());
  if (!choice) return note(ToastKind::kError, choice.error().message());
  choice->of_bone[case_->bone(wish.bone).name] = wish.felt;
  open({to_text(*choice), {}, nullptr});
}

// What was carved since the picture before. A processor that draws has to draw all of it anew then.
void WindowApp::show_carved() {
  constexpr double kRest_s = 0.1;
  if (live_ && carved_run_ != live_->run_number()) renderer_->clear_cubes();
  carved_run_ = live_ ? live_->run_number() : 0;
  if (renderer_->software_driver() && now_s_ - carved_s_ < kRest_s) return;
  if (replay_ && player_ && carved_)
    carved_place_ = replay_->cuts.show(player_->position_s(), carved_place_, *carved_);
  CarvedPicture* const picture = live_ ? &live_->carved() : carved_ ? &*carved_ : nullptr;
  if (!picture) return;
  for (const CarvedPicture::Changed& changed : picture->changes()) {
    renderer_->set_cubes(changed.bone, changed.grid, changed.cubes);
    carved_s_ = now_s_;
  }
}

// Measured when it is first shown: it would double the time that opening takes.
void WindowApp::poll_felt() {
  if (felt_job_ && felt_job_->done()) {
    const Result<PreparedCase> measured = felt_job_->take();
    if (!measured)
      note(ToastKind::kWarning,
           "What is felt could not be measured: " + measured.error().message());
    else
      renderer_->set_surfaces(*measured);
    edit_drawn_ = kEditNotDrawn;
    felt_job_.reset();
    felt_known_ = true;
  }
  // What is felt, and the light, may still change.
  if (!ready() || !view_.show_felt || !prepared_ || refining_ || lighting_) return;
  felt_job_ = std::make_unique<SideJob<PreparedCase>>(measure_felt(case_, std::move(*prepared_)));
  prepared_.reset();
}

ViewState WindowApp::picture_view() const {
  ViewState view = view_;
  view.show_felt = view.show_felt && felt_known_;
  hide_while_bending(view);
  return view;
}

void WindowApp::leave_replay() {
  replay_.reset();
  player_.reset();
  carved_.reset();
  renderer_->clear_cubes();
  start_live(settings_.device);
}

}  // namespace osteon
