#pragma once

#include <span>

#include "osteon/base/types.h"
#include "osteon/physics/fallen_pieces.h"

namespace osteon {

/// How far a point lies in something, and which way is out.
struct PiecePush {
  double depth_m = 0;  ///< not above 0: it lies in nothing
  Vec3 out_W = Vec3::UnitZ();
};

/// What loose pieces meet in a step: bones as they are now, and the instruments of the hands.
struct PieceSurroundings {
  const PiecesSetup& setup;
  std::span<const ToolState* const> tools;
  const BoneSnapshot& bones;
  std::span<const CarvedField* const> carved;

  /// The deepest of all bones, of those whose box the ball overlaps.
  PiecePush in_bone(const Vec3& p_W) const;
  /// The deepest of all instruments that are where the bones are.
  PiecePush in_tool(const Vec3& p_W) const;
  /// Whether soft parts are about a point: it lies in the limb.
  bool in_tissue(const Vec3& p_W) const;
  /// Whether any instrument comes into that ball.
  bool tool_near(const Vec3& center_W, double radius_m) const;
};

/// How far a point in Tool lies in a part of an instrument; `out_W` is in Tool.
PiecePush push_of(const Primitive& part, const Vec3& p_T);
/// The same of what is left of a carved bone, in Bone.
PiecePush push_of(const CarvedField& field, const Vec3& p_B);

}  // namespace osteon
