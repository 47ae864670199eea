#include "soft/skin_field.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <variant>

#include "finding/displace.h"
#include "osteon/base/random.h"

namespace osteon {
namespace {

class WristSkin : public testing::Test {
 protected:
  WristSkin() {
    const std::string file = OSTEON_SOURCE_DIR "/assets/anatomy/wrist.toml";
    std::ifstream in(file);
    const std::string text(std::istreambuf_iterator<char>(in), {});
    anatomy_ = parse_description(text, file).value();
    for (const SoftDescription& soft : anatomy_.softs)
      if (const auto* skin = std::get_if<SkinDescription>(&soft.shape)) skin_ = *skin;
    for (const BoneDescription& bone : anatomy_.bones) poses_.push_back(rest_pose(bone));
  }

  /// What the field is, told straight.
  double plain_value(const Vec3& p_W) const {
    Solid flesh;
    for (const BoundPart& part : skin_.parts)
      if (part.part.operation == Operation::kAdd) flesh.parts.push_back(part.part);
    double d = distance(flesh, p_W);
    for (std::size_t i = 0; i < poses_.size(); ++i) {
      const Mat3 R_WB = poses_[i].q.toRotationMatrix();
      const Vec3 p_B = R_WB.transpose() * (p_W - poses_[i].p);
      d = smooth_min(d, distance(anatomy_.bones[i].solid, p_B) - skin_.offset, skin_.blend);
    }
    for (const BoundPart& part : skin_.parts)
      if (part.part.operation == Operation::kCut) d = less(d, part.part, p_W);
    return d;
  }

  AnatomyDescription anatomy_;
  SkinDescription skin_;
  std::vector<Pose> poses_;
};

TEST_F(WristSkin, IsFleshOverAllBonesAndTheSameNearBy) {
  const SkinField field(skin_, anatomy_.bones, poses_);
  const Aabb& box = field.bounds_W();
  Random random(13);
  int known = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    const Vec3 share(random.uniform(0, 1), random.uniform(0, 1), random.uniform(0, 1));
    const Vec3 center = box.lo + box.extent().cwiseProduct(share);
    const double radius = random.uniform(0.001, 0.01);
    const LocalField::Near near = field.near(center, radius);
    known += near.sign != 0 ? 1 : 0;
    for (int i = 0; i < 20; ++i) {
      const Vec3 p = center + random.uniform(0, radius) * random.direction();
      const double value = field.at(p);
      EXPECT_EQ(near.field->at(p), value);
      if (near.sign != 0) {
        EXPECT_GT(near.sign * value, 0);
      }
      // A bone's box is a bound only about as good as the bone's value is a distance.
      if (std::abs(value) < 0.001) {
        EXPECT_NEAR(value, plain_value(p), 1e-4);
      }
    }
  }
  EXPECT_GT(known, 500) << "the signs of most places should be known";
}

}  // namespace
}  // namespace osteon
