#pragma once

#include "knee/knee_parts.h"
#include "osteon/physics/acl_tunnels.h"

namespace osteon {

/// graft_bend_at for a knee whose bones are known; both tunnels are there, the bend is in range.
GraftBend bend_of_graft(const KneeParts& parts, const AclTunnels& tunnels, double flexion_deg);

}  // namespace osteon
