// Parts between two bones: of a tube each end goes with its own.
#include "vary/vary_bound.h"

#include <gtest/gtest.h>

namespace osteon {
namespace {

AnatomyDescription two_bones_and_a_tube() {
  AnatomyDescription out;
  out.bones.resize(2);
  out.bones[0].name = "near";
  out.bones[1].name = "far";
  BoundPart part;
  part.bone = 0;
  part.to_bone = 1;
  part.part.primitive = tube_through({{0, 0, 0}, {0.01, 0, 0}}, {0.001, 0.001});
  part.part.blend = 0.002;
  VolumeDescription volume;
  volume.parts.push_back(part);
  SoftDescription soft;
  soft.name = "disc";
  soft.kind = "disc";
  soft.shape = volume;
  out.softs.push_back(soft);
  return out;
}

const Tube& tube_of(const AnatomyDescription& anatomy) {
  const auto& volume = std::get<VolumeDescription>(anatomy.softs[0].shape);
  return std::get<Tube>(volume.parts[0].part.primitive);
}

void shift(AnatomyDescription& anatomy, const std::vector<std::string>& bones) {
  move_bound(anatomy, bones,
             {[](const Vec3& p) { return Vec3(p + Vec3(0, 0.003, 0)); },
              [](Primitive& part) {
                for (Vec3& p : std::get<Tube>(part).points) p.y() += 0.003;
              },
              1});
}

TEST(VaryBound, EachEndOfATubeGoesWithItsOwnBone) {
  AnatomyDescription anatomy = two_bones_and_a_tube();
  shift(anatomy, {"far"});
  EXPECT_EQ(tube_of(anatomy).points.front(), Vec3::Zero());
  EXPECT_EQ(tube_of(anatomy).points.back(), Vec3(0.01, 0.003, 0));
  EXPECT_GT(tube_of(anatomy).reach[0], 0.0114) << "what it reaches follows";
  shift(anatomy, {"near"});
  EXPECT_EQ(tube_of(anatomy).points.front(), Vec3(0, 0.003, 0));
  EXPECT_EQ(tube_of(anatomy).points.back(), Vec3(0.01, 0.003, 0));
}

TEST(VaryBound, WithBothBonesItGoesAsAWhole) {
  AnatomyDescription anatomy = two_bones_and_a_tube();
  shift(anatomy, {"*"});
  for (const Vec3& p : tube_of(anatomy).points) EXPECT_EQ(p.y(), 0.003);
}

}  // namespace
}  // namespace osteon
