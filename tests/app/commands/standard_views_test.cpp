#include "commands/standard_views.h"

#include <gtest/gtest.h>

#include <set>

#include "osteon/base/file.h"
#include "osteon/scene/scope.h"

namespace osteon {
namespace {

const std::string kHeader =
    "name,title,scope,flexion_deg,at_x,at_y,at_z,toward_x,toward_y,toward_z,post_deg,up_x,up_y,"
    "up_z\n";

TEST(StandardViews, AWrongLineIsNamed) {
  EXPECT_FALSE(parse_standard_views("", "t"));
  EXPECT_FALSE(parse_standard_views(kHeader, "t"));
  const std::string good = "a,A,knee_30,0,1,2,3,4,5,6,7,0,0,1\n";
  const auto one = parse_standard_views(kHeader + good, "t");
  ASSERT_TRUE(one) << one.error().message();
  EXPECT_EQ(one->front().toward_mm, Vec3(4, 5, 6));
  EXPECT_EQ(one->front().post_deg, 7);
  for (const char* bad :
       {"b,B,knee_30,0,1,2,3,4,5,6,7,0,0\n", "b,B,knee_30,0,1,2,x,4,5,6,7,0,0,1\n",
        "b,B,knee_30,0,nan,2,3,4,5,6,7,0,0,1\n"}) {
    const auto wrong = parse_standard_views(kHeader + good + bad, "t");
    ASSERT_FALSE(wrong) << bad;
    EXPECT_NE(wrong.error().message().find("line 3"), std::string::npos);
  }
}

TEST(StandardViews, ShippedOnesAreTwelveOfTheKneeAndEightOfTheWrist) {
  for (const auto& [name, bone, count] :
       {std::tuple{"knee", "femur", 12u}, {"wrist", "radius", 8u}}) {
    Case the_case;
    the_case.bones.emplace_back();
    the_case.bones.back().name = bone;
    const auto views = standard_views(the_case);
    ASSERT_TRUE(views) << views.error().message();
    EXPECT_EQ(views->size(), count) << name;
    std::set<std::string> names;
    for (const StandardView& view : *views) {
      names.insert(view.name);
      EXPECT_TRUE(load_scope(view.scope)) << view.scope;
      EXPECT_GT((view.toward_mm - view.at_mm).cross(view.up).norm(), 1) << view.name;
    }
    EXPECT_EQ(names.size(), count);
  }
  EXPECT_FALSE(standard_views(Case{}));
}

}  // namespace
}  // namespace osteon
