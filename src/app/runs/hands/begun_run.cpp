#include "runs/hands/begun_run.h"

#include <algorithm>
#include <optional>
#include <system_error>
#include <utility>

#include "osteon/physics/soft_setup.h"
#include "osteon/record/recording.h"
#include "runs/hands/tray.h"

namespace osteon {
namespace {

constexpr double kQueued_s = 8;             // of the feed of a live run
constexpr std::uint64_t kDrainTicks = 500;  // far less than that
constexpr const char* kRecordAgain = "Record it again with this version of Osteon";

// Where each instrument of the recording stands in the tray of the run.
Result<std::vector<std::uint32_t>> places_of(const BegunOrder& order,
                                             std::vector<std::string> recorded) {
  if (recorded.empty()) recorded.push_back(kWristProbe);
  std::vector<std::uint32_t> places;
  for (const std::string& name : recorded) {
    const auto place = order.place(name);
    if (!place || *place >= order.tray.tools.size())
      return fail("the tray has no '" + name + "', which the recording uses", "tray", kRecordAgain);
    places.push_back(*place);
  }
  return places;
}

std::uint32_t place_of(const std::vector<std::uint32_t>& places, std::uint32_t recorded) {
  return recorded < places.size() ? places[recorded] : 0;
}

// As recorded, with the tray of the run and what was made for that.
Result<SessionSettings> settings_for_begin(const BegunOrder& order, const RecordingHeader& header,
                                           const std::vector<std::uint32_t>& places) {
  auto settings = parse_settings(header.settings_json);
  if (!settings) return settings;
  const bool carves = order.tray.carving != nullptr;
  // Where nothing that the recording holds removes bone, a run that could repeats it all the same.
  if ((settings->carve.on && !carves) || settings->soft != order.tray.softs.names)
    return fail("bones or soft parts of the recording were felt otherwise", order.begin.string(),
                kRecordAgain);
  settings->tray = order.tray.names;
  for (auto& hand : settings->hands) hand.instrument = place_of(places, hand.instrument);
  settings->carve = order.tray.carve;
  settings->carve.on = carves;
  settings->soft_hash = order.tray.softs.setup ? order.tray.softs.setup->hash : 0;
  return settings;
}

// One run that repeats another's begin.
class Beginning {
 public:
  Beginning(const BegunOrder& order, BegunRun run) : order_(order), run_(std::move(run)) {
    run_.tools.resize(run_.session->hands());
    for (const ToolState& tool : run_.tools) tools_.push_back(&tool);
  }

  Result<BegunRun> follow(RecordingReader& recording, std::vector<std::uint32_t> places) {
    if (order_.at_begin) order_.at_begin(*run_.carved);
    RepeatOptions how;
    how.on_step = [this] { add_step(); };
    how.on_tick = [this](std::size_t hand, const BoneSnapshot& bones) {
      return add_tick(hand, bones);
    };
    how.change = [&places](Command& command) {
      if (command.kind == CommandKind::kTake)
        command.value = place_of(places, static_cast<std::uint32_t>(command.value));
    };
    if (auto ok = repeat(recording, *run_.session, how); !ok) return tl::unexpected(ok.error());
    run_.feed->drain();
    if (const std::string why = run_.feed->early_end(); !why.empty())
      return fail(why, order_.file.string());
    if (!enough_)
      return fail("the recording ends before what was asked for", order_.begin.string());
    return std::move(run_);
  }

 private:
  void add_step() {
    const Session& session = *run_.session;
    run_.feed->push(session.last_step_record());
    show_cuts();
    if (session.bones().saved_step != session.bones().step) return;
    run_.feed->drain();
    run_.feed->add(stored_state(session));
  }

  bool add_tick(std::size_t hand, const BoneSnapshot& bones) {
    const Session& session = *run_.session;
    run_.feed->push(hand, session.last_tick_record(hand), session.last_events(hand));
    run_.tools[hand] = session.tool_state(hand);
    const std::uint64_t tick = run_.tools.front().tick;
    const bool all = std::all_of(run_.tools.begin(), run_.tools.end(),
                                 [&](const ToolState& tool) { return tool.tick == tick; });
    if (!all) return true;
    if (tick % kDrainTicks == 0) run_.feed->drain();
    enough_ = !order_.on_tick(tools_, bones);
    return !enough_ && run_.feed->early_end().empty();
  }

  void show_cuts() {
    CutsFeed* const feed = run_.session->cuts_feed();
    while (feed && feed->take(patch_)) run_.carved->take(patch_);
  }

  const BegunOrder& order_;
  BegunRun run_;
  std::vector<const ToolState*> tools_;
  CutsPatch patch_;
  bool enough_ = false;
};

}  // namespace

Result<BegunRun> begin_run(const BegunOrder& order) {
  auto recording = RecordingReader::open(order.begin);
  if (!recording) return tl::unexpected(recording.error());
  const auto recorded = parse_settings(recording->header().settings_json);
  if (!recorded) return tl::unexpected(recorded.error());
  const auto places = places_of(order, recorded->tray);
  if (!places) return tl::unexpected(places.error());
  auto settings = settings_for_begin(order, recording->header(), *places);
  if (!settings) return tl::unexpected(settings.error());
  BegunRun run;
  run.settings = std::move(*settings);
  run.file = order.file;
  run.session = std::make_unique<Session>(order.the_case, run.settings, order.tray.tools,
                                          order.tray.carving, order.tray.softs.setup);
  run.carved = std::make_unique<CarvedPicture>(order.tray.carving);
  RecordingHeader header = recording_header(*order.the_case, run.settings, order.case_source,
                                            OSTEON_VERSION, order.tray.tools);
  header.case_path = absolute_case_path(order.case_source);
  auto writer = RecordingWriter::create(order.file, header);
  if (!writer) return tl::unexpected(writer.error());
  run.feed = std::make_unique<RecordFeed>(std::move(*writer), kQueued_s, run.session->hands());
  auto begun = Beginning(order, std::move(run)).follow(*recording, *places);
  if (begun) return begun;
  std::error_code ec;
  for (const char* end : {"", "-wal", "-shm"})
    std::filesystem::remove(order.file.string() + end, ec);
  return begun;
}

}  // namespace osteon
