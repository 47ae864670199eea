#include "osteon/scene/tool_moment.h"

#include <algorithm>

namespace osteon {

Vec3 grip_of(const Tool& tool) {
  return tool.shaft.radius > 0 ? tool.shaft.p1 : Vec3(Vec3::Zero());
}

// Symbols: g, the point; f_i at p_i, the forces of the contacts; F, the whole force on the hand.
// The sum of (p_i - g) x f_i, and of what F has beside the f_i: a portal's share acts in its hole.
// Without a portal such a rest is that of a tip which has just let go, and acts there.
Vec3 moment_about(const Vec3& g_W, const ToolState& state, std::span<const Portal> portals) {
  if ((state.status & (kTickFading | kTickGrabbing)) != 0 || state.force_W.isZero(0))
    return Vec3::Zero();
  Vec3 rest_W = state.force_W;
  Vec3 moment_W = Vec3::Zero();
  const auto add = [&](const Vec3& p_W, const Vec3& force_W) {
    moment_W += (p_W - g_W).cross(force_W);
    rest_W -= force_W;
  };
  const std::size_t bones = std::min<std::size_t>(state.contact_count, kMaxContacts);
  for (std::size_t i = 0; i < bones; ++i)
    add(state.contacts[i].p_W, state.contacts[i].force_on_tool_W);
  const std::size_t tools = std::min<std::size_t>(state.tool_contact_count, kMaxToolContacts);
  for (std::size_t i = 0; i < tools; ++i)
    add(state.tool_contacts[i].p_W, state.tool_contacts[i].force_on_tool_W);
  Vec3 at_W = state.X_WP.p;
  if (state.portal < portals.size()) {
    const Portal& portal = portals[state.portal];
    at_W = portal.made == kNotMade ? portal.p_W : state.p_portal_W;
  }
  moment_W += (at_W - g_W).cross(Vec3(rest_W));
  return moment_W;
}

Vec3 moment_at_grip(const ToolState& state, const Tool& tool, std::span<const Portal> portals) {
  const Vec3 moment_W = moment_about(state.X_WP * grip_of(tool), state, portals);
  return is_finite(moment_W) ? moment_W : Vec3(Vec3::Zero());
}

}  // namespace osteon
