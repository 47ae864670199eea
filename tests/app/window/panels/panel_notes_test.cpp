#include <gtest/gtest.h>

#include "app/ui/ui_frame.h"

namespace osteon {
namespace {

UiModel noted_model(const test::UiFrame& ui) {
  UiModel model = test::small_model();
  model.width = ui.model.width;
  model.height = ui.model.height;
  model.notes.can_edit = true;
  model.notes.rows = {{"Look here", "Scaphoid", true, 600, 300}, {"And here", "", false, 0, 0}};
  return model;
}

TEST(PanelNotes, OneIsAddedByAClickThatIsWaitedFor) {
  test::UiFrame ui;
  ui.model = noted_model(ui);
  const ImVec2 button = ui.find("##case", {"notes", "Add a note"});
  ASSERT_GE(button.x, 0);
  EXPECT_TRUE(ui.click(button).notes.add);
  ui.model.notes.placing = true;
  EXPECT_LT(ui.find("##case", {"notes", "Add a note"}).x, 0);
  EXPECT_TRUE(ui.click(ui.find("##case", {"notes", "Cancel"})).notes.stop_placing);
}

TEST(PanelNotes, NothingIsChangedWhileTheCaseIsNeededAsItIs) {
  test::UiFrame ui;
  ui.model = noted_model(ui);
  ui.model.notes.can_edit = false;
  const ImVec2 button = ui.find("##case", {"notes", "Add a note"});
  ASSERT_GE(button.x, 0);
  EXPECT_FALSE(ui.click(button).notes.add);
}

TEST(PanelNotes, ABuiltInCaseIsSavedAsANewOne) {
  test::UiFrame ui;
  ui.model = noted_model(ui);
  EXPECT_LT(ui.find("##case", {"notes", "Save as a case"}).x, 0);
  ui.model.notes.saves_itself = false;
  ui.model.notes.changed = true;
  EXPECT_TRUE(ui.click(ui.find("##case", {"notes", "Save as a case"})).notes.save);
}

}  // namespace
}  // namespace osteon
