// A real scan: the head of Debian's invesalius-examples, with the bone mask that its makers drew.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "files/volume_files.h"
#include "image/dice.h"
#include "osteon/image/load_volume.h"
#include "osteon/image/segment.h"

namespace osteon {
namespace {

std::filesystem::path cranium() {
  const char* set = std::getenv("OSTEON_CRANIUM");
  return set ? set : "/usr/share/doc/invesalius-examples/examples/Cranium.inv3";
}

TEST(Cranium, BoneAgreesWithTheFilesOwnMask) {
  if (!std::filesystem::exists(cranium()))
    GTEST_SKIP() << "install invesalius-examples, or set OSTEON_CRANIUM to its Cranium.inv3";
  const auto volume = load_volume(cranium());
  ASSERT_TRUE(volume) << volume.error().message();
  const auto own = read_inv3_mask(cranium());
  ASSERT_TRUE(own) << own.error().message();
  EXPECT_EQ(own->low_hu, 226);
  SegmentOptions options;
  options.threshold_hu = own->low_hu;
  options.outside = true;  // its makers drew the head rest too
  const auto found = segment_bone(*volume, options);
  ASSERT_TRUE(found) << found.error().message();
  Mask bone{volume->frame, {}};
  for (const std::uint16_t label : found->labels.values) bone.values.push_back(label ? 1 : 0);
  const double agreement = dice(bone, own->mask);
  RecordProperty("dice", std::to_string(agreement));
  std::printf("Dice %.4f\n", agreement);
  EXPECT_GE(agreement, 0.95);
}

// Two bright shells of a head rest stand beside the head, 21 000 voxels each.
TEST(Cranium, TheHeadRestIsNoBone) {
  if (!std::filesystem::exists(cranium())) GTEST_SKIP() << "no Cranium.inv3";
  const auto volume = load_volume(cranium());
  ASSERT_TRUE(volume) << volume.error().message();
  for (const double threshold_hu : {226., 402.}) {
    SegmentOptions options;
    options.threshold_hu = threshold_hu;
    const auto found = segment_bone(*volume, options);
    ASSERT_TRUE(found) << found.error().message();
    EXPECT_EQ(found->outside, 2u);
    EXPECT_GT(found->regions.size(), 1u);
    // The head is between columns 45 and 215.
    const GridFrame& frame = found->labels.frame;
    for (int k = 0; k < frame.size[2]; ++k)
      for (int j = 0; j < frame.size[1]; ++j)
        for (const int i : {20, 41, 220, 240})
          ASSERT_EQ(found->labels.at(i, j, k), 0) << i << " " << j << " " << k;
  }
}

// The patient lies on the head rest: what of the picture is outside the head, in front of its
// middle, is air alone.
TEST(Cranium, ItIsNoMirrorImage) {
  if (!std::filesystem::exists(cranium())) GTEST_SKIP() << "no Cranium.inv3";
  const auto volume = load_volume(cranium());
  ASSERT_TRUE(volume) << volume.error().message();
  std::size_t in_front = 0, behind = 0;
  const int half = volume->frame.size[1] / 2;
  for (int k = 40; k < 60; ++k)
    for (int j = 0; j < volume->frame.size[1]; ++j)
      for (const int i : {20, 41, 220, 240})
        if (volume->at(i, j, k) > 226) ++(j < half ? in_front : behind);
  EXPECT_EQ(in_front, 0u);
  EXPECT_GT(behind, 20u);
}

}  // namespace
}  // namespace osteon
