#include "tool_vicinity.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "osteon/base/random.h"
#include "test_scene.h"

namespace osteon {
namespace {

// Bones of a few boxes each, spread over 60 mm, and a tool of six stretches.
struct Surrounded {
  static constexpr std::uint32_t kBones = 8;
  Surrounded() {
    Random random(5);
    for (std::uint32_t b = 0; b < kBones; ++b) {
      std::vector<Hull> hulls;
      for (int i = 0; i < 12; ++i)
        hulls.push_back(test::box_hull(Vec3(0.002, 0.001, 0.003), 0.008 * random.direction()));
      bones.push_back(test::bone_of(hulls));
      broad.add_bone(std::span<const ConvexBody>(bones.back().bodies));
      X_WB.push_back({0.03 * random.direction(), random.rotation()});
    }
    for (std::uint32_t s = 0; s < 6; ++s)
      stretches.push_back({Vec3(0, 0, 0.015 * s), Vec3(0, 0, 0.015 * (s + 1)), 0.001, s});
  }
  std::vector<Bone> bones;
  BroadPhase broad;
  std::vector<Pose> X_WB;
  std::vector<ToolStretch> stretches;
};

struct SeenPiece {
  std::uint32_t stretch, bone, piece;
  bool operator==(const SeenPiece&) const = default;
};

std::vector<SeenPiece> seen_by(ToolVicinity& around, const Pose& X_WT, std::span<const Pose> X_WB,
                               double margin) {
  std::vector<SeenPiece> out;
  around.look(X_WT, X_WB, margin);
  std::array<PieceRef, 128> pieces;
  for (const StretchBesideBone& which : around.near()) {
    const std::size_t count =
        around.query(which, around.ball(which.stretch, X_WT), X_WB, margin, pieces);
    for (std::size_t i = 0; i < count; ++i)
      out.push_back({which.stretch, pieces[i].bone, pieces[i].piece});
  }
  return out;
}

std::vector<SeenPiece> all_of(const Surrounded& s, const ToolVicinity& around, const Pose& X_WT,
                              std::span<const Pose> X_WB, double margin) {
  std::vector<SeenPiece> out;
  std::array<PieceRef, 128> pieces;
  for (std::uint32_t k = 0; k < s.stretches.size(); ++k) {
    const std::size_t count = s.broad.query(X_WB, around.ball(k, X_WT), margin, pieces);
    for (std::size_t i = 0; i < count; ++i) out.push_back({k, pieces[i].bone, pieces[i].piece});
  }
  return out;
}

TEST(ToolVicinity, OfAPoseThatIsNoNumberAreEverything) {
  Surrounded s;
  ToolVicinity around(s.broad, s.stretches, 0.1);
  Pose X_WT;
  (void)seen_by(around, X_WT, s.X_WB, 0.001);
  X_WT.p.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(seen_by(around, X_WT, s.X_WB, 0.001).size(), 6u * Surrounded::kBones * 12);
  s.X_WB[3].p.y() = std::numeric_limits<double>::infinity();
  const auto seen = seen_by(around, Pose{Vec3(0.5, 0, 0), Quat::Identity()}, s.X_WB, 0.001);
  EXPECT_EQ(seen.size(), 6u * 12);
  for (const SeenPiece& piece : seen) EXPECT_EQ(piece.bone, 3u);
}

// Tool and bones wander by steps of all sizes, and the margin changes: what is found is what a
// search over everything finds, in the same order.
TEST(ToolVicinity, AreThoseOfASearchOverAll) {
  Surrounded s;
  ToolVicinity around(s.broad, s.stretches, 0.1);
  Random random(8);
  Pose X_WT{Vec3(0.02, 0, 0), Quat::Identity()};
  std::size_t found = 0;
  std::size_t looked_at = 0;
  for (int i = 0; i < 4000; ++i) {
    const double step = i % 500 == 0 ? 0.03 : 0.0006 * random.uniform(0, 1);
    X_WT.p += step * random.direction();
    if (X_WT.p.norm() > 0.05) X_WT.p *= 0.5;
    const Vec3 turn = 5 * step * random.direction();
    X_WT.q = (Quat(1, turn.x(), turn.y(), turn.z()) * X_WT.q).normalized();
    Pose& bone = s.X_WB[static_cast<std::size_t>(i) % Surrounded::kBones];
    const Vec3 shake = 1e-3 * random.direction();
    if (i % 3 == 0) bone.q = (Quat(1, shake.x(), shake.y(), shake.z()) * bone.q).normalized();
    if (i % 3 == 1) bone.p += 1e-4 * random.direction();
    const double margin = random.uniform(0.0001, 0.002);
    const auto seen = seen_by(around, X_WT, s.X_WB, margin);
    ASSERT_EQ(seen, all_of(s, around, X_WT, s.X_WB, margin)) << i;
    found += seen.size();
    looked_at += around.near().size();
  }
  EXPECT_GT(found, 1500u);
  EXPECT_LT(looked_at, 4000u * 6 * Surrounded::kBones / 2);
}

}  // namespace
}  // namespace osteon
