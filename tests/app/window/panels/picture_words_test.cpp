#include "window/panels/picture_words.h"

#include <gtest/gtest.h>

#include "app/ui/ui_frame.h"

namespace osteon {
namespace {

bool cover(const UiRect& a, const UiRect& b) {
  return a.x < b.right() && b.x < a.right() && a.y < b.bottom() && b.y < a.bottom();
}

/// What a panel is given, between two frames.
struct Words {
  explicit Words(test::UiFrame& frame) : ui(frame) { ImGui::NewFrame(); }
  ~Words() { ImGui::Render(); }
  test::UiFrame& ui;
  UiLayout layout = make_layout(1280, 720, 1, true);
  UiRequests requests;
  PanelContext c{ui.model, ui.fonts(), layout, requests};
};

UiModel three_bones() {
  UiModel model = test::small_model();
  model.width = 1280;
  model.height = 720;
  return model;
}

TEST(PictureWords, NothingToSayIsNothing) {
  test::UiFrame ui;
  ui.model = three_bones();
  const Words words(ui);
  EXPECT_TRUE(note_words(words.c).empty());
  EXPECT_TRUE(name_words(words.c).empty());
}

// A note on a bone stands at its middle, and so does the bone's name.
TEST(PictureWords, NamesKeepOffNotesAndTheDistanceAtTheTip) {
  test::UiFrame ui;
  ui.model = three_bones();
  ui.model.notes.rows = {{"Look here", "Lunate", true, 600, 300},
                         {"And here", "", true, 610, 302},
                         {"Not drawn", "", false, 600, 300}};
  ui.model.hands.names = {{BoneId{0}, 604, 318}, {BoneId{1}, 600, 300}, {BoneId{2}, 420, 204}};
  ui.model.hands.tip = {true, 12.3, BoneId{0}, {}, true, 380, 180, 400, 200};
  const Words words(ui);
  const auto notes = note_words(words.c), names = name_words(words.c);
  ASSERT_EQ(notes.size(), 2u);
  ASSERT_EQ(names.size(), 3u);
  EXPECT_EQ(names[1].text, "Lunate");
  EXPECT_FALSE(cover(notes[0].at, notes[1].at));
  for (const PictureWords& name : names) {
    for (const PictureWords& note : notes) EXPECT_FALSE(cover(name.at, note.at)) << name.text;
    EXPECT_FALSE(cover(name.at, {597, 297, 6, 6})) << name.text << " lies over the note's dot";
    EXPECT_FALSE(cover(name.at, tip_words(words.c).at)) << name.text;
  }
}

TEST(PictureWords, NoneIsDrawnUnderACard) {
  test::UiFrame ui;
  ui.model = three_bones();
  const float edge = make_layout(1280, 720, 1, true).right.x;
  ui.model.notes.rows = {{"At the right", "", true, edge - 20, 300}, {"Under", "", true, 30, 300}};
  ui.model.hands.names = {{BoneId{0}, 20, 300}, {BoneId{1}, 600, 300}, {BoneId{2}, edge, 200}};
  {
    const Words words(ui);
    const auto notes = note_words(words.c), names = name_words(words.c);
    ASSERT_EQ(notes.size(), 2u);
    EXPECT_EQ(notes[0].text, "At the right");
    EXPECT_LT(notes[0].at.right(), edge - 20) << "on the other side of its dot";
    EXPECT_EQ(notes[1].text, "");
    EXPECT_EQ(names[0].text, "");
    EXPECT_EQ(names[1].text, "Lunate");
    EXPECT_EQ(names[2].text, "");
  }
  ui.model.panels_open = false;
  const Words words(ui);
  EXPECT_EQ(name_words(words.c)[2].text, "Capitate") << "the cards are folded away";
}

}  // namespace
}  // namespace osteon
