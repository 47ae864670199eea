// The whole instrument is felt: shaft, boxes and thick handles, on pieces and on fields.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include "contact_field.h"
#include "mesh/shapes.h"
#include "osteon/base/random.h"
#include "osteon/collide/primitive_contact.h"
#include "test_scene.h"

namespace osteon {
namespace {

using test::Rig;

constexpr double kStiffness = 2000;

Tool tool_of_parts(std::vector<Primitive> parts) {
  Tool tool;
  tool.name = "whole";
  tool.parts = std::move(parts);
  return tool;
}

// A tip of 1 mm and a shaft of 2 mm along +z.
Tool scope(double shaft_radius = 0.002) {
  return tool_of_parts({make_rod(Vec3::Zero(), Vec3::Zero(), 0.001),
                        make_rod(Vec3(0, 0, 0.004), Vec3(0, 0, 0.15), shaft_radius)});
}

Quat about_y(double rad) { return {std::cos(rad / 2), 0, std::sin(rad / 2), 0}; }

Bone block(bool field, double half = 0.006) {
  if (field) return test::field_bone(test::cube(half), {}, {1e4, 0, 0});
  return test::bone_of({test::box_hull(Vec3::Constant(half))});
}

// Straight, turned as q.
const ToolState& go(Rig& rig, const Vec3& from, const Vec3& to, const Quat& q) {
  constexpr int kSteps = 100;
  for (int i = 1; i < kSteps; ++i) rig.at(from + (to - from) * (double(i) / kSteps), q);
  return rig.at(to, q);
}

class WholeTool : public ::testing::TestWithParam<bool> {};

// The shaft lies flat over the block, its tip far beyond: pressed down it meets the top.
TEST_P(WholeTool, AShaftThatLiesOnABlockIsHeldByIt) {
  Rig rig({block(GetParam())}, scope());
  const Quat flat = about_y(std::numbers::pi / 2);  // shaft along +x
  const double rest = 0.006 + 0.002;
  rig.at(Vec3(-0.05, 0, 0.012), flat);
  double last = 0;
  for (int i = 0; i <= 60; ++i) {
    const double z = 0.011 - 1e-4 * i;
    const ToolState& s = rig.at(Vec3(-0.05, 0, z), flat);
    EXPECT_NEAR(s.X_WP.p.z(), std::max(z, rest), 2e-5) << i;
    EXPECT_NEAR(s.force_W.z(), kStiffness * std::max(0.0, rest - z), 0.05) << i;
    EXPECT_GE(s.force_W.z(), last - 1e-9);
    last = s.force_W.z();
  }
  EXPECT_GT(last, 5);
}

// Two blocks whose lower faces lie in one plane, and a blade that rises between them. The planes
// that parted it from both when it was far below would stop it there, in the air.
TEST(WholeToolGap, ABladeRisesBetweenTwoBlocksOfOneHeight) {
  for (const double stop_m : {-0.0065, -0.006501, -0.0065005, -0.003}) {
    Bone right = block(false);
    right.X_WB.p = {0.028, 0, 0};
    Rig rig({block(false), right}, tool_of_parts({make_box({}, Vec3(0.005, 0.020, 0.0005))}));
    const Vec3 middle(0.014, 0, 0);
    go(rig, middle + Vec3(0, 0, -0.05), middle + Vec3(0, 0, stop_m), Quat::Identity());
    for (int i = 0; i < 5; ++i) rig.at(middle + Vec3(0, 0, stop_m));
    const ToolState& s =
        go(rig, middle + Vec3(0, 0, stop_m), middle + Vec3(0, 0, 0.004), Quat::Identity());
    EXPECT_EQ(s.X_WP.p, Vec3(middle + Vec3(0, 0, 0.004))) << stop_m;
    EXPECT_EQ(s.force_W, Vec3(0, 0, 0)) << stop_m;
  }
}

// Far more pieces lie within a wide turn of the shaft than a list holds: it turns in small steps
// where it once stood still for good.
TEST(WholeToolTurn, ALongShaftAmongManyPiecesGoesOnTurning) {
  std::vector<Hull> pieces;
  for (int ring = 0; ring < 5; ++ring)
    for (int k = 0; k < 20; ++k) {
      const double a = 2 * std::numbers::pi * k / 20;
      pieces.push_back(
          test::box_hull(Vec3::Constant(0.0004),
                         Vec3(0.0065 * std::cos(a), 0.0065 * std::sin(a), 0.09 + 0.005 * ring)));
    }
  ASSERT_GT(pieces.size(), kMaxCandidates);
  Rig rig({test::bone_of(std::move(pieces))}, scope());
  rig.at(Vec3::Zero());
  const ToolState* s = nullptr;
  for (int i = 0; i < 200; ++i) {
    s = &rig.at(Vec3::Zero(), about_y(0.3));
    ASSERT_FALSE(s->status & kTickSolverLimit) << i;
  }
  const double turned = 2 * std::asin(std::abs(s->X_WP.q.y()));
  EXPECT_GT(turned, 0.02);
  EXPECT_LT(turned, 0.08);
}

// A handle thicker than the field's fine band stands off by its radius.
TEST_P(WholeTool, AThickHandleStandsOffByItsRadius) {
  for (const double radius : {0.003, 0.008, 0.016}) {
    Rig rig({block(GetParam())}, scope(radius));
    const Quat flat = about_y(std::numbers::pi / 2);
    rig.at(Vec3(-0.05, 0, 0.010 + radius), flat);
    const ToolState& s =
        go(rig, Vec3(-0.05, 0, 0.010 + radius), Vec3(-0.05, 0, 0.004 + radius), flat);
    EXPECT_NEAR(s.X_WP.p.z(), 0.006 + radius, 3e-5) << radius;
  }
}

TEST_P(WholeTool, ABoxIsHeldByItsEdge) {
  const Primitive box = make_box({Vec3(0, 0, 0.005), Quat::Identity()}, Vec3(0.003, 0.001, 0.005));
  Rig rig({block(GetParam())}, tool_of_parts({box}));
  const Quat tilted = about_y(0.3);
  // Lowest corner under the origin of the tool.
  const double reach = support(box, tilted.conjugate() * -Vec3::UnitZ());
  rig.at(Vec3(0, 0, 0.012), tilted);
  const ToolState& s = go(rig, Vec3(0, 0, 0.012), Vec3(0, 0, 0.005), tilted);
  EXPECT_NEAR(s.X_WP.p.z(), 0.006 + reach, 3e-5);
  EXPECT_GT(s.force_W.z(), 1);
}

// How far the parts are from the block, by a search that shares nothing with the tick.
double least_gap(const Rig& rig, const ToolState& s, const Primitive& block) {
  double least = 1e9;
  for (const Primitive& part : rig.tool->parts)
    least = std::min(least, primitive_contact(block, part, s.X_WP).gap);
  return least;
}

TEST_P(WholeTool, NeitherPushNorTurnBringsAnyPartIntoBone) {
  const Primitive solid = make_box({}, Vec3::Constant(0.006));
  // A field of 0.25 mm cells rounds a sharp edge by a tenth of a millimetre at most.
  const double rounded = GetParam() ? 1.2e-4 : 2e-6;
  Random random(11);
  int touched = 0, turned = 0;
  for (int run = 0; run < 3; ++run) {
    Tool tool = scope();
    tool.parts.push_back(
        make_box({Vec3(0.006, 0, 0.03), Quat::Identity()}, Vec3(0.006, 0.001, 0.002)));
    Rig rig({block(GetParam())}, std::move(tool));
    Vec3 p(0, 0, 0.03);
    Quat q = random.rotation();
    rig.at(Vec3(0, 0, 0.4), q);
    Vec3 to = p;
    for (int i = 0; i < 1500; ++i) {
      if (i % 60 == 0) to = 0.02 * random.direction();
      p += 0.04 * (to - p);
      const Vec3 w = 0.01 * random.direction();
      q = (Quat(1, w.x(), w.y(), w.z()) * q).normalized();
      const ToolState& s = rig.at(p, q);
      if (s.status & kTickProxyBlocked) continue;
      touched += s.contact_count > 0;
      turned += s.X_WP.q.angularDistance(q) < 1e-9;
      EXPECT_GT(least_gap(rig, s, solid), -rounded) << run << " " << i;
    }
  }
  EXPECT_GT(touched, 500);
  EXPECT_GT(turned, 1500);
}

TEST_P(WholeTool, ASavedStateGoesOnAsItWas) {
  Rig rig({block(GetParam())}, scope());
  rig.at(Vec3(0, 0, 0.02), about_y(1.2));
  const auto move = [&](double x) {
    for (int i = 0; i < 200; ++i)
      rig.at(Vec3(x * i / 200, 0.001, 0.012 - 4e-5 * i), about_y(1.2 + 0.001 * i));
  };
  move(0.003);
  const auto saved = rig.loop.save();
  move(-0.004);
  const std::uint64_t once = rig.loop.state_hash();
  rig.loop.restore(*saved);
  EXPECT_NE(rig.loop.state_hash(), once);
  move(-0.004);
  EXPECT_EQ(rig.loop.state_hash(), once);
}

INSTANTIATE_TEST_SUITE_P(PiecesAndFields, WholeTool, ::testing::Values(false, true),
                         [](const auto& test) { return test.param ? "Field" : "Pieces"; });

// As many pieces as a bone of a case has, and more parts: what is near is found by a search over
// all of them.
TEST(WholeToolSearch, FindsEveryPairThatIsNear) {
  Random random(12);
  std::vector<Hull> pieces;
  for (int i = 0; i < 60; ++i)
    pieces.push_back(test::box_hull(Vec3(0.001, 0.0015, 0.0008), 0.03 * random.direction()));
  Case the_case;
  the_case.bones.push_back(test::bone_of(pieces));
  the_case.bones.push_back(test::bone_of({test::box_hull(Vec3::Constant(0.002))}));
  Tool tool = scope();
  tool.parts.push_back(
      make_box({Vec3(0, 0.01, 0.04), random.rotation()}, Vec3(0.006, 0.001, 0.002)));
  const ContactField field(the_case, tool);
  ToolVicinity around = field.vicinity();
  const std::vector<Pose> X_WB(2);
  std::size_t found = 0;
  for (int i = 0; i < 400; ++i) {
    const Pose X_WT{0.03 * random.direction(), random.rotation()};
    CandidateList list;
    ASSERT_TRUE(field.collect({X_WT, 0.001, 0}, X_WB, X_WB, around, list));
    std::vector<bool> listed(field.pairs().size(), false);
    for (std::uint32_t k = 0; k < list.count; ++k) {
      listed[list.pair[k]] = true;
      if (k > 0) {
        EXPECT_LT(list.pair[k - 1], list.pair[k]);
      }
    }
    for (std::uint32_t pair = 0; pair < field.pairs().size(); ++pair) {
      const PiecePair& ids = field.pairs()[pair];
      const PrimitiveContact contact =
          primitive_contact(the_case.bones[ids.bone].bodies[ids.piece], tool.parts[ids.tool_piece],
                            X_WB[ids.bone].inverse() * X_WT);
      ASSERT_EQ(contact.status, LpStatus::kOptimal);
      if (contact.gap < 0.001) {
        EXPECT_TRUE(listed[pair]);
      }
    }
    found += list.count;
  }
  EXPECT_GT(found, 300u);
}

}  // namespace
}  // namespace osteon
