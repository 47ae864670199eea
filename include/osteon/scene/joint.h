#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "osteon/base/id.h"
#include "osteon/base/pose_track.h"

namespace osteon {

/// A joint of a case that can be bent: how bones stand against one that stays.
template <class BoneKey>
struct BendingJoint {
  struct Moved {
    BoneKey bone;
    PoseTrack X_FB;  ///< pose in the fixed bone, by degrees of bend
  };
  std::string name;   ///< "flexion"
  BoneKey fixed;      ///< the bone that stays
  double at_deg = 0;  ///< how far it is bent while every bone is at rest
  std::vector<Moved> bones;
  std::optional<double> begin_deg = {};  ///< how far it is bent as a session begins; none: at_deg

  double min_deg() const { return bones.empty() ? 0 : bones[0].X_FB.first; }
  double max_deg() const { return bones.empty() ? 0 : bones[0].X_FB.last(); }
};
using CaseJoint = BendingJoint<BoneId>;
using JointDef = BendingJoint<std::string>;  ///< bones by name

/// What grows a case of a built-in anatomy again, in words that the anatomy knows.
struct CaseRecipe {
  std::string anatomy;  ///< "knee"
  std::optional<std::uint64_t> seed;
  std::string side;
  std::vector<std::pair<std::string, double>> set;
  std::vector<std::pair<std::string, std::string>> findings;  ///< with their grades
};

}  // namespace osteon
