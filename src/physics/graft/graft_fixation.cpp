#include "osteon/physics/graft_fixation.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "osteon/scene/graft.h"

namespace osteon {
namespace {

constexpr double kButton_n_per_m = 600e3, kLoop_n = 12e3;
constexpr double kScrew_n_per_m = 300e3, kScrewLength_m = 0.028;
constexpr double kHold_n_per_m = 20.14e3;  // 564 N over 28 mm
constexpr double kFullHold_n = 564, kSlip_m = 0.001, kMostSlip_m = 0.015;
constexpr double kCreep = 0.03;
constexpr double kLeastEngaged_m = 0.002;

struct FixingRange {
  const char* name;
  double value, least, most, unit;
};

Result<void> check_fixing(const GraftFixing& g) {
  const FixingRange ranges[] = {
      {"diameter, mm", g.diameter_m, 0.004, 0.014, 1e3},
      {"length, mm", g.length_m, 0.005, 0.300, 1e3},
      {"loop, mm", g.loop_m, 0.005, 0.060, 1e3},
      {"channel, mm", g.channel_m, 0.001, 0.150, 1e3},
      {"socket, mm", g.socket_m, 0.001, 0.150, 1e3},
      {"tibial tunnel, mm", g.tibia_m, 0.001, 0.150, 1e3},
      {"between the mouths, mm", g.between_m, 0.001, 0.150, 1e3},
      {"gap under the button, mm", g.button_gap_m, 0, 0.030, 1e3},
      {"pretension, s", g.pretension_s, 0, 1e6, 1},
      {"cycles", g.cycles, 0, 1e5, 1},
      {"screw's diameter, mm", g.screw_m, 0.004, 0.015, 1e3},
      {"screw's length, mm", g.screw_length_m, 0.010, 0.050, 1e3},
      {"screw's divergence, degrees", g.divergence_rad, 0, 1.05, 57.29578}};
  for (const FixingRange& range : ranges)
    if (!(range.value >= range.least && range.value <= range.most))
      return fail(std::to_string(range.unit * range.value) + " is outside of " +
                      std::to_string(range.unit * range.least) + " to " +
                      std::to_string(range.unit * range.most),
                  std::string("graft: ") + range.name);
  return {};
}

double engaged_m(const GraftFixing& g, double in_tibia_m) {
  double reach = std::min(g.screw_length_m, in_tibia_m);
  const double aside = std::tan(g.divergence_rad);
  if (aside > 1e-9) reach = std::min(reach, 0.5 * g.tibia_diameter_m / aside);
  return std::max(0.0, reach);
}

}  // namespace

Result<FixedGraft> fix_graft(const GraftFixing& g) {
  if (auto ok = check_fixing(g); !ok) return tl::unexpected(ok.error());
  FixedGraft out;
  const LoopFit fit = fit_loop(g.channel_m, g.socket_m, g.loop_m);
  out.in_socket_m = std::max(0.0, fit.in_socket_m);
  out.in_tibia_m = std::clamp(g.length_m - out.in_socket_m - g.between_m, 0.0, g.tibia_m);
  out.engaged_m = engaged_m(g, out.in_tibia_m);
  const double grip = std::clamp(0.5 + 0.5 * (g.screw_m - g.tibia_diameter_m) / 0.001, 0.0, 1.0);
  out.strength_n = kHold_n_per_m * out.engaged_m * grip;
  if (!fit.flips) {
    out.held = false;
    out.why = fit.in_socket_m > 0 ? "the button cannot turn: the loop is too short"
                                  : "the loop is longer than the channel";
  } else if (out.engaged_m < kLeastEngaged_m || !(out.strength_n > 0)) {
    out.held = false;
    out.why = out.in_tibia_m < kLeastEngaged_m ? "the graft does not reach the tibial tunnel"
                                               : "the screw does not hold the graft";
  }
  if (!out.held) return out;
  const double screw = kScrew_n_per_m * out.engaged_m / kScrewLength_m;
  out.stiffness_n_per_m = 1 / (1 / kButton_n_per_m + g.loop_m / kLoop_n + 1 / screw);
  const double stretched = out.in_socket_m + g.between_m + out.in_tibia_m - out.engaged_m;
  const double slip = kSlip_m * std::max(0.0, kFullHold_n / out.strength_n - 1);
  out.slack_m = kCreep * creep_left(g.pretension_s, g.cycles) * stretched + g.button_gap_m +
                std::min(slip, kMostSlip_m);
  return out;
}

}  // namespace osteon
