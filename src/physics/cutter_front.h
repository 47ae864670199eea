#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>

#include "osteon/carve/carved_field.h"
#include "osteon/carve/cutter.h"
#include "osteon/carve/thrust.h"

namespace osteon {

/// What stands before a cutter's front, in points of equal area over it.
struct FrontShare {
  std::size_t looked = 0;
  std::array<std::size_t, kBoneTissues> found{};
  std::size_t left() const;  ///< points with bone
  bool meets_bone() const;   ///< not cartilage or marrow alone
  /// The tissue that most points are in; none: no bone.
  std::optional<BoneTissue> most() const;
};

/// What is left of a bone at a point; none: nothing.
std::optional<BoneTissue> tissue_at(const CarvedField& field, const Vec3& p_B);
/// Whether a point lies outside of the bone as it was before any cut.
bool was_outside(const CarvedField& field, const Vec3& p_B);

/// How far a line from a place at the bone's surface goes on in the bone as it was before any cut,
/// up to 0.2 m.
double way_in_bone(const CarvedField& field, const Vec3& from_B, const Vec3& way_B);

/// Before a cutter that is turned about its axis, a drill or a reamer, beyond its pilot's radius.
FrontShare look_before(const CarvedField& field, const Cutter& cutter, double pilot_m,
                       const Pose& X_BC);
/// Whether nothing is left where that front itself stands, between the field's nodes too.
bool front_is_free(const CarvedField& field, const Cutter& cutter, double pilot_m,
                   const Pose& X_BC);
/// How wide the cortex is that stands before a reamer's rim, from the rim inwards, m: the mean of
/// its sides, each up to 2 mm.
double cut_a_side(const CarvedField& field, const Cutter& cutter, const Pose& X_BC);
/// The same before a long point, an awl's: what of it is in bone decides, so it is looked at in
/// more rings.
FrontShare look_before_point(const CarvedField& field, const Cutter& cutter, const Pose& X_BC);
/// Before the edge of a blade, which lies along x through X_BC's origin.
FrontShare look_before_edge(const CarvedField& field, double width_m, const Pose& X_BC);
/// Before a ball about X_BC's origin that is pressed against -nhat_B.
FrontShare look_under_ball(const CarvedField& field, double radius_m, const Vec3& p_B,
                           const Vec3& nhat_B);

/// One material for all that is before the front, by its shares of the front's area.
DrillMaterial mixed(const DrillTable& table, const FrontShare& share);

}  // namespace osteon
