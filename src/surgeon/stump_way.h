#pragma once

#include <string>
#include <vector>

#include "acl_knee.h"
#include "acl_way.h"
#include "osteon/mesh/distance.h"
#include "osteon/scene/stumps.h"

namespace osteon {

/// Stumps in the way of what is not to touch them, their bones at rest.
class StumpsAsObstacles {
 public:
  StumpsAsObstacles(const Case& the_case, std::vector<TornStump> stumps);
  /// Whether a rod between two places keeps clear of all of them.
  bool is_free(const Vec3& from_W, const Vec3& to_W, double radius_m) const;

 private:
  std::vector<MeshDistance> stumps_W_;
};

/// Who clears stumps: with what, through which portal.
struct StumpClearing {
  std::string instrument;
  double size_mm = 0, radius_m = 0.0021;  ///< of its round end
  Vec3 portal_W = Vec3::Zero();
};

/// A place that the middle of the round end goes to, straight in from the portal.
struct ClearingPlace {
  Vec3 to_W = Vec3::Zero();
  double way_m = 0;             ///< so long before it there is something to clear
  Vec3 aside_W = Vec3::Zero();  ///< on which side of the way there is more of it
};

/// Places whose ways clear stumps and touch no bone, each chosen for what it clears that those
/// before it have left. Ends when one more would clear next to nothing. What no straight way leads
/// to stays.
std::vector<ClearingPlace> clearing_places(const AclKnee& knee,
                                           const std::vector<TornStump>& stumps,
                                           const StumpClearing& with);

/// So far before the stumps the tip is free of them; from the portal, m.
double before_stumps_m(const AclKnee& knee, const std::vector<TornStump>& stumps,
                       const Vec3& portal_W);

/// Takes the instrument outside of the portal, comes in to `before_m` on the way to the place, and
/// turns it on. The hand must be outside.
void begin_clearing(const StumpClearing& with, const ClearingPlace& first, double before_m,
                    AclWay& way);
/// Goes to all of these places, then once more with its window to the other side.
void clear_places(const StumpClearing& with, const std::vector<ClearingPlace>& places,
                  double before_m, AclWay& way);
/// Turns it off and comes back out, from the way to that place.
void end_clearing(const StumpClearing& with, const ClearingPlace& last, AclWay& way);

}  // namespace osteon
