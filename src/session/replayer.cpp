#include "replayer.h"

#include <algorithm>

#include "osteon/base/clock.h"

namespace osteon {
namespace {

// Far more than any pair of threads drifts apart, and little memory.
constexpr std::size_t kMostKept = 20000;

RecordStream<TickRecord> ticks_from(const RecordSource& source, std::size_t hand,
                                    std::uint64_t first) {
  return {[&source, hand](std::uint64_t n) { return source.ticks(hand, n); }, first};
}

}  // namespace

Replayer::Replayer(const RecordSource& source, Session& session)
    : source_(source), session_(session), steps_(source.steps, 1) {
  for (std::size_t h = 0; h < session_.hands(); ++h)
    hands_.push_back({ticks_from(source, h, 1), 0, {}, {}, {}, 0});
  snapshots_.push_back(session_.bones());
}

Result<bool> Replayer::begin_at(const StoredState& at) {
  const auto bytes = at.bytes.empty() ? source_.state(at.step) : Result<std::string>(at.bytes);
  if (!bytes) return tl::unexpected(bytes.error());
  const auto state = state_from_bytes(*bytes);
  if (!state) return tl::unexpected(state.error());
  if (auto done = session_.restore(*state); !done) return tl::unexpected(done.error());
  for (std::size_t h = 0; h < hands_.size(); ++h) {
    const HandState& hand = state->hands[h];
    HandTrack& track = hands_[h];
    const std::uint64_t done = hand.haptic.tool.tick;
    if (done != at.ticks[h]) return false;
    track = {ticks_from(source_, h, done + 1), done, {}, hand.seen, {}, at.step};
    if (done > 1) track.kept.push_back(hand.before);
    if (done > 0) track.kept.push_back(hand.haptic.tool);
  }
  if (state->world.bones.step != at.step) return false;
  steps_ = RecordStream<StepRecord>(source_.steps, at.step + 1);
  snapshots_.assign(1, session_.bones());
  used_by_steps_ = {};
  // What comes first consumes the oldest: if that is there, so is all that follows.
  const StepRecord* step = steps_.peek();
  for (std::size_t h = 0; h < hands_.size(); ++h) {
    const TickRecord* tick = hands_[h].records.peek();
    if (tick && tick->bone_step < at.step) return false;
    for (std::size_t k = 0; tick && k < hands_.size(); ++k) {
      const std::uint64_t other = tick->other_ticks[k];
      if (other <= hands_[k].done && !other_tool(hands_[h], k, other)) return false;
    }
    const std::uint64_t pushed = step ? step->tool_ticks[h] : hands_[h].done;
    if (pushed != 0 && pushed <= hands_[h].done && !kept_tool(h, pushed)) return false;
    if (pushed == 0 && hands_[h].done > 0) return false;
  }
  return true;
}

const ToolState* Replayer::kept_tool(std::size_t hand, std::uint64_t tick) const {
  if (tick == 0) return &before_first_;
  const std::deque<ToolState>& kept = hands_[hand].kept;
  if (kept.empty() || tick < kept.front().tick || tick > kept.back().tick) return nullptr;
  return &kept[static_cast<std::size_t>(tick - kept.front().tick)];
}

const BoneSnapshot* Replayer::kept_bones(std::uint64_t step) const {
  const std::uint64_t first = snapshots_.front().step;
  if (step < first || step > snapshots_.back().step) return nullptr;
  return &snapshots_[static_cast<std::size_t>(step - first)];
}

std::optional<OtherTool> Replayer::other_tool(const HandTrack& track, std::size_t hand,
                                              std::uint64_t tick) const {
  if (tick == 0) return OtherTool{};
  if (hand >= hands_.size()) return std::nullopt;
  if (const ToolState* tool = kept_tool(hand, tick)) return seen_from_outside(*tool);
  if (track.seen[hand].tick == tick) return track.seen[hand];
  return std::nullopt;
}

bool Replayer::can_run(const HandTrack& track, const TickRecord& record) {
  for (std::size_t k = 0; k < kMaxHands; ++k)
    if (!other_tool(track, k, record.other_ticks[k])) return false;
  return run_steps_to(record.bone_step) && kept_bones(record.bone_step);
}

bool Replayer::run_steps_to(std::uint64_t step) {
  while (snapshots_.back().step < step)
    if (!run_next_step()) return false;
  return true;
}

bool Replayer::run_next_step() {
  const StepRecord* record = steps_.peek();
  if (!record) return false;
  std::array<const ToolState*, kMaxHands> tools{};
  for (std::size_t h = 0; h < hands_.size(); ++h) {
    tools[h] = kept_tool(h, record->tool_ticks[h]);
    if (!tools[h]) return false;
  }
  const std::int64_t begin_ns = steady_now_ns();
  snapshots_.push_back(
      session_.physics_step(std::span(tools).first(hands_.size()), record->command));
  step_times_.add_ns(steady_now_ns() - begin_ns);
  session_.catch_up();
  elapsed_ns_ += steady_now_ns() - begin_ns;
  used_by_steps_ = record->tool_ticks;
  steps_.pop();
  if (on_step_) on_step_();
  return true;
}

// Of the hands that can go on the one that is farthest behind: the same order in every replay.
std::optional<std::size_t> Replayer::runnable_hand() {
  std::array<std::size_t, kMaxHands> order{};
  for (std::size_t h = 0; h < hands_.size(); ++h) order[h] = h;
  std::sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(hands_.size()),
            [&](std::size_t a, std::size_t b) {
              return hands_[a].done != hands_[b].done ? hands_[a].done < hands_[b].done : a < b;
            });
  for (std::size_t i = 0; i < hands_.size(); ++i) {
    HandTrack& track = hands_[order[i]];
    const TickRecord* record = track.records.peek();
    if (record && can_run(track, *record)) return order[i];
  }
  return std::nullopt;
}

void Replayer::run_tick(std::size_t hand) {
  HandTrack& track = hands_[hand];
  hand_ = hand;
  record_ = *track.records.peek();
  if (change_) change_(record_.command);
  bones_ = kept_bones(record_.bone_step);
  OtherTools others{};
  for (std::size_t k = 0; k < hands_.size(); ++k)
    others[k] = *other_tool(track, k, record_.other_ticks[k]);
  const std::int64_t begin_ns = steady_now_ns();
  const ToolState& tool =
      session_.haptic_tick(hand, record_.input, *bones_, others, record_.command);
  last_tick_ns_ = steady_now_ns() - begin_ns;
  elapsed_ns_ += last_tick_ns_;
  track.kept.push_back(tool);
  track.done = record_.tick;
  track.used = record_.other_ticks;
  track.used_step = record_.bone_step;
  track.records.pop();
}

// What everybody has gone past is not consumed any more.
void Replayer::forget() {
  for (std::size_t h = 0; h < hands_.size(); ++h) {
    std::uint64_t oldest = used_by_steps_[h];
    for (std::size_t k = 0; k < hands_.size(); ++k)
      if (k != h) oldest = std::min(oldest, hands_[k].used[h]);
    std::deque<ToolState>& kept = hands_[h].kept;
    while (kept.size() > 1 && kept.front().tick < oldest) kept.pop_front();
  }
  std::uint64_t oldest_step = ~std::uint64_t{0};
  for (const HandTrack& track : hands_) oldest_step = std::min(oldest_step, track.used_step);
  // The one that the caller looks at stays.
  while (snapshots_.size() > 1 && snapshots_.front().step < oldest_step &&
         &snapshots_.front() != bones_)
    snapshots_.pop_front();
}

bool Replayer::failed() {
  for (const HandTrack& track : hands_)
    if (track.records.error()) error_ = track.records.error();
  if (steps_.error()) error_ = steps_.error();
  for (const HandTrack& track : hands_)
    if (track.kept.size() > kMostKept)
      error_ = Error{"the clocks of the recording run too far apart", "recording",
                     "The file is damaged: use another copy of it"};
  return error_.has_value();
}

Replayer::Outcome Replayer::next() {
  const auto hand = runnable_hand();
  if (failed()) return Outcome::kError;
  if (hand) {
    run_tick(*hand);
    forget();
    return Outcome::kTick;
  }
  while (run_next_step()) {
  }
  if (failed()) return Outcome::kError;
  bool left = steps_.peek() != nullptr;
  for (HandTrack& track : hands_) left = left || track.records.peek() != nullptr;
  return left ? Outcome::kStuck : Outcome::kEnd;
}

}  // namespace osteon
