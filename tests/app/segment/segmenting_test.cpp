#include "segment/segmenting.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

namespace osteon {
namespace {

/// Two blocks of bone in soft tissue, joined by a bridge; 1 mm voxels.
Volume two_blocks() {
  Volume volume;
  volume.frame.size = {40, 24, 16};
  volume.frame.spacing_m = Vec3::Constant(0.001);
  for (int k = 0; k < 16; ++k)
    for (int j = 0; j < 24; ++j)
      for (int i = 0; i < 40; ++i) {
        const bool rows = j >= 4 && j < 20 && k >= 2 && k < 14;
        const bool block = rows && ((i >= 3 && i < 17) || (i >= 22 && i < 37));
        const bool bridge = i >= 17 && i < 22 && j >= 11 && j < 13 && k >= 7 && k < 9;
        volume.values.push_back(block || bridge ? 1000 : 40);
      }
  return volume;
}

class SegmentingTest : public ::testing::Test {
 protected:
  SegmentingTest()
      : segmenting(LabelEdit::begin(std::make_shared<const Volume>(two_blocks())).value(),
                   {40, 1000, 500}) {
    for (std::size_t p = 0; p < 3; ++p) segmenting.resize_pane(p, 400, 300);
  }

  void use(SegmentTool tool) {
    SegmentRequests requests;
    requests.tools = segmenting.tools();
    requests.tools->tool = tool;
    ASSERT_TRUE(segmenting.apply(requests));
  }

  /// A drag in the axial pane through these voxels of its slice; one voxel: a click.
  Result<void> drag(std::initializer_list<std::pair<double, double>> ij, bool ctrl = false) {
    Result<void> outcome;
    const auto step = [&](double i, double j, bool pressed, bool held, bool released) {
      const PanePoint at = pane_point(segmenting.planes()[0], segmenting.edit().labels().frame,
                                      segmenting.windows()[0], Vec3(i, j, segmenting.slice(0)));
      SegmentRequests requests;
      PaneInput& input = requests.pointer.emplace();
      input.x = at.x;
      input.y = at.y;
      input.pressed = pressed;
      input.held = held;
      input.released = released;
      input.ctrl = ctrl;
      if (auto done = segmenting.apply(requests); !done) outcome = done;
    };
    step(ij.begin()->first, ij.begin()->second, true, true, false);
    for (const auto& [i, j] : ij) step(i, j, false, true, false);
    const auto& end = *std::prev(ij.end());
    step(end.first, end.second, false, false, true);
    return outcome;
  }

  std::size_t voxels(std::uint16_t label) const {
    return segmenting.edit().has(label) ? segmenting.edit().bones().at(label).voxels : 0;
  }

  Segmenting segmenting;
};

TEST_F(SegmentingTest, BeginsInTheMiddleWithTheSuggestedThreshold) {
  EXPECT_EQ(segmenting.cross(), (std::array<int, 3>{20, 12, 8}));
  EXPECT_EQ(segmenting.tools().range.lo, 500);
  EXPECT_FALSE(segmenting.edit().is_changed());
}

TEST_F(SegmentingTest, NothingToUndoAndNothingChosenIsNoHarm) {
  SegmentRequests requests;
  requests.undo = true;
  EXPECT_TRUE(segmenting.apply(requests));
  requests = {};
  requests.remove = 7;
  EXPECT_FALSE(segmenting.apply(requests));
  requests = {};
  requests.split_chosen = true;
  EXPECT_FALSE(segmenting.apply(requests));
  use(SegmentTool::kErase);
  EXPECT_FALSE(drag({{5, 10}}));
  use(SegmentTool::kMerge);
  EXPECT_FALSE(drag({{5, 10}}));
  use(SegmentTool::kSplit);
  EXPECT_FALSE(drag({{5, 10}}));
  EXPECT_FALSE(drag({{5, 10}, {30, 10}}));
  EXPECT_FALSE(segmenting.edit().is_changed());
}

TEST_F(SegmentingTest, ClicksOutsideTheScanAreSaid) {
  use(SegmentTool::kGrow);
  EXPECT_FALSE(drag({{-20, 10}}));
  EXPECT_FALSE(drag({{10, 1}})) << "soft tissue";
  EXPECT_TRUE(segmenting.edit().bones().empty());
  use(SegmentTool::kCross);
  EXPECT_TRUE(drag({{-20, 500}}));
  EXPECT_EQ(segmenting.cross()[0], 0);
  EXPECT_EQ(segmenting.cross()[1], 23);
}

TEST_F(SegmentingTest, TheCrossHairLinksTheThreeViews) {
  ASSERT_TRUE(drag({{10, 6}, {30, 15}}));
  EXPECT_EQ(segmenting.cross(), (std::array<int, 3>{30, 15, 8}));
  EXPECT_EQ(segmenting.slice(0), 8);
  EXPECT_EQ(segmenting.slice(1), 15);
  EXPECT_EQ(segmenting.slice(2), 30);
}

TEST_F(SegmentingTest, TheWheelGoesThroughSlicesAndStopsAtTheEnds) {
  SegmentRequests requests;
  requests.pointer.emplace().wheel = 3;
  ASSERT_TRUE(segmenting.apply(requests));
  EXPECT_EQ(segmenting.slice(0), 11);
  requests.pointer->wheel = 100;
  ASSERT_TRUE(segmenting.apply(requests));
  EXPECT_EQ(segmenting.slice(0), 15);
  requests.pointer->wheel = -0.2;
  ASSERT_TRUE(segmenting.apply(requests));
  EXPECT_EQ(segmenting.slice(0), 14) << "a touch pad's small notch";
  requests.pointer->ctrl = true;
  const double scale = segmenting.windows()[0].m_per_px;
  ASSERT_TRUE(segmenting.apply(requests));
  EXPECT_EQ(segmenting.slice(0), 14);
  EXPECT_GT(segmenting.windows()[0].m_per_px, scale);
}

TEST_F(SegmentingTest, GrowSplitMergeAndBack) {
  use(SegmentTool::kGrow);
  ASSERT_TRUE(drag({{6, 10}}));
  const std::uint16_t whole = segmenting.chosen();
  const std::size_t all = voxels(whole);
  EXPECT_EQ(all, 14u * 16 * 12 + 15u * 16 * 12 + 5u * 4);
  use(SegmentTool::kSplit);
  ASSERT_TRUE(drag({{30, 10}, {8, 10}}));
  const std::uint16_t part = segmenting.chosen();
  EXPECT_NE(part, whole);
  EXPECT_NEAR(static_cast<double>(voxels(whole)), 15 * 16 * 12 + 10, 14);
  EXPECT_EQ(voxels(whole) + voxels(part), all);
  use(SegmentTool::kMerge);
  ASSERT_TRUE(drag({{30, 10}}));
  EXPECT_EQ(voxels(part), all);
  EXPECT_FALSE(segmenting.edit().has(whole));
  EXPECT_FALSE(drag({{30, 10}})) << "with itself";
  SegmentRequests undo;
  undo.undo = true;
  for (int n = 0; n < 3; ++n) ASSERT_TRUE(segmenting.apply(undo));
  EXPECT_TRUE(segmenting.edit().bones().empty());
  EXPECT_EQ(segmenting.chosen(), 0);
  EXPECT_FALSE(segmenting.edit().is_changed());
}

TEST_F(SegmentingTest, AClickWithTheSplitToolPartsAtTheNeck) {
  use(SegmentTool::kGrow);
  ASSERT_TRUE(drag({{6, 10}}));
  use(SegmentTool::kSplit);
  ASSERT_TRUE(drag({{6, 10}}));
  EXPECT_EQ(segmenting.edit().bones().size(), 2u);
}

TEST_F(SegmentingTest, AStrokeIsOneStepAndMakesItsBone) {
  use(SegmentTool::kPaint);
  SegmentRequests requests;
  requests.tools = segmenting.tools();
  requests.tools->ball = false;
  requests.tools->radius_m = 0.0015;
  ASSERT_TRUE(segmenting.apply(requests));
  ASSERT_TRUE(drag({{5, 10}, {15, 10}, {15, 14}}));
  EXPECT_EQ(segmenting.edit().bones().size(), 1u);
  EXPECT_EQ(segmenting.edit().undo_steps(), 1u);
  const std::uint16_t label = segmenting.chosen();
  EXPECT_EQ(segmenting.edit().labels().at(10, 10, 8), label) << "between two pointer places";
  EXPECT_EQ(segmenting.edit().labels().at(10, 10, 9), 0) << "a disc";
  const std::size_t painted = voxels(label);
  ASSERT_TRUE(drag({{10, 10}}, true));
  EXPECT_LT(voxels(label), painted) << "with Ctrl it erases";
  EXPECT_EQ(segmenting.edit().undo_steps(), 2u);
}

TEST_F(SegmentingTest, UndoInTheMiddleOfAStrokeTakesThatStrokeBackAlone) {
  use(SegmentTool::kGrow);
  ASSERT_TRUE(drag({{6, 10}}));
  const std::size_t grown = voxels(segmenting.chosen());
  use(SegmentTool::kErase);
  SegmentRequests requests;
  PaneInput& input = requests.pointer.emplace();
  const PanePoint at = pane_point(segmenting.planes()[0], segmenting.edit().labels().frame,
                                  segmenting.windows()[0], Vec3(8, 10, 8));
  input.x = at.x;
  input.y = at.y;
  input.pressed = input.held = true;
  ASSERT_TRUE(segmenting.apply(requests));
  EXPECT_LT(voxels(segmenting.chosen()), grown);
  requests = {};
  requests.undo = true;
  ASSERT_TRUE(segmenting.apply(requests));
  EXPECT_EQ(voxels(segmenting.chosen()), grown);
  EXPECT_EQ(segmenting.edit().undo_steps(), 1u);
}

TEST_F(SegmentingTest, GrowOnABoneChoosesIt) {
  use(SegmentTool::kGrow);
  ASSERT_TRUE(drag({{6, 10}}));
  SegmentRequests requests;
  requests.add = true;
  ASSERT_TRUE(segmenting.apply(requests));
  ASSERT_TRUE(drag({{30, 10}}));
  EXPECT_EQ(segmenting.edit().bones().size(), 2u);
  EXPECT_EQ(segmenting.chosen(), 1) << "the bone that was clicked on";
}

TEST_F(SegmentingTest, GrowAddsToTheChosenBoneWhereThatIsWanted) {
  SegmentRequests requests;
  requests.tools = segmenting.tools();
  requests.tools->tool = SegmentTool::kGrow;
  requests.tools->fresh = false;
  requests.tools->reach_m = 0.004;
  ASSERT_TRUE(segmenting.apply(requests));
  ASSERT_TRUE(drag({{6, 8}}));
  const std::size_t first = voxels(segmenting.chosen());
  ASSERT_TRUE(drag({{30, 12}}));
  EXPECT_EQ(segmenting.edit().bones().size(), 1u);
  EXPECT_GT(voxels(segmenting.chosen()), first + 100);
}

TEST_F(SegmentingTest, PartsOfTheThresholdBecomeBonesAndCanBeNamed) {
  SegmentRequests requests;
  requests.find_bodies = true;
  ASSERT_TRUE(segmenting.apply(requests));
  ASSERT_EQ(segmenting.edit().bones().size(), 1u);
  requests = {};
  requests.rename = NewName{segmenting.chosen(), "lunate"};
  ASSERT_TRUE(segmenting.apply(requests));
  EXPECT_EQ(segmenting.edit().bones().at(segmenting.chosen()).name, "lunate");
  requests.rename->name = "1mc";
  ASSERT_TRUE(segmenting.apply(requests));
  EXPECT_EQ(segmenting.edit().bones().at(segmenting.chosen()).name, "metacarpal_1");
  requests.rename->name = "";
  EXPECT_FALSE(segmenting.apply(requests));
}

TEST_F(SegmentingTest, HiddenBonesAreLeftOutOfThePicture) {
  use(SegmentTool::kGrow);
  ASSERT_TRUE(drag({{6, 10}}));
  const std::uint16_t label = segmenting.chosen();
  EXPECT_EQ(segmenting.look().colors.count(label), 1u);
  const std::uint64_t before = segmenting.look_version();
  SegmentRequests requests;
  requests.toggle_shown = label;
  ASSERT_TRUE(segmenting.apply(requests));
  EXPECT_EQ(segmenting.look().colors.count(label), 0u);
  EXPECT_GT(segmenting.look_version(), before);
  requests = {};
  requests.show_all = true;
  ASSERT_TRUE(segmenting.apply(requests));
  EXPECT_TRUE(segmenting.is_shown(label));
}

TEST_F(SegmentingTest, ABoneChosenInTheListIsSeen) {
  use(SegmentTool::kGrow);
  ASSERT_TRUE(drag({{6, 10}}));
  use(SegmentTool::kCross);
  ASSERT_TRUE(drag({{1, 1}}));
  SegmentRequests requests;
  requests.choose = segmenting.chosen() ? segmenting.chosen() : std::uint16_t{1};
  ASSERT_TRUE(segmenting.apply(requests));
  EXPECT_EQ(segmenting.cross(), (std::array<int, 3>{19, 11, 7}));
}

}  // namespace
}  // namespace osteon
