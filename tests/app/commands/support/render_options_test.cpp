#include "commands/support/render_options.h"

#include <gtest/gtest.h>

namespace osteon {
namespace {

TEST(RenderOptions, RefusesWhatIsNoSize) {
  for (const char* text : {"", "x", "0x0", "10", "10x", "x10", "10x-3", "10x20x30", "10 x 20",
                           "9000x10", "1e3x10", "99999999999x1", "10x20 "})
    EXPECT_FALSE(parse_picture_size(text).has_value()) << text;
}

TEST(RenderOptions, ReadsASize) {
  const auto size = parse_picture_size("8192x1");
  ASSERT_TRUE(size.has_value());
  EXPECT_EQ(size->width, 8192);
  EXPECT_EQ(size->height, 1);
}

TEST(RenderOptions, KnowsTheViews) {
  EXPECT_EQ(parse_view_preset("ulnar").value(), ViewPreset::kUlnar);
  EXPECT_EQ(parse_view_preset("ap").value(), ViewPreset::kAp);
  EXPECT_EQ(parse_view_preset("front").value(), ViewPreset::kDorsal);
  EXPECT_EQ(parse_view_preset("inner").value(), ViewPreset::kUlnar);
  EXPECT_FALSE(parse_view_preset("Dorsal").has_value());
}

TEST(RenderOptions, HidesTheNamedBonesAndNamesTheUnknownOne) {
  Case two;
  two.bones.resize(2);
  two.bones[0].name = "lunate";
  two.bones[1].name = "scaphoid";
  ViewState view;
  ASSERT_TRUE(hide_bones(two, {"scaphoid"}, view).has_value());
  EXPECT_TRUE(view.bones[0].visible);
  EXPECT_FALSE(view.bones[1].visible);
  const auto failed = hide_bones(two, {"femur"}, view);
  ASSERT_FALSE(failed.has_value());
  EXPECT_NE(failed.error().message().find("femur"), std::string::npos);
  EXPECT_NE(failed.error().message().find("lunate, scaphoid"), std::string::npos);
}

}  // namespace
}  // namespace osteon
