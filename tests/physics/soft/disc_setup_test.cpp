// The disc of a wrist: what is none is refused; a tear changes how it gives way to a press and a
// lift.
#include "osteon/physics/disc_setup.h"

#include <gtest/gtest.h>

#include "osteon/scene/field_cache.h"
#include "physics/disc_fixtures.h"

namespace osteon {
namespace {

using testing::disc_case;
using testing::disc_row;
using testing::kDiscTable_n_per_m;

TEST(DiscSetup, ACaseWithoutADiscIsRefusedAndSaysWhatToGive) {
  const auto none = make_disc_solids(*disc_case(false, false), disc_row(), kDiscTable_n_per_m);
  ASSERT_FALSE(none);
  EXPECT_NE(none.error().message().find("builtin:wrist"), std::string::npos);
  DiscRow other = disc_row();
  other.part = "labrum";
  EXPECT_FALSE(make_disc_solids(*disc_case(), other, kDiscTable_n_per_m));
}

TEST(DiscSetup, AFieldThatIsKnownIsNotMadeAgain) {
  FieldCache known;
  const auto first = make_disc_solids(*disc_case(), disc_row(), kDiscTable_n_per_m, &known);
  const auto second = make_disc_solids(*disc_case(), disc_row(), kDiscTable_n_per_m, &known);
  const auto without = make_disc_solids(*disc_case(), disc_row(), kDiscTable_n_per_m);
  ASSERT_TRUE(first && second && without);
  EXPECT_EQ(second->front().field, first->front().field);
  EXPECT_NE(without->front().field, first->front().field);
  EXPECT_EQ(hash_of(*without), hash_of(*first));
}

TEST(DiscSetup, OneThatReachesOnlyOneBoneIsRefused) {
  auto the_case = std::make_shared<Case>(*disc_case());
  for (Vec3& p : the_case->softs[0].mesh_W.vertices) p.x() -= 0.003;
  const auto made = make_disc_solids(*the_case, disc_row(), kDiscTable_n_per_m);
  ASSERT_FALSE(made);
  EXPECT_NE(made.error().what.find("does not reach"), std::string::npos);
}

TEST(DiscSetup, OneThatIsOpenIsRefused) {
  auto the_case = std::make_shared<Case>(*disc_case());
  the_case->softs[0].mesh_W.triangles.pop_back();
  EXPECT_FALSE(make_disc_solids(*the_case, disc_row(), kDiscTable_n_per_m));
}

TEST(DiscSetup, ItsNamesAreTfccAndThatOfThePart) {
  const auto the_case = disc_case();
  EXPECT_TRUE(names_disc(*the_case, "tfcc"));
  EXPECT_TRUE(names_disc(*the_case, "tfcc_disc"));
  EXPECT_FALSE(names_disc(*the_case, "radius"));
  EXPECT_FALSE(names_disc(*the_case, "menisci"));
}

TEST(DiscSetup, ATornOneIsTwoSolidsTheLargerFirst) {
  const auto whole = make_disc_solids(*disc_case(), disc_row(), kDiscTable_n_per_m);
  const auto torn = make_disc_solids(*disc_case(true), disc_row(), kDiscTable_n_per_m);
  ASSERT_TRUE(whole && torn);
  ASSERT_EQ(whole->size(), 1u);
  EXPECT_EQ(whole->front().surface_B, nullptr);
  ASSERT_EQ(torn->size(), 2u);
  EXPECT_EQ(torn->front().name, "tfcc_disc");
  EXPECT_EQ(torn->back().name, "tfcc_disc_piece_2");
  ASSERT_TRUE(torn->front().surface_B && torn->back().surface_B);
  EXPECT_LT(torn->front().surface_B->vertices[0].x(), 0);
}

// Mean way along z of what is at `x_m`, for each newton of a push all across, up or down.
double gives(const SoftSolid& disc, double x_m, double side) {
  std::vector<SolidPush> pushes;
  constexpr int kPlaces = 9;
  for (int i = 0; i < kPlaces; ++i) {
    const double y = 0.5 * testing::kDiscWide_m * (2.0 * i / (kPlaces - 1) - 1);
    pushes.push_back(disc.body->push_at({x_m, y, 0}, {0, 0, side}, 1.0 / kPlaces));
  }
  const std::vector<Vec3> moved = disc.body->moved(pushes);
  double sum = 0;
  for (const SolidPush& push : pushes) sum -= side * PressedSolid::moved_at(push.patch, moved).z();
  return sum / kPlaces;
}

// A wide strip of length a, held at its root, loaded at its end: a^3 (1 - nu^2) / (3 E I) + 6 a /
// (5 G A).
double cantilever(double a_m, double young_pa) {
  constexpr double kPoisson = 0.3;
  const double b = testing::kDiscWide_m, h = testing::kDiscThick_m;
  const double shear_pa = young_pa / (2 + 2 * kPoisson);
  const double plate_pa = young_pa / (1 - kPoisson * kPoisson);
  return 4 * a_m * a_m * a_m / (plate_pa * b * h * h * h) + 1.2 * a_m / (shear_pa * b * h);
}

// Along x, where a push at `x_m` acts: near an end its nodes are those on one side.
double acts_at(const SoftSolid& disc, double x_m) {
  const SolidPatch patch = disc.body->patch_at({x_m, 0, 0});
  double sum = 0;
  for (std::uint32_t i = 0; i < patch.count; ++i)
    sum += patch.weight[i] * disc.body->node_at(patch.node[i]).x();
  return sum;
}

TEST(DiscSetup, TornOffTheUlnaItHangsOnTheRadiusAsABeam) {
  DiscRow row = disc_row();
  row.tension_pa = 0;
  const auto torn = make_disc_solids(*disc_case(true), row, kDiscTable_n_per_m);
  ASSERT_TRUE(torn);
  const double beam =
      cantilever(testing::kDiscHalf_m + acts_at(torn->front(), 0.004), row.young_pa);
  const double ratio = gives(torn->front(), 0.004, -1) / beam;
  EXPECT_GT(ratio, 0.65) << "two layers of cubes bend too stiffly";
  EXPECT_LT(ratio, 1.05);
}

// A string of tension T between both bones carries 4 T / L of a push in the middle (of springs side
// by side), and nothing when one end is torn off.
TEST(DiscSetup, ATearTakesTheTensionAndLetsItLift) {
  DiscRow slack = disc_row();
  slack.tension_pa = 0;
  const auto whole = make_disc_solids(*disc_case(), disc_row(), kDiscTable_n_per_m);
  const auto untense = make_disc_solids(*disc_case(), slack, kDiscTable_n_per_m);
  const auto torn = make_disc_solids(*disc_case(true), disc_row(), kDiscTable_n_per_m);
  ASSERT_TRUE(whole && untense && torn);
  const double tension_n = disc_row().tension_pa * testing::kDiscWide_m * testing::kDiscThick_m;
  const double string = 4 * tension_n / (2 * testing::kDiscHalf_m);
  const double more = 1 / gives(whole->front(), 0, 1) - 1 / gives(untense->front(), 0, 1);
  EXPECT_NEAR(more / string, 1, 0.3);
  EXPECT_GT(gives(torn->front(), 0, 1), 1.5 * gives(whole->front(), 0, 1));
  EXPECT_GT(gives(torn->front(), 0.004, -1), 8 * gives(whole->front(), 0.004, -1));
}

}  // namespace
}  // namespace osteon
