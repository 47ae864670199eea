#include "commands/recordings/record_names.h"

#include <gtest/gtest.h>

#include "osteon/record/recording.h"

namespace osteon {
namespace {

TEST(RecordNames, HandsAreCalledAsTheSettingsCallThemAndNoHandHasNoName) {
  RecordingHeader header;
  header.hands = 3;
  header.settings_json = R"({"hands": [{"name": "scope"}, {"name": ""}, {}]})";
  const RecordNames names(header);
  EXPECT_EQ(names.hand(0), "scope");
  EXPECT_EQ(names.hand(1), "hand_2");
  EXPECT_EQ(names.hand(2), "hand_3");
  EXPECT_EQ(names.hand(7), "hand_8") << "more than there are";
  EXPECT_EQ(names.hand(kNoHand), "");
}

TEST(RecordNames, SettingsThatAreNoneNameNothing) {
  RecordingHeader header;
  header.settings_json = "[";
  header.names_json = "{";
  const RecordNames names(header);
  EXPECT_EQ(names.hand(0), "hand_1");
  Event event;
  EXPECT_EQ(names.subject(event), "");
  event.subject_kind = SubjectKind::kSoftPart;
  event.subject = 4;
  EXPECT_EQ(names.subject(event), "4");
}

}  // namespace
}  // namespace osteon
