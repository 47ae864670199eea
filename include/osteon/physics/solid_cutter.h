#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/carve/cutter.h"
#include "osteon/scene/tool.h"

namespace osteon {

/// What an instrument of the tray does to a soft solid.
struct SolidCutter {
  enum class Way : std::uint8_t {
    kSlice,  ///< an edge: opens a slit where it is pressed hard enough, as far as it is drawn
    kBite,   ///< jaws: take what is between them, when they shut
    kClear   ///< takes what it presses, while it runs
  };
  Way way = Way::kSlice;
  Cutter cutter;
  Vec3 flat_T = Vec3::Zero();  ///< of an edge: across the blade
  /// Of an edge: however fast it is drawn, it needs so much of the force that pushes it straight
  /// in.
  double drawn_share = 0.2;
  std::uint64_t works = 0;  ///< which of tool_rods() do it, bit by bit
  std::uint64_t lifts = 0;  ///< which are out of the way while the jaws are open
  /// Of what clears: the line of its rod, and the half of space to which it does (zero: all round).
  Vec3 from_T = Vec3::Zero(), to_T = Vec3::Zero(), face_T = Vec3::Zero();
  double speed_m_per_s = 0;  ///< at full power
};

/// A blade's slit is at least so wide.
inline constexpr double kLeastSlit_m = 0.00045;
/// What clears is by so much thicker than its file says, so that the hand can follow it.
inline constexpr double kClearRoom_m = 0.00005;

/// A tool with a thin part near its tip; none: it has no edge.
std::optional<SolidCutter> slicing_with(const Tool& tool);

/// How far an edge goes in within a step, m. `p`: by how much it is pressed, m, and `F` the push of
/// that, N; `f`: the force that pushes it straight in; `s`: by how much it slides along itself;
/// `share`: however fast it is drawn it needs so much of f. A drawn edge needs f / (1 + (s / x)^2),
/// x being how far it goes in (Atkins, Xu and Jeronimidis 2004: pressing and slicing; the share
/// stands for the friction that limits it there).
double edge_goes_in(double p, double F, double f, double s, double share);

/// Of each name of a tray ("scalpel_11", "basket_punch:3.4"); none: it does not cut. Fails where
/// the instruments cannot be read.
Result<std::vector<std::optional<SolidCutter>>> make_solid_cutters(
    std::span<const std::string> tray);

}  // namespace osteon
