#include "describe/shape_count.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <set>
#include <stdexcept>

#include "describe/description.h"

namespace osteon {
namespace {

const std::string kBone =
    "name = \"test\"\nside = \"left\"\n[[bone]]\nname = \"a\"\nfma_id = 7\ncell_mm = 0.7\n"
    "position_mm = [1, 2, 3]\nrotation_deg = [4, 5, 6]\ndensity_kg_per_m3 = 1200\nblend_mm = 2\n";
const std::string kBallShape = "shape = \"ellipsoid\", center_mm = [0, 0, 0], radii_mm = [5, 4, 3]";

std::vector<ShapeNumbers> counts_of(const std::string& text) {
  const auto anatomy = parse_description(text, "test.toml");
  if (!anatomy) throw std::runtime_error(anatomy.error().message());
  return anatomy->bones.at(0).shape_numbers;
}

TEST(ShapeCount, PlaceDetailAndWeightShapeNothing) {
  const auto counts = counts_of(kBone + "add = [{ " + kBallShape + " }]\n");
  ASSERT_EQ(counts.size(), 1u);
  EXPECT_EQ(counts[0].bone, "a");
  EXPECT_EQ(counts[0].section, "");
  EXPECT_EQ(counts[0].numbers, 1u + 6u);
}

TEST(ShapeCount, EveryWrittenNumberCountsZerosToo) {
  const auto counts = counts_of(
      kBone + "add = [{ " + kBallShape + ", rotation_deg = [0, 0, 0], blend_mm = 1 }, " +
      "{ shape = \"tube\", points_mm = [[0, 0, 0], [9, 0, 0], [20, 0, 0]], radii_mm = [3] }]\n" +
      "cut = [{ shape = \"box\", center_mm = [0, 0, 0], half_mm = [1, 2, 3], round_mm = 0.5, " +
      "tilt_deg = 8 }]\nclear = [{ bone = \"b\", gap_mm = 1.5, blend_mm = 1 }]\n" +
      "[[bone]]\nname = \"b\"\nfma_id = 8\nposition_mm = [30, 0, 0]\nadd = [{ " + kBallShape +
      " }]\n");
  ASSERT_EQ(counts.size(), 1u);
  EXPECT_EQ(counts[0].numbers, 1u + 10u + 10u + 8u + 2u);
}

TEST(ShapeCount, SectionsCountApartAndEachWithWhatIsShared) {
  const auto counts =
      counts_of(kBone + "add = [{ section = \"head\", name = \"x\", " + kBallShape +
                " }, { section = \"shaft\", " + kBallShape +
                ", blend_mm = 1 }, { section = \"head\", like = \"x\", shift_mm = [1, 0, 0] }]\n");
  ASSERT_EQ(counts.size(), 2u);
  EXPECT_EQ(counts[0].section, "head");
  EXPECT_EQ(counts[0].numbers, 1u + 6u + 3u);
  EXPECT_EQ(counts[1].section, "shaft");
  EXPECT_EQ(counts[1].numbers, 1u + 7u);
}

/// Femur and tibia are counted by their ends and shafts.
TEST(ShapeCount, NoBuiltInBoneHasMoreThanSixtyNumbers) {
  const std::filesystem::path assets = std::filesystem::path(OSTEON_SOURCE_DIR) / "assets/anatomy";
  std::set<std::pair<std::string, std::string>> sections;
  for (const char* name : {"wrist.toml", "knee.toml"}) {
    const auto counts = shape_numbers(assets / name);
    ASSERT_TRUE(counts) << counts.error().message();
    for (const ShapeNumbers& c : *counts) {
      std::printf("%-12s %-9s %3zu\n", c.bone.c_str(), c.section.c_str(), c.numbers);
      EXPECT_LE(c.numbers, kMostShapeNumbers) << c.bone << " " << c.section;
      if (!c.section.empty()) sections.insert({c.bone, c.section});
    }
  }
  EXPECT_EQ(sections, (std::set<std::pair<std::string, std::string>>{{"femur", "distal"},
                                                                     {"femur", "proximal"},
                                                                     {"femur", "shaft"},
                                                                     {"tibia", "proximal"},
                                                                     {"tibia", "shaft"}}));
}

}  // namespace
}  // namespace osteon
