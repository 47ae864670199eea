#include "exercises/ghost/begun_attempt.h"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <system_error>
#include <utility>

#include "osteon/record/recording.h"
#include "osteon/record/recording_note.h"

namespace osteon {
namespace {

constexpr std::uint64_t kAskTicks = 200;
constexpr double kPlayedShare = 0.5;  // of the work, where the expert has to play first

// `carved`: what is left of the bones while the begin is repeated; known once that begins.
std::unique_ptr<AttemptWatch> watch_begin(const BegunAttemptOrder& order,
                                          const CarvedPicture* const& carved,
                                          const AttemptPart& part, PartStages stages,
                                          double tick_s) {
  auto watch = std::make_unique<AttemptWatch>(*order.plan, *order.the_case, order.hands, tick_s);
  TunnelSources sources;
  sources.case_spec = order.wanted.case_spec;
  sources.tray = order.tray.names;
  sources.carved = [&carved](std::uint32_t bone) { return carved->cut_bone(bone); };
  sources.graft = order.graft;
  watch->watch_tunnels(std::move(sources));
  watch->watch_tray(order.tray.names);
  watch->set_part(part, stages);
  return watch;
}

// When the expert had done the stage before the part, as his report tells; 0: it does not.
double begin_of_part_s(const std::filesystem::path& expert, const std::string& stage) {
  const auto report = read_note(expert, "report");
  if (!report || !*report) return 0;
  const auto json = nlohmann::json::parse(**report, nullptr, false);
  if (!json.is_object() || !json.contains("stages")) return 0;
  for (const auto& done : json["stages"])
    if (done.value("name", "") == stage && done["completed_s"].is_number())
      return done["completed_s"].get<double>();
  return 0;
}

Result<BegunAttempt> repeat_begin(const BegunAttemptOrder& order,
                                  const std::filesystem::path& expert, PartStages stages,
                                  double from_share, const Progress& progress) {
  BegunAttempt begun;
  begun.part = order.part;
  begun.part.from_tick = std::numeric_limits<std::uint64_t>::max();
  const double tick_s = SessionSettings{}.haptic.tick_s;
  const CarvedPicture* carved = nullptr;
  begun.watch = watch_begin(order, carved, begun.part, stages, tick_s);
  const std::string& before = order.wanted.scenario.stages[stages.first - 1].name;
  const double whole_s = begin_of_part_s(expert, before);
  bool stopped = false;
  BegunOrder run{
      expert, order.file, order.the_case, order.wanted.case_spec, order.tray, order.place, {}, {}};
  run.at_begin = [&](const CarvedPicture& picture) { carved = &picture; };
  run.on_tick = [&](std::span<const ToolState* const> tools, const BoneSnapshot& bones) {
    begun.watch->add(tools, bones);
    begun.part.from_tick = tools[0]->tick;
    const ScenarioState& state = begun.watch->state();
    const double share = whole_s > 0 ? std::min(1.0, tools[0]->time_s / whole_s) : 0.0;
    if (tools[0]->tick % kAskTicks == 0)
      stopped =
          !progress("The expert does the stages before", from_share + (1 - from_share) * share);
    return !stopped && !state.over && state.stage < stages.first;
  };
  auto made = begin_run(run);
  if (!made) return tl::unexpected(made.error());
  const bool came = begun.watch->state().stage >= stages.first && !begun.watch->state().over;
  if (stopped || !came) {
    made->feed.reset();  // closes its file
    std::error_code ec;
    std::filesystem::remove(order.file, ec);
    return fail(stopped ? "stopped" : "the virtual expert does not come to this stage",
                order.wanted.case_spec);
  }
  begun.watch->set_part(begun.part, stages);
  begun.watch->go_on_live({});  // `carved` ends here
  begun.run = std::move(*made);
  return begun;
}

// One of an older build, or a damaged one, is made anew.
bool is_of_this_build(const std::filesystem::path& expert) {
  const auto reader = RecordingReader::open(expert);
  return reader && reader->complete() && reader->header().osteon_version == OSTEON_VERSION;
}

// Who works to the exercise's end need not wait for all that the expert would do: he plays the rest
// meanwhile, to be shown.
GhostWanted as_far_as(const GhostWanted& wanted, PartStages stages) {
  GhostWanted begin = wanted;
  if (begin.to_stage.empty()) begin.to_stage = begin.scenario.stages[stages.first - 1].name;
  return begin;
}

// He plays once for a patient, in minutes.
std::string expert_plays(int for_s) {
  char time[16];
  std::snprintf(time, sizeof time, "%d:%02d", for_s / 60, for_s % 60);
  return std::string("The expert plays it on this patient, this once: ") + time + " so far";
}

}  // namespace

Result<BegunAttempt> begin_attempt(const BegunAttemptOrder& order, const Progress& progress) {
  const auto stages = stages_of(order.part, order.wanted.scenario);
  if (!stages) return tl::unexpected(stages.error());
  if (stages->first == 0) return fail("nothing comes before this stage", order.part.from);
  const GhostWanted wanted = as_far_as(order.wanted, *stages);
  const std::filesystem::path kept = kept_expert(wanted);
  std::error_code ec;
  if (std::filesystem::exists(kept, ec) && !is_of_this_build(kept))
    std::filesystem::remove(kept, ec);
  const bool known = std::filesystem::exists(kept, ec);
  // How long an expert will take is not known beforehand; that he is at it, is.
  const auto begun = std::chrono::steady_clock::now();
  int told_s = -1;
  const auto go_on = [&] {
    const auto lasted = std::chrono::steady_clock::now() - begun;
    const auto now_s = static_cast<int>(std::chrono::duration<double>(lasted).count());
    if (known || now_s == told_s) return progress(nullptr, 0);
    told_s = now_s;
    return progress(expert_plays(now_s).c_str(), 0);
  };
  const auto expert = recorded_expert(wanted, go_on, order.program);
  if (!expert) return tl::unexpected(expert.error());
  // Who has never recorded anything has no folder for it yet.
  std::filesystem::create_directories(order.file.parent_path(), ec);
  return repeat_begin(order, *expert, *stages, known ? 0 : kPlayedShare, progress);
}

}  // namespace osteon
