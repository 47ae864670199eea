#pragma once

#include <cmath>
#include <memory>
#include <numbers>
#include <string>

#include "osteon/scene/build_case.h"
#include "osteon/scene/state.h"

namespace osteon::testing {

/// A torus whose hole looks along z, 8 mm wide, of 2 mm thickness.
inline TriMesh ring_mesh() {
  constexpr std::uint32_t kRound = 32, kAcross = 8;
  TriMesh mesh;
  for (std::uint32_t i = 0; i < kRound; ++i)
    for (std::uint32_t k = 0; k < kAcross; ++k) {
      const double a = 2 * std::numbers::pi * i / kRound, b = 2 * std::numbers::pi * k / kAcross;
      const double out = 0.005 + 0.001 * std::cos(b);
      mesh.vertices.push_back({out * std::cos(a), out * std::sin(a), 0.001 * std::sin(b)});
      const std::uint32_t j = (i + 1) % kRound, l = (k + 1) % kAcross;
      mesh.triangles.push_back({i * kAcross + k, j * kAcross + k, j * kAcross + l});
      mesh.triangles.push_back({i * kAcross + k, j * kAcross + l, i * kAcross + l});
    }
  return mesh;
}

inline BoneDef block_at(const std::string& name, const Vec3& lo, const Vec3& hi) {
  BoneDef bone;
  bone.name = name;
  bone.felt = Felt::kHull;
  bone.X_WB.p = 0.5 * (lo + hi);
  const Vec3 half = 0.5 * (hi - lo);
  for (int i = 0; i < 8; ++i)
    bone.mesh.vertices.push_back({(i & 1) ? half.x() : -half.x(), (i & 2) ? half.y() : -half.y(),
                                  (i & 4) ? half.z() : -half.z()});
  bone.mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                         {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return bone;
}

inline constexpr double kRingLies_m = 0.006;  // on a shoulder: the height of its middle

/// A floor at z = 0; two pegs 12 mm high at x = 0 and x = 30 mm, each on a shoulder 5 mm high; on
/// the first one a ring (bone 5), and one more (bone 6) where `second` says, flat.
inline std::shared_ptr<const Case> ring_box(const Vec3& second = {0.06, 0, 0.001}) {
  CaseDef def;
  def.name = "ring box";
  def.bones.push_back(block_at("floor", {-0.1, -0.1, -0.006}, {0.1, 0.1, 0}));
  for (int i = 0; i < 2; ++i) {
    const double x = 0.03 * i;
    const std::string n = std::to_string(i + 1);
    def.bones.push_back(
        block_at("shoulder_" + n, {x - 0.0042, -0.0042, 0}, {x + 0.0042, 0.0042, 0.005}));
    def.bones.push_back(
        block_at("peg_" + n, {x - 0.002, -0.002, 0.005}, {x + 0.002, 0.002, 0.012}));
  }
  for (int i = 0; i < 2; ++i) {
    BoneDef ring;
    ring.name = "ring_" + std::to_string(i + 1);
    ring.felt = Felt::kHull;
    ring.mesh = ring_mesh();
    ring.X_WB.p = i == 0 ? Vec3(0, 0, kRingLies_m) : second;
    def.bones.push_back(ring);
  }
  def.landmarks = {{"top_1", Vec3(0, 0, 0.012)}, {"top_2", Vec3(0.03, 0, 0.012)}};
  auto built = build_case(std::move(def));
  if (!built) return nullptr;
  return std::make_shared<const Case>(std::move(*built));
}

/// A tool that comes level along +x, its jaws' hinge along y, at the middle line of a ring whose
/// middle is `center_W`.
inline ToolState jaws_at_ring(const Vec3& center_W, double jaw) {
  ToolState tool;
  tool.tick = 1;
  tool.jaw = jaw;
  // z of Tool looks back, along -x; x lies along -y; y along z.
  Mat3 R;
  R.col(0) = Vec3(0, -1, 0);
  R.col(1) = Vec3(0, 0, 1);
  R.col(2) = Vec3(-1, 0, 0);
  tool.X_WP = {center_W + Vec3(-0.005 + 0.0015, 0, 0), Quat(Eigen::Quaterniond(R))};
  return tool;
}

}  // namespace osteon::testing
