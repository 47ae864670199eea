#include "osteon/tissue/rod_cut.h"

namespace osteon {
namespace {

// Of a list of nodes or of segments: from one place on, so many.
template <class T>
std::vector<T> some_of(const std::vector<T>& all, std::size_t from, std::size_t count) {
  const auto begin = all.begin() + static_cast<std::ptrdiff_t>(from);
  return {begin, begin + static_cast<std::ptrdiff_t>(count)};
}

Rod rod_part(const Rod& rod, std::size_t from, std::size_t segments) {
  Rod out;
  out.material = rod.material;
  out.section = rod.section;
  out.radius_m = rod.radius_m;
  out.friction = rod.friction;
  out.start_W = some_of(rod.start_W, from, segments + 1);
  out.start_R_WS = some_of(rod.start_R_WS, from, segments);
  out.length_m = some_of(rod.length_m, from, segments);
  out.rest_turn = some_of(rod.rest_turn, from, segments - 1);
  out.mass_kg = some_of(rod.mass_kg, from, segments + 1);
  return out;
}

RodState state_part(const RodState& state, std::size_t from, std::size_t segments) {
  RodState out;
  out.at_W = some_of(state.at_W, from, segments + 1);
  out.velocity_m_per_s = some_of(state.velocity_m_per_s, from, segments + 1);
  out.R_WS = some_of(state.R_WS, from, segments);
  out.spin_rad_per_s = some_of(state.spin_rad_per_s, from, segments);
  out.grip_n.assign(state.grip_n.size(), Vec3::Zero());
  out.grip_n_m = out.grip_n;
  out.tick = state.tick;
  return out;
}

// `mass_kg`: of the nodes of the whole, by which a force on the node that was cut is shared.
RodSupports supports_part(const RodSupports& all, std::size_t from, const Rod& part,
                          const std::vector<double>& mass_kg) {
  RodSupports out;
  out.grips = all.grips;
  out.obstacles = all.obstacles;
  out.gravity_m_per_s2 = all.gravity_m_per_s2;
  const std::size_t segments = part.segments();
  for (RodHeldAxis axis : all.axes) {
    if (axis.node < from || axis.node > from + segments) continue;
    axis.node -= static_cast<std::uint32_t>(from);
    out.axes.push_back(axis);
  }
  for (RodHeldFrame frame : all.frames) {
    if (frame.segment < from || frame.segment >= from + segments) continue;
    frame.segment -= static_cast<std::uint32_t>(from);
    out.frames.push_back(frame);
  }
  for (NodeLoad load : all.loads) {
    if (load.slot < from || load.slot > from + segments) continue;
    const double whole = mass_kg[load.slot];
    load.slot -= static_cast<std::uint32_t>(from);
    load.force_n *= part.mass_kg[load.slot] / whole;
    out.loads.push_back(load);
  }
  return out;
}

}  // namespace

std::optional<std::pair<RodPart, RodPart>> cut_rod(const Rod& rod, const RodSupports& supports,
                                                   const RodState& state, std::size_t node) {
  const std::size_t segments = rod.segments();
  if (node < 1 || node >= segments) return std::nullopt;
  RodPart before{rod_part(rod, 0, node), {}, state_part(state, 0, node)};
  RodPart after{rod_part(rod, node, segments - node), {}, state_part(state, node, segments - node)};
  // By the lengths of the segments on both sides, as it was made of them.
  const double share = rod.length_m[node - 1] / (rod.length_m[node - 1] + rod.length_m[node]);
  before.rod.mass_kg.back() = share * rod.mass_kg[node];
  after.rod.mass_kg.front() = rod.mass_kg[node] - before.rod.mass_kg.back();
  before.supports = supports_part(supports, 0, before.rod, rod.mass_kg);
  after.supports = supports_part(supports, node, after.rod, rod.mass_kg);
  return std::pair{std::move(before), std::move(after)};
}

}  // namespace osteon
