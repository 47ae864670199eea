#include "osteon/procedure/placing_watch.h"

#include "osteon/scene/case.h"

namespace osteon {
namespace {

void tell_placing(std::uint64_t tick, EventKind kind, std::array<double, 3> values,
                  std::vector<Event>& out) {
  Event event;
  event.tick = tick;
  event.kind = kind;
  event.hand = 0;
  event.values = values;
  out.push_back(event);
}

}  // namespace

PlacingWatch::PlacingWatch(const Case& the_case) : plan_(find_placing(the_case)) {}

void PlacingWatch::add(std::uint64_t tick, const BoneSnapshot& bones, std::vector<Event>& out) {
  if (!plan_ || !bones.placing.on) return;
  const GraftPlacingState &now = bones.placing, &was = seen_;
  const double beyond_mm = 1e3 * (now.drawn_m - plan_->button_out_m());
  if (now.lost > was.lost) tell_placing(tick, kThreadLost, {double(now.lost), 0, 0}, out);
  if (now.phase != was.phase && now.phase == PlacingPhase::kThreadInside &&
      was.phase == PlacingPhase::kEmpty)
    tell_placing(tick, kThreadLaid, {double(now.lost), 0, 0}, out);
  if (now.phase != was.phase && now.phase == PlacingPhase::kThreadOut &&
      was.phase != PlacingPhase::kTurned)
    tell_placing(tick, kThreadOut, {0, 0, 0}, out);
  if (now.let_go_early > was.let_go_early)
    tell_placing(tick, kButtonLetGo, {-beyond_mm, now.most_pull_n, 0}, out);
  if (now.phase != was.phase && now.phase == PlacingPhase::kTurned)
    tell_placing(tick, kButtonTurned, {1e3 * now.gap_m, now.most_pull_n, beyond_mm}, out);
  seen_ = now;
}

}  // namespace osteon
