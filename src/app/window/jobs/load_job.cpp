#include "window/jobs/load_job.h"

#include <algorithm>
#include <utility>

#include "cases/all_cores.h"
#include "cases/open_case.h"
#include "osteon/physics/carving.h"
#include "osteon/render/prepare_unlit.h"
#include "runs/hands/tray.h"
#include "runs/replays/demo_path.h"
#include "window/jobs/replay_filling.h"

namespace osteon {

namespace {

class Loader {
 public:
  struct Cancelled {};
  Loader(const LoadOrder& order, const Progress& progress) : order_(order), progress_(progress) {}
  Result<Loaded> run();

 private:
  Result<void> load_the_recording(Loaded& loaded, Recording& recording);
  Result<void> load_the_case(Loaded& loaded, const std::string& spec, std::uint64_t wanted_hash);
  Result<void> open_at_once(Loaded& loaded, const std::string& spec);
  Result<void> open_whole(Loaded& loaded, const std::string& spec);
  void make_surfaces(Loaded& loaded);
  Result<void> soften(Loaded& loaded);
  Result<void> repeat(Loaded& loaded, const Recording& recording);
  Result<void> repeat_first(LoadedReplay& replay_of);
  /// Reports where the work is; leaves it by an exception when it was cancelled.
  void say(const char* what, double fraction) {
    if (!goes_on(progress_, what, fraction)) throw Cancelled{};
  }

  const LoadOrder& order_;
  const Progress& progress_;
};

Result<Loaded> Loader::run() {
  Loaded loaded;
  Recording recording;
  std::string spec = order_.case_spec;
  std::uint64_t wanted_hash = order_.open ? order_.open->hash : 0;
  if (!order_.recording.empty()) {
    const Result<void> read = load_the_recording(loaded, recording);
    if (!read) return tl::unexpected(read.error());
    spec = recording.header.case_source;
    wanted_hash = recording.header.case_hash;
  }
  const Result<void> opened = load_the_case(loaded, spec, wanted_hash);
  if (!opened) return tl::unexpected(opened.error());
  if (loaded.replay) {
    const Result<void> repeated = repeat(loaded, recording);
    if (!repeated) return tl::unexpected(repeated.error());
  }
  say("Ready", 1);
  return loaded;
}

Result<void> Loader::load_the_recording(Loaded& loaded, Recording& recording) {
  say("Reading the recording", 0);
  auto read = load_recording(order_.recording);
  if (!read) return tl::unexpected(read.error());
  recording = std::move(*read);
  loaded.replay.emplace();
  loaded.replay->file = order_.recording;
  loaded.replay->header = recording.header;
  loaded.replay->complete = recording.complete;
  return {};
}

Result<void> Loader::load_the_case(Loaded& loaded, const std::string& spec,
                                   std::uint64_t wanted_hash) {
  loaded.case_source = spec;
  if (order_.open && order_.open->hash == wanted_hash && !order_.recording.empty()) {
    loaded.the_case = order_.open;
  } else {
    const bool at_once = order_.at_once && order_.recording.empty();
    auto opened = at_once ? open_at_once(loaded, spec) : open_whole(loaded, spec);
    if (!opened) return opened;
  }
  if (auto softened = soften(loaded); !softened) return softened;
  say("Planning the demonstration", 0.7);
  loaded.demo = demo_path(*loaded.the_case, spec);
  return {};
}

Result<void> Loader::open_at_once(Loaded& loaded, const std::string& spec) {
  auto opened = open_case_at_once(
      spec, [this](const char* what, double share) { say(what, 0.05 + 0.45 * share); });
  if (!opened) return tl::unexpected(opened.error());
  loaded.the_case = std::move(opened->the_case);
  loaded.case_source = std::move(opened->spec);
  loaded.finer_source = std::move(opened->finer);
  // What it takes to carve it can wait.
  if (loaded.finer_source.empty() && has_field(*loaded.the_case))
    loaded.finer_source = loaded.case_source;
  make_surfaces(loaded);
  loaded.lit = false;
  return {};
}

// Surfaces and tray at the same time, as far as there are processors.
void Loader::make_surfaces(Loaded& loaded) {
  const Case& the_case = *loaded.the_case;
  const std::size_t bones = the_case.bones.size(), softs = the_case.softs.size();
  PreparedCase& prepared = loaded.prepared.emplace();
  prepared.bones.resize(bones);
  prepared.softs.resize(softs);
  const auto task = [&](std::size_t i) {
    if (i == 0)
      loaded.tray = prepare_tray(region_of(the_case), order_.instruments);
    else if (i <= bones)
      prepared.bones[i - 1] = unlit_bone(the_case, i - 1);
    else
      prepared.softs[i - 1 - bones] = unlit_soft(the_case, i - 1 - bones);
  };
  run_on_all_cores(1 + bones + softs, task,
                   [&](double share) { say("Building the surfaces", 0.5 + 0.2 * share); });
}

Result<void> Loader::open_whole(Loaded& loaded, const std::string& spec) {
  auto opened =
      open_case(spec, [this](const char* what, double share) { say(what, 0.05 + 0.35 * share); });
  if (!opened) return tl::unexpected(opened.error());
  loaded.the_case = std::move(*opened);
  constexpr const char* kLight = "Computing soft shadows";
  say(kLight, 0.4);
  loaded.prepared = prepare_case(*loaded.the_case, [this](double share) {
    return goes_on(progress_, kLight, 0.4 + 0.3 * share);
  });
  loaded.tray = prepare_tray(region_of(*loaded.the_case), order_.instruments);
  say("Preparing bones for carving", 0.7);
  loaded.carving = prepare_carving(*loaded.the_case, loaded.tray->tray, order_.carve);
  loaded.carve = order_.carve;
  return {};
}

Result<void> Loader::soften(Loaded& loaded) {
  if (order_.softs.empty() || !loaded.tray) return {};
  say("Preparing ligaments and menisci", 0.7);
  loaded.softs = prepare_softs(*loaded.the_case, loaded.tray->tray, order_.softs);
  if (order_.needs_softs && !loaded.softs.problem.empty()) return fail(loaded.softs.problem);
  return {};
}

Result<void> Loader::repeat(Loaded& loaded, const Recording& recording) {
  LoadedReplay& replay_of = *loaded.replay;
  const auto settings = parse_settings(recording.header.settings_json);
  if (!settings) return tl::unexpected(settings.error());
  ReplayOptions options;
  auto tray = make_tray(settings->tray, settings->probe_radius_m);
  if (!tray) return tl::unexpected(tray.error());
  options.tray = *tray;
  auto carving = carving_for(*loaded.the_case, *settings);
  if (!carving) return tl::unexpected(carving.error());
  options.carving = replay_of.carving = std::move(*carving);
  options.on_cuts = [&](const CutsPatch& patch, double time_s) {
    replay_of.cuts.add(patch, time_s);
  };
  auto softs = softs_for(*loaded.the_case, *settings);
  if (!softs) return tl::unexpected(softs.error());
  options.softs = replay_of.softs = std::move(*softs);
  SoftPushes pushes;
  options.on_pushes = [&](const SoftPushes& now) { pushes = now; };
  const bool from_the_start = options.carving || options.softs;
  replay_of.tray = std::move(*tray);
  if (replay_of.tray.empty())
    replay_of.tray.push_back(
        std::make_shared<const Tool>(make_wrist_probe(settings->probe_radius_m)));
  replay_of.instruments = settings->tray;
  auto portals = open_portals(*loaded.the_case, *settings);
  if (!portals) return tl::unexpected(portals.error());
  replay_of.portals = std::move(*portals);
  for (const HandSettings& hand : settings->hands) replay_of.hands.push_back(hand.name);
  replay_of.more.resize(settings->hands.size() - 1);
  if (!from_the_start) {
    ReplayOptions how;
    how.tray = options.tray;
    auto filling = ReplayFilling::plan(order_.recording, loaded.the_case, how);
    if (!filling) return tl::unexpected(filling.error());
    replay_of.filling = std::move(*filling);
  }
  if (replay_of.filling) return repeat_first(replay_of);
  const double total = static_cast<double>(std::max<std::size_t>(1, recording.ticks.size()));
  options.on_tick = [&](std::size_t hand, const ToolState& tool, const BoneSnapshot& bones,
                        std::span<const Event> events) {
    ReplayTrack& track = hand == 0 ? replay_of.track : replay_of.more[hand - 1];
    track.add(tool, bones);
    if (hand == 0) replay_of.pushes.add(pushes, tool.time_s);
    for (const Event& event : events) replay_of.events.add(event, settings->haptic.tick_s);
    if (hand == 0 && tool.tick % 500 == 0)
      say("Replaying the recorded run", 0.75 + 0.25 * static_cast<double>(tool.tick) / total);
  };
  const auto outcome = replay(recording, loaded.the_case, options);
  if (!outcome) return tl::unexpected(outcome.error());
  if (replay_of.track.empty())
    return fail("the recording holds no ticks", order_.recording.string(), "Record a longer run");
  replay_of.identical = outcome->identical;
  replay_of.first_different_tick = outcome->first_different_tick;
  replay_of.ticks = outcome->ticks;
  replay_of.duration_s = replay_of.track.duration_s();
  return {};
}

// What the user looks at; the rest follows beside the window.
Result<void> Loader::repeat_first(LoadedReplay& replay_of) {
  say("Replaying the recorded run", 0.75);
  replay_of.duration_s = replay_of.filling->duration_s();
  const auto filled = replay_of.filling->fill_at(order_.at_s, replay_of, progress_);
  if (!filled) return filled;
  if (replay_of.track.empty())
    return fail("the recording holds no ticks", order_.recording.string(), "Record a longer run");
  return {};
}

}  // namespace

bool has_field(const Case& the_case) {
  return std::any_of(the_case.bones.begin(), the_case.bones.end(),
                     [](const Bone& bone) { return is_field(bone.felt); });
}

// A bone that cannot be carved is seen and felt all the same.
PreparedCarving prepare_carving(const Case& the_case, const InstrumentTray& tray,
                                const CarveSettings& carve) {
  if (!can_carve(the_case, tray.run().names)) return {};
  auto carving = carving_for_run(the_case, tray.run().names, carve);
  if (!carving) return {nullptr, carving.error().message()};
  return {std::move(*carving), {}};
}

PreparedSofts prepare_softs(const Case& the_case, const InstrumentTray& tray,
                            const std::vector<std::string>& names) {
  SessionSettings settings;
  settings.soft = names;
  settings.tray = tray.run().names;
  auto setup = softs_for(the_case, settings);
  if (!setup) return {{}, setup.error().message()};
  return {{names, std::move(*setup)}, {}};
}

Result<Loaded> load(const LoadOrder& order, const Progress& progress) {
  try {
    return Loader(order, progress).run();
  } catch (const Loader::Cancelled&) {
    return fail("the loading was cancelled");
  }
}

}  // namespace osteon
