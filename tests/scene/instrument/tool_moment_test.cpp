#include "osteon/scene/tool_moment.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "osteon/base/random.h"

namespace osteon {
namespace {

constexpr double kLength = 0.15;

Tool shaft_of_150_mm() {
  Tool tool;
  tool.shaft = {Vec3(0, 0, 0.001), Vec3(0, 0, kLength), 0.001};
  return tool;
}

ToolState pressed_at(const Vec3& p_W, const Vec3& force_W) {
  ToolState state;
  state.contact_count = 1;
  state.contacts[0].p_W = p_W;
  state.contacts[0].force_on_tool_W = force_W;
  state.force_W = force_W;
  return state;
}

Vec3 random_vec(Random& random, double size) {
  const double x = random.uniform(-size, size);
  const double y = random.uniform(-size, size);
  return {x, y, random.uniform(-size, size)};
}

TEST(ToolMoment, OfNothingIsZero) {
  EXPECT_EQ(moment_at_grip({}, shaft_of_150_mm(), {}), Vec3::Zero());
  EXPECT_EQ(moment_at_grip({}, Tool{}, {}), Vec3::Zero());
}

// Force times lever: 2 N across the tip of a shaft that is held 150 mm behind it.
TEST(ToolMoment, OfAForceAcrossTheTipIsForceTimesLever) {
  const ToolState state = pressed_at(Vec3::Zero(), Vec3(2, 0, 0));
  const Vec3 moment = moment_at_grip(state, shaft_of_150_mm(), {});
  EXPECT_NEAR(moment.y(), -2 * kLength, 1e-15);
  EXPECT_NEAR(moment.norm(), 2 * kLength, 1e-15);
  // Along the shaft there is no lever.
  EXPECT_NEAR(moment_at_grip(pressed_at(Vec3::Zero(), Vec3(0, 0, 5)), shaft_of_150_mm(), {}).norm(),
              0, 1e-15);
  // Without a shaft the tip itself is held.
  EXPECT_EQ(moment_at_grip(state, Tool{}, {}), Vec3::Zero());
}

// Two equal and opposite forces on the shaft are a couple: the same about any point, and no force.
// The force on the hand is then not zero by another contact along the shaft alone.
TEST(ToolMoment, OfACoupleIsForceTimesTheDistanceBetween) {
  ToolState state = pressed_at(Vec3(0, 0, 0.02), Vec3(3, 0, 0));
  state.contacts[state.contact_count++] = {
      {}, 0, Vec3(0, 0, 0.07), Vec3::UnitX(), 0, Vec3(-3, 0, 0)};
  state.contacts[state.contact_count++] = {{}, 0, Vec3::Zero(), Vec3::UnitZ(), 0, Vec3(0, 0, 1)};
  state.force_W = Vec3(0, 0, 1);
  EXPECT_NEAR((moment_at_grip(state, shaft_of_150_mm(), {}) - Vec3(0, -3 * 0.05, 0)).norm(), 0,
              1e-15);
}

// What the force has beside its contacts is the portal's, and acts in the hole: against the sum of
// force times lever in random poses, with a contact of a bone and of another tool.
TEST(ToolMoment, OfAPortalAndContactsIsTheirSum) {
  Random random(4);
  const Tool tool = shaft_of_150_mm();
  for (int i = 0; i < 200; ++i) {
    std::vector<Portal> portals(2);
    portals[1].p_W = random_vec(random, 0.05);
    ToolState state = pressed_at(random_vec(random, 0.05), random_vec(random, 3));
    state.tool_contact_count = 1;
    state.tool_contacts[0].p_W = random_vec(random, 0.05);
    state.tool_contacts[0].force_on_tool_W = random_vec(random, 3);
    const Vec3 of_portal = random_vec(random, 3);
    state.force_W += state.tool_contacts[0].force_on_tool_W + of_portal;
    state.portal = 1;
    const double turn = random.uniform(-3, 3);
    state.X_WP = {random_vec(random, 0.1), Quat(std::cos(turn), 0, std::sin(turn), 0)};
    const Vec3 grip = state.X_WP.p + kLength * state.X_WP.rotate(Vec3::UnitZ());
    const Vec3 expected =
        (state.contacts[0].p_W - grip).cross(state.contacts[0].force_on_tool_W) +
        (state.tool_contacts[0].p_W - grip).cross(state.tool_contacts[0].force_on_tool_W) +
        (portals[1].p_W - grip).cross(of_portal);
    EXPECT_LT((moment_at_grip(state, tool, portals) - expected).norm(), 1e-12);
  }
}

TEST(ToolMoment, WhileTheForceFadesOrIsNoNumberThereIsNone) {
  ToolState state = pressed_at(Vec3::Zero(), Vec3(2, 0, 0));
  state.status = kTickFading;
  EXPECT_EQ(moment_at_grip(state, shaft_of_150_mm(), {}), Vec3::Zero());
  state = pressed_at(Vec3::Zero(), Vec3(std::numeric_limits<double>::quiet_NaN(), 0, 0));
  EXPECT_EQ(moment_at_grip(state, shaft_of_150_mm(), {}), Vec3::Zero());
}

}  // namespace
}  // namespace osteon
