#include "cases/standard_views.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <memory>
#include <optional>
#include <set>

#include "cases/scoped_case.h"
#include "osteon/base/file.h"
#include "osteon/render/scope_sight.h"

namespace osteon {
namespace {

const std::string kColumns =
    "name,title,scope,finding,shows,flexion_deg,at_x,at_y,at_z,toward_x,toward_y,toward_z,post_deg,"
    "up_x,up_y,up_z\n";

CaseDef with_bone(const std::string& name) {
  CaseDef def;
  def.bones.emplace_back();
  def.bones.back().name = name;
  return def;
}

TEST(StandardViews, AWrongLineIsNamed) {
  EXPECT_FALSE(parse_standard_views("", "t"));
  EXPECT_FALSE(parse_standard_views(kColumns, "t"));
  const std::string good = "a,A,knee_30,acl_tear=femoral,acl pcl,70,1,2,3,4,5,6,90,0,0,1\n";
  const auto one = parse_standard_views(kColumns + good, "t");
  ASSERT_TRUE(one) << one.error().message();
  EXPECT_LT((one->front().pose.toward_W - Vec3(0.004, 0.005, 0.006)).norm(), 1e-15);
  EXPECT_NEAR(one->front().pose.post_rad, 1.5707963267948966, 1e-15);
  EXPECT_EQ(one->front().shows, (std::vector<std::string>{"acl", "pcl"}));
  EXPECT_EQ(one->front().finding, "acl_tear=femoral");
  for (const char* bad :
       {"b,B,knee_30,,,0,1,2,3,4,5,6,7,0,0\n", "b,B,knee_30,,,0,1,2,x,4,5,6,7,0,0,1\n",
        "b,B,knee_30,,,0,nan,2,3,4,5,6,7,0,0,1\n", "b,B,knee_30,,,0,1,2,3,1,2,4,7,0,0,1\n",
        ",B,knee_30,,,0,1,2,3,4,5,6,7,0,0,1\n"}) {
    const auto wrong = parse_standard_views(kColumns + good + bad, "t");
    ASSERT_FALSE(wrong) << bad;
    EXPECT_NE(wrong.error().message().find("line 3"), std::string::npos);
  }
}

TEST(StandardViews, ShippedOnesAreTwelveOfAKneeAndEightOfAWrist) {
  for (const auto& [bone, count] : {std::pair{"femur", 12u}, {"radius", 8u}}) {
    const auto views = standard_views(with_bone(bone));
    ASSERT_TRUE(views) << views.error().message();
    EXPECT_EQ(views->size(), count) << bone;
    std::set<std::string> names;
    for (const StandardView& view : *views) {
      names.insert(view.name);
      EXPECT_TRUE(load_scope(view.scope)) << view.scope;
      EXPECT_FALSE(view.shows.empty()) << view.name;
    }
    EXPECT_EQ(names.size(), count);
  }
  EXPECT_FALSE(standard_views(CaseDef{}));
}

TEST(StandardViews, TipsAreOutOfBoneAndSoftPartsAndWhatBelongsThereIsSeen) {
  if (!std::getenv("OSTEON_LONG")) GTEST_SKIP() << "takes long: set OSTEON_LONG=1";
  for (const auto& [name, bone] :
       {std::pair{"builtin:knee", "femur"}, {"builtin:wrist", "radius"}}) {
    const auto views = standard_views(with_bone(bone));
    ASSERT_TRUE(views);
    std::optional<ScopeRays> rays;
    const StandardView* before = nullptr;
    for (const StandardView& view : *views) {
      if (!before || !before->same_setting(view)) {
        const auto bent =
            std::string(bone) == "femur" ? std::optional<double>(view.flexion_deg) : std::nullopt;
        const auto opened = open_scoped_case(name, bent, view.finding);
        ASSERT_TRUE(opened) << opened.error().message();
        rays.emplace(*opened);
      }
      before = &view;
      const auto scope = load_scope(view.scope);
      ASSERT_TRUE(scope);
      const ScopeSight sight = rays->look(ScopeCamera(*scope, view.pose), 32);
      EXPECT_GT(sight.clearance_m, 0.25 * scope->diameter_m) << view.name << ": " << sight.nearest;
      EXPECT_EQ(sight.within, "") << view.name;
      double share = 0;
      for (const SeenPart& part : sight.parts) share += part.share;
      EXPECT_GT(share, 0.3) << view.name << " looks into nothing";
      for (const std::string& part : view.shows)
        EXPECT_GT(sight.share_of(part), 0.01) << view.name << ": " << part;
    }
  }
}

TEST(StandardViews, WaterOfAPictureIsThatOfTheModel) {
  WaterOrder order;
  order.turbidity = 0.4;
  const auto pale = water_after(order, knee_fluid());
  ASSERT_TRUE(pale);
  EXPECT_NEAR(pale->turbidity, 0.4, 1e-12);
  EXPECT_EQ(pale->seen.blood, 0);
  order.turbidity = 0;
  order.drive.bleeding_m3_s = 3 * kM3_s_per_ml_min;
  const auto red = water_after(order, knee_fluid());
  ASSERT_TRUE(red);
  EXPECT_EQ(red->seen.blood, 1);
  EXPECT_NEAR(red->turbidity, turbidity(knee_fluid(), red->state), 1e-12);
  EXPECT_NEAR(red->state.time_s, 60, 1e-6);
  order.fog = 0.5;
  order.flushed_s = 1;
  const auto flushed = water_after(order, knee_fluid());
  ASSERT_TRUE(flushed);
  EXPECT_NEAR(flushed->seen.fog, 0.5 * std::exp(-0.55), 1e-12);
  for (double* wrong : {&order.turbidity, &order.fog, &order.after_s, &order.drive.suction}) {
    const double right = *wrong;
    *wrong = -1;
    EXPECT_FALSE(water_after(order, knee_fluid()));
    *wrong = std::nan("");
    EXPECT_FALSE(water_after(order, knee_fluid()));
    *wrong = right;
  }
}

}  // namespace
}  // namespace osteon
