#pragma once

#include <cstdint>
#include <vector>

#include "acl_knee.h"
#include "osteon/mesh/distance.h"
#include "osteon/procedure/scope_watch.h"
#include "osteon/scene/case.h"
#include "osteon/scene/state.h"

namespace osteon {

/// What hides from a scope what it looks for in a knee: bone, menisci, cartilage, ligaments. Not
/// the stumps of a torn one, which are what is looked at, nor fat, which moves aside.
class OpenSight {
 public:
  /// `knee`: its bones are where they hide. `at_rest`: the case whose soft parts those are, each of
  /// which goes with its bones from rest to `bones`; one between bones that moved apart is left
  /// out.
  OpenSight(const AclKnee& knee, const Case& at_rest, const BoneSnapshot& bones);

  /// Distance to the nearest of it, negative inside.
  double gap_m(const Vec3& p_W) const;
  /// Whether nothing comes within 0.4 mm of the line between them.
  bool is_in_sight(const Vec3& eye_W, const Vec3& to_W) const;
  /// Whether nothing is close before the window: it would be all that the light shows.
  bool is_open(const ScopeView& view, const ScopeOptics& optics) const;

 private:
  struct Part {
    MeshDistance mesh;
    Pose X_rest;  ///< from where it is now to rest
  };
  const AclKnee& knee_;
  std::vector<Part> parts_;
};

}  // namespace osteon
