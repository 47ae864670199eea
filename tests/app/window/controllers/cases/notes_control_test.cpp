#include "window/controllers/cases/notes_control.h"

#include <gtest/gtest.h>
#include <unistd.h>

namespace osteon {
namespace {

namespace fs = std::filesystem;

// The control without its window: what it keeps is read back from the case's folder.
class NotesControlTest : public ::testing::Test {
 protected:
  void SetUp() override {
    for (const char* name : {"a", "b"}) fs::create_directories(folder(name));
    ASSERT_TRUE(save_notes(three(), folder("a")));
    open("a");
  }
  void TearDown() override { fs::remove_all(dir_); }

  fs::path folder(const std::string& name) const { return dir_ / name; }
  void open(const std::string& name) {
    scene_.source = folder(name).string();
    notes_.begin_case();
  }
  static CaseNotes three() {
    return {{"one", "", Vec3(0.001, 0, 0)},
            {"two", "", Vec3(0, 0.002, 0)},
            {"three", "", Vec3(0, 0, 0.003)}};
  }
  CaseNotes kept(const std::string& name = "a") const {
    const auto read = load_notes(folder(name));
    EXPECT_TRUE(read);
    return read ? *read : CaseNotes();
  }
  void edit(std::size_t which, const std::string& text, bool may_edit = true) {
    NotesRequests begin;
    begin.edit = which;
    notes_.apply(begin, may_edit);
    NotesRequests typed;
    typed.text = text;
    notes_.apply(typed, may_edit);
  }
  void remove(std::size_t which, bool may_edit = true) {
    NotesRequests requests;
    requests.remove = which;
    notes_.apply(requests, may_edit);
  }

  fs::path dir_ = fs::temp_directory_path() / ("osteon_notes_" + std::to_string(::getpid()));
  WindowHost host_{WindowOrder{}};
  ShownCase scene_;
  SceneSight sight_{host_, scene_};
  LiveControl live_{host_, scene_, sight_};
  ReplayControl replay_{host_, sight_};
  CaseControl cases_{host_, scene_, sight_, live_, replay_};
  NotesControl notes_{host_, scene_, sight_, live_, cases_};
};

TEST_F(NotesControlTest, NothingAskedForChangesNothing) {
  notes_.apply({}, true);
  NotesRequests text;
  text.text = "of none that is being edited";
  notes_.apply(text, true);
  remove(3);
  edit(3, "there is no fourth");
  EXPECT_EQ(kept(), three());
}

TEST_F(NotesControlTest, ATextThatWasTypedIsKeptInTheCasesFolderAtOnce) {
  edit(1, "a crack");
  CaseNotes wanted = three();
  wanted[1].text = "a crack";
  EXPECT_EQ(kept(), wanted);
}

TEST_F(NotesControlTest, ATextThatIsNoneIsRefusedInWordsAndTheOldOneStays) {
  for (const std::string& bad : {std::string(), std::string(kLongestNote + 1, 'x'),
                                 std::string("two\nlines"), std::string("\xff")}) {
    edit(1, bad);
    EXPECT_EQ(kept(), three());
  }
  ASSERT_FALSE(host_.toasts.shown().empty());
  EXPECT_EQ(host_.toasts.shown()[0].kind, ToastKind::kWarning);
}

TEST_F(NotesControlTest, ARemovedNoteLeavesTheOthersAndNoTextGoesToAnother) {
  NotesRequests begin;
  begin.edit = 0;
  notes_.apply(begin, true);
  remove(0);
  NotesRequests typed;
  typed.text = "for the one that is gone";
  notes_.apply(typed, true);
  EXPECT_EQ(kept(), (CaseNotes{three()[1], three()[2]}));
}

TEST_F(NotesControlTest, WhereNothingMayBeEditedNothingIs) {
  edit(1, "a crack", false);
  remove(0, false);
  EXPECT_EQ(kept(), three());
}

TEST_F(NotesControlTest, AnotherCaseHasItsOwnNotes) {
  open("b");
  edit(0, "of the other case");
  remove(0);
  EXPECT_TRUE(kept("b").empty());
  EXPECT_EQ(kept("a"), three());
}

// A click goes to the camera unless a note is being placed.
TEST_F(NotesControlTest, WithNoPlacingOrOverPanelsAClickIsNoNotesPlace) {
  SceneInput click;
  click.left = true;
  EXPECT_FALSE(notes_.poll_pointer(click));
  NotesRequests add;
  add.add = true;
  notes_.apply(add, true);
  click.over_panels = true;
  EXPECT_FALSE(notes_.poll_pointer(click));
  notes_.stop_placing();
  click.over_panels = false;
  EXPECT_FALSE(notes_.poll_pointer(click));
  EXPECT_EQ(kept(), three());
}

TEST_F(NotesControlTest, AFolderThatCannotBeReadIsToldAndShowsNone) {
  fs::create_directories(folder("b") / "notes.toml");
  open("b");
  ASSERT_FALSE(host_.toasts.shown().empty());
  EXPECT_EQ(kept("a"), three());
}

}  // namespace
}  // namespace osteon
