#include "osteon/scene/event.h"

#include <gtest/gtest.h>

#include <set>

namespace osteon {
namespace {

TEST(Event, AKindHasOneNameAndIsFoundByItAndByItsCode) {
  std::set<std::string_view> names;
  EventKind last = EventKind::kNone;
  for (const EventKindRow& row : event_table()) {
    EXPECT_LT(last, row.kind) << row.name;
    last = row.kind;
    EXPECT_TRUE(names.insert(row.name).second) << row.name;
    EXPECT_EQ(find_event_kind(row.kind), &row);
    EXPECT_EQ(find_event_kind(row.name), &row);
  }
  EXPECT_EQ(find_event_kind(EventKind::kNone), nullptr);
  EXPECT_EQ(find_event_kind("nothing of the kind"), nullptr);
}

// Files keep the codes: a change here is a new format.
TEST(Event, CodesStayAsTheyAre) {
  const std::pair<const char*, int> codes[] = {{"contact_begin", 1},   {"contact_end", 2},
                                               {"force_over", 3},      {"force_under", 4},
                                               {"structure_seen", 10}, {"structure_entered", 11},
                                               {"structure_left", 12}, {"instrument_taken", 20},
                                               {"powered", 21},        {"portal_entered", 22},
                                               {"portal_left", 23},    {"mark", 30},
                                               {"restored", 31},       {"fault", 40}};
  for (const auto& [name, code] : codes) {
    const EventKindRow* row = find_event_kind(name);
    ASSERT_NE(row, nullptr) << name;
    EXPECT_EQ(static_cast<int>(row->kind), code) << name;
  }
}

TEST(Event, IsEqualWhenAllOfItIs) {
  Event a{7, EventKind::kMark, 1, SubjectKind::kMark, 3, Vec3::Zero(), {}};
  Event b = a;
  EXPECT_EQ(a, b);
  b.p_W.x() = 1e-9;
  EXPECT_FALSE(a == b);
}

}  // namespace
}  // namespace osteon
