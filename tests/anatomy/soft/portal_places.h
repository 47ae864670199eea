#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <string>

#include "anatomy/anatomy_assets.h"
#include "anatomy/knee_figures.h"
#include "anatomy/soft/soft_checks.h"
#include "osteon/anatomy/variation.h"

// Where the portals of a knee lie, by the surfaces of its tendon and bones alone.
namespace osteon::checks {

inline GeneratedAnatomy bent_knee(std::uint64_t seed, double flexion_deg) {
  constexpr double kPlacesCell_m = 0.003;  // enough where only places matter
  GenerateOptions options;
  options.cell_m = kPlacesCell_m;
  VariationRequest request;
  request.seed = seed;
  request.side = seed % 2 == 0 ? "right" : "left";
  request.set = {{"flexion_deg", flexion_deg}};
  auto r = generate_varied(kAnatomyAssets / "knee.toml", kAnatomyAssets / "knee_variation.toml",
                           request, options);
  if (!r) throw std::runtime_error(r.error().message());
  return std::move(r->anatomy);
}

/// mm, in the tibia's own frame.
struct PortalPlace {
  double beyond_edge = 0;   ///< of the patellar tendon at the portal's height, to its own side
  double over_plateau = 0;  ///< up along the tibia from the top of the plateau on that side
  double from_bone = 1e9;
  double from_tendon = 0;
  double off_skin = 0;
};

inline PortalPlace place_of_portal(const GeneratedAnatomy& knee, const std::string& name) {
  const double lateral = knee.side == "left" ? 1 : -1;
  const double side = name == "portal_al" ? lateral : -lateral;
  const GeneratedBone& tibia = bone_named(knee, "tibia");
  const Pose X_TW = tibia.X_WB.inverse();
  const Vec3 p_W = landmark_of(knee, name), p_T = X_TW * p_W;
  PortalPlace out;
  const TriMesh& tendon_W = soft_named(knee, "patellar_tendon").mesh_W;
  double edge = -1e9;  // the farthest place of the tendon's section at that height
  for (const Triangle& t : tendon_W.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 a = X_TW * tendon_W.vertices[t[k]], b = X_TW * tendon_W.vertices[t[(k + 1) % 3]];
      if ((a.x() < p_T.x()) == (b.x() < p_T.x())) continue;
      const double share = (p_T.x() - a.x()) / (b.x() - a.x());
      edge = std::max(edge, side * (a.y() + share * (b.y() - a.y())));
    }
  double top = 1e9;
  for (const Vec3& v : tibia.mesh.vertices)
    if (side * v.y() > 0.012 && side * v.y() < 0.030 && v.z() > 0) top = std::min(top, v.x());
  out.beyond_edge = 1e3 * (side * p_T.y() - edge);
  out.over_plateau = 1e3 * (top - p_T.x());
  for (const MeshDistance& bone : bone_surfaces_W(knee))
    out.from_bone = std::min(out.from_bone, 1e3 * bone.closest(p_W).signed_distance);
  out.from_tendon = 1e3 * MeshDistance(tendon_W).closest(p_W).signed_distance;
  out.off_skin = 1e3 * MeshDistance(soft_named(knee, "skin").mesh_W).closest(p_W).signed_distance;
  return out;
}

/// The anterolateral portal lies just beside the tendon, the anteromedial one 10 mm from it (see
/// assets/anatomy/knee.toml), both a finger's breadth over the plateau; at no place over bone.
inline void expect_in_soft_spots(std::uint64_t seed, double flexion_deg) {
  const GeneratedAnatomy knee = bent_knee(seed, flexion_deg);
  for (const std::string name : {"portal_al", "portal_am"}) {
    SCOPED_TRACE("seed " + std::to_string(seed) + ", " + std::to_string(int(flexion_deg)) +
                 " degrees, " + name);
    const PortalPlace at = place_of_portal(knee, name);
    EXPECT_GT(at.beyond_edge, name == "portal_al" ? 2 : 5);
    EXPECT_LT(at.beyond_edge, name == "portal_al" ? 6 : 12);
    EXPECT_GT(at.over_plateau, 4);
    EXPECT_LT(at.over_plateau, 16);
    EXPECT_GT(at.from_bone, 10);
    EXPECT_GT(at.from_tendon, 2);
    EXPECT_LT(std::abs(at.off_skin), 0.1);
    std::printf(
        "seed %2d %3.0f deg %s: %.1f mm beyond the tendon's edge, %.1f over the plateau, "
        "%.1f from bone, %.1f from the tendon\n",
        int(seed), flexion_deg, name.c_str(), at.beyond_edge, at.over_plateau, at.from_bone,
        at.from_tendon);
  }
}

}  // namespace osteon::checks
