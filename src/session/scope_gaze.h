#pragma once

#include <cstdint>
#include <vector>

#include "osteon/procedure/scope_watch.h"
#include "osteon/scene/case.h"
#include "osteon/scene/event.h"
#include "osteon/scene/state.h"

namespace osteon {

/// What lies in the middle of a scope's picture: the first bone on the line of sight, felt pieces
/// or hull, as whole as at the start. Allocates nothing after it is made; a function of its inputs.
class ScopeGaze {
 public:
  static constexpr double kFarthest_m = 0.06;  ///< farther off, it is no close look

  struct Seen {
    std::uint32_t bone = kNoSubject;
    double distance_m = 0;
    Vec3 p_W = Vec3::Zero();
  };

  /// The case must outlive it.
  explicit ScopeGaze(const Case& the_case);
  /// No bone: nothing is near. An eye within a bone looks through it.
  Seen middle_of(const ScopeView& view, const BoneSnapshot& bones) const;

 private:
  struct Ball {
    Vec3 p_B = Vec3::Zero();
    double radius_m = 0;
  };
  double nearest(std::size_t bone, const Vec3& eye_B, const Vec3& along_B, double far_m) const;

  const Case* case_;
  std::vector<Ball> bones_;                ///< about each bone
  std::vector<std::vector<Ball>> pieces_;  ///< about each of its pieces
};

}  // namespace osteon
