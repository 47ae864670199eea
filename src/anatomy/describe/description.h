#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "describe/shape.h"
#include "joint/joint_description.h"
#include "osteon/anatomy/shape_numbers.h"
#include "osteon/base/result.h"
#include "soft/soft_description.h"

namespace osteon {

/// "No point of this bone is nearer than `gap` to that one": a joint space. The other bone counts
/// as its own parts alone, before its clearances, so that the order of bones does not matter.
struct Clearance {
  std::size_t other_bone = 0;
  double gap = 0;    ///< metres
  double blend = 0;  ///< metres, rounds the rim of the hollow
};

struct BoneDescription {
  std::string name;
  int fma_id = 0;
  double density_kg_per_m3 = 1900;
  double cell_m = 0.0006;  ///< of the grid on which its surface is found
  Vec3 p_WB = Vec3::Zero();
  Mat3 R_WB = Mat3::Identity();
  Solid solid;  ///< in Bone
  std::vector<Clearance> clearances;
  std::vector<ShapeNumbers> shape_numbers = {};  ///< as written, before anything varies it
  /// Taken from it last, by findings; in World. Its neighbours clear it as if it were whole.
  std::vector<BoundPart> defects = {};
  double coarsest_cell_m = 1;  ///< that shows the defects, whatever cell is asked for
};

/// Bones that a finding or a bent joint moves rigidly once they and their cartilage have grown,
/// about the pivot and then by the shift. Landmarks that are bound to them go along.
struct Displacement {
  std::vector<std::size_t> bones;
  Mat3 R_W = Mat3::Identity();
  Vec3 shift_W = Vec3::Zero();  ///< metres of the finished anatomy, whatever its size
  BoundPoint pivot;
  bool by_joint = false;  ///< the skin follows too; after all that findings move
};

/// A bone that a finding parts: what its defects leave becomes bones of their own, each named by
/// the place that it lies nearest to.
struct BoneSplit {
  struct Fragment {
    std::string name;
    BoundPoint near;
  };
  std::size_t bone = 0;
  std::vector<Fragment> fragments;
};

struct LandmarkDescription {
  std::string name;
  Vec3 p_W = Vec3::Zero();
  /// The bone or the soft part on whose surface the finished landmark is laid.
  std::optional<std::size_t> on_bone = {}, on_soft = {};
  /// The bone that it moves with, which one that lies on a bone always has. No step of a variation
  /// table names it then.
  std::optional<std::size_t> bone = {};
  /// A band, of the soft parts, beside which it stays where joints bend and findings move bones.
  /// In a session, whose skin does not slide, it goes with `bone` all the same.
  std::optional<std::size_t> along = {};
};

struct AnatomyDescription {
  std::string name;
  std::string side;
  std::vector<BoneDescription> bones;
  std::vector<SoftDescription> softs;
  std::vector<LandmarkDescription> landmarks;
  std::vector<Displacement> displacements = {};
  std::vector<BoneSplit> splits = {};
  std::vector<RollingJoint> joints = {};
};

/// Reads a description (its grammar: docs/anatomy-description.md). Strict: a key that is missing,
/// unknown, of the wrong type or out of its range fails, naming file, bone and key.
Result<AnatomyDescription> parse_description(std::string_view toml, const std::string& file);

}  // namespace osteon
