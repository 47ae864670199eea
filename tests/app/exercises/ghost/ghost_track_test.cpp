#include "exercises/ghost/ghost_track.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace osteon {
namespace {

// Two stages: the first has a goal of two bones, the second a goal about the hand itself.
ScenarioState state_at(std::uint32_t stage, char first = 0, char second = 0) {
  ScenarioState state;
  state.stage = stage;
  state.completed_s = {-1, -1};
  if (stage == 0) state.goals = {{{first, second}, first != 0 && second != 0}};
  if (stage == 1) state.goals = {{{}, false}};
  return state;
}

// The tip moves along x by 1 mm each tick of 1 ms; the second bone is done first, at 100 ms, the
// first at 300 ms, the second stage at 500 ms.
GhostTrack sample_track() {
  GhostTrackMaker maker(0.001);
  for (std::uint64_t tick = 1; tick <= 600; ++tick) {
    ToolState tool;
    tool.tick = tick;
    tool.X_WP.p = Vec3(1e-3 * static_cast<double>(tick), 0, 0);
    tool.instrument = 1;
    const ToolState* const tools[] = {&tool};
    maker.add(tools, tick < 100   ? state_at(0)
                     : tick < 300 ? state_at(0, 0, 1)
                     : tick < 500 ? state_at(1)
                                  : state_at(2));
  }
  return maker.finish({"wrist_probe", "hook_probe"});
}

TEST(GhostTrack, IsCutWhereSomethingBecameDone) {
  const GhostTrack track = sample_track();
  ASSERT_EQ(track.hands.size(), 1u);
  // The first tick, then every twentieth.
  EXPECT_EQ(track.hands[0].size(), 31u);
  ASSERT_EQ(track.stretches.size(), 3u);
  EXPECT_EQ(track.stretches[0].done, (std::vector<GoalPart>{{0, 1}}));
  EXPECT_EQ(track.stretches[1].done, (std::vector<GoalPart>{{0, 0}}));
  EXPECT_EQ(track.stretches[2].done, (std::vector<GoalPart>{{0, 0}}));
  EXPECT_EQ(track.stretches[2].stage, 1u);
  for (std::size_t i = 1; i < 3; ++i)
    EXPECT_EQ(track.stretches[i].from, track.stretches[i - 1].to) << "no gap, no jump";
  EXPECT_NEAR(track.hands[0][track.stretches[0].to].X_WT.p.x(), 0.100, 1e-12);
  EXPECT_NEAR(track.hands[0][track.stretches[1].to].X_WT.p.x(), 0.300, 1e-12);
  EXPECT_NEAR(track.hands[0][track.stretches[2].to].X_WT.p.x(), 0.500, 1e-12);
}

TEST(GhostTrack, LeadsAlongTheNearestPlaceOfItsStretch) {
  const GhostTrack track = sample_track();
  std::size_t at = 0;
  GuideLine line = guide_along(track, 1, 0, Vec3(0.103, 0.004, 0), at);
  ASSERT_TRUE(line.on);
  EXPECT_EQ(line.strength, 1);
  EXPECT_NEAR((line.along_W - Vec3(1, 0, 0)).norm(), 0, 1e-12);
  EXPECT_NEAR(line.p_W.y(), 0, 1e-12);
  EXPECT_NEAR(line.p_W.x(), 0.103, 0.0101) << "a sample each 20 mm";
  // Farther than it looks ahead: it goes along as it is led, not across to where the way comes by.
  const std::size_t before = at;
  line = guide_along(track, 1, 0, Vec3(0.290, 0, 0), at);
  EXPECT_LE(at, before + 1);
  EXPECT_LT(line.p_W.x(), 0.150);
  for (int i = 0; i < 20; ++i) line = guide_along(track, 1, 0, Vec3(0.290, 0, 0), at);
  EXPECT_NEAR(line.p_W.x(), 0.290, 0.0101);
}

TEST(GhostTrack, LeadsNobodyWhereThereIsNoWay) {
  GhostTrack track = sample_track();
  std::size_t at = 7;
  EXPECT_FALSE(guide_along(GhostTrack{}, 0, 0, Vec3::Zero(), at).on);
  EXPECT_FALSE(guide_along(track, 3, 0, Vec3::Zero(), at).on);
  EXPECT_FALSE(guide_along(track, 0, 1, Vec3::Zero(), at).on);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(guide_along(track, 0, 0, Vec3(nan, 0, 0), at).on);
  for (auto& sample : track.hands[0]) sample.X_WT.p.x() = nan;
  EXPECT_FALSE(guide_along(track, 0, 0, Vec3::Zero(), at).on);
}

// An expert who stays at a place for seconds does not hold the learner there.
TEST(GhostTrack, AStayOfTheExpertsHasNoLength) {
  GhostTrack track;
  track.hands.resize(1);
  const auto add = [&](double x) {
    track.hands[0].push_back({{Vec3(x, 0, 0), Quat::Identity()}, 0});
  };
  for (int i = 0; i < 10; ++i) add(0.001 * i);
  for (int i = 0; i < 500; ++i) add(0.009);
  for (int i = 0; i < 10; ++i) add(0.009 + 0.001 * i);
  track.stretches = {{0, {}, 0, track.hands[0].size() - 1}};
  std::size_t at = 0;
  guide_along(track, 0, 0, Vec3(0.009, 0, 0), at);
  const GuideLine line = guide_along(track, 0, 0, Vec3(0.014, 0.001, 0), at);
  EXPECT_NEAR(line.p_W.x(), 0.014, 1e-12);
  // Where it only stays there is no direction: the place itself is the way.
  track.hands[0].assign(50, {{Vec3(0.009, 0, 0), Quat::Identity()}, 0});
  track.stretches = {{0, {}, 0, 49}};
  at = 0;
  EXPECT_EQ(guide_along(track, 0, 0, Vec3::Zero(), at).along_W, Vec3::Zero());
}

TEST(GhostTrack, TheNextStepIsTheExpertsFirstThatIsLeft) {
  const GhostTrack track = sample_track();
  EXPECT_EQ(next_stretch(track, state_at(0)), 0u);
  EXPECT_EQ(next_stretch(track, state_at(0, 0, 1)), 1u);
  EXPECT_EQ(next_stretch(track, state_at(0, 1, 0)), 0u) << "in another order than the expert's";
  EXPECT_EQ(next_stretch(track, state_at(1)), 2u);
  EXPECT_EQ(next_stretch(track, state_at(2)), std::nullopt);
  EXPECT_EQ(next_stretch(GhostTrack{}, state_at(0)), std::nullopt);
  EXPECT_EQ(stretches_left(track, state_at(0)), (std::vector<std::size_t>{0, 1}));
  EXPECT_EQ(stretches_left(track, state_at(0, 0, 1)), std::vector<std::size_t>{1});
  EXPECT_TRUE(stretches_left(track, state_at(2)).empty());
}

TEST(GhostTrack, MovesAsTheExpertDidRestsAndBeginsAgain) {
  const GhostTrack track = sample_track();
  const auto x = [&](double since_s) { return ghost_at(track, 1, 0, since_s)->X_WT.p.x(); };
  EXPECT_NEAR(x(0), 0.100, 1e-12);
  EXPECT_NEAR(x(0.05), 0.150, 1e-12) << "between two samples";
  EXPECT_NEAR(x(0.2), 0.300, 1e-12);
  EXPECT_NEAR(x(0.2 + 0.9 * kGhostRest_s), 0.300, 1e-12) << "rests";
  EXPECT_NEAR(x(0.2 + kGhostRest_s + 0.05), 0.150, 1e-9) << "again";
  EXPECT_NEAR(x(-3), 0.100, 1e-12);
  EXPECT_EQ(ghost_at(track, 1, 0, 0)->instrument, 1u);
  EXPECT_FALSE(ghost_at(track, 3, 0, 0));
  EXPECT_FALSE(ghost_at(track, 0, 1, 0));
  EXPECT_FALSE(ghost_at(track, 0, 0, std::nan("")));
  GhostTrack lost = track;
  lost.hands[0][0].X_WT.p.y() = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(ghost_at(lost, 0, 0, 0));
}

TEST(GhostTrack, TellsHowAnInstrumentIsHeldNearATip) {
  GhostTrack track = sample_track();
  const std::size_t of = 1;  // from 100 to 300 mm
  for (auto& sample : track.hands[0])
    sample.X_WT.q = Quat(Eigen::AngleAxisd(sample.X_WT.p.x(), Vec3::UnitY()));
  const auto held = ghost_beside(track, of, 0, 1, Vec3(0.2, 0.05, 0));
  ASSERT_TRUE(held);
  EXPECT_NEAR(held->p.x(), 0.2, 1e-9);
  EXPECT_NEAR(held->q.angularDistance(Quat(Eigen::AngleAxisd(0.2, Vec3::UnitY()))), 0, 1e-9);
  EXPECT_NEAR(ghost_beside(track, of, 0, 1, Vec3(0.9, 0, 0))->p.x(), 0.3, 1e-9) << "its end";
  EXPECT_FALSE(ghost_beside(track, of, 0, 0, Vec3::Zero())) << "another instrument";
  EXPECT_FALSE(ghost_beside(track, of, 1, 1, Vec3::Zero()));
  EXPECT_FALSE(ghost_beside(track, 9, 0, 1, Vec3::Zero()));
}

TEST(GhostTrack, TellsHowAnInstrumentIsHeldInAnotherSize) {
  GhostTrack track = sample_track();
  track.tray = {"graft_sizer:9", "graft_sizer:8.5", "graft_sizer_stand"};
  const auto held = ghost_beside_in_any_size(track, 1, 0, "graft_sizer:8", Vec3(0.2, 0.05, 0));
  ASSERT_TRUE(held);
  EXPECT_NEAR(held->p.x(), 0.2, 1e-9);
  EXPECT_TRUE(ghost_beside_in_any_size(track, 1, 0, "graft_sizer", Vec3::Zero()))
      << "a usual size may have no number";
  EXPECT_FALSE(ghost_beside_in_any_size(track, 1, 0, "graft_sizer_stand", Vec3::Zero()));
  EXPECT_FALSE(ghost_beside_in_any_size(track, 1, 0, "endobutton:8.5", Vec3::Zero()));
}

// 1 mm a sample from 100 to 150 mm along x, a turn on the spot by 0.1 rad a sample, and a stay.
GhostTrack winding_track() {
  GhostTrack track;
  track.tray = {"wrist_probe", "shaver"};
  auto& samples = track.hands.emplace_back();
  const auto add = [&](double x_mm, double turned_rad, std::uint32_t instrument) {
    samples.push_back(
        {{Vec3(1e-3 * x_mm, 0, 0), Quat(Eigen::AngleAxisd(turned_rad, Vec3::UnitZ()))},
         instrument});
  };
  for (int i = 0; i < 5; ++i) add(0, 0, 0);
  for (int i = 0; i <= 50; ++i) add(100 + i, 0, 1);
  for (int i = 1; i <= 10; ++i) add(150, 0.1 * i, 1);
  for (int i = 0; i < 20; ++i) add(150, 1, 1);
  track.stretches.push_back({0, {}, 0, samples.size() - 1});
  return track;
}

TEST(GhostTrack, AHandGoesOnAlongTheWayStepByStep) {
  const GhostTrack track = winding_track();
  const auto shaver = [](std::uint32_t instrument) { return instrument == 1; };
  std::optional<std::size_t> at;
  Vec3 tip_W(0.101, 0.03, 0);
  std::vector<double> steps_mm;
  std::optional<Pose> to;
  for (int press = 0; press < 20; ++press) {
    to = ghost_onward(track, 0, 0, shaver, tip_W, at);
    ASSERT_TRUE(to);
    steps_mm.push_back(1e3 * (to->p.x() - (press == 0 ? 0.101 : tip_W.x())));
    tip_W = to->p;
    if (*at == track.stretches[0].to) break;
  }
  EXPECT_NEAR(to->q.angularDistance(Quat(Eigen::AngleAxisd(1, Vec3::UnitZ()))), 0, 1e-9);
  EXPECT_NEAR(to->p.x(), 0.150, 1e-12);
  ASSERT_GE(steps_mm.size(), 8u) << "along x, and three turns";
  ASSERT_LE(steps_mm.size(), 11u);
  for (int i = 0; i < 5; ++i) EXPECT_NEAR(steps_mm[i], 1e3 * kStepOn_m, 1.001) << i;
  // At its end, once more: from where it first came so near.
  const auto again = ghost_onward(track, 0, 0, shaver, tip_W, at);
  ASSERT_TRUE(again);
  EXPECT_LT(*at, track.stretches[0].to);
  EXPECT_LT((again->p - tip_W).norm(), 0.012);
  for (int press = 0; press < 20 && *at != track.stretches[0].to; ++press)
    tip_W = ghost_onward(track, 0, 0, shaver, tip_W, at)->p;
  EXPECT_EQ(*at, track.stretches[0].to);
  // A tip that was led away begins again with the nearest place.
  ASSERT_TRUE(ghost_onward(track, 0, 0, shaver, Vec3(0.12, 0.02, 0), at));
  EXPECT_NEAR(track.hands[0][*at].X_WT.p.x(), 0.128, 1.001e-3);
}

TEST(GhostTrack, NobodyGoesOnWhereTheInstrumentIsNotHeld) {
  GhostTrack track = winding_track();
  std::optional<std::size_t> at;
  const auto never = [](std::uint32_t) { return false; };
  EXPECT_FALSE(ghost_onward(track, 0, 0, never, Vec3::Zero(), at));
  EXPECT_FALSE(at);
  const auto probe = [](std::uint32_t instrument) { return instrument == 0; };
  ASSERT_TRUE(ghost_onward(track, 0, 0, probe, Vec3::Zero(), at));
  EXPECT_EQ(*at, 4u) << "before the other instrument is taken";
  EXPECT_FALSE(ghost_onward(track, 0, 1, probe, Vec3::Zero(), at)) << "no such hand";
  EXPECT_FALSE(ghost_onward(track, 3, 0, probe, Vec3::Zero(), at)) << "no such stretch";
  at = 1000;  // of another track
  EXPECT_TRUE(ghost_onward(track, 0, 0, probe, Vec3::Zero(), at));
  track.hands[0][2].X_WT.p.x() = std::nan("");
  at.reset();
  ASSERT_TRUE(ghost_onward(track, 0, 0, probe, Vec3::Zero(), at));
  EXPECT_EQ(*at, 1u) << "the way ends where its place is not known";
}

TEST(GhostTrack, AHeldKeyGoesAlongInHisOwnTime) {
  const GhostTrack track = winding_track();
  const auto any = [](std::uint32_t instrument) { return instrument < 2; };
  const auto& samples = track.hands[0];
  GhostPlace place{10, 0};
  Vec3 tip_W = samples[10].X_WT.p;
  for (int picture = 0; picture < 24; ++picture) {
    const auto to = ghost_along(track, 0, 0, any, tip_W, 0.13 / kGhostHz, place);
    ASSERT_TRUE(to);
    tip_W = to->p;
  }
  EXPECT_NEAR(static_cast<double>(place.at) + place.beyond, 13.12, 1e-9);
  EXPECT_FALSE(ghost_along(track, 0, 0, any, tip_W + Vec3(0, 0.013, 0), 1, place)) << "held up";
  EXPECT_FALSE(ghost_along(
      track, 0, 0, [](auto) { return false; }, tip_W, 1, place));
  EXPECT_FALSE(ghost_along(track, 0, 5, any, tip_W, 1, place)) << "no such hand";
  EXPECT_FALSE(ghost_along(track, 9, 0, any, tip_W, 1, place)) << "no such stretch";
  GhostPlace beyond{samples.size(), 0};
  EXPECT_FALSE(ghost_along(track, 0, 0, any, tip_W, 1, beyond));
  ASSERT_TRUE(ghost_along(track, 0, 0, any, tip_W, std::nan(""), place));
  EXPECT_EQ(place.at, 13u) << "a time that is no number";
  EXPECT_FALSE(ghost_ends(track, 0, 0, any, place.at));
  ASSERT_TRUE(ghost_along(track, 0, 0, any, tip_W, 1e6, place));
  EXPECT_EQ(place.at, track.stretches[0].to);
  EXPECT_TRUE(ghost_ends(track, 0, 0, any, place.at));
}

TEST(GhostTrack, TurnsBetweenSamplesByTheShorterWay) {
  GhostTrack track;
  track.hands = {{{}, {}}};
  track.hands[0][1].X_WT.q = Quat(Eigen::AngleAxisd(0.2, Vec3::UnitZ()));
  track.hands[0][1].X_WT.q.coeffs() *= -1;
  track.stretches = {{0, {{0, 0}}, 0, 1}};
  const auto half = ghost_at(track, 0, 0, 0.5 / kGhostHz);
  ASSERT_TRUE(half);
  EXPECT_NEAR(half->X_WT.q.angularDistance(Quat::Identity()), 0.1, 1e-12);
}

TEST(GhostTrack, FollowsProgressAndNotTheClock) {
  const GhostTrack track = sample_track();
  GhostFollower follower;
  EXPECT_FALSE(follower.at(track, 0, 0));
  follower.follow(track, state_at(0), 10);
  EXPECT_NEAR(follower.at(track, 0, 10)->X_WT.p.x(), 0.001, 1e-12);
  // However long the learner takes, the ghost shows the same step.
  follower.follow(track, state_at(0), 1000);
  EXPECT_LE(follower.at(track, 0, 1000)->X_WT.p.x(), 0.100 + 1e-12);
  follower.follow(track, state_at(1), 1000.5);
  EXPECT_NEAR(follower.at(track, 0, 1000.5)->X_WT.p.x(), 0.300, 1e-12);
  EXPECT_NEAR(follower.at(track, 0, 1000.6)->X_WT.p.x(), 0.400, 1e-6);
  follower.restart(1000.6);
  EXPECT_NEAR(follower.at(track, 0, 1000.6)->X_WT.p.x(), 0.300, 1e-12);
  follower.follow(track, state_at(2), 1001);
  EXPECT_FALSE(follower.at(track, 0, 1001));
}

TEST(GhostTrack, FadesAlongTheLearningCurve) {
  EXPECT_EQ(ghost_strength({}), 1);
  EXPECT_EQ(ghost_strength({false, false}), 1);
  double before = 1;
  for (std::size_t passes = 1; passes < 15; ++passes) {
    const double now = ghost_strength(std::vector<bool>(passes, true));
    EXPECT_LT(now, before) << passes;
    EXPECT_GT(now, 0) << passes;
    before = now;
  }
  // ln(0.9 / 0.75) a pass, 3.5 to show competence: the twentieth.
  EXPECT_NEAR(ghost_strength({true}), 1 - std::log(0.9 / 0.75) / 3.5, 1e-12);
  EXPECT_GT(ghost_strength(std::vector<bool>(19, true)), 0);
  EXPECT_EQ(ghost_strength(std::vector<bool>(20, true)), 0);
  std::vector<bool> relapsed(20, true);
  relapsed.insert(relapsed.end(), 6, false);
  EXPECT_EQ(ghost_strength(relapsed), 1);
}

}  // namespace
}  // namespace osteon
