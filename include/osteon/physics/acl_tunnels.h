#pragma once

#include <optional>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/physics/graft_fixation.h"
#include "osteon/physics/graft_passing.h"
#include "osteon/physics/knee_laxity.h"
#include "osteon/scene/build_case.h"
#include "osteon/tissue/ligament_table.h"

namespace osteon {

/// What a drill did to a bone of the knee: its axis ran from one place to the other and took
/// everything within a radius. Either end may stand in the bone (a socket) or outside of it.
struct DrilledLine {
  Vec3 from_W = Vec3::Zero(), to_W = Vec3::Zero();
  double diameter_m = 0;
  bool open = false;  ///< it was found to leave the bone at both ends
};
struct AclDrilling {
  std::optional<DrilledLine> femur, tibia;
};

/// A socket or tunnel in the femur for a graft.
struct FemoralTunnel {
  Vec3 aperture_W = Vec3::Zero();  ///< on the axis, where it leaves the notch's wall
  Vec3 inwards_W = Vec3::UnitX();  ///< unit, along the axis into the bone
  /// Quadrant method (Bernard and Hertel 1997), 0 to 1, on the lateral condyle seen from the side:
  /// along Blumensaat's line from the hind border, and away from the line.
  double depth_share = 0, height_share = 0;
  double off_target_m = 0;   ///< in that picture, from the footprint's middle (24.8 / 28.5 %)
  double from_roof_rad = 0;  ///< about the notch's middle: 0 at twelve o'clock, a sixth pi an hour
  double channel_m = 0;      ///< of the axis in bone, to the far cortex
  double drilled_m = 0;      ///< of it, what is drilled
  double diameter_m = 0;
  /// Least bone behind the tunnel: at the mouth up to the condyle's hind border, deeper from the
  /// wall straight away from the axis; below 0: it is open there.
  double back_wall_m = 0;
  bool blow_out = false;
  bool through = false;  ///< the drill came out on the far side
};

/// A tunnel in the tibia.
struct TibialTunnel {
  Vec3 aperture_W = Vec3::Zero();  ///< on the axis, on the plateau
  Vec3 inwards_W = Vec3::UnitX();  ///< unit, along the axis into the bone
  /// Amis and Jakob 1998, 0 to 1: along a line parallel to the medial plateau from its front; and
  /// from the medial border.
  double front_share = 0, medial_share = 0;
  double length_m = 0;
  double diameter_m = 0;
  double to_plateau_rad = 0;  ///< between axis and plateau, seen from the side
  bool through = false;
  /// How far the tunnel's front edge lies behind the roof of the notch, led on to the plateau, in
  /// the knee stretched out (Howell and Taylor 1993).
  double behind_roof_m = 0;
};

/// How a graft between two tunnels was made and fixed, where that is known.
struct GraftChoices {
  std::optional<double> diameter_m, length_m, loop_m, tension_n, flexion_deg;
  std::optional<double> screw_m, screw_length_m;  ///< 1 mm more than the tunnel, 28 mm long
  double divergence_rad = 0, button_gap_m = 0;
  double pretension_s = 600, cycles = 25;
  double passing_flexion_deg = 90, tail_n = 10;  ///< while it is drawn in
};

/// How far a graft turns at the mouths of both tunnels at a bend of the case's own: it runs
/// straight between them.
struct GraftBend {
  double flexion_deg = 0, length_m = 0;  ///< length: from mouth to mouth
  double femur_rad = 0, tibia_rad = 0;
};

/// What a knee does with a graft between both mouths.
struct GraftOutcome {
  std::vector<LineLength> lengths;  ///< of a straight line between the mouths
  double excursion_m = 0;           ///< longest less shortest
  /// Room between the graft and the roof of the notch, seen from the side, in the knee stretched
  /// out, farther than 8 mm from the femoral mouth; below 0: the roof presses on the graft.
  double roof_gap_m = 0;
  KneeLaxity lachman, pivot;
  double lachman_whole_m = 0, pivot_whole_m = 0;  ///< of the same knee before it was torn
  /// Under load, how much farther forward the tibia stands than that of the whole knee: slack also
  /// moves the place of rest from which a test counts, and shows here in full.
  double lachman_ahead_m = 0, pivot_ahead_m = 0;
  std::vector<GraftBend> bends;       ///< at the same bends as `lengths`
  std::optional<FixedGraft> fixed;    ///< of a graft that was made and fixed as said
  std::optional<PassedGraft> passed;  ///< of the same graft: how it was drawn in before
  double diameter_m = 0;
  KneeGraft graft;    ///< as it is in the knee that was tested
  bool holds = true;  ///< it is fixed, and the screw bears what the tests pull
};

struct AclTunnels {
  std::optional<FemoralTunnel> femur;
  std::optional<TibialTunnel> tibia;
};

/// Places of the tunnels in a grown knee at any bend, left or right; the bones' meshes are those
/// before drilling. Fails where a line misses its bone, where numbers are not finite or a diameter
/// is not within 1 to 20 mm, and where the case lacks what a knee needs (femur, tibia, its
/// cartilage, its bending, landmarks of Blumensaat's line).
Result<AclTunnels> measure_tunnels(const CaseDef& def, const AclDrilling& drilling);

/// Fails without both tunnels, and on a flexion that the case's knee does not reach.
Result<GraftBend> graft_bend_at(const CaseDef& def, const AclTunnels& tunnels, double flexion_deg);

/// A graft between the mouths of both tunnels in the case's knee: as thick as the thinner tunnel
/// and fixed as the table says, or as was chosen. A graft that nothing holds pulls nowhere. Fails
/// on a graft that is thicker than a tunnel, and on choices out of range.
Result<GraftOutcome> graft_outcome(const CaseDef& def, const LigamentTable& table,
                                   const AclTunnels& tunnels,
                                   const std::optional<GraftChoices>& choices = {});

}  // namespace osteon
