// A session's shafts in the holes of the skin: events, report, recording, and going back.
#include <gtest/gtest.h>

#include <algorithm>

#include "count_allocations.h"
#include "session_fixtures.h"

#include "osteon/base/turn.h"

namespace osteon {
namespace {

using testing::kBoxHalf;

constexpr double kSkin_m = 0.03;

// The portal stands straight above a corner of the box, so that inwards is down.
std::shared_ptr<const Case> box_under_portal() {
  CaseDef def;
  def.name = "box under a portal";
  BoneDef bone;
  bone.name = "block";
  bone.mesh = testing::box_mesh(kBoxHalf);
  def.bones.push_back(bone);
  def.landmarks.push_back({"portal_a", {kBoxHalf.x(), kBoxHalf.y(), kSkin_m}});
  def.landmarks.push_back({"portal_b", {-kBoxHalf.x(), -kBoxHalf.y(), kSkin_m}});
  auto built = build_case(std::move(def));
  return std::make_shared<const Case>(std::move(*built));
}

Tool shaft(double radius_m) {
  Tool tool;
  tool.name = "shaft";
  tool.shaft = {Vec3(0, 0, 0.001), Vec3(0, 0, 0.15), radius_m};
  tool.parts.push_back(make_rod(Vec3::Zero(), Vec3::Zero(), radius_m));
  tool.parts.push_back(make_rod(tool.shaft.p0, tool.shaft.p1, radius_m));
  return tool;
}

Tray probe_and_shaft(double radius_m = 0.001) {
  return {std::make_shared<const Tool>(make_wrist_probe()),
          std::make_shared<const Tool>(shaft(radius_m))};
}

SessionSettings settings_of_two() {
  SessionSettings settings = testing::moving_bones();
  settings.hands = {{"left", 1}, {"right", 0}};
  settings.tray = {"wrist_probe", "shaft"};
  return settings;
}

// Down through portal a in half a second, half a second within while it is pulled sideways, and
// out.
ToolInput in_and_out(std::uint64_t n) {
  const double t = static_cast<double>(n) * 0.001;
  const double down = std::clamp(t / 0.5, 0.0, 1.0) - std::clamp((t - 1.0) / 0.5, 0.0, 1.0);
  ToolInput input;
  input.X_WD.p = {kBoxHalf.x() + 0.003 * down * std::sin(12 * t), kBoxHalf.y(),
                  0.04 - 0.025 * down};
  return input;
}

std::array<HandInput, 2> both_hands(std::uint64_t n) {
  std::array<HandInput, 2> hands;
  hands[0].input = in_and_out(n);
  hands[1].input.X_WD.p = {-0.05, 0, 0.05};
  return hands;
}

// The left hand lets its shaft go within the portal, takes it again, and the world goes back.
std::array<HandInput, 2> with_exchanges(std::uint64_t n) {
  std::array<HandInput, 2> hands = both_hands(n);
  if (n == 600) hands[0].command = {CommandKind::kTake, 0};
  if (n == 700) hands[0].command = {CommandKind::kTake, 1};
  if (n == 450) hands[1].command = {CommandKind::kTake, 1};
  if (n == 300) hands[0].command = hands[1].command = {CommandKind::kMark, 1};
  if (n == 900) hands[0].command = hands[1].command = {CommandKind::kRestore, 1};
  return hands;
}

Recording record(const std::shared_ptr<const Case>& the_case, std::uint64_t ticks,
                 std::uint64_t* hash = nullptr) {
  const SessionSettings settings = settings_of_two();
  Session session(the_case, settings, probe_and_shaft());
  Recording recording;
  recording.header = recording_header(*the_case, settings, "test", "0", session.tray());
  recording.more_hands.resize(1);
  for (std::uint64_t n = 1; n <= ticks; ++n) {
    (void)session.tick(with_exchanges(n));
    for (std::size_t h = 0; h < 2; ++h) {
      recording.ticks_of(h).push_back(session.last_tick_record(h));
      for (const Event& event : session.last_events(h)) recording.events.push_back(event);
    }
    if (session.last_steps() > 0) recording.steps.push_back(session.last_step_record());
    if (n % 250 == 0)
      recording.states.push_back({{n, n, 0, 0}, session.bones().step, to_bytes(session.save())});
  }
  recording.complete = true;
  if (hash) *hash = session.state_hash();
  return recording;
}

TEST(SessionPortals, AreThoseThatTheSettingsName) {
  const auto the_case = box_under_portal();
  SessionSettings settings = settings_of_two();
  EXPECT_EQ(open_portals(*the_case, settings)->size(), 2u);
  settings.portals = {"B"};
  ASSERT_EQ(open_portals(*the_case, settings)->size(), 1u);
  EXPECT_EQ(open_portals(*the_case, settings)->front().name, "portal_b");
  settings.portals = {};
  EXPECT_TRUE(open_portals(*the_case, settings)->empty());
  settings.portals = {"portal_a", "6R"};
  const auto wrong = open_portals(*the_case, settings);
  ASSERT_FALSE(wrong);
  EXPECT_NE(wrong.error().message().find("6R"), std::string::npos);
  EXPECT_NE(wrong.error().message().find("A, B"), std::string::npos);
}

TEST(SessionPortals, EnteringAndLeavingAreEventsAndTheReportHasTheTime) {
  const auto the_case = box_under_portal();
  Session session(the_case, settings_of_two(), probe_and_shaft());
  ReportBuilder report(*the_case, 0.001, session.portals());
  std::vector<Event> events;
  for (std::uint64_t n = 1; n <= 1600; ++n) {
    (void)session.tick(both_hands(n));
    report.add(session.tool_state(0));
    for (std::size_t h = 0; h < 2; ++h)
      for (const Event& event : session.last_events(h))
        if (event.subject_kind == SubjectKind::kPortal) events.push_back(event);
  }
  ASSERT_EQ(events.size(), 2u);
  EXPECT_EQ(events[0].kind, EventKind::kPortalEntered);
  EXPECT_EQ(events[1].kind, EventKind::kPortalLeft);
  for (const Event& event : events) {
    EXPECT_EQ(event.hand, 0);
    EXPECT_EQ(event.subject, 0u);
  }
  EXPECT_GT(events[0].values[0], 0);  // mm within
  EXPECT_LT(events[0].values[0], 0.2);
  // The tip is 1 mm above the tool's origin: it passes the skin at 0.22 s, and is 0.5 mm out of it
  // at 1.29 s; 80 ms later it counts as out.
  EXPECT_NEAR(static_cast<double>(events[0].tick) * 0.001, 0.22, 0.02);
  EXPECT_NEAR(static_cast<double>(events[1].tick) * 0.001, 1.37, 0.02);
  const Report done = report.finish();
  ASSERT_EQ(done.portals.size(), 2u);
  EXPECT_EQ(done.portals[0].times_entered, 1u);
  EXPECT_EQ(done.portals[1].times_entered, 0u);
  EXPECT_NEAR(done.portals[0].time_s, static_cast<double>(events[1].tick - events[0].tick) * 0.001,
              1e-9);
  EXPECT_NE(to_json(done).find("\"portal_a\""), std::string::npos);
}

TEST(SessionPortals, AClosedOneIsNotFelt) {
  SessionSettings settings = settings_of_two();
  settings.portals = {"portal_b"};
  Session session(box_under_portal(), settings, probe_and_shaft());
  for (std::uint64_t n = 1; n <= 800; ++n) {
    (void)session.tick(both_hands(n));
    ASSERT_EQ(session.tool_state(0).portal, kNoPortal) << n;
  }
}

TEST(SessionPortals, AReplayFromAnyStateHasTheSameBits) {
  const auto the_case = box_under_portal();
  std::uint64_t hash = 0;
  const Recording recording = record(the_case, 1600, &hash);
  const auto in_portal =
      std::count_if(recording.events.begin(), recording.events.end(),
                    [](const Event& event) { return event.kind == EventKind::kPortalEntered; });
  ASSERT_GE(in_portal, 2) << "the shaft that is taken within the portal is in it again";
  ReplayOptions options;
  options.tray = probe_and_shaft();
  for (const double from_s : {0.0, 0.25, 0.5, 0.75, 1.0, 1.25}) {
    options.from_s = from_s;
    const auto outcome = replay(recording, the_case, options);
    ASSERT_TRUE(outcome) << outcome.error().message();
    EXPECT_TRUE(outcome->identical) << from_s << " " << outcome->first_different_tick;
    EXPECT_EQ(outcome->first_tick, static_cast<std::uint64_t>(from_s * 1000 + 1));
    EXPECT_EQ(outcome->state_hash, hash);
  }
}

// Two portals 10 mm apart.
std::shared_ptr<const Case> box_under_near_portals() {
  CaseDef def;
  def.name = "box under near portals";
  BoneDef bone;
  bone.name = "block";
  bone.mesh = testing::box_mesh(kBoxHalf);
  def.bones.push_back(bone);
  def.landmarks.push_back({"portal_a", {0.005, 0, kSkin_m}});
  def.landmarks.push_back({"portal_b", {-0.005, 0, kSkin_m}});
  auto built = build_case(std::move(def));
  return std::make_shared<const Case>(std::move(*built));
}

// Down through portal a; then the tip goes to between both, and the device turns so that the shaft,
// if it went as the device is turned, would pass portal b.
ToolInput turned_towards_b(std::uint64_t n) {
  const double t = static_cast<double>(n) * 0.001;
  const double down = std::clamp(t / 0.4, 0.0, 1.0), over = std::clamp((t - 0.4) / 0.4, 0.0, 1.0);
  ToolInput input;
  input.X_WD.p = {(1 - over) * 0.005, 0, 0.04 - 0.024 * down};
  const Vec3 to_b = Vec3(-0.005, 0, kSkin_m) - input.X_WD.p;
  input.X_WD.q = Quat::Identity().slerp(over, turn_between(Vec3::UnitZ(), to_b));
  return input;
}

// Undo, another instrument, the same again: the shaft is where it was, in portal a, and turned so
// that it passes there, however the device is turned.
TEST(SessionPortals, AShaftStaysInItsPortalOverUndoAndExchange) {
  const Tray tray = {std::make_shared<const Tool>(shaft(0.001)),
                     std::make_shared<const Tool>(shaft(0.0015))};
  SessionSettings settings = testing::moving_bones();
  settings.tray = {"thin", "thick"};
  Session session(box_under_near_portals(), settings, tray);
  std::vector<Event> events;
  double worst_m = 0;
  for (std::uint64_t n = 1; n <= 1600; ++n) {
    Command command;
    if (n == 850) command = {CommandKind::kMark, 0};
    if (n == 900) command = {CommandKind::kRestore, 0};
    if (n == 1100) command = {CommandKind::kTake, 1};
    if (n == 1300) command = {CommandKind::kTake, 0};
    const ToolState& tool = session.tick(turned_towards_b(n), command);
    for (const Event& event : session.last_events())
      if (event.subject_kind == SubjectKind::kPortal) events.push_back(event);
    if (n < 850) continue;
    ASSERT_EQ(tool.portal, 0u) << n;
    const Vec3 along_W = tool.X_WP.rotate(Vec3::UnitZ());
    const Vec3 to_W = session.portals()[0].p_W - tool.X_WP.p;
    const double off_m = (to_W - to_W.dot(along_W) * along_W).norm();
    worst_m = std::max(worst_m, off_m);
  }
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].kind, EventKind::kPortalEntered);
  EXPECT_LT(worst_m, 0.001);
}

TEST(SessionPortals, AReplayNeedsTheSameInstrumentsAndPortals) {
  const auto the_case = box_under_portal();
  Recording recording = record(the_case, 100);
  const auto says = [&](const Tray& tray) {
    ReplayOptions options;
    options.tray = tray;
    const auto outcome = replay(recording, the_case, options);
    return outcome ? std::string() : outcome.error().message();
  };
  EXPECT_EQ(says(probe_and_shaft()), "");
  EXPECT_NE(says({}).find("2 instruments"), std::string::npos);
  EXPECT_NE(says(probe_and_shaft(0.0011)).find("instruments"), std::string::npos);
  recording.header.portals_hash ^= 1;
  EXPECT_NE(says(probe_and_shaft()).find("portals"), std::string::npos);
}

TEST(SessionPortals, AStateWithAPortalThatThereIsNotIsRefused) {
  Session session(box_under_portal(), settings_of_two(), probe_and_shaft());
  SessionState state = session.save();
  EXPECT_TRUE(session.restore(state));
  state.hands[0].haptic.portal.portal = 2;
  EXPECT_FALSE(session.restore(state));
  state = session.save();
  state.hands[1].haptic.portal.nearest = 7;
  EXPECT_FALSE(session.restore(state));
}

TEST(SessionPortals, EnteringExchangeAndLeavingAllocateNothing) {
  Session session(box_under_portal(), settings_of_two(), probe_and_shaft());
  (void)session.tick(with_exchanges(1));
  const auto before = testing::allocations();
  for (std::uint64_t n = 2; n <= 1600; ++n) (void)session.tick(with_exchanges(n));
  EXPECT_EQ(testing::allocations(), before);
}

}  // namespace
}  // namespace osteon
