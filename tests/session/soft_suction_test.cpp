// Suction that draws soft parts to its mouth and holds them: the shipped cannula.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "driven_hand.h"
#include "osteon/physics/joint_fluid.h"
#include "osteon/physics/soft_world.h"
#include "osteon/scene/instrument.h"
#include "osteon/scene/soft_events.h"
#include "recorded_run.h"
#include "soft_fixtures.h"
#include "soft_solid_fixtures.h"

namespace osteon {
namespace {

using testing::band_table;
using testing::BandRun;
using testing::begin_recording;
using testing::DrivenHand;
using testing::expect_same_replays;
using testing::kBandMiddle;
using testing::kBandRadius_m;

constexpr std::uint32_t kSuction = 1;
// 200 mmHg on three quarters of 3 mm.
const double kFull_n = 200 * kPa_per_mmHg * std::numbers::pi / 4 * 0.00225 * 0.00225;

template <class Run>
Run with_suction(Run run) {
  const auto instruments = load_instruments();
  EXPECT_TRUE(instruments);
  const Instrument* found = find_instrument(*instruments, "suction");
  run.settings.tray.emplace_back("suction");
  run.tray.push_back(std::make_shared<const Tool>(make_tool(*found, found->usual_size)));
  SoftSetup setup = *run.softs;
  auto grippers = make_soft_grippers(run.settings.tray);
  EXPECT_TRUE(grippers);
  if (grippers) add_grippers(setup, std::move(*grippers));
  EXPECT_NE(setup.hash, run.softs->hash);
  run.settings.soft_hash = setup.hash;
  run.softs = std::make_shared<const SoftSetup>(std::move(setup));
  return run;
}

struct SuctionHand : DrivenHand {
  SuctionHand(Session& s, const Vec3& from) : DrivenHand(s, from) {
    store_every = 250;
    take(kSuction);
    rest(40);
  }
  void power(double of_full) {
    tick({CommandKind::kPower, of_full});
    rest(4);
  }
  const SoftGrip& grip() const { return session.softs()->state().grips[0]; }
  bool holds() const { return grip().hold.of != SoftHold::Of::kNothing; }
  double pull_n() const { return -session.tool_state().force_W.z(); }
  Event last(EventKind kind) const {
    Event out;
    for (const Event& event : events)
      if (event.kind == kind) out = event;
    return out;
  }
};

// The tip's lowest place is its mouth.
double mouth_m(const BandRun& run) { return run.softs->grippers[kSuction]->bore_T.z(); }

TEST(SoftSuction, ItsForceIsPressureTimesAreaAndFallsAsTheSquareOfTheSpeedOfWhatFlowsIn) {
  const auto instruments = load_instruments();
  ASSERT_TRUE(instruments);
  const Instrument* found = find_instrument(*instruments, "suction");
  ASSERT_TRUE(found);
  const auto mouth = sucker_of(*found, found->usual_size);
  ASSERT_TRUE(mouth);
  EXPECT_NEAR(mouth->bore_m, 0.00225, 1e-12);
  EXPECT_NEAR(suction_at(*mouth, 0), kFull_n, 1e-9);
  EXPECT_NEAR(suction_at(*mouth, -0.001), kFull_n, 1e-9);
  // DallaValle: a tenth of the speed a diameter before the mouth, within a few percent.
  const double speed = std::sqrt(suction_at(*mouth, mouth->bore_m) / kFull_n);
  EXPECT_NEAR(speed, 1 / (1 + 40 / std::numbers::pi), 1e-12);
  EXPECT_FALSE(sucker_of(*find_instrument(*instruments, "grasper"), 0));
  EXPECT_FALSE(sucker_of(*find_instrument(*instruments, "hook_probe"), 0));
}

Vec3 before_band(const BandRun& run, double gap_m) {
  return kBandMiddle + Vec3(0, 0, kBandRadius_m + gap_m - mouth_m(run));
}

TEST(SoftSuction, WithoutPowerItHoldsNothingAndOffItLetsGo) {
  const BandRun run = with_suction(BandRun());
  Session session = run.session();
  SuctionHand hand(session, before_band(run, 0.010));
  hand.move(before_band(run, 0.00001), 200);
  hand.rest(50);
  EXPECT_FALSE(hand.holds());
  hand.power(1);
  ASSERT_TRUE(hand.holds());
  ASSERT_EQ(hand.count(kSoftHeld), 1u);
  EXPECT_NEAR(hand.last(kSoftHeld).values[0], kFull_n, 1e-9);
  EXPECT_EQ(run.the_case->softs[hand.last(kSoftHeld).subject].name, "acl");
  EXPECT_LT((hand.last(kSoftHeld).p_W - kBandMiddle).norm(), kBandRadius_m + 0.0001);
  hand.power(0);
  EXPECT_FALSE(hand.holds());
  EXPECT_EQ(hand.count(kSoftFreed), 1u);
  hand.rest(10);
  EXPECT_EQ(session.tool_state().force_W, Vec3(0, 0, 0));
}

// A taut one comes from as far as the suction there overcomes what it pulls back with; a slack one
// does not pull back at all.
TEST(SoftSuction, ItDrawsASlackLigamentFromFartherThanATautOne) {
  for (const double strain : {0.01, -0.02}) {
    const BandRun run = with_suction(BandRun(band_table(strain)));
    Session session = run.session();
    SuctionHand hand(session, before_band(run, 0.006));
    hand.power(1);
    double first_m = 0;
    for (double gap_m = 0.006; gap_m > 0 && !hand.holds(); gap_m -= 2e-6) {
      hand.at = before_band(run, gap_m);
      hand.tick();
      first_m = gap_m;
    }
    ASSERT_TRUE(hand.holds()) << strain;
    const SoftGripper& mouth = *run.softs->grippers[kSuction];
    const SoftBand& band = run.softs->bands[0];
    const BandSpan span{kBandMiddle - Vec3(testing::kBandGap_m / 2, 0, 0),
                        kBandMiddle + Vec3(testing::kBandGap_m / 2, 0, 0)};
    const auto needs_n = [&](double gap_m) {
      const Vec3 to = kBandMiddle + Vec3(0, 0, kBandRadius_m + gap_m);
      return draw_band(band, span, to, 0, kJawSpring_n_per_m).force_n;
    };
    EXPECT_LE(needs_n(first_m), suction_at(mouth, first_m));
    EXPECT_GT(needs_n(first_m + 1e-5), suction_at(mouth, first_m + 1e-5));
    EXPECT_EQ(first_m > 0.0015, strain < 0) << first_m;
  }
}

// Two legs of the string, drawn by what the mouth's spring leaves of the way: F = 2 T b / l. It
// comes off at the suction's pressure times the area of the mouth.
TEST(SoftSuction, ItHoldsALigamentUntilItIsPulledOffAtPressureTimesArea) {
  for (const double of_full : {1.0, 0.5}) {
    const BandRun run = with_suction(BandRun(band_table(-0.02)));
    Session session = run.session();
    SuctionHand hand(session, before_band(run, 0.0005));
    hand.power(of_full);
    hand.rest(200);
    ASSERT_TRUE(hand.holds());
    EXPECT_NEAR(hand.pull_n(), 0, 1e-6);
    double step_n = 0, last_n = 0, most_n = 0, slack_m = 0.0005;
    for (double gap_m = 0.0005; gap_m < 0.008 && hand.holds(); gap_m += 2e-6) {
      hand.at = before_band(run, gap_m);
      hand.tick();
      if (hand.pull_n() == 0) slack_m = gap_m;
      step_n = std::max(step_n, hand.pull_n() - last_n);
      last_n = hand.pull_n();
      most_n = std::max(most_n, last_n);
      if (!(last_n > 0.01)) continue;
      const double bent = gap_m - last_n / kJawSpring_n_per_m;
      const double leg = std::hypot(testing::kBandGap_m / 2, bent);
      if (last_n < 0.99 * of_full * kFull_n) {
        EXPECT_NEAR(last_n, 2 * tension_at(run.softs->bands[0], 2 * leg) * bent / leg,
                    0.02 * last_n);
      }
    }
    EXPECT_GT(slack_m, 0.0015);
    EXPECT_FALSE(hand.holds());
    hand.rest(4);
    EXPECT_EQ(hand.count(kSoftSlipped), 1u);
    const Event off = hand.last(kSoftSlipped);
    EXPECT_NEAR(off.values[1], of_full * kFull_n, 1e-9);
    EXPECT_NEAR(off.values[0], of_full * kFull_n, 0.03 * kFull_n);
    EXPECT_LE(most_n, of_full * kFull_n + 1e-9);
    EXPECT_LT(step_n, 0.02 * kFull_n);
    EXPECT_EQ(session.tool_state().force_W, Vec3(0, 0, 0));
  }
}

testing::MeniscusRun solid_run() { return with_suction(testing::meniscus_run()); }

// A spring, the meniscus and the mouth one behind the other, no more than pressure times area.
TEST(SoftSuction, ItHoldsAMeniscusUntilItIsPulledOff) {
  const testing::MeniscusRun run = solid_run();
  Session session = run.session();
  const double mouth = run.softs->grippers[kSuction]->bore_T.z();
  const auto over = [&](double gap_m) {
    return Vec3(0.002, 0.001, testing::kMeniscusHalf.z() + gap_m - mouth);
  };
  SuctionHand hand(session, over(0.005));
  hand.power(1);
  hand.rest(20);
  EXPECT_FALSE(hand.holds());
  hand.move(over(0.0), 500);
  hand.rest(200);
  ASSERT_TRUE(hand.holds());
  EXPECT_EQ(run.the_case->softs[hand.last(kSoftHeld).subject].name, "medial_meniscus");
  hand.move(over(0.0001), 100);
  hand.rest(200);
  const double k = session.softs()->state().grips[0].hold.stiffness_n_per_m;
  EXPECT_GT(k, 200);
  EXPECT_LT(k, kJawSpring_n_per_m / 2);
  EXPECT_NEAR(hand.pull_n(), 0.0001 * k, 0.05 * 0.0001 * k);
  EXPECT_NEAR(session.softs()->solid_readout(0).force_n[0], hand.pull_n(), 0.05 * hand.pull_n());
  // It slides along, and pulls straight to its mouth.
  hand.move(hand.at + Vec3(0.003, 0, 0), 300);
  hand.rest(100);
  EXPECT_TRUE(hand.holds());
  EXPECT_LT(session.tool_state().force_W.head<2>().norm(), 0.1 * hand.pull_n());
  const double off_m = kFull_n / k;
  for (double gap_m = 0.0001; gap_m < 0.001 && hand.holds(); gap_m += 1e-6) {
    hand.at.z() = over(gap_m).z();
    hand.tick();
    EXPECT_LE(hand.pull_n(), kFull_n + 1e-9);
  }
  hand.rest(20);
  EXPECT_EQ(hand.count(kSoftSlipped), 1u);
  EXPECT_NEAR(hand.last(kSoftSlipped).values[2], 1e3 * off_m, 0.1e3 * off_m);
  EXPECT_FALSE(hand.holds());
  EXPECT_EQ(hand.count(kSoftHeld), 1u);
}

// Pressed on, it is what it is without suction.
TEST(SoftSuction, PressedOnItFeelsTheTissueAsWithoutPower) {
  const testing::MeniscusRun run = solid_run();
  const double mouth = run.softs->grippers[kSuction]->bore_T.z();
  std::array<double, 2> felt{};
  for (const double power : {0.0, 1.0}) {
    Session session = run.session();
    SuctionHand hand(session, Vec3(0.002, 0.001, testing::kMeniscusHalf.z() + 0.003 - mouth));
    hand.power(power);
    double most = 0;
    for (int n = 0; n < 2000; ++n) {
      const double before = hand.pull_n();
      hand.move(hand.at - Vec3(0, 0, 2e-6), 1);
      most = std::max(most, std::abs(hand.pull_n() - before));
    }
    hand.rest(200);
    felt[power > 0 ? 1 : 0] = -hand.pull_n();
    EXPECT_EQ(hand.holds(), power > 0);
    EXPECT_LT(most, 0.02) << power;
  }
  EXPECT_GT(felt[0], 0.5);
  EXPECT_NEAR(felt[1], felt[0], 0.01 * felt[0]);
}

TEST(SoftSuction, AReplayIsTheSameFromTheStartAndFromTheMiddle) {
  const BandRun run = with_suction(BandRun(band_table(-0.01)));
  Session session = run.session();
  Recording recording = begin_recording(run);
  DrivenHand by(session, before_band(run, 0.004));
  by.into = &recording;
  by.store_every = 250;
  by.take(kSuction);
  by.rest(40);
  by.tick({CommandKind::kPower, 1});
  for (int n = 0; n < 4; ++n) {
    by.move(before_band(run, 0.0002), 150);
    by.move(before_band(run, 0.0010) + Vec3(0.002, 0, 0), 150);
    by.move(before_band(run, 0.0040), 150);
  }
  EXPECT_GE(by.count(kSoftHeld), 4u);
  EXPECT_GE(by.count(kSoftSlipped), 4u);
  ASSERT_GT(recording.states.size(), 4u);
  expect_same_replays(recording, run, session, {0.0, 0.3, 0.6, 1.1});
}

}  // namespace
}  // namespace osteon
