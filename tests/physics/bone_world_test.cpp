#include "osteon/physics/bone_world.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "osteon/base/random.h"
#include "physics_fixtures.h"

namespace osteon {
namespace {

using testing::box_case;
using testing::center_W;
using testing::push;

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

PhysicsParams springs() {
  PhysicsParams params;
  params.hold_bones = false;
  return params;
}

// Random pushes on random bones: a function of the seed.
ToolState random_push(Random& random, const BoneSnapshot& bones) {
  ToolState tool;
  tool.contact_count = static_cast<std::uint32_t>(random.uniform(0, 4));
  for (std::uint32_t i = 0; i < tool.contact_count; ++i) {
    const auto bone = static_cast<std::uint32_t>(random.uniform(0, bones.count));
    const Vec3 p_W = center_W(bones.bones[bone].X_WB) + 0.01 * random.direction();
    const Vec3 force_W = random.direction() * random.uniform(0, 5);
    const ToolState one = push(bone, p_W, force_W);
    tool.contacts[i] = one.contacts[0];
  }
  return tool;
}

void expect_at_rest(const Case& the_case, const BoneSnapshot& snapshot) {
  ASSERT_EQ(snapshot.count, the_case.bones.size());
  for (std::size_t i = 0; i < snapshot.count; ++i) {
    EXPECT_EQ(snapshot.bones[i].X_WB.p, the_case.bones[i].X_WB.p);
    EXPECT_EQ(snapshot.bones[i].X_WB.q.coeffs(), the_case.bones[i].X_WB.q.coeffs());
    EXPECT_EQ(snapshot.bones[i].v_W, Vec3::Zero());
    EXPECT_EQ(snapshot.bones[i].w_W, Vec3::Zero());
  }
}

TEST(BoneWorld, OfNoBonesSteps) {
  BoneWorld world(box_case({}), springs());
  EXPECT_EQ(world.step(ToolState{}).step, 1u);
  EXPECT_EQ(world.snapshot().count, 0u);
}

// After one step from rest a body of half the mass is faster; what it has lost is told, not kept in
// its state.
TEST(BoneWorld, ABoneThatHasLostHalfIsLighter) {
  const auto the_case = box_case({0.1});
  BoneWorld whole(the_case, springs()), half(the_case, springs());
  const double mass = whole.mass_kg(0);
  BoneLoss loss;
  loss.mass_kg = 0.5 * mass;
  loss.first_B = loss.mass_kg * Vec3(0.03, -0.02, 0.05);
  half.set_loss(0, loss);
  EXPECT_NEAR(half.mass_kg(0), 0.5 * mass, 1e-15);
  EXPECT_EQ(half.snapshot().bones[0].X_WB.p, whole.snapshot().bones[0].X_WB.p);
  half.set_loss(0, {});
  EXPECT_EQ(half.mass_kg(0), mass);
  half.set_loss(0, loss);
  const ToolState pushed = push(0, center_W(the_case->bones[0].X_WB), Vec3(0, 0, 1));
  const double v_whole = whole.step(pushed).bones[0].v_W.z();
  const double v_half = half.step(pushed).bones[0].v_W.z();
  EXPECT_GT(v_whole, 0);
  EXPECT_GT(v_half, 1.05 * v_whole);
}

TEST(BoneWorld, BeginsAtRestAndCountsItsSteps) {
  const auto the_case = box_case({0.003, 0.05});
  BoneWorld world(the_case, springs());
  expect_at_rest(*the_case, world.snapshot());
  EXPECT_EQ(world.snapshot().step, 0u);
  for (int i = 0; i < 3; ++i) (void)world.step(ToolState{});
  EXPECT_EQ(world.snapshot().step, 3u);
  EXPECT_DOUBLE_EQ(world.snapshot().time_s, 0.006);
}

TEST(BoneWorld, HeldBonesStayExactlyAtRest) {
  const auto the_case = box_case({0.003, 0.05});
  BoneWorld world(the_case, PhysicsParams{});
  Random random(1);
  for (int i = 0; i < 100; ++i) (void)world.step(random_push(random, world.snapshot()));
  expect_at_rest(*the_case, world.snapshot());
}

TEST(BoneWorld, HoldingPutsBonesBack) {
  const auto the_case = box_case({0.003});
  BoneWorld world(the_case, springs());
  const ToolState tool = push(0, center_W(the_case->bones[0].X_WB), {3, 0, 0});
  for (int i = 0; i < 50; ++i) (void)world.step(tool);
  EXPECT_NE(world.snapshot().bones[0].X_WB.p, the_case->bones[0].X_WB.p);
  world.set_hold(true);
  (void)world.step(tool);
  expect_at_rest(*the_case, world.snapshot());
  world.set_hold(false);
  (void)world.step(tool);
  EXPECT_NE(world.snapshot().bones[0].X_WB.p, the_case->bones[0].X_WB.p);
}

TEST(BoneWorld, LeftAloneBonesStay) {
  const auto the_case = box_case({0.0005, 0.003, 1});
  BoneWorld world(the_case, springs());
  for (int i = 0; i < 20000; ++i) (void)world.step(ToolState{});
  for (std::size_t i = 0; i < 3; ++i) {
    const BoneMotion& bone = world.snapshot().bones[i];
    EXPECT_LT((bone.X_WB.p - the_case->bones[i].X_WB.p).norm(), 1e-12);
    EXPECT_LT(bone.X_WB.q.angularDistance(the_case->bones[i].X_WB.q), 1e-7);
  }
}

TEST(BoneWorld, ASteadyPushEndsWhereTheSpringHoldsIt) {
  for (const double mass : {0.0005, 0.003, 0.05, 1.0}) {
    const auto the_case = box_case({mass});
    const Pose rest = the_case->bones[0].X_WB;
    BoneWorld world(the_case, springs());
    const Vec3 force_W(1.5, -2, 0.5);
    for (int i = 0; i < 5000; ++i)
      (void)world.step(push(0, center_W(world.snapshot().bones[0].X_WB), force_W));
    const BoneMotion& bone = world.snapshot().bones[0];
    EXPECT_LT((center_W(bone.X_WB) - center_W(rest) - force_W / 3000).norm(), 1e-9) << mass;
    EXPECT_LT(bone.v_W.norm(), 1e-9);
    for (int i = 0; i < 5000; ++i) (void)world.step(ToolState{});
    EXPECT_LT((center_W(world.snapshot().bones[0].X_WB) - center_W(rest)).norm(), 1e-9) << mass;
  }
}

TEST(BoneWorld, AnOffCentrePushTurnsTheBoneAboutItsCentreOfMass) {
  const auto the_case = box_case({0.003});
  const Pose rest = the_case->bones[0].X_WB;
  BoneWorld world(the_case, springs());
  // A pure couple: 2 N and -2 N, 10 mm apart, about the world's z.
  for (int i = 0; i < 5000; ++i) {
    const Vec3 c = center_W(world.snapshot().bones[0].X_WB);
    ToolState tool = push(0, c + Vec3(0.005, 0, 0), {0, 2, 0});
    tool.contacts[1] = push(0, c - Vec3(0.005, 0, 0), {0, -2, 0}).contacts[0];
    tool.contact_count = 2;
    (void)world.step(tool);
  }
  const BoneMotion& bone = world.snapshot().bones[0];
  EXPECT_LT((center_W(bone.X_WB) - center_W(rest)).norm(), 1e-9);
  const Eigen::AngleAxisd turn(bone.X_WB.q * rest.q.conjugate());
  // k 2 sin(angle / 2) = 0.02 N m with k = 0.5.
  EXPECT_NEAR(2 * std::sin(turn.angle() / 2), 0.04, 1e-6);
  EXPECT_GT(turn.axis().z() * turn.angle(), 0);
  EXPECT_NEAR(std::abs(turn.axis().z()), 1, 1e-6);
}

TEST(BoneWorld, CriticalDampingDoesNotOvershoot) {
  for (const double mass : {0.0005, 0.005, 0.5}) {
    const auto the_case = box_case({mass});
    const Vec3 c0 = center_W(the_case->bones[0].X_WB);
    BoneWorld world(the_case, springs());
    for (int i = 0; i < 200; ++i)
      (void)world.step(push(0, center_W(world.snapshot().bones[0].X_WB), {5, 0, 0}));
    double before = (center_W(world.snapshot().bones[0].X_WB) - c0).x();
    for (int i = 0; i < 3000; ++i) {
      (void)world.step(ToolState{});
      const double now = (center_W(world.snapshot().bones[0].X_WB) - c0).x();
      if (i > 2) {
        EXPECT_LE(now, before + 1e-12);
      }
      EXPECT_GE(now, -1e-9);
      before = now;
    }
  }
}

TEST(BoneWorld, IsStableWithoutDampingAndWithStiffSprings) {
  for (const double mass : {0.0005, 0.003, 1.0}) {
    PhysicsParams params = springs();
    params.spring_n_per_m = 1e6;
    params.spring_nm_per_rad = 100;
    params.damping_ratio = 0;
    const auto the_case = box_case({mass});
    BoneWorld world(the_case, params);
    const Vec3 corner_W = the_case->bones[0].X_WB * Vec3(0.036, -0.01, 0.065);
    for (int i = 0; i < 10; ++i) (void)world.step(push(0, corner_W, {20, 5, -9}));
    double largest = 0;
    for (int i = 0; i < 20000; ++i) {
      const BoneMotion& bone = world.step(ToolState{}).bones[0];
      if (i >= 10000) largest = std::max(largest, (bone.X_WB.p - the_case->bones[0].X_WB.p).norm());
    }
    EXPECT_LT(largest, 1e-4) << mass;
  }
}

TEST(BoneWorld, VelocitiesAreThoseOfTheMotion) {
  // The speed of the frame's origin, which is not the centre of mass, against a difference
  // quotient.
  const auto the_case = box_case({0.02});
  PhysicsParams params = springs();
  params.step_s = 1e-5;
  BoneWorld world(the_case, params);
  const Vec3 corner_W = the_case->bones[0].X_WB * Vec3(0.036, -0.01, 0.065);
  for (int i = 0; i < 1000; ++i) {
    const BoneMotion before = world.snapshot().bones[0];
    const BoneMotion now = world.step(push(0, corner_W, {2, 1, -1})).bones[0];
    const Vec3 v_W = (now.X_WB.p - before.X_WB.p) / params.step_s;
    EXPECT_LT((v_W - now.v_W).norm(), 1e-3 + 1e-2 * now.v_W.norm());
    const Quat turn = now.X_WB.q * before.X_WB.q.conjugate();
    EXPECT_LT((2 * turn.vec() / params.step_s - now.w_W).norm(), 1e-3 + 1e-2 * now.w_W.norm());
  }
}

TEST(BoneWorld, ABoneStaysWithinItsRange) {
  const auto the_case = box_case({0.0005, 1});
  BoneWorld world(the_case, springs());
  Random random(4);
  for (int i = 0; i < 3000; ++i) {
    ToolState tool = random_push(random, world.snapshot());
    for (Contact& contact : tool.contacts) contact.force_on_tool_W *= 150;
    (void)world.step(tool);
    for (std::size_t b = 0; b < 2; ++b) {
      const Pose& X_WB = world.snapshot().bones[b].X_WB;
      EXPECT_LT((center_W(X_WB) - center_W(the_case->bones[b].X_WB)).norm(), 0.0200001);
      EXPECT_LT(X_WB.q.angularDistance(the_case->bones[b].X_WB.q), 0.52);
    }
  }
}

TEST(BoneWorld, FaultyContactsAreNotApplied) {
  const auto the_case = box_case({0.003});
  const Vec3 c = center_W(the_case->bones[0].X_WB);
  BoneWorld world(the_case, springs());
  BoneWorld untouched(the_case, springs());
  for (const ToolState& tool :
       {push(0, c, {kNaN, 0, 0}), push(0, c, {kInf, 0, 0}), push(0, {kNaN, 0, 0}, {1, 0, 0}),
        push(0, c, {1e300, 1e300, 0}), push(0, {1e300, 0, 0}, {1, 0, 0}), push(0, c, {1001, 0, 0}),
        push(5, c, {1, 0, 0}), push(BoneId::kNone, c, {1, 0, 0})}) {
    (void)world.step(tool);
    (void)untouched.step(ToolState{});
    EXPECT_EQ(world.state_hash(), untouched.state_hash());
  }
  // A sound contact beside a faulty one still counts.
  ToolState both = push(0, c, {kNaN, 0, 0});
  both.contacts[1] = push(0, c, {1, 0, 0}).contacts[0];
  both.contact_count = 2;
  EXPECT_GT(world.step(both).bones[0].v_W.x(), 0.01);
}

TEST(BoneWorld, IsAFunctionOfItsInputs) {
  const auto the_case = box_case({0.0005, 0.003, 0.02, 1});
  BoneWorld a(the_case, springs()), b(the_case, springs());
  Random random_a(6), random_b(6);
  std::uint64_t before = 0;
  for (int i = 0; i < 500; ++i) {
    (void)a.step(random_push(random_a, a.snapshot()));
    (void)b.step(random_push(random_b, b.snapshot()));
    ASSERT_EQ(a.state_hash(), b.state_hash()) << i;
    EXPECT_NE(a.state_hash(), before);
    before = a.state_hash();
  }
}

TEST(BoneWorld, ARestoredWorldGoesOnWithTheSameBits) {
  const auto the_case = box_case({0.0005, 0.003, 0.02});
  BoneWorld original(the_case, springs());
  Random random(7);
  for (int i = 0; i < 300; ++i) (void)original.step(random_push(random, original.snapshot()));
  const BoneSnapshot saved = original.snapshot();

  // Into a new world, and into one that has been elsewhere.
  BoneWorld fresh(the_case, springs()), used(the_case, springs());
  Random other(8);
  for (int i = 0; i < 100; ++i) (void)used.step(random_push(other, used.snapshot()));
  fresh.restore(saved, false);
  used.restore(saved, false);
  for (int i = 0; i < 300; ++i) {
    const ToolState tool = random_push(random, original.snapshot());
    (void)original.step(tool);
    (void)fresh.step(tool);
    (void)used.step(tool);
    ASSERT_EQ(fresh.state_hash(), original.state_hash()) << i;
    ASSERT_EQ(used.state_hash(), original.state_hash()) << i;
  }
}

TEST(BoneWorld, TheHashSeesEveryPart) {
  const auto the_case = box_case({0.003});
  BoneWorld world(the_case, springs());
  const BoneSnapshot rest = world.snapshot();
  const auto hash_with = [&](auto change) {
    BoneSnapshot changed = rest;
    change(changed);
    return hash_of(changed);
  };
  const std::uint64_t h = hash_of(rest);
  EXPECT_NE(h, hash_with([](BoneSnapshot& s) { s.step = 1; }));
  EXPECT_NE(h, hash_with([](BoneSnapshot& s) { s.bones[0].X_WB.p.x() += 1e-15; }));
  EXPECT_NE(h, hash_with([](BoneSnapshot& s) { s.bones[0].X_WB.q.w() += 1e-15; }));
  EXPECT_NE(h, hash_with([](BoneSnapshot& s) { s.bones[0].v_W.y() = 1e-300; }));
  EXPECT_NE(h, hash_with([](BoneSnapshot& s) { s.bones[0].w_W.z() = 1e-300; }));
  const std::uint64_t free_hash = world.state_hash();
  world.restore(rest, true);
  EXPECT_NE(world.state_hash(), free_hash);
}

// A stiff wall pushes a bone and learns of its place two steps late, as the haptic loop may.
double farthest_after(double contact_n_per_m, double mass_kg, int steps) {
  constexpr double kWall = 2000;
  constexpr double kSpring = 300;
  constexpr double kBalance = 0.001 * kWall / (kWall + kSpring);
  PhysicsParams params = springs();
  params.spring_n_per_m = kSpring;
  params.contact_n_per_m = contact_n_per_m;
  const auto the_case = box_case({mass_kg});
  BoneWorld world(the_case, params);
  const Vec3 rest_W = center_W(the_case->bones[0].X_WB);
  const Vec3 n_W = Vec3::UnitZ();
  std::array<double, 2> late{0, 0};
  double farthest = 0;
  for (int i = 0; i < steps; ++i) {
    const double depth = 0.001 - late[static_cast<std::size_t>(i % 2)];
    const ToolState tool = depth > 0 ? push(0, rest_W, kWall * depth * n_W) : ToolState{};
    const double way = (center_W(world.step(tool).bones[0].X_WB) - rest_W).dot(n_W);
    late[static_cast<std::size_t>(i % 2)] = way;
    if (i > steps - 100) farthest = std::max(farthest, std::abs(way - kBalance));
  }
  return farthest;
}

TEST(BoneWorld, ALightBoneUnderAStiffLateContactComesToRest) {
  for (const double mass_kg : {0.0005, 0.002, 0.01, 0.1})
    EXPECT_LT(farthest_after(2000, mass_kg, 1000), 1e-6) << mass_kg;
  EXPECT_GT(farthest_after(0, 0.002, 1000), 1e-4) << "what the damper is for";
}

}  // namespace
}  // namespace osteon
