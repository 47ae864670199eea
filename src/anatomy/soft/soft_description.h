#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "describe/shape.h"

namespace osteon {

/// A place in World that moves with a bone when the bone is varied.
struct BoundPoint {
  std::size_t bone = 0;
  Vec3 p_W = Vec3::Zero();
};

/// A part in World that moves and grows with a bone when the bone is varied.
struct BoundPart {
  std::size_t bone = 0;
  Part part;
  /// A band whose ends take it along where their bones are displaced, in place of `bone`; may be
  /// empty.
  std::string along = {};
  /// Of a tube: the bone that its last point goes with, its first one with `bone`; those between by
  /// their place in the list.
  std::optional<std::size_t> to_bone = {};
};

/// Cartilage: a layer on a bone's surface. Covered is what lies within `reach` of a bone of
/// `facing`, turned towards it, and inside `region`; either may be empty. Lengths in metres.
struct LayerDescription {
  std::size_t bone = 0;
  std::vector<std::size_t> facing;
  std::vector<BoundPart> region;
  double thickness = 0;
  double reach = 0;
  double taper = 0;      ///< from the rim to full thickness
  double clearance = 0;  ///< that stays free between two layers
  double rim = 0;        ///< thickness of the edge; 0: a share of the thickness
};

struct BandPoint {
  BoundPoint at;
  double width = 0, thickness = 0;  ///< of the band there, metres
  std::string name;                 ///< of an attachment
  bool thins_out = false;           ///< towards this attached end, whose thickness was not said
  bool attached = false;            ///< laid on the bone's surface: the first and the last point
};

/// Ligament or tendon: flat or round, along a smooth curve through points, over bone.
struct BandDescription {
  std::vector<BandPoint> path;
  Vec3 flat_W = Vec3::UnitZ();  ///< unit; the band's thickness is measured along it
  double sink = 0;              ///< metres: how far it reaches into bone and cartilage
};

/// Disc, meniscus or fat: parts, less bone and cartilage and the soft parts of `clear_of`.
struct VolumeDescription {
  std::vector<BoundPart> parts;
  std::vector<std::string> clear_of;
  double sink = 0;
  double least = 0;  ///< thickness that is left between two bones, metres
};

/// Skin: the outline of flesh. All that lies within `offset` of a bone, joined with `parts`.
struct SkinDescription {
  std::vector<BoundPart> parts;
  double offset = 0;
  double blend = 0;
};

struct SoftDescription {
  std::string name;
  int fma_id = 0;  ///< 0: none is known
  std::string tissue;
  std::string kind;  ///< "cartilage", "ligament", "tendon", "disc", "meniscus", "fat", "skin"
  double cell = 0.0005;
  std::variant<LayerDescription, BandDescription, VolumeDescription, SkinDescription> shape;
  std::vector<BoundPart> defects = {};  ///< taken from it last, by findings
  std::size_t pieces = 1;               ///< so many are kept of what it falls into, the largest
};

/// The bone that a soft part grows with: the layer's own, else that of its first point or part.
std::size_t carrier(const SoftDescription& soft);

}  // namespace osteon
