#include "event_watch.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace osteon {
namespace {

double finite_or_zero(double value) { return std::isfinite(value) ? value : 0; }

}  // namespace

Event EventWatch::event(const ToolState& tool, EventKind kind, std::uint32_t bone) const {
  const SubjectKind subject = bone == kNoSubject ? SubjectKind::kNothing : SubjectKind::kBone;
  return {tool.tick, kind, hand_, subject, bone, tool.X_WP.p, {}};
}

void EventWatch::see(const ToolState& tool, WatchState& state, EventList& out) const {
  see_contacts(tool, state, out);
  see_ends(tool, state, out);
  see_force(tool, state, out);
}

void EventWatch::see_contacts(const ToolState& tool, WatchState& state, EventList& out) const {
  for (std::uint32_t i = 0; i < tool.contact_count; ++i) {
    const Contact& contact = tool.contacts[i];
    const std::uint32_t bone = contact.bone.index;
    if (bone >= kMaxBones) continue;
    const double force_n = finite_or_zero(contact.force_on_tool_W.norm());
    Touch& touch = state.touches[bone];
    const std::uint64_t bit = std::uint64_t{1} << bone;
    if ((state.touched & bit) == 0) {
      state.touched |= bit;
      touch = {tool.tick, tool.tick, 0, 0};
      Event begins = event(tool, EventKind::kContactBegin, bone);
      begins.p_W = contact.p_W;
      begins.values[0] = force_n;
      out.add(begins);
    }
    touch.last_tick = tool.tick;
    touch.peak_force_n = std::max(touch.peak_force_n, force_n);
    touch.deepest_m = std::max(touch.deepest_m, finite_or_zero(contact.depth_m));
  }
}

void EventWatch::see_ends(const ToolState& tool, WatchState& state, EventList& out) const {
  for (std::uint64_t left = state.touched; left != 0; left &= left - 1) {
    const auto bone = static_cast<std::uint32_t>(std::countr_zero(left));
    const Touch& touch = state.touches[bone];
    if (tool.tick < touch.last_tick + kLetGoTicks) continue;
    state.touched &= ~(std::uint64_t{1} << bone);
    Event ends = event(tool, EventKind::kContactEnd, bone);
    ends.values = {static_cast<double>(touch.last_tick - touch.first_tick + 1) * tick_s_,
                   touch.peak_force_n, touch.deepest_m * 1e3};
    out.add(ends);
  }
}

void EventWatch::see_force(const ToolState& tool, WatchState& state, EventList& out) const {
  const double force_n = finite_or_zero(tool.force_W.norm());
  if (state.over_since == 0 && force_n > limit_n_) {
    state.over_since = tool.tick;
    state.over_bone = tool.contact_count > 0 ? tool.contacts[0].bone.index : kNoSubject;
    Event over = event(tool, EventKind::kForceOver, state.over_bone);
    over.values = {force_n, limit_n_, 0};
    out.add(over);
  } else if (state.over_since != 0 && force_n < kBackUnder * limit_n_) {
    Event under = event(tool, EventKind::kForceUnder, state.over_bone);
    under.values = {force_n, limit_n_, static_cast<double>(tool.tick - state.over_since) * tick_s_};
    out.add(under);
    state.over_since = 0;
  }
}

}  // namespace osteon
