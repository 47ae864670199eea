#pragma once

#include <memory>

#include "osteon/mesh/append_mesh.h"
#include "osteon/physics/disc_setup.h"
#include "osteon/scene/build_case.h"

namespace osteon::testing {

inline TriMesh disc_block(const Vec3& lo, const Vec3& hi) {
  TriMesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.vertices.push_back(
        {(i & 1) ? hi.x() : lo.x(), (i & 2) ? hi.y() : lo.y(), (i & 4) ? hi.z() : lo.z()});
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

inline constexpr double kDiscHalf_m = 0.008;   // from bone to bone, along x
inline constexpr double kDiscWide_m = 0.010;   // along y
inline constexpr double kDiscThick_m = 0.003;  // along z

/// Two blocks with a disc between them, high above their middles; or one that is torn off the ulna,
/// of which a stump is left.
inline std::shared_ptr<const Case> disc_case(bool torn = false, bool with_disc = true) {
  CaseDef def;
  def.name = "two blocks and a disc";
  for (const double side : {-1.0, 1.0}) {
    BoneDef bone;
    bone.name = side < 0 ? "radius" : "ulna";
    bone.mesh = side < 0 ? disc_block({-0.020, -0.008, -0.020}, {-kDiscHalf_m, 0.008, 0.004})
                         : disc_block({kDiscHalf_m, -0.008, -0.020}, {0.020, 0.008, 0.004});
    def.bones.push_back(bone);
  }
  const Vec3 half(kDiscHalf_m + 0.0002, kDiscWide_m / 2, kDiscThick_m / 2);
  SoftDef soft;
  soft.name = "tfcc_disc";
  soft.tissue = "meniscus";
  soft.kind = "disc";
  soft.bones = {"radius", "ulna"};
  if (torn) {
    soft.mesh_W = disc_block(-half, {0.005, half.y(), half.z()});
    append_mesh(soft.mesh_W, disc_block({0.006, -half.y(), -half.z()}, half));
  } else {
    soft.mesh_W = disc_block(-half, half);
  }
  if (with_disc) def.softs.push_back(soft);
  auto built = build_case(std::move(def));
  return built ? std::make_shared<const Case>(std::move(*built)) : nullptr;
}

inline DiscRow disc_row() { return {"tfcc_disc", 4e5, 4e5}; }
inline constexpr double kDiscTable_n_per_m = 900;

}  // namespace osteon::testing
