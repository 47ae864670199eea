#include "runs/hands/shaft_place.h"

#include <gtest/gtest.h>

#include "osteon/scene/instrument.h"

namespace osteon {
namespace {

Tool tool_named(const char* name) {
  const auto instruments = load_instruments();
  EXPECT_TRUE(instruments);
  const Instrument* const found = find_instrument(*instruments, name);
  EXPECT_NE(found, nullptr) << name;
  return make_tool(*found, found->usual_size);
}

// Of a place from the axis of a tool's shaft.
double off_axis_m(const Tool& tool, const Pose& X_WT, const Vec3& p_W) {
  const Vec3 from = X_WT * tool.shaft.p0, along = X_WT.rotate(tool.shaft.p1 - tool.shaft.p0);
  return (p_W - from).cross(along.normalized()).norm();
}

TEST(ShaftPlace, AHooksShaftPassesThroughThePortalToo) {
  const Vec3 portal(0.01, -0.02, 0.03), inwards = Vec3(0.3, -0.5, -0.8).normalized();
  for (const char* name : {"hook_probe", "trocar_blunt", "arthroscope_30"}) {
    const Tool tool = tool_named(name);
    const Pose X_WT = before_portal(tool, portal, inwards, 0.012);
    EXPECT_LT(off_axis_m(tool, X_WT, portal), 1e-9) << name;
    EXPECT_NEAR((X_WT.p - portal).dot(inwards), -0.012, 1e-12) << name;
  }
  EXPECT_GT(shaft_beside_tip(tool_named("hook_probe")).norm(), 0.002);
}

TEST(ShaftPlace, WhatIsTakenHasItsShaftWhereTheOtherHadIt) {
  const Tool hook = tool_named("hook_probe"), trocar = tool_named("trocar_blunt");
  const Pose X_WT{{0.1, 0.2, 0.3}, Quat(0.5, 0.5, -0.5, 0.5)};
  const Vec3 on_line = X_WT * Vec3(trocar.shaft.p0 + Vec3(0, 0, 0.05));
  const Pose taken = on_the_same_line(trocar, hook, X_WT);
  EXPECT_LT(off_axis_m(hook, taken, on_line), 1e-12);
  EXPECT_LT((on_the_same_line(hook, trocar, taken).p - X_WT.p).norm(), 1e-12);
  EXPECT_EQ(on_the_same_line(hook, hook, X_WT).p, X_WT.p);
}

// Outside the direction stays; inside the axis leads back through the hole, of a hook as well.
TEST(ShaftPlace, WhatAHoleLeadsTurnsAboutItOnceItIsInside) {
  const Vec3 hole(0.01, 0, 0);
  for (const char* name : {"hook_probe", "trocar_blunt"}) {
    const Tool tool = tool_named(name);
    const Vec3 beside = shaft_beside_tip(tool);
    Pose X_WT = before_portal(tool, hole, -Vec3::UnitZ(), 0.012);
    const Pose pushed = slid_through(X_WT, beside, hole, 2);
    EXPECT_NEAR(pushed.p.z(), X_WT.p.z() - 0.004, 1e-12) << name;
    EXPECT_EQ(pushed.q.coeffs(), X_WT.q.coeffs()) << name;
    X_WT.p += Vec3(0.004, -0.003, -0.035);
    const Pose inside = slid_through(X_WT, beside, hole, 0);
    EXPECT_LT(off_axis_m(tool, inside, hole), 1e-9) << name;
    EXPECT_EQ(inside.p, X_WT.p) << name;
    EXPECT_LT(inside.q.angularDistance(X_WT.q), 0.3) << name;
    X_WT.p = hole - Vec3(0, 0, 0.002);
    EXPECT_EQ(slid_through(X_WT, beside, hole, 0).q.coeffs(), X_WT.q.coeffs()) << "hardly in";
  }
}

}  // namespace
}  // namespace osteon
