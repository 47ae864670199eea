#include "segment/slice_picture.h"

#include <gtest/gtest.h>

#include <memory>

namespace osteon {
namespace {

/// HU rises by 10 with i, by 100 with j.
LabelEdit ramp() {
  Volume volume;
  volume.frame.size = {16, 12, 4};
  volume.frame.spacing_m = Vec3::Constant(0.001);
  for (int k = 0; k < 4; ++k)
    for (int j = 0; j < 12; ++j)
      for (int i = 0; i < 16; ++i)
        volume.values.push_back(static_cast<std::int16_t>(10 * i + 100 * j));
  return LabelEdit::begin(std::make_shared<const Volume>(std::move(volume))).value();
}

/// Axial, four pixels a voxel: pixel (2 + 4 i, 2 + 4 j) is the middle of voxel (i, j).
struct SlicePane {
  explicit SlicePane(const LabelEdit& edit) : plane(slice_planes(edit.labels().frame)[0]) {
    window = whole_slice(plane, edit.labels().frame, 64, 48);
  }
  Rgba at(const LabelEdit& edit, const SliceLook& look, int x, int y) {
    draw_slice(edit, plane, window, 1, look, pixels);
    EXPECT_EQ(pixels.size(), 64u * 48u);
    return pixels[static_cast<std::size_t>(y * 64 + x)];
  }
  SlicePlane plane;
  SliceWindow window;
  std::vector<Rgba> pixels;
};

int red(Rgba c) { return static_cast<int>(c & 0xff); }
int blue(Rgba c) { return static_cast<int>(c >> 16 & 0xff); }

TEST(SlicePicture, GreyFollowsTheWindowAndIsBlackAndWhiteBeyond) {
  const LabelEdit edit = ramp();
  SlicePane pane(edit);
  SliceLook look;
  look.grey = {500, 1000};
  // Between voxel centres: pixel 32, 24 lies at i = 7.625, j = 5.625.
  EXPECT_NEAR(red(pane.at(edit, look, 32, 24)), 255 * (10 * 7.625 + 100 * 5.625) / 1000, 1.01);
  look.grey = {5000, 100};
  EXPECT_EQ(red(pane.at(edit, look, 32, 24)), 0);
  look.grey = {-500, 100};
  EXPECT_EQ(red(pane.at(edit, look, 32, 24)), 255);
  look.grey = {500, 0};
  EXPECT_GE(red(pane.at(edit, look, 32, 24)), 0) << "a window without width";
}

TEST(SlicePicture, BeyondTheScanIsGround) {
  const LabelEdit edit = ramp();
  SlicePane pane(edit);
  SliceLook look;
  look.grey = {-500, 100};  // all of the scan is white
  pane.window = panned(pane.plane, edit.labels().frame, pane.window, 32, 0);
  EXPECT_LT(red(pane.at(edit, look, 30, 24)), 40);
  EXPECT_EQ(red(pane.at(edit, look, 34, 24)), 255);
}

TEST(SlicePicture, BonesAreFilledOutlinedAndHidden) {
  LabelEdit edit = ramp();
  const std::uint16_t label = edit.add("lunate").value();
  edit.begin_step("Paint");
  for (int j = 3; j < 9; ++j) edit.set(edit.labels().frame.index(4, j, 1), 8, label);
  edit.commit_step();
  SlicePane pane(edit);
  SliceLook look;
  look.grey = {5000, 100};  // the ground is black
  look.colors[label] = 0xff0000ff;
  const int inside = red(pane.at(edit, look, 32, 24));
  const int rim = red(pane.at(edit, look, 16, 24));
  EXPECT_NEAR(inside, 255 * look.fill, 3);
  EXPECT_GT(rim, 230);
  EXPECT_EQ(red(pane.at(edit, look, 15, 24)), 0);
  look.chosen = label;
  EXPECT_GT(red(pane.at(edit, look, 32, 24)), inside);
  look.colors.clear();
  EXPECT_EQ(red(pane.at(edit, look, 32, 24)), 0);
}

TEST(SlicePicture, ThePreviewTintsWhatIsInRangeAndNoBoneYet) {
  LabelEdit edit = ramp();
  const std::uint16_t label = edit.add("lunate").value();
  edit.begin_step("Paint");
  edit.set(edit.labels().frame.index(0, 11, 1), 16, label);
  edit.commit_step();
  SlicePane pane(edit);
  SliceLook look;
  look.grey = {5000, 100};
  look.preview = HuRange{800, 2000};
  EXPECT_EQ(blue(pane.at(edit, look, 32, 24)), 0) << "HU 575";
  EXPECT_GT(blue(pane.at(edit, look, 32, 38)), 60) << "HU 970";
  EXPECT_EQ(blue(pane.at(edit, look, 32, 46)), 0) << "a hidden bone's voxel is taken all the same";
}

TEST(SlicePicture, ASliceBeyondTheScanIsItsLast) {
  const LabelEdit edit = ramp();
  SlicePane pane(edit);
  draw_slice(edit, pane.plane, pane.window, 99, {}, pane.pixels);
  const auto beyond = pane.pixels;
  draw_slice(edit, pane.plane, pane.window, 3, {}, pane.pixels);
  EXPECT_EQ(pane.pixels, beyond);
}

}  // namespace
}  // namespace osteon
