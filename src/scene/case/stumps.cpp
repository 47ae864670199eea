#include "osteon/scene/stumps.h"

#include <algorithm>
#include <limits>

#include "osteon/mesh/distance.h"
#include "osteon/mesh/measure.h"

namespace osteon {
namespace {

constexpr double kLeastShare = 0.01;  // of the ligament's volume: less is a shred

// Nearest by its surface; none: there is none.
std::size_t nearest_part(const std::vector<TriMesh>& parts, const Vec3& p) {
  std::size_t best = parts.size();
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const ClosestPoint at = MeshDistance(parts[i]).closest(p);
    const double distance = (at.point - p).norm();
    if (!(distance < least)) continue;
    least = distance;
    best = i;
  }
  return best;
}

}  // namespace

std::vector<TornStump> torn_stumps(const Case& the_case) {
  std::vector<TornStump> out;
  for (std::uint32_t soft = 0; soft < the_case.softs.size(); ++soft) {
    const SoftPart& part = the_case.softs[soft];
    if (part.kind != "ligament" || part.attachments.size() < 2) continue;
    std::vector<TriMesh> parts = connected_parts(part.mesh_W);
    const double least_m3 = kLeastShare * std::abs(volume(part.mesh_W));
    std::erase_if(parts, [&](const TriMesh& one) {
      return !topology(one).closed() || volume(one) < least_m3;
    });
    if (parts.size() < 2) continue;
    std::vector<char> taken(parts.size(), 0);
    for (const Attachment& foot : part.attachments) {
      const std::size_t at = nearest_part(parts, foot.p_W);
      if (at == parts.size() || taken[at]) continue;
      taken[at] = 1;
      const Pose X_BW = the_case.bone(foot.bone).X_WB.inverse();
      TornStump stump{soft, foot.bone, X_BW * foot.p_W, parts[at]};
      for (Vec3& p : stump.mesh_B.vertices) p = X_BW * p;
      out.push_back(std::move(stump));
    }
  }
  return out;
}

}  // namespace osteon
