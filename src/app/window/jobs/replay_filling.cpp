#include "window/jobs/replay_filling.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "loops/realtime.h"

namespace osteon {
namespace {

// Thrown through the replay, which knows no other way to be stopped.
struct StoppedFilling {};

constexpr double kShortest_s = 2;  // marks may leave states close together
// The first hand's clock may be behind another's, whose ticks up to the next state count too.
constexpr double kBehind_s = 0.05;
constexpr std::uint64_t kTicksBetweenLooks = 500;

std::vector<ReplayStretch> stretches_of(const std::vector<StoredState>& states, double tick_s,
                                        std::uint64_t ticks) {
  std::vector<ReplayStretch> out(1);
  const auto seconds = [&](std::uint64_t tick) { return static_cast<double>(tick) * tick_s; };
  for (const StoredState& state : states) {
    const double time_s = seconds(state.ticks[0]);
    if (time_s < out.back().begin_s + kShortest_s || time_s > seconds(ticks) - kShortest_s)
      continue;
    out.back().last = state.ticks;
    out.back().end_s = time_s;
    out.push_back({state.ticks, {}, time_s, 0});
  }
  out.back().last.fill(std::numeric_limits<std::uint64_t>::max());
  out.back().end_s = seconds(ticks);
  return out;
}

Result<RepeatedStretch> repeat_stretch(const std::filesystem::path& file,
                                       const std::shared_ptr<const Case>& the_case,
                                       ReplayOptions how, std::size_t hands,
                                       const ReplayStretch& stretch, const Progress& tell) {
  auto reader = RecordingReader::open(file);
  if (!reader) return tl::unexpected(reader.error());
  RepeatedStretch out;
  out.tracks.resize(hands);
  how.from_s = stretch.begin_s;
  how.to_s = stretch.end_s + kBehind_s;
  how.on_tick = [&](std::size_t hand, const ToolState& tool, const BoneSnapshot& bones,
                    std::span<const Event>) {
    if (tool.tick % kTicksBetweenLooks == 0 && !goes_on(tell, nullptr, 0)) throw StoppedFilling{};
    if (tool.tick <= stretch.after[hand] || tool.tick > stretch.last[hand]) return;
    if (hand == 0) ++out.ticks;
    out.tracks[hand].add(tool, bones);
  };
  try {
    const auto outcome = replay(*reader, the_case, how);
    if (!outcome) return tl::unexpected(outcome.error());
    out.identical = outcome->identical;
    out.first_different_tick = outcome->first_different_tick;
  } catch (const StoppedFilling&) {
    return stopped();
  }
  return out;
}

Result<void> add_events(RecordingReader& reader, double tick_s, RunEvents& into) {
  for (std::uint64_t next = 1;;) {
    const auto events = reader.read_events(next);
    if (!events) return tl::unexpected(events.error());
    if (events->empty()) return {};
    next += events->size();
    for (const Event& event : *events) into.add(event, tick_s);
  }
}

}  // namespace

Result<std::shared_ptr<ReplayFilling>> ReplayFilling::plan(const std::filesystem::path& file,
                                                           std::shared_ptr<const Case> the_case,
                                                           const ReplayOptions& how) {
  auto reader = RecordingReader::open(file);
  if (!reader) return tl::unexpected(reader.error());
  const auto settings = parse_settings(reader->header().settings_json);
  if (!settings) return tl::unexpected(settings.error());
  const auto states = reader->states();
  if (!states) return tl::unexpected(states.error());
  std::shared_ptr<ReplayFilling> made(new ReplayFilling);
  made->stretches_ = stretches_of(*states, settings->haptic.tick_s, reader->ticks(0));
  if (made->stretches_.size() < 2) return std::shared_ptr<ReplayFilling>();
  made->file_ = file;
  made->case_ = std::move(the_case);
  made->how_ = how;
  made->hands_ = reader->header().hands;
  made->done_.resize(made->stretches_.size());
  return made;
}

std::size_t ReplayFilling::index_at(double time_s) const {
  const auto later =
      std::upper_bound(stretches_.begin() + 1, stretches_.end(), time_s,
                       [](double t, const ReplayStretch& stretch) { return t < stretch.begin_s; });
  return static_cast<std::size_t>(later - stretches_.begin()) - 1;
}

SideJob<RepeatedStretch>::Work ReplayFilling::work_for(std::size_t index) const {
  return [file = file_, the_case = case_, how = how_, hands = hands_,
          stretch = stretches_[index]](const Progress& tell) {
    take_late_turns();
    return repeat_stretch(file, the_case, how, hands, stretch, tell);
  };
}

void ReplayFilling::add(std::size_t index, const RepeatedStretch& repeated, LoadedReplay& into) {
  if (done_[index]) return;
  done_[index] = true;
  ++filled_;
  into.track.join(repeated.tracks[0]);
  into.more.resize(hands_ - 1);
  for (std::size_t h = 1; h < hands_; ++h) into.more[h - 1].join(repeated.tracks[h]);
  into.ticks += repeated.ticks;
  if (repeated.identical) return;
  const bool first = into.identical || repeated.first_different_tick < into.first_different_tick;
  if (first) into.first_different_tick = repeated.first_different_tick;
  into.identical = false;
}

Result<void> ReplayFilling::fill_at(double time_s, LoadedReplay& into, const Progress& progress) {
  if (into.events.events().empty()) {
    auto reader = RecordingReader::open(file_);
    if (!reader) return tl::unexpected(reader.error());
    const auto settings = parse_settings(reader->header().settings_json);
    if (!settings) return tl::unexpected(settings.error());
    if (auto ok = add_events(*reader, settings->haptic.tick_s, into.events); !ok) return ok;
  }
  const std::size_t index = index_at(time_s);
  if (done_[index]) return {};
  const auto repeated = repeat_stretch(file_, case_, how_, hands_, stretches_[index], progress);
  if (!repeated) return tl::unexpected(repeated.error());
  add(index, *repeated, into);
  return {};
}

Result<void> ReplayFilling::poll(double time_s, LoadedReplay& into) {
  if (job_ && job_->done()) {
    const auto repeated = job_->take();
    job_.reset();
    over_ = !repeated;
    if (over_) return tl::unexpected(repeated.error());
    add(under_way_, *repeated, into);
  }
  if (job_ || over_ || whole()) return {};
  under_way_ = index_at(time_s);
  while (done_[under_way_]) under_way_ = (under_way_ + 1) % stretches_.size();
  job_ = std::make_unique<SideJob<RepeatedStretch>>(work_for(under_way_));
  return {};
}

}  // namespace osteon
