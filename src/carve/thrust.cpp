#include "osteon/carve/thrust.h"

#include <algorithm>
#include <cmath>

namespace osteon {
namespace {

/// Of the diameter that the edges cut, as part of the usual one. A pilot hole takes the drill's
/// middle away.
double cut_width(const DrillTable& table, const DrillTool& tool) {
  return std::max(0.0, tool.diameter_m - tool.pilot_diameter_m) / table.usual_diameter_m;
}

/// Thrust below which nothing is cut, N; infinite for a drill that is all blunt.
double edge_thrust(const DrillTable& table, const DrillMaterial& material, const DrillTool& tool) {
  const double blunt = std::clamp(tool.bluntness, 0.0, 1.0);
  const double more = 1 + (table.blunt_factor - 1) * blunt / (1 - blunt);
  return cut_width(table, tool) * material.edge_share * material.thrust_n * more;
}

/// Thrust by feed beyond the edge's, N a metre a turn.
double thrust_slope(const DrillTable& table, const DrillMaterial& material, const DrillTool& tool) {
  return cut_width(table, tool) * (1 - material.edge_share) * material.thrust_n /
         table.usual_feed_m_per_rev;
}

double rubbing_torque(const DrillTable& table, const DrillTool& tool, double edge_n) {
  return table.rubbing * edge_n * tool.diameter_m / 4;
}

}  // namespace

const DrillMaterial* DrillTable::find(std::string_view name) const {
  for (const DrillMaterial& m : materials)
    if (m.name == name) return &m;
  return nullptr;
}

double thrust_for(const DrillTable& table, const DrillMaterial& material, const DrillTool& tool,
                  double feed_m_per_rev) {
  return edge_thrust(table, material, tool) + thrust_slope(table, material, tool) * feed_m_per_rev;
}

double torque_for(const DrillTable& table, const DrillMaterial& material, const DrillTool& tool,
                  double feed_m_per_rev) {
  const double across =
      tool.diameter_m * tool.diameter_m -
      std::min(tool.pilot_diameter_m * tool.pilot_diameter_m, tool.diameter_m * tool.diameter_m);
  return material.specific_energy_j_per_m3 * feed_m_per_rev * across / 8 +
         rubbing_torque(table, tool, edge_thrust(table, material, tool));
}

DrillStep step_drill(DrillState& state, const DrillTable& table, const DrillTool& tool,
                     const DrillBite& bite, double thrust_n, double dt_s) {
  DrillStep out;
  state.turned_rev += tool.speed_rev_per_s * dt_s;
  if (!bite.material) {
    out.breaks_out = state.was_cutting;
    state.was_cutting = false;
    return out;
  }
  const double pushed = std::max(thrust_n, 0.0);
  const bool held = state.depth_m >= table.start_depth_m || tool.pilot_diameter_m > 0;
  out.skives = !held && pushed > 0 && bite.angle_rad > table.skive_angle_rad;
  const double per_s = 2 * M_PI * std::abs(tool.speed_rev_per_s);
  const double edge = edge_thrust(table, *bite.material, tool);
  out.resistance_n = out.skives ? pushed * std::cos(bite.angle_rad) : pushed;
  const bool cuts = tool.speed_rev_per_s > 0 && tool.bluntness < 1 && !out.skives && pushed > edge;
  if (!cuts) {
    out.torque_nm = tool.speed_rev_per_s == 0 ? 0 : rubbing_torque(table, tool, pushed);
    out.rubbing_w = out.torque_nm * per_s;
    return out;
  }
  const double slope = thrust_slope(table, *bite.material, tool);
  const double feed = slope > 0 ? (pushed - edge) / slope : table.largest_feed_m_per_rev;
  out.feed_m_per_rev = std::min(feed, table.largest_feed_m_per_rev);
  out.advance_m = out.feed_m_per_rev * tool.speed_rev_per_s * dt_s;
  out.torque_nm = torque_for(table, *bite.material, tool, out.feed_m_per_rev);
  out.rubbing_w = rubbing_torque(table, tool, edge) * per_s;
  out.cutting_w = out.torque_nm * per_s - out.rubbing_w;
  state.depth_m += out.advance_m;
  state.was_cutting = true;
  return out;
}

// A tooth cuts the wave that the one before it left; beyond a depth of cut the wave grows until
// the teeth leave the bone, which bounds it. Below, it dies out.
std::optional<Chatter> reamer_chatter(const DrillTable& table, double diameter_m, double canal_m,
                                      double speed_rev_per_s, bool in_cortex) {
  const double depth = 0.5 * (diameter_m - canal_m);
  if (!in_cortex || !(speed_rev_per_s > 0) || !(depth > table.chatter_depth_m)) return std::nullopt;
  return Chatter{
      std::min(table.chatter_gain * (depth - table.chatter_depth_m), table.chatter_most_m),
      table.reamer_teeth * speed_rev_per_s};
}

}  // namespace osteon
