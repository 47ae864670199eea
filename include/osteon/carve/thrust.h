#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/carve/heat.h"

namespace osteon {

/// One kind of bone as a drill meets it.
struct DrillMaterial {
  std::string name;
  double thrust_n = 0;                  ///< at the usual feed, speed and diameter
  double specific_energy_j_per_m3 = 0;  ///< u = 8 T / (f D^2)
  double edge_share = 0;                ///< of the thrust, below which the drill does not cut
};

/// assets/materials/drilling.toml, with the marks of sources left out.
struct DrillTable {
  double usual_diameter_m = 0, usual_speed_rev_per_s = 0, usual_feed_m_per_rev = 0;
  std::vector<DrillMaterial> materials;
  double largest_feed_m_per_rev = 0;
  double skive_angle_rad = 0;
  double start_depth_m = 0;
  double rubbing = 0;
  double blunt_factor = 0;
  double chips_heat_share = 0;    ///< of the cutting power, that stays in the bone
  double rubbing_heat_share = 0;  ///< of the rubbing power
  double outrun_m_per_s = 0;      ///< at this feed half of that is cut away with the bone it is in
  HeatMaterial heat;
  Irrigation water;
  double reamer_teeth = 0, chatter_depth_m = 0, chatter_gain = 0, chatter_most_m = 0;
  double chatter_most_n = 0;  ///< of the hand, by which its wave is felt

  /// Null when no material has this name.
  const DrillMaterial* find(std::string_view name) const;
};
/// Strict: an unknown or missing key, a number without a mark or out of range is an error.
Result<DrillTable> parse_drill_table(std::string_view text, const std::string& where);
Result<DrillTable> load_drill_table(const std::filesystem::path& file);

/// A twist drill in use.
struct DrillTool {
  double diameter_m = 0.0032;
  double speed_rev_per_s = 16.7;  ///< negative: it runs backwards
  double bluntness = 0;           ///< 0 new, 1 it does not cut any more
  double pilot_diameter_m = 0;    ///< of a hole that is there already
};

/// What the drill's tip stands on. No material: air.
struct DrillBite {
  const DrillMaterial* material = nullptr;
  double angle_rad = 0;  ///< between the axis and the surface's normal, both into the bone
};

/// All that a drill remembers: a value, copied freely.
struct DrillState {
  double depth_m = 0;  ///< that it has removed along its axis
  double turned_rev = 0;
  bool was_cutting = false;

  bool operator==(const DrillState&) const = default;
};

struct DrillStep {
  double feed_m_per_rev = 0;
  double advance_m = 0;     ///< that the drill removed in this step
  double resistance_n = 0;  ///< of the bone against the thrust
  double torque_nm = 0;
  double cutting_w = 0;     ///< power that goes into chips
  double rubbing_w = 0;     ///< power of the edges' friction
  bool skives = false;      ///< the tip slides sideways: it has no hold
  bool breaks_out = false;  ///< the bone before the tip ended in this step
};

/// Thrust needed for a feed, N: F = s (e F* + (1 - e) F* f / f*), where F* and f* are the table's
/// thrust and usual feed, e the edge's share and s scales with the diameter that is cut. Blunt
/// edges raise the first part.
double thrust_for(const DrillTable& table, const DrillMaterial& material, const DrillTool& tool,
                  double feed_m_per_rev);

/// Torque at a feed, N m: u f (D^2 - d^2) / 8 with d the pilot hole's diameter, and the friction of
/// the edge at a quarter of the diameter.
double torque_for(const DrillTable& table, const DrillMaterial& material, const DrillTool& tool,
                  double feed_m_per_rev);

/// One step: the drill goes forward by as much as it removes under `thrust_n`, no further. Bone
/// resists with the whole thrust; faster than the flutes clear the drill does not go. Blunt or
/// backwards it removes nothing and rubs; at too shallow an angle it slides unless a start was
/// made. In air it removes nothing and meets nothing.
DrillStep step_drill(DrillState& state, const DrillTable& table, const DrillTool& tool,
                     const DrillBite& bite, double thrust_n, double dt_s);

/// A reamer that shakes: an event's numbers.
struct Chatter {
  double amplitude_m = 0;
  double frequency_hz = 0;  ///< at which its teeth pass
};
/// Chatter of a reamer of `diameter_m` in a canal; none where it cuts little a side or meets no
/// cortex.
std::optional<Chatter> reamer_chatter(const DrillTable& table, double diameter_m, double canal_m,
                                      double speed_rev_per_s, bool in_cortex);

}  // namespace osteon
