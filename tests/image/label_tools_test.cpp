#include "osteon/image/label_tools.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "osteon/image/fill.h"
#include "osteon/image/segment.h"
#include "volumes.h"

namespace osteon {
namespace {

GridFrame frame_of(int i, int j, int k, const Vec3& spacing_m = Vec3::Constant(0.0005)) {
  GridFrame frame;
  frame.size = {i, j, k};
  frame.spacing_m = spacing_m;
  return frame;
}

template <class F>
LabelEdit scan_where(const GridFrame& frame, F hu) {
  Volume volume{frame, {}};
  for (int k = 0; k < frame.size[2]; ++k)
    for (int j = 0; j < frame.size[1]; ++j)
      for (int i = 0; i < frame.size[0]; ++i)
        volume.values.push_back(static_cast<std::int16_t>(hu(i, j, k)));
  return LabelEdit::begin(std::make_shared<const Volume>(std::move(volume))).value();
}

GrowOptions above(int hu, bool fill = false) { return {{hu, 32767}, 0, fill}; }

std::size_t voxels(const LabelEdit& edit, std::uint16_t label) {
  return edit.bones().at(label).voxels;
}

// Two shells around marrow, a voxel of bone joining them.
const Vec3 kBallA(20, 20, 20), kBallB(47, 20, 20);
double two_balls(int i, int j, int k) {
  const Vec3 p(i, j, k);
  const double d = std::min((p - kBallA).norm() - 14, (p - kBallB).norm() - 12);
  return d > 0 ? 40 : d > -3 ? 1200 : 200;
}

TEST(GrowLabel, NothingGrowsWhereItMayNot) {
  LabelEdit edit = scan_where(frame_of(6, 5, 4), [](int i, int, int) { return i < 3 ? 900 : 0; });
  EXPECT_FALSE(grow_label(edit, 1, {0, 0, 0}, above(500))) << "no bone yet";
  const std::uint16_t a = edit.add("lunate").value(), b = edit.add("ulna").value();
  EXPECT_FALSE(grow_label(edit, a, {-1, 0, 0}, above(500))) << "outside";
  EXPECT_FALSE(grow_label(edit, a, {6, 0, 0}, above(500))) << "outside";
  const auto dark = grow_label(edit, a, {4, 0, 0}, above(500));
  ASSERT_FALSE(dark);
  EXPECT_NE(dark.error().message().find("0 HU"), std::string::npos);
  EXPECT_EQ(grow_label(edit, a, {1, 2, 2}, above(500)).value(), 60u);
  EXPECT_FALSE(grow_label(edit, b, {1, 2, 2}, above(500))) << "taken";
  EXPECT_EQ(grow_label(edit, a, {1, 2, 2}, above(500)).value(), 0u) << "has it all";
}

TEST(GrowLabel, ANewBoneComesAndGoesWithItsVoxels) {
  LabelEdit edit = scan_where(frame_of(6, 5, 4), [](int i, int, int) { return i < 3 ? 900 : 0; });
  EXPECT_FALSE(grow_new_label(edit, {4, 0, 0}, above(500)));
  EXPECT_TRUE(edit.bones().empty());
  EXPECT_EQ(grow_new_label(edit, {0, 0, 0}, above(500)).value(), 60u);
  EXPECT_EQ(edit.bones().size(), 1u);
  EXPECT_FALSE(grow_new_label(edit, {0, 0, 0}, above(500))) << "taken";
  ASSERT_TRUE(edit.undo());
  EXPECT_TRUE(edit.bones().empty());
}

/// The oracle takes one voxel after the other.
std::vector<char> flood(const LabelEdit& edit, const std::array<int, 3>& seed, const HuRange& range,
                        double reach_m) {
  const GridFrame& frame = edit.labels().frame;
  std::vector<char> in(frame.count(), 0);
  std::vector<std::array<int, 3>> open = {seed};
  in[frame.index(seed[0], seed[1], seed[2])] = 1;
  while (!open.empty()) {
    const auto at = open.back();
    open.pop_back();
    for (std::size_t s = 0; s < 6; ++s) {
      auto to = at;
      to[s / 2] += s % 2 ? 1 : -1;
      if (!frame.contains(to[0], to[1], to[2])) continue;
      const std::size_t n = frame.index(to[0], to[1], to[2]);
      const Vec3 way =
          frame.point_P(Vec3(to[0], to[1], to[2])) - frame.point_P(Vec3(seed[0], seed[1], seed[2]));
      if (in[n] || !range.holds(edit.volume().values[n])) continue;
      if (reach_m > 0 && way.norm() > reach_m) continue;
      in[n] = 1;
      open.push_back(to);
    }
  }
  return in;
}

TEST(GrowLabel, AgreesWithFloodingVoxelByVoxel) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const GridFrame frame = frame_of(13, 11, 9, Vec3(0.0004, 0.0006, 0.001));
    const Volume noise = noise_volume(frame, seed);
    LabelEdit edit = LabelEdit::begin(std::make_shared<const Volume>(noise)).value();
    const std::uint16_t label = edit.add().value();
    const std::array<int, 3> start = {6, 5, 4};
    GrowOptions options;
    options.range = {noise.at(6, 5, 4) - 1300, noise.at(6, 5, 4) + 1300};
    options.reach_m = seed % 2 ? 0 : 0.0021;
    options.fill = false;
    ASSERT_TRUE(grow_label(edit, label, start, options));
    const auto expected = flood(edit, start, options.range, options.reach_m);
    for (std::size_t n = 0; n < expected.size(); ++n)
      ASSERT_EQ(edit.labels().values[n] == label, expected[n] != 0) << seed << " " << n;
  }
}

TEST(GrowLabel, DoesNotPassThroughAnotherBoneAndTakesNothingFromIt) {
  LabelEdit edit = scan_where(frame_of(9, 3, 3), [](int, int, int) { return 900; });
  const std::uint16_t wall = edit.add("wall").value(), a = edit.add("a").value();
  edit.begin_step("Wall");
  for (int k = 0; k < 3; ++k)
    for (int j = 0; j < 3; ++j) edit.set(edit.labels().frame.index(4, j, k), 1, wall);
  edit.commit_step();
  EXPECT_EQ(grow_label(edit, a, {0, 0, 0}, above(500, true)).value(), 36u);
  EXPECT_EQ(voxels(edit, wall), 9u);
}

TEST(GrowLabel, TakesTheMarrowWithTheShell) {
  LabelEdit edit = scan_where(frame_of(68, 41, 41), two_balls);
  const std::uint16_t hollow = edit.add().value();
  const std::size_t shell = grow_label(edit, hollow, {20, 20, 7}, above(600)).value();
  EXPECT_EQ(edit.labels().at(20, 20, 20), 0);
  ASSERT_TRUE(edit.undo());
  const std::size_t whole = grow_label(edit, hollow, {20, 20, 7}, above(600, true)).value();
  EXPECT_GT(whole, shell);
  EXPECT_EQ(edit.labels().at(20, 20, 20), hollow);
  const double balls = 4.0 / 3 * M_PI * (14 * 14 * 14 + 12 * 12 * 12);
  EXPECT_NEAR(static_cast<double>(whole), balls, 0.02 * balls);
}

TEST(DabLabel, BeyondTheScanAndWithoutABoneNothingIsDrawn) {
  LabelEdit edit = scan_where(frame_of(8, 8, 8), [](int, int, int) { return 0; });
  edit.begin_step("Paint");
  EXPECT_EQ(dab_label(edit, 5, Vec3(4, 4, 4), Vec3(4, 4, 4), {}), 0u);
  const std::uint16_t label = edit.add().value();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(dab_label(edit, label, Vec3(nan, 0, 0), Vec3(4, 4, 4), {}), 0u);
  EXPECT_EQ(dab_label(edit, label, Vec3(1e9, 4, 4), Vec3(1e9, 4, 4), {}), 0u);
  EXPECT_EQ(dab_label(edit, label, Vec3(-40, 4, 4), Vec3(-40, 4, 4), {.radius_m = 0.001}), 0u);
  EXPECT_EQ(dab_label(edit, label, Vec3(4, 4, 9), Vec3(4, 4, 9), {.slice_axis = 2}), 0u)
      << "a slice that does not exist";
}

TEST(DabLabel, TheSmallestBrushDrawsAVoxel) {
  LabelEdit edit = scan_where(frame_of(8, 8, 8), [](int, int, int) { return 0; });
  edit.begin_step("Paint");
  const std::uint16_t label = edit.add().value();
  EXPECT_EQ(dab_label(edit, label, Vec3(3.4, 4, 4), Vec3(3.4, 4, 4), {.radius_m = 0}), 1u);
  EXPECT_EQ(edit.labels().at(3, 4, 4), label);
}

/// Every voxel tried, with the distance from the straight way by its closed form.
TEST(DabLabel, DrawsAllVoxelsWithinTheRadiusOfTheWayAndNoOthers) {
  const Vec3 spacing(0.0004, 0.0007, 0.0012);
  for (const int axis : {-1, 0, 1, 2}) {
    LabelEdit edit = scan_where(frame_of(30, 22, 14, spacing), [](int, int, int) { return 0; });
    const std::uint16_t label = edit.add().value();
    const Vec3 from(5.2, 4.1, 6.0), to(21.7, 15.3, 6.0 + (axis == 2 ? 0 : 3));
    Vec3 begin = from, end = to;
    if (axis >= 0) begin[axis] = end[axis] = std::round(to[axis]);
    edit.begin_step("Paint");
    dab_label(edit, label, from, to, {.radius_m = 0.0021, .slice_axis = axis});
    edit.commit_step();
    for (int k = 0; k < 14; ++k)
      for (int j = 0; j < 22; ++j)
        for (int i = 0; i < 30; ++i) {
          const Vec3 p = spacing.cwiseProduct(Vec3(i, j, k));
          const Vec3 a = spacing.cwiseProduct(begin), b = spacing.cwiseProduct(end);
          const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
          const double away = (p - (a + t * (b - a))).norm();
          const bool slice = axis < 0 || (axis == 0 ? i : axis == 1 ? j : k) == end[axis];
          if (std::abs(away - 0.0021) < 1e-9) continue;
          ASSERT_EQ(edit.labels().at(i, j, k) == label, slice && away < 0.0021)
              << axis << ": " << i << " " << j << " " << k;
        }
  }
}

TEST(DabLabel, KeepsOffOtherBonesAndOtherValues) {
  LabelEdit edit = scan_where(frame_of(20, 8, 8), [](int i, int, int) { return i < 10 ? 800 : 0; });
  const std::uint16_t a = edit.add("a").value(), b = edit.add("b").value();
  const auto paint = [&](std::uint16_t label, const Vec3& at, const LabelBrush& brush) {
    edit.begin_step("Paint");
    const std::size_t changed = dab_label(edit, label, at, at, brush);
    edit.commit_step();
    return changed;
  };
  const Vec3 middle(10, 4, 4);
  const std::size_t ball = paint(a, middle, {.radius_m = 0.0015});
  EXPECT_EQ(paint(b, middle, {.radius_m = 0.0015}), 0u);
  EXPECT_EQ(paint(b, middle, {.radius_m = 0.0015, .over_others = true}), ball);
  EXPECT_EQ(paint(a, middle, {.radius_m = 0.0015, .erase = true}), 0u) << "is another bone's";
  const std::size_t dark =
      paint(b, middle, {.radius_m = 0.0015, .erase = true, .within = HuRange{-100, 100}});
  EXPECT_GT(dark, ball / 3);
  EXPECT_LT(dark, ball);
  EXPECT_EQ(edit.labels().at(9, 4, 4), b);
  EXPECT_EQ(edit.labels().at(10, 4, 4), 0);
}

std::uint16_t joined_balls(LabelEdit& edit) {
  const std::uint16_t label = edit.add("two").value();
  EXPECT_TRUE(grow_label(edit, label, {20, 20, 7}, above(600, true)));
  EXPECT_EQ(edit.labels().at(47, 20, 20), label) << "they are connected";
  return label;
}

void expect_parted_at_the_plane(const LabelEdit& edit, std::uint16_t a, std::uint16_t b) {
  // The spheres meet where x = 34.46.
  std::size_t wrong = 0, all = 0;
  for (int k = 0; k < 41; ++k)
    for (int j = 0; j < 41; ++j)
      for (int i = 0; i < 68; ++i) {
        const std::uint16_t label = edit.labels().at(i, j, k);
        if (label == 0) continue;
        ++all;
        wrong += label != (i < 34.46 ? a : b);
      }
  EXPECT_LT(static_cast<double>(wrong), 0.003 * static_cast<double>(all));
}

TEST(SplitLabel, ASingleVoxelAndNothingHaveNoNeck) {
  LabelEdit edit = scan_where(frame_of(5, 5, 5), [](int, int, int) { return 900; });
  EXPECT_FALSE(split_label(edit, 1));
  const std::uint16_t label = edit.add().value();
  EXPECT_FALSE(split_label(edit, label)) << "no voxels";
  edit.begin_step("Paint");
  edit.set(62, 1, label);
  edit.commit_step();
  const std::size_t steps = edit.undo_steps();
  EXPECT_FALSE(split_label(edit, label));
  EXPECT_FALSE(split_label_between(edit, {2, 2, 2}, {2, 2, 2}));
  EXPECT_FALSE(split_label_between(edit, {2, 2, 2}, {2, 2, 3})) << "not in the bone";
  EXPECT_FALSE(split_label_between(edit, {2, 2, 2}, {2, 2, 9})) << "not in the scan";
  EXPECT_EQ(edit.undo_steps(), steps);
  EXPECT_EQ(voxels(edit, label), 1u);
}

TEST(SplitLabel, PartsBallsThatTouchAndTheLargerKeepsTheName) {
  LabelEdit edit = scan_where(frame_of(68, 41, 41), two_balls);
  const std::uint16_t label = joined_balls(edit);
  const auto parts = split_label(edit, label);
  ASSERT_TRUE(parts) << parts.error().message();
  ASSERT_EQ(parts->size(), 1u);
  expect_parted_at_the_plane(edit, label, parts->front());
  ASSERT_TRUE(edit.undo());
  EXPECT_EQ(edit.labels().at(47, 20, 20), label);
  EXPECT_EQ(edit.bones().size(), 1u);
}

TEST(SplitLabel, ABallStaysWhole) {
  LabelEdit edit = scan_where(frame_of(31, 31, 31), [](int i, int j, int k) {
    return (Vec3(i, j, k) - Vec3(15, 15, 15)).norm() < 12 ? 1000 : 0;
  });
  const std::uint16_t label = edit.add().value();
  ASSERT_TRUE(grow_label(edit, label, {15, 15, 15}, above(500)));
  EXPECT_FALSE(split_label(edit, label));
}

// Wherever in the two bodies the stroke begins and ends, the border is the neck.
TEST(SplitLabelBetween, TheBorderRunsThroughTheNeck) {
  const std::array<int, 3> in_a[] = {{20, 20, 20}, {8, 20, 20}, {20, 31, 14}, {31, 20, 20}};
  const std::array<int, 3> in_b[] = {{47, 20, 20}, {57, 20, 20}, {45, 12, 22}, {38, 20, 20}};
  for (const auto& a : in_a)
    for (const auto& b : in_b) {
      LabelEdit edit = scan_where(frame_of(68, 41, 41), two_balls);
      const std::uint16_t label = joined_balls(edit);
      const auto part = split_label_between(edit, a, b);
      ASSERT_TRUE(part) << part.error().message();
      expect_parted_at_the_plane(edit, label, *part);
    }
}

TEST(SplitLabelBetween, WithoutANeckItIsHalfWay) {
  LabelEdit edit = scan_where(frame_of(31, 9, 9), [](int i, int j, int k) {
    return i > 0 && i < 30 && j > 0 && j < 8 && k > 0 && k < 8 ? 1000 : 0;
  });
  const std::uint16_t label = edit.add().value();
  ASSERT_TRUE(grow_label(edit, label, {5, 4, 4}, above(500)));
  const auto part = split_label_between(edit, {5, 4, 4}, {25, 4, 4});
  ASSERT_TRUE(part);
  EXPECT_EQ(edit.labels().at(13, 4, 4), label);
  EXPECT_EQ(edit.labels().at(17, 4, 4), *part);
  EXPECT_EQ(voxels(edit, label) + voxels(edit, *part), 29u * 49u);
}

TEST(SplitLabelBetween, AScanThatIsBoneAllOverIsSplitToo) {
  LabelEdit edit = scan_where(frame_of(9, 1, 1), [](int, int, int) { return 1000; });
  const std::uint16_t label = edit.add().value();
  ASSERT_TRUE(grow_label(edit, label, {0, 0, 0}, above(500)));
  const auto part = split_label_between(edit, {0, 0, 0}, {8, 0, 0});
  ASSERT_TRUE(part);
  EXPECT_GE(voxels(edit, *part), 4u);
  EXPECT_GE(voxels(edit, label), 4u);
}

TEST(LabelBodies, NothingWithinTheRangeIsSaid) {
  LabelEdit edit = scan_where(frame_of(5, 5, 5), [](int, int, int) { return 0; });
  EXPECT_FALSE(label_bodies(edit, {.range = {500, 3000}}));
  EXPECT_EQ(edit.undo_steps(), 0u);
}

TEST(LabelBodies, MakesABoneOfEachAndLeavesThoseThatAre) {
  LabelEdit edit = scan_where(frame_of(40, 12, 12), [](int i, int, int) {
    return i < 10 || (i > 15 && i < 30) || i == 38 ? 900 : 0;
  });
  const std::uint16_t mine = edit.add("mine").value();
  ASSERT_TRUE(grow_label(edit, mine, {0, 0, 0}, above(500)));
  const auto made = label_bodies(edit, {.range = {500, 3000}, .smallest_m3 = 3e-8});
  ASSERT_TRUE(made);
  ASSERT_EQ(made->size(), 1u) << "the slice at the rim is too small";
  EXPECT_EQ(voxels(edit, made->front()), 14u * 144u);
  EXPECT_EQ(voxels(edit, mine), 1440u);
  EXPECT_FALSE(label_bodies(edit, {.range = {500, 3000}, .smallest_m3 = 3e-8}));
}

// A limb (40 HU) from i = 0 on with a bone in it, in air, and a rail at i = 34 to 38.
int limb_and_rail(int i, int j, int k) {
  const bool rail = i >= 34 && i < 38;
  if (rail) return 900;
  if (i >= 26) return -1000;
  return i >= 6 && i < 20 && j >= 6 && j < 18 && k >= 6 && k < 18 ? 900 : 40;
}

TEST(LabelBodies, WhatLiesOutsideTheBodyIsNoBoneWhetherOrNotTheBonesAreMadeAlready) {
  LabelEdit edit = scan_where(frame_of(48, 24, 24), limb_and_rail);
  const auto made = label_bodies(edit, {.range = {500, 3000}, .smallest_m3 = 3e-8});
  ASSERT_TRUE(made);
  ASSERT_EQ(made->size(), 1u);
  EXPECT_EQ(voxels(edit, made->front()), 14u * 144u);
  EXPECT_FALSE(label_bodies(edit, {.range = {500, 3000}, .smallest_m3 = 3e-8})) << "the rail";
}

// The same bones as the import's own stages find, where nothing has grown together.
TEST(LabelBodies, AgreeWithTheImport) {
  const auto apart = [](int i, int j, int k) {
    const Vec3 p(i, j, k);
    const double d =
        std::min((p - Vec3(15, 15, 15)).norm() - 11, (p - Vec3(42, 15, 15)).norm() - 9);
    return d > 0 ? 40 : d > -3 ? 1200 : 200;
  };
  LabelEdit edit = scan_where(frame_of(56, 31, 31), apart);
  const auto made = label_bodies(edit, {.range = {600, 3000}});
  ASSERT_TRUE(made);
  SegmentOptions options;
  options.threshold_hu = 600;
  const auto imported = segment_bone(edit.volume(), options);
  ASSERT_TRUE(imported);
  EXPECT_EQ(edit.labels().values, imported->labels.values);
}

// Told to stop at any of its questions, a tool leaves labels, names and history as they were.
TEST(LabelToolsStopped, NothingHasChanged) {
  LabelEdit edit = scan_where(frame_of(68, 40, 40), two_balls);
  const std::uint16_t whole = edit.add("whole").value();
  ASSERT_TRUE(grow_label(edit, whole, {20, 20, 7}, above(900, true)));
  const LabelVolume before = edit.labels();
  const std::size_t steps = edit.undo_steps();
  EXPECT_EQ(edit.undo_voxels(), voxels(edit, whole));
  using Tool = std::function<bool(const Progress&)>;
  const std::vector<Tool> tools = {
      [&](const Progress& p) { return split_label(edit, whole, p).has_value(); },
      [&](const Progress& p) {
        return split_label_between(edit, {20, 20, 20}, {47, 20, 20}, p).has_value();
      },
      [&](const Progress& p) {
        return grow_label(edit, whole, {20, 20, 7}, above(-999), p).has_value();
      },
      [&](const Progress& p) {
        return label_bodies(edit, {{-999, 100}, 1e-9, true, 64}, p).has_value();
      }};
  for (std::size_t tool = 0; tool < tools.size(); ++tool) {
    int asked = 0, allowed = 0;
    const auto until = [&](const char*, double) { return asked++ < allowed; };
    for (; allowed < 50; ++allowed) {
      asked = 0;
      if (tools[tool](until)) break;
      ASSERT_EQ(edit.labels().values, before.values) << "tool " << tool << ", stop " << allowed;
      ASSERT_EQ(edit.undo_steps(), steps);
      ASSERT_EQ(edit.bones().size(), 1u);
    }
    EXPECT_GT(allowed, 0) << "tool " << tool << " never asks";
    EXPECT_NE(edit.undo_steps(), steps) << "tool " << tool << " never ends";
    ASSERT_TRUE(edit.undo());
    ASSERT_EQ(edit.labels().values, before.values);
  }
}

}  // namespace
}  // namespace osteon
