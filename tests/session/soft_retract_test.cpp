// A retractor's blade holds soft parts aside in a session, and the hand feels it.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "osteon/physics/soft_world.h"
#include "osteon/scene/instrument.h"
#include "osteon/scene/soft_events.h"
#include "soft_fixtures.h"
#include "soft_solid_fixtures.h"

namespace osteon {
namespace {

using testing::band_table;
using testing::BandRun;
using testing::kBandMiddle;
using testing::kBandRadius_m;
using testing::kBandSurface_n_per_m;
using testing::kShaftRadius_m;

constexpr double kThinHalf_m = 0.0005, kDrawnAside_m = 0.005;

constexpr std::uint32_t kBladeOfTwo = 1;

template <class Run>
Run with_retractor(Run run) {
  const auto instruments = load_instruments();
  EXPECT_TRUE(instruments);
  const Instrument* found = find_instrument(*instruments, "malleable_retractor");
  run.settings.tray.emplace_back("malleable_retractor");
  run.tray.push_back(std::make_shared<const Tool>(make_tool(*found, found->usual_size)));
  run.settings.hands = {{"right", kBladeOfTwo}, {"left", 0}};
  return run;
}

// The blade stands across the band, flat against it: z of the tool to -y. The other one's to y.
const Quat kAcrossBand(std::sqrt(0.5), std::sqrt(0.5), 0, 0);
const Quat kFromOpposite(std::sqrt(0.5), -std::sqrt(0.5), 0, 0);

/// The right hand has the retractor, the left one what the run begins with.
struct TwoOnTissue {
  TwoOnTissue(Session& s, const Vec3& from) : session(s) {
    set(0, from, kAcrossBand);
    set(1, from + Vec3(0.011, -0.040, 0), kFromOpposite);
    tick();
    rest(50);
  }
  Session& session;
  std::array<HandInput, 2> in;
  std::vector<Event> events;

  void tick() {
    (void)session.tick(in);
    for (const Event& event : session.last_events()) events.push_back(event);
  }
  void rest(int ticks) {
    for (int n = 0; n < ticks; ++n) tick();
  }
  void move(std::size_t hand, const Vec3& to, int ticks = 400) {
    const Vec3 from = in[hand].input.X_WD.p;
    for (int n = 1; n <= ticks; ++n) {
      in[hand].input.X_WD.p = from + n / static_cast<double>(ticks) * (to - from);
      tick();
    }
  }
  void set(std::size_t hand, const Vec3& at, const Quat& q) { in[hand].input.X_WD = {at, q}; }
  Vec3 force(std::size_t hand) const { return session.tool_state(hand).force_W; }
};

Vec3 across_at(double z_m) { return kBandMiddle + Vec3(0, 0.020, z_m); }

// The string gives way by what its surface does not: F = 2 T b / l for legs l that are bent by b.
TEST(SoftRetract, ABladeHoldsALigamentAsideAndFeelsItWithoutSteps) {
  const BandRun run = with_retractor(BandRun(band_table(0.01)));
  Session session = run.session();
  TwoOnTissue hands(session, across_at(-0.05));
  const double touch = -(kBandRadius_m + kThinHalf_m);
  hands.move(0, across_at(touch - 0.003));
  hands.rest(50);
  EXPECT_LT(hands.force(0).norm(), 0.01);
  EXPECT_EQ(session.softs()->readout(0).force_n[0], 0);
  const double slow_m = 2e-5;  // a tick
  const int ticks = static_cast<int>((kDrawnAside_m + 0.003) / slow_m);
  double most = 0;
  for (int n = 1; n <= ticks; ++n) {
    const double before = hands.force(0).z();
    hands.move(0, across_at(touch - 0.003 + n * slow_m), 1);
    most = std::max(most, std::abs(hands.force(0).z() - before));
  }
  hands.rest(300);
  const double held = -hands.force(0).z();
  EXPECT_GT(held, 2);
  EXPECT_LT(most, 0.02 * held);
  EXPECT_NEAR(session.softs()->readout(0).force_n[0], held, 0.01 * held);
  const double bent = kDrawnAside_m - held / kBandSurface_n_per_m;
  const double leg = std::hypot(testing::kBandGap_m / 2, bent);
  EXPECT_NEAR(held, 2 * tension_at(run.softs->bands[0], 2 * leg) * bent / leg, 0.01 * held);
  most = 0;
  for (int n = 0; n < 1000; ++n) {
    hands.tick();
    most = std::max(most, std::abs(-hands.force(0).z() - held));
  }
  EXPECT_LT(most, 0.001 * held);
}

// What another hand meets beside the blade is the leg of the string that it has drawn aside; it is
// the two legs from there on.
TEST(SoftRetract, WhereALigamentWasAnotherHandFindsRoom) {
  const BandRun run = with_retractor(BandRun(band_table(0.003)));
  const double touch = -(kBandRadius_m + kThinHalf_m), aside_m = 0.020, beside_m = 0.0095;
  const double other_touch = -(kBandRadius_m + testing::kShaftRadius_m);
  const auto other_at = [&](double z_m) -> Vec3 {
    return kBandMiddle + Vec3(beside_m, -0.020, z_m);
  };
  std::array<double, 2> felt{};
  for (const bool retracted : {false, true}) {
    Session session = run.session();
    TwoOnTissue hands(session, across_at(-0.05));
    hands.move(0, across_at(touch - 0.003));
    hands.rest(50);
    if (retracted) hands.move(0, across_at(touch + aside_m));
    hands.move(1, other_at(-0.012));
    hands.move(1, other_at(other_touch + 0.0004));
    hands.rest(100);
    felt[retracted ? 1 : 0] = hands.force(1).norm();
    if (!retracted) continue;
    // Up to where the leg is.
    const double bent = aside_m + hands.force(0).z() / kBandSurface_n_per_m;
    const double leg = bent * (1 - beside_m / (testing::kBandGap_m / 2));
    EXPECT_GT(leg, 0.0006);
    double first = 0, most = 0;
    for (double z = 0.0004; z < leg + 0.002; z += 1e-5) {
      const double before = hands.force(1).norm();
      hands.move(1, other_at(other_touch + z), 1);
      if (first == 0 && hands.force(1).norm() > 0.02) first = z;
      most = std::max(most, std::abs(hands.force(1).norm() - before));
    }
    EXPECT_NEAR(first, leg, 0.0001);
    EXPECT_GT(hands.force(1).norm(), 0.5);
    EXPECT_LT(most, 0.05);
    // Both at rest, and what they feel does not swing.
    hands.rest(300);
    const Vec3 one = hands.force(0), other = hands.force(1);
    hands.rest(200);
    EXPECT_LT((hands.force(0) - one).norm(), 1e-3);
    EXPECT_LT((hands.force(1) - other).norm(), 1e-3);
  }
  EXPECT_GT(felt[0], 0.1);
  EXPECT_EQ(felt[1], 0);
}

// Slightly aslant, so that its tip is what lifts.
TEST(SoftRetract, ABladeUnderAMeniscusLiftsItAndAnotherHandFindsRoom) {
  const testing::MeniscusRun run = with_retractor(testing::meniscus_run());
  const double turn = std::numbers::pi / 2 + 0.2;
  const Quat aslant(std::cos(turn / 2), std::sin(turn / 2), 0, 0);
  const double touch = -(testing::kMeniscusHalf.z() + kThinHalf_m);
  const Vec3 under(0, 0.003, -(testing::kMeniscusHalf.z() + testing::kBallRadius_m));
  std::array<double, 2> felt{};
  for (const bool lifted : {false, true}) {
    Session session = run.session();
    TwoOnTissue hands(session, {0, 0.020, -0.020});
    hands.set(0, {0, 0, touch - 0.004}, aslant);
    hands.rest(50);
    if (lifted) hands.move(0, {0, 0, touch + 0.004});
    hands.rest(200);
    EXPECT_EQ(hands.force(0).z() < -1, lifted) << hands.force(0).z();
    hands.set(1, under - Vec3(0, 0, 0.006), Quat::Identity());
    hands.rest(50);
    hands.move(1, under + Vec3(0, 0, 0.001));
    felt[lifted ? 1 : 0] = hands.force(1).norm();
  }
  EXPECT_GT(felt[0], 0.3);
  EXPECT_LT(felt[1], 0.1 * felt[0]);
}

}  // namespace
}  // namespace osteon
