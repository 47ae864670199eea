#include "osteon/image/label_edit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "volumes.h"

namespace osteon {
namespace {

std::shared_ptr<const Volume> small_scan() {
  return std::make_shared<const Volume>(noise_volume(small_frame(), 3));
}

LabelEdit begun(std::size_t history_bytes = LabelEdit::kHistoryBytes) {
  auto edit = LabelEdit::begin(small_scan(), history_bytes);
  EXPECT_TRUE(edit);
  return std::move(*edit);
}

/// Counts and boxes as a plain pass over all voxels finds them.
void expect_books_kept(const LabelEdit& edit) {
  std::map<std::uint16_t, std::size_t> counts;
  const GridFrame& frame = edit.labels().frame;
  for (int k = 0; k < frame.size[2]; ++k)
    for (int j = 0; j < frame.size[1]; ++j)
      for (int i = 0; i < frame.size[0]; ++i) {
        const std::uint16_t label = edit.labels().at(i, j, k);
        if (label == 0) continue;
        ++counts[label];
        ASSERT_TRUE(edit.has(label));
        const VoxelBox& box = edit.bones().at(label).box;
        const int at[3] = {i, j, k};
        for (std::size_t a = 0; a < 3; ++a) {
          EXPECT_GE(at[a], box.lo[a]);
          EXPECT_LT(at[a], box.hi[a]);
        }
      }
  for (const auto& [label, bone] : edit.bones()) EXPECT_EQ(bone.voxels, counts[label]);
}

TEST(LabelEdit, RefusesScansThatAreNone) {
  EXPECT_FALSE(LabelEdit::begin(nullptr));
  EXPECT_FALSE(LabelEdit::begin(std::make_shared<const Volume>()));
  Volume cut = noise_volume(small_frame(), 1);
  cut.values.pop_back();
  EXPECT_FALSE(LabelEdit::begin(std::make_shared<const Volume>(std::move(cut))));
}

TEST(LabelEdit, WithoutAnyChangeThereIsNothingToUndo) {
  LabelEdit edit = begun();
  EXPECT_FALSE(edit.undo());
  EXPECT_FALSE(edit.redo());
  EXPECT_FALSE(edit.is_changed());
  EXPECT_FALSE(edit.commit_step());
  edit.cancel_step();
  edit.begin_step("Nothing");
  EXPECT_FALSE(edit.commit_step());
  EXPECT_EQ(edit.undo_steps(), 0u);
}

TEST(LabelEdit, WhatCannotBeDoneIsSaidAndChangesNothing) {
  LabelEdit edit = begun();
  const std::uint16_t lunate = edit.add("lunate").value();
  const std::uint16_t ulna = edit.add("ulna").value();
  const std::size_t steps = edit.undo_steps();
  EXPECT_FALSE(edit.add("lunate"));
  EXPECT_FALSE(edit.rename(lunate, "ulna"));
  EXPECT_FALSE(edit.rename(lunate, ""));
  EXPECT_FALSE(edit.rename(77, "capitate"));
  EXPECT_FALSE(edit.remove(77));
  EXPECT_FALSE(edit.merge(77, lunate));
  EXPECT_FALSE(edit.merge(lunate, 77));
  const auto itself = edit.merge(ulna, ulna);
  ASSERT_FALSE(itself);
  EXPECT_NE(itself.error().message().find("itself"), std::string::npos);
  EXPECT_TRUE(edit.rename(lunate, "lunate")) << "its own name is no change";
  EXPECT_EQ(edit.undo_steps(), steps);
}

TEST(LabelEdit, NewNamesAreThoseNotInUse) {
  LabelEdit edit = begun();
  EXPECT_EQ(edit.bones().at(edit.add().value()).name, "bone_1");
  const std::uint16_t second = edit.add().value();
  EXPECT_EQ(edit.bones().at(second).name, "bone_2");
  ASSERT_TRUE(edit.remove(1));
  EXPECT_EQ(edit.unused_name(), "bone_1");
  EXPECT_EQ(edit.add().value(), 1) << "a label that is free again";
}

TEST(LabelEdit, AStrokeIsUndoneAtOnceAndComesBack) {
  LabelEdit edit = begun();
  const std::uint16_t label = edit.add("lunate").value();
  edit.begin_step("Paint lunate");
  EXPECT_EQ(edit.set(4, 3, label), 3u);
  EXPECT_EQ(edit.set(6, 3, label), 2u) << "one of them had it already";
  EXPECT_EQ(edit.set(40, 1, label), 1u);
  EXPECT_TRUE(edit.commit_step());
  EXPECT_EQ(edit.undo_what(), "Paint lunate");
  EXPECT_EQ(edit.bones().at(label).voxels, 6u);
  expect_books_kept(edit);
  ASSERT_TRUE(edit.undo());
  EXPECT_EQ(edit.redo_what(), "Paint lunate");
  EXPECT_EQ(std::count(edit.labels().values.begin(), edit.labels().values.end(), label), 0);
  expect_books_kept(edit);
  ASSERT_TRUE(edit.redo());
  EXPECT_EQ(edit.bones().at(label).voxels, 6u);
  expect_books_kept(edit);
}

TEST(LabelEdit, AStepUnderWayCanBeCancelled) {
  LabelEdit edit = begun();
  const std::uint16_t label = edit.add("lunate").value();
  edit.begin_step("Paint");
  edit.set(0, 20, label);
  edit.set(5, 5, 0);  // what the step itself had changed
  edit.cancel_step();
  EXPECT_EQ(std::count(edit.labels().values.begin(), edit.labels().values.end(), 0),
            static_cast<std::ptrdiff_t>(edit.labels().values.size()));
  EXPECT_EQ(edit.undo_steps(), 1u);
  expect_books_kept(edit);
}

TEST(LabelEdit, MergeAndRemoveTakeNamesWithThemAndBack) {
  LabelEdit edit = begun();
  const std::uint16_t a = edit.add("lunate").value(), b = edit.add("ulna").value();
  edit.begin_step("Paint");
  edit.set(0, 30, a);
  edit.set(30, 50, b);
  edit.commit_step();
  ASSERT_TRUE(edit.merge(b, a));
  EXPECT_FALSE(edit.has(b));
  EXPECT_EQ(edit.bones().at(a).voxels, 80u);
  expect_books_kept(edit);
  ASSERT_TRUE(edit.remove(a));
  EXPECT_TRUE(edit.bones().empty());
  ASSERT_TRUE(edit.undo());
  ASSERT_TRUE(edit.undo());
  EXPECT_EQ(edit.bones().at(b).name, "ulna");
  EXPECT_EQ(edit.bones().at(b).voxels, 50u);
  EXPECT_EQ(edit.labels().values[29], a);
  EXPECT_EQ(edit.labels().values[30], b);
  expect_books_kept(edit);
}

/// Random steps, each remembered whole: undo and redo lead through the very same states.
TEST(LabelEdit, UndoAndRedoWalkThroughTheStatesThatWere) {
  LabelEdit edit = begun();
  Random random(8);
  struct State {
    std::vector<std::uint16_t> values;
    std::map<std::uint16_t, std::string> names;
  };
  const auto now = [&] {
    State state{edit.labels().values, {}};
    for (const auto& [label, bone] : edit.bones()) state.names[label] = bone.name;
    return state;
  };
  std::vector<State> states = {now()};
  for (int n = 0; n < 150; ++n) {
    const double kind = random.uniform();
    const auto pick = static_cast<std::uint16_t>(1 + random.uniform() * 4);
    const auto first = static_cast<std::size_t>(random.uniform() * 300);
    if (kind < 0.2)
      (void)edit.add();
    else if (kind < 0.3)
      (void)edit.remove(pick);
    else if (kind < 0.4)
      (void)edit.merge(pick, 1);
    else if (kind < 0.5)
      (void)edit.rename(pick, "name_" + std::to_string(n));
    else if (edit.has(pick)) {
      edit.begin_step("Paint");
      edit.set(first, 15, pick);
      edit.set(first / 2, 9, 0);
      edit.commit_step();
    }
    if (edit.undo_steps() + 1 > states.size()) states.push_back(now());
  }
  ASSERT_GT(states.size(), 30u);
  for (std::size_t n = states.size() - 1; n-- > 0;) {
    ASSERT_TRUE(edit.undo());
    ASSERT_EQ(edit.labels().values, states[n].values) << n;
    ASSERT_EQ(now().names, states[n].names) << n;
    expect_books_kept(edit);
  }
  EXPECT_FALSE(edit.undo());
  EXPECT_FALSE(edit.is_changed());
  for (std::size_t n = 1; n < states.size(); ++n) {
    ASSERT_TRUE(edit.redo());
    ASSERT_EQ(edit.labels().values, states[n].values) << n;
    ASSERT_EQ(now().names, states[n].names) << n;
  }
}

TEST(LabelEdit, ANewStepForgetsWhatWasUndone) {
  LabelEdit edit = begun();
  (void)edit.add();
  (void)edit.add();
  edit.undo();
  EXPECT_EQ(edit.redo_steps(), 1u);
  (void)edit.add("ulna");
  EXPECT_EQ(edit.redo_steps(), 0u);
}

TEST(LabelEdit, HistoryKeepsWithinItsMemory) {
  constexpr std::size_t kBytes = 4000;
  LabelEdit edit = begun(kBytes);
  const std::uint16_t label = edit.add("lunate").value();
  for (std::size_t n = 0; n < 200; ++n) {
    edit.begin_step("Paint");
    edit.set(n, 1, label);
    edit.commit_step();
    EXPECT_LE(edit.history_bytes(), kBytes);
  }
  EXPECT_GT(edit.undo_steps(), 5u);
  EXPECT_LT(edit.undo_steps(), 100u);
  while (edit.undo()) {
  }
  EXPECT_TRUE(edit.is_changed()) << "the first state cannot be reached any more";
}

// A solid block of a scan costs a run a row, not its voxels.
TEST(LabelEdit, AStepHoldsRunsNotVoxels) {
  LabelEdit edit = begun();
  const std::uint16_t label = edit.add("lunate").value();
  const std::size_t before = edit.history_bytes();
  edit.begin_step("Paint");
  edit.set(0, edit.labels().values.size(), label);
  edit.commit_step();
  EXPECT_LT(edit.history_bytes() - before, 200u);
}

TEST(LabelEdit, KnowsWhatIsSaved) {
  LabelEdit edit = begun();
  (void)edit.add("lunate");
  EXPECT_TRUE(edit.is_changed());
  edit.mark_saved();
  EXPECT_FALSE(edit.is_changed());
  (void)edit.add("ulna");
  EXPECT_TRUE(edit.is_changed());
  edit.undo();
  EXPECT_FALSE(edit.is_changed());
  edit.undo();
  EXPECT_TRUE(edit.is_changed());
}

TEST(LabelEdit, OtherLabelsComeInOneStepOrNotAtAll) {
  LabelEdit edit = begun();
  const std::uint16_t old = edit.add("old").value();
  edit.begin_step("Paint");
  edit.set(0, 9, old);
  edit.commit_step();
  LabelVolume labels{small_frame(), std::vector<std::uint16_t>(small_frame().count(), 0)};
  std::fill_n(labels.values.begin() + 4, 20, std::uint16_t{7});
  EXPECT_FALSE(edit.replace(labels, {}, "Find")) << "a label without a name";
  EXPECT_FALSE(edit.replace(labels, {{7, "a"}, {8, "a"}}, "Find")) << "a name for two";
  LabelVolume other = labels;
  other.frame.size = {3, 3, 3};
  EXPECT_FALSE(edit.replace(other, {{7, "a"}}, "Find"));
  EXPECT_EQ(edit.bones().at(old).voxels, 9u);
  ASSERT_TRUE(edit.replace(labels, {{7, "capitate"}}, "Find"));
  EXPECT_EQ(edit.labels().values, labels.values);
  EXPECT_FALSE(edit.has(old));
  expect_books_kept(edit);
  ASSERT_TRUE(edit.undo());
  EXPECT_EQ(edit.bones().at(old).voxels, 9u);
  EXPECT_EQ(edit.bones().size(), 1u);
  expect_books_kept(edit);
}

}  // namespace
}  // namespace osteon
