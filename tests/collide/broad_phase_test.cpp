#include "osteon/collide/broad_phase.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "collide/shapes.h"
#include "osteon/collide/lp_contact.h"

namespace osteon {
namespace {

constexpr double kBall = 0.002;
constexpr double kMargin = 0.001;

struct Scene {
  BroadPhase broad;
  std::vector<std::vector<ConvexBody>> bones;
  std::vector<Pose> X_WB;
};

Scene scattered(Random& random, int bones, int pieces) {
  Scene s;
  for (int i = 0; i < bones; ++i) {
    std::vector<ConvexBody> bone;
    for (int k = 0; k < pieces; ++k) {
      const Vec3 half(random.uniform(0.002, 0.01), 0.004, 0.006);
      const Vec3 center = 0.02 * random.direction();
      bone.push_back(shapes::body(shapes::box(half, center)));
    }
    s.broad.add_bone(bone);
    s.bones.push_back(std::move(bone));
    s.X_WB.push_back(shapes::random_pose(random, 0.06));
  }
  return s;
}

// Whether a box of the ball's size plus margin, at some place along the path, meets the piece: it
// is inside the ball's reach, so the broad phase must name the piece.
bool surely_near(const ConvexBody& piece, const Pose& X_WB, const SweptSphere& ball) {
  const double half = (ball.radius + kMargin) / std::sqrt(3.0);
  const ConvexBody inner = shapes::body(shapes::box(Vec3::Constant(half)));
  for (int i = 0; i <= 20; ++i) {
    const Vec3 p_W = ball.p_from_W + (ball.p_to_W - ball.p_from_W) * (i / 20.0);
    if (lp_test(piece, inner, X_WB.inverse() * Pose{p_W, Quat::Identity()}).hit) return true;
  }
  return false;
}

TEST(BroadPhase, EmptyAndBoneWithoutPieces) {
  BroadPhase broad;
  std::array<PieceRef, 4> out;
  EXPECT_EQ(broad.query({}, {}, 0, out), 0u);
  broad.add_bone(std::span<const ConvexBody>());
  const std::array<Pose, 1> X_WB;
  EXPECT_EQ(broad.query(X_WB, {}, 1, out), 0u);
}

TEST(BroadPhase, TouchingCountsAndBeyondTheMarginDoesNot) {
  BroadPhase broad;
  const std::vector<ConvexBody> pieces = {shapes::body(shapes::box({0.01, 0.01, 0.01}))};
  broad.add_bone(pieces);
  const std::array<Pose, 1> X_WB;
  std::array<PieceRef, 4> out;
  const auto at = [&](double x) {
    return broad.query(X_WB, {Vec3(x, 0, 0), Vec3(x, 0, 0), kBall}, kMargin, out);
  };
  EXPECT_EQ(at(0.013), 1u);
  EXPECT_EQ(at(0.0131), 0u);
  // A path that starts and ends outside but passes through.
  EXPECT_EQ(broad.query(X_WB, {Vec3(-1, 0, 0), Vec3(1, 0, 0), 0}, 0, out), 1u);
  EXPECT_EQ(broad.query(X_WB, {Vec3(-1, 0.02, 0), Vec3(1, 0.02, 0), 0}, 0, out), 0u);
}

TEST(BroadPhase, NamesEveryPieceThatIsNearInCreationOrder) {
  Random random(17);
  std::size_t named = 0, near = 0, all = 0;
  for (int round = 0; round < 12; ++round) {
    const Scene s = scattered(random, 6, 4);
    for (int i = 0; i < 25; ++i) {
      const Vec3 from = shapes::random_pose(random, 0.06).p;
      const Vec3 step = 0.08 * random.direction();
      const SweptSphere ball{from, from + step, kBall};
      std::array<PieceRef, 64> out;
      const std::size_t count = s.broad.query(s.X_WB, ball, kMargin, out);
      ASSERT_LE(count, out.size());
      const auto end = out.begin() + static_cast<std::ptrdiff_t>(count);
      EXPECT_TRUE(std::is_sorted(out.begin(), end, [](const PieceRef& p, const PieceRef& q) {
        return p.bone != q.bone ? p.bone < q.bone : p.piece < q.piece;
      }));
      for (std::uint32_t b = 0; b < s.bones.size(); ++b)
        for (std::uint32_t p = 0; p < s.bones[b].size(); ++p, ++all) {
          if (!surely_near(s.bones[b][p], s.X_WB[b], ball)) continue;
          ++near;
          EXPECT_NE(std::find(out.begin(), end, PieceRef{b, p}), end);
        }
      named += count;
    }
  }
  // It must also leave most of the far pieces out.
  EXPECT_GT(near, 50u);
  EXPECT_LT(named, 3 * near);
  EXPECT_LT(named, all / 2) << near;
}

// A ball that wanders, stops, leaps and grows among bones that move: the kept lists change nothing.
TEST(BroadPhase, WhatIsKeptNearByChangesNothing) {
  Random random(19);
  Scene s = scattered(random, 6, 12);
  NearPieces near(s.broad);
  Vec3 p = Vec3::Zero();
  std::size_t named = 0;
  for (int i = 0; i < 6000; ++i) {
    const Vec3 step = random.direction();
    p += (i % 700 == 699 ? 0.03 : 1e-4) * step;
    if (p.norm() > 0.05) p *= 0.2;
    const Vec3 shift = random.direction();
    const Quat turn = random.rotation();
    Pose& X_WB = s.X_WB[static_cast<std::size_t>(i) % s.X_WB.size()];
    if (i % 3 == 0) X_WB.p += 2e-5 * shift;
    if (i % 50 == 0) X_WB.q = Quat::Identity().slerp(0.01, turn) * X_WB.q;
    const double margin = i % 97 == 0 ? 0.02 : random.uniform(0, 0.003);
    const Vec3 to = i % 11 == 0 ? Vec3(p + 0.004 * step) : p;
    std::array<PieceRef, 72> plain, kept;
    const std::size_t count = s.broad.query(s.X_WB, {p, to, kBall}, margin, plain);
    ASSERT_EQ(s.broad.query(s.X_WB, {p, to, kBall}, margin, kept, &near), count) << i;
    const auto end = plain.begin() + static_cast<std::ptrdiff_t>(count);
    ASSERT_TRUE(std::equal(plain.begin(), end, kept.begin())) << i;
    named += count;
  }
  EXPECT_GT(named, 6000u);
}

TEST(BroadPhase, ASmallBufferGetsTheFirstAndTheFullCount) {
  BroadPhase broad;
  const std::vector<ConvexBody> pieces(5, shapes::body(shapes::box({0.01, 0.01, 0.01})));
  broad.add_bone(pieces);
  const std::array<Pose, 1> X_WB;
  std::array<PieceRef, 2> out;
  EXPECT_EQ(broad.query(X_WB, {}, 0, out), 5u);
  EXPECT_EQ(out[0], (PieceRef{0, 0}));
  EXPECT_EQ(out[1], (PieceRef{0, 1}));
}

TEST(BroadPhase, ABrokenPoseHidesNothing) {
  BroadPhase broad;
  const std::vector<ConvexBody> pieces = {shapes::body(shapes::box({0.01, 0.01, 0.01}))};
  broad.add_bone(pieces);
  broad.add_bone(pieces);
  const std::array<Pose, 2> X_WB = {Pose{Vec3(NAN, 0, 0), Quat::Identity()},
                                    Pose{Vec3(5, 5, 5), Quat::Identity()}};
  std::array<PieceRef, 4> out;
  EXPECT_EQ(broad.query(X_WB, {}, 0, out), 1u);
  EXPECT_EQ(out[0], (PieceRef{0, 0}));
  NearPieces near(broad);
  EXPECT_EQ(broad.query(X_WB, {}, 0, out, &near), 1u);
  EXPECT_EQ(out[0], (PieceRef{0, 0}));
}

}  // namespace
}  // namespace osteon
