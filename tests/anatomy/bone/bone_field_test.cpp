#include "bone/bone_field.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <utility>

#include "mesh/surface_checks.h"
#include "osteon/base/random.h"
#include "osteon/mesh/isosurface.h"

namespace osteon {
namespace {

AnatomyDescription built_in(const std::string& name) {
  const std::string file = OSTEON_SOURCE_DIR "/assets/anatomy/" + name + ".toml";
  std::ifstream in(file);
  const std::string text(std::istreambuf_iterator<char>(in), {});
  return parse_description(text, file).value();
}

/// What the field is, told straight.
double plain_value(const AnatomyDescription& anatomy, const BoneDescription& bone,
                   const Vec3& p_B) {
  double d = distance(bone.solid, p_B);
  for (const Clearance& c : bone.clearances) {
    const BoneDescription& other = anatomy.bones[c.other_bone];
    const Mat3 R_NB = other.R_WB.transpose() * bone.R_WB;
    const Vec3 p_NB = other.R_WB.transpose() * (bone.p_WB - other.p_WB);
    const Vec3 p_N = R_NB * p_B + p_NB;
    const Aabb reach = bounds(other.solid).grown((c.gap + c.blend) * stretch(other.solid));
    if (reach.overlaps({p_N, p_N})) d = smooth_max(d, c.gap - distance(other.solid, p_N), c.blend);
  }
  const Vec3 p_W = bone.R_WB * p_B + bone.p_WB;
  for (const BoundPart& defect : bone.defects) d = less(d, defect.part, p_W);
  return d;
}

TEST(BoneField, EveryBonesFieldIsTheSameNearBy) {
  AnatomyDescription anatomy = built_in("wrist");
  BoundPart slit;
  slit.part.operation = Operation::kCut;
  slit.part.primitive = Crack{anatomy.bones[2].p_WB, Vec3(0.6, 0.8, 0), 0.002, 0.0004, 0.003};
  slit.part.blend = 0.0005;
  anatomy.bones[2].defects.push_back(slit);
  Random random(11);
  int known = 0, places = 0;
  for (const BoneDescription& bone : anatomy.bones) {
    const BoneField field(anatomy, bone);
    const Aabb box = bounds(bone.solid);
    for (int trial = 0; trial < 200; ++trial, ++places) {
      const Vec3 share(random.uniform(-0.1, 1.1), random.uniform(-0.1, 1.1),
                       random.uniform(-0.1, 1.1));
      const Vec3 center = box.lo + box.extent().cwiseProduct(share);
      const double radius = random.uniform(0.0003, 0.005);
      const LocalField::Near near = field.near(center, radius);
      known += near.sign != 0 ? 1 : 0;
      for (int i = 0; i < 20; ++i) {
        const Vec3 p = center + random.uniform(0, radius) * random.direction();
        const double value = plain_value(anatomy, bone, p);
        EXPECT_EQ(field.at(p), value) << bone.name;
        if (near.field) {
          EXPECT_EQ(near.field->at(p), value) << bone.name;
        }
        if (near.sign != 0) {
          EXPECT_GT(near.sign * value, 0) << bone.name;
        }
      }
    }
  }
  EXPECT_GT(known, places / 2) << "the signs of most places should be known";
}

/// Against the surface of the same field looked at everywhere.
TEST(BoneField, EverySurfaceIsTheOneOfTheWholeField) {
  for (const auto& [name, cell_m] : {std::pair("wrist", 0.0012), {"knee", 0.003}}) {
    const AnatomyDescription anatomy = built_in(name);
    for (const BoneDescription& bone : anatomy.bones) {
      const BoneField field(anatomy, bone);
      IsosurfaceOptions options;
      options.cell_m = cell_m;
      const Aabb box = bounds(bone.solid).grown(cell_m);
      const auto near = isosurface(field, box, options);
      options.slack_m = 1;
      const auto plain = isosurface([&](const Vec3& p_B) { return field.at(p_B); }, box, options);
      ASSERT_TRUE(near && plain) << bone.name;
      EXPECT_EQ(checks::hash_of(*near), checks::hash_of(*plain)) << bone.name;
    }
  }
}

}  // namespace
}  // namespace osteon
