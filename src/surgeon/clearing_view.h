#pragma once

#include <vector>

#include "acl_knee.h"
#include "osteon/procedure/scope_watch.h"
#include "osteon/surgeon/scope_reach.h"
#include "stump_way.h"

namespace osteon {

/// How a scope looks on while stumps are cleared, and what is cleared meanwhile.
struct ClearingView {
  Gaze gaze;
  std::vector<ClearingPlace> places;
};

/// Who looks on: through which portal, and what else the other hand comes to, straight in from its
/// own portal. The scope keeps clear of that.
struct ClearingWatcher {
  ScopeOptics optics;
  Vec3 portal_W = Vec3::Zero();
  std::vector<Vec3> also_W;
  std::vector<Vec3> aims_W;  ///< that the scope may look at beside what is cleared
};

/// The fewest gazes that were found from which the tip is seen at all places, each in the group of
/// the first that shows it; shaft and window keep clear of bone, of the stumps and of the other
/// instrument. Places that no gaze shows are in the last group. Empty: no gaze shows anything.
std::vector<ClearingView> clearing_views(const AclKnee& knee, const StumpsAsObstacles& stumps,
                                         const StumpClearing& with, const ClearingWatcher& who,
                                         std::vector<ClearingPlace> places);

}  // namespace osteon
