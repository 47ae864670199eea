#include "commands/support/pose_table.h"

#include <gtest/gtest.h>

namespace osteon {
namespace {

std::string error_of(std::string_view text) {
  const auto poses = parse_pose_table(text, "p.csv");
  return poses ? "no error" : poses.error().message();
}

void expect_error(std::string_view text, std::string_view part) {
  EXPECT_NE(error_of(text).find(part), std::string::npos) << error_of(text);
}

TEST(PoseTable, NamesTheLineOfWhatIsWrong) {
  const std::string head = std::string(kPoseColumns) + "\n";
  expect_error("", "holds no poses");
  expect_error(head, "holds no poses");
  expect_error(head + "0,0,0,1,0,0,0\n0,0,zero,1,0,0,0\n", "line 3");
  expect_error(head + "0,0,zero,1,0,0,0\n", "z_mm is \"zero\"");
  expect_error(head + "0,0,0,1,0,0\n", "6 columns");
  expect_error(head + "0,0,0,1,0,0,0,0\n", "8 columns");
  expect_error(head + "0,0,0,1,0,0,\n", "qz is \"\"");
  expect_error(head + "0,0,0,0,0,-0,0\n", "length zero");
  expect_error(head + "nan,0,0,1,0,0,0\n", "not finite");
  expect_error(head + "0,inf,0,1,0,0,0\n", "not finite");
  expect_error(head + "0,1e999,0,1,0,0,0\n", "y_mm");
  expect_error(head + "0,0x10,0,1,0,0,0\n", "y_mm");
  expect_error(head + "0,1 2,0,1,0,0,0\n", "y_mm");
  expect_error("nan,0,0,1,0,0,0\n", "not finite");
  expect_error("x_mm,y_mm,z_mm,qx,qy,qz,qw\n0,0,0,0,0,0,1\n", "column 4 is \"qx\"");
  expect_error("x_mm,y_mm\n", "column z_mm is missing");
  expect_error("x_mm,y_mm,z_mm,qw,qx,qy,qz,t\n", "more than 7");
  expect_error("0,0,0,1,0,0,0\n" + head, "x_mm is \"x_mm\"");
}

TEST(PoseTable, ReadsMillimetresAndAnyLengthOfQuaternion) {
  const auto poses = parse_pose_table(
      "\xef\xbb\xbfx_mm, y_mm ,z_mm,qw,qx,qy,qz\r\n1,-2.5,+3e1,2,0,0,0\r\n\r\n"
      "0,0,0,1e-200,1e-200,0,0",
      "p.csv");
  ASSERT_TRUE(poses) << poses.error().message();
  ASSERT_EQ(poses->size(), 2u);
  EXPECT_NEAR(((*poses)[0].p - Vec3(0.001, -0.0025, 0.03)).norm(), 0, 1e-17);
  EXPECT_EQ((*poses)[0].q.w(), 1);
  EXPECT_NEAR((*poses)[1].q.x(), std::sqrt(0.5), 1e-15);
}

TEST(PoseTable, TheHeaderMayBeLeftOut) {
  const auto poses = parse_pose_table("0,0,0,1,0,0,0\n1,0,0,1,0,0,0\n", "p.csv");
  ASSERT_TRUE(poses);
  EXPECT_EQ(poses->size(), 2u);
}

}  // namespace
}  // namespace osteon
