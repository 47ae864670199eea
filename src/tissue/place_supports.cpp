#include <algorithm>
#include <cmath>
#include <map>

#include "solver.h"

namespace osteon {
namespace {

struct Chosen {
  std::vector<const BodyNode*> nodes;
  double mass_kg = 0;
};

Result<Chosen> in_box(const SolveScene& scene, std::span<const BodyNode> nodes, const Aabb& box,
                      double tolerance_m, const std::string& key) {
  Chosen out;
  const Aabb grown = box.grown(tolerance_m);
  for (const BodyNode& node : nodes) {
    const bool inside = (node.rest_W.array() >= grown.lo.array()).all() &&
                        (node.rest_W.array() <= grown.hi.array()).all();
    if (!inside) continue;
    out.nodes.push_back(&node);
    out.mass_kg += node.mass_kg;
  }
  if (out.nodes.empty())
    return fail(
        "'" + key + ".box_mm' contains no node of the body", scene.name,
        "Make the box reach the body's nodes: for a grid these are the corners of its cells");
  return out;
}

std::string entry_name(const char* list, std::size_t i) {
  return std::string(list) + "[" + std::to_string(i) + "]";
}

/// By node and axis, so that each is held once.
using HeldMap = std::map<std::pair<std::uint32_t, std::uint32_t>, HeldAxis>;

void hold(HeldMap& map, const Chosen& chosen, const HeldAxes& axes, const Vec3& to_m, double over_s,
          std::size_t entry) {
  for (const BodyNode* node : chosen.nodes)
    for (std::uint32_t k = 0; k < 3; ++k)
      if (axes[k])
        map[{node->slot, k}] = {node->slot, k, to_m[k], over_s, static_cast<std::uint32_t>(entry)};
}

double body_size(std::span<const BodyNode> nodes) {
  Aabb box;
  for (const BodyNode& node : nodes) box.include(node.rest_W);
  return box.extent().norm();
}

}  // namespace

Result<Supports> place_supports(const SolveScene& scene, std::span<const BodyNode> nodes) {
  const double tolerance_m = 1e-6 * body_size(nodes);
  Supports out;
  out.gravity_m_per_s2 = scene.gravity_m_per_s2;
  HeldMap held;
  for (std::size_t i = 0; i < scene.fixed.size(); ++i) {
    const FixedBox& box = scene.fixed[i];
    const auto chosen = in_box(scene, nodes, box.box_m, tolerance_m, entry_name("fixed", i));
    if (!chosen) return tl::unexpected(chosen.error());
    hold(held, *chosen, box.axes, Vec3::Zero(), 0, out.entries++);
  }
  for (std::size_t i = 0; i < scene.moved.size(); ++i) {
    const MovedBox& box = scene.moved[i];
    const auto chosen = in_box(scene, nodes, box.box_m, tolerance_m, entry_name("moved", i));
    if (!chosen) return tl::unexpected(chosen.error());
    hold(held, *chosen, box.axes, box.by_m, box.over_s, out.entries++);
  }
  for (std::size_t i = 0; i < scene.loads.size(); ++i) {
    const LoadBox& box = scene.loads[i];
    const auto chosen = in_box(scene, nodes, box.box_m, tolerance_m, entry_name("load", i));
    if (!chosen) return tl::unexpected(chosen.error());
    for (const BodyNode* node : chosen->nodes)
      out.loads.push_back({node->slot, node->mass_kg / chosen->mass_kg * box.force_n, box.over_s});
  }
  for (const auto& [at, axis] : held) out.held.push_back(axis);
  return out;
}

std::uint64_t steps_for(double time_s, double longest_s) {
  const double steps = std::ceil(time_s / longest_s * (1 - 1e-12));
  return static_cast<std::uint64_t>(std::max(steps, 1.0));
}

Result<void> check_work(const SolveScene& scene, double step_s, std::size_t elements) {
  constexpr double kMost = 1e12;
  const double work = scene.time_s / step_s * static_cast<double>(elements);
  if (work <= kMost) return {};
  char text[160];
  std::snprintf(text, sizeof text,
                "'run.time_s' takes %.3g steps of %.3g s, the longest stable ones",
                scene.time_s / step_s, step_s);
  return fail(text, scene.name,
              "Solve a shorter time, with larger cells, a softer or a denser material");
}

}  // namespace osteon
