// A reamer that cuts deep into the wall of a canal shakes: it is told and felt.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "drilling.h"
#include "osteon/carve/removed.h"
#include "osteon/scene/carve_events.h"
#include "recorded_run.h"

namespace osteon {
namespace {

using testing::Drilling;
using testing::go_on_as;

constexpr double kTopHere_m = 0.004;
constexpr double kTeethAtFull_hz = 35;  // six teeth, 350 turns a minute

// A plate of 16 x 16 x 8 mm, cortex through and through.
std::shared_ptr<const Case> plate() {
  CaseDef def;
  def.name = "plate";
  BoneDef bone;
  bone.name = "plate";
  bone.mesh = testing::box_mesh(Vec3(0.008, 0.008, kTopHere_m));
  bone.felt = Felt::kField;
  def.bones.push_back(bone);
  auto built = build_case(std::move(def));
  EXPECT_TRUE(built);
  return std::make_shared<const Case>(std::move(*built));
}

Drilling reaming(double size_mm, double cortex_m = 0.02) {
  static const std::shared_ptr<const Case> the_plate = plate();
  Drilling with;
  with.the_case = the_plate;
  with.settings.tray.clear();
  with.tray.clear();
  with.settings.carve.cell_m = 0.0003;
  with.settings.carve.cortex_m = cortex_m;
  with.settings.carve.thrust_scale = 80;
  with.also("reamer:" + std::to_string(size_mm));
  return with;
}

// With a canal through the plate's middle as if a reamer of that size had made it.
Session with_canal(const Drilling& with, double canal_mm) {
  Session session = with.session();
  Carving carving(with.setup, 1, with.settings.haptic.stiffness_n_per_m);
  CarvedField field = *carving.field(0);
  const auto reamer = make_cutter("reamer", 1e-3 * canal_mm);
  EXPECT_TRUE(reamer);
  (void)field.cut(*reamer, {Vec3(0, 0, 0.01), Quat::Identity()},
                  {Vec3(0, 0, -0.01), Quat::Identity()});
  auto carved = std::make_shared<CarvingState>(carving.save());
  carved->bones[0] = field.save();
  SessionState state = session.save();
  state.world.carved = std::move(carved);
  EXPECT_TRUE(session.restore(state));
  return session;
}

struct Reamed {
  std::vector<Event> events;
  std::vector<double> force_n;  // of each tick
  double deep_m = 0;
};

HandInput pressing(const Session& session, int n, double power) {
  HandInput hand;
  const double z = session.tool_state().X_WP.p.z();
  hand.input.X_WD.p = {0, 0, n < 400 ? kTopHere_m + 0.002 - 1e-5 * n : z - 0.004};
  if (n == 2) hand.command = {CommandKind::kPower, power};
  return hand;
}

Reamed ream(Session& session, int from, int to, double power = 1) {
  Reamed out;
  for (int n = from; n <= to; ++n) {
    const HandInput hand = pressing(session, n, power);
    (void)session.tick(std::span(&hand, 1));
    for (const Event& event : session.last_events()) out.events.push_back(event);
    out.force_n.push_back(session.tool_state().force_W.z());
  }
  out.deep_m = kTopHere_m - session.tool_state().X_WP.p.z();
  return out;
}

std::vector<Event> of_kind(const Reamed& reamed, EventKind kind) {
  std::vector<Event> out;
  std::copy_if(reamed.events.begin(), reamed.events.end(), std::back_inserter(out),
               [kind](const Event& e) { return e.kind == kind; });
  return out;
}

// Amplitude of what swings at a frequency in a part of a force's course.
double swing_at(const std::vector<double>& force_n, std::size_t from, double hz) {
  std::complex<double> sum = 0;
  for (std::size_t n = from; n < force_n.size(); ++n)
    sum += force_n[n] * std::polar(1.0, -2 * std::numbers::pi * hz * 0.001 * double(n));
  return 2 * std::abs(sum) / double(force_n.size() - from);
}

// By (10 - 8.5) / 2 mm a side: 0.15 of what is beyond 0.4 mm.
TEST(Chatter, OfADeepCutIsToldWithAmplitudeAndFrequency) {
  const Drilling with = reaming(10);
  Session session = with_canal(with, 8.5);
  const Reamed done = ream(session, 1, 1500);
  ASSERT_GT(done.deep_m, 0.0005);
  const auto told = of_kind(done, kChatter);
  ASSERT_FALSE(told.empty());
  EXPECT_LT(told.size(), 8u) << "told anew at every step";
  EXPECT_NEAR(told.back().values[0], 0.15 * (0.75 - 0.4), 0.03);
  EXPECT_NEAR(told.back().values[1], kTeethAtFull_hz, 1e-9);
}

TEST(Chatter, AStepOfHalfAMillimetreRunsSmoothly) {
  const Drilling with = reaming(9);
  Session session = with_canal(with, 8.5);
  const Reamed done = ream(session, 1, 1500);
  ASSERT_GT(done.deep_m, 0.0005);
  EXPECT_TRUE(of_kind(done, kChatter).empty());
}

TEST(Chatter, CancellousBoneAndAStillReamerDoNotShake) {
  const Drilling soft = reaming(10, 0.0001);
  Session session = with_canal(soft, 8.5);
  EXPECT_TRUE(of_kind(ream(session, 1, 900), kChatter).empty());
  const Drilling hard = reaming(10);
  Session still = with_canal(hard, 8.5);
  EXPECT_TRUE(of_kind(ream(still, 1, 900, 0), kChatter).empty());
}

// The hand feels the teeth, and next to nothing of it where the reamer runs smoothly.
TEST(Chatter, IsFeltAtTheTeethsFrequency) {
  const auto felt = [](double size_mm) {
    const Drilling with = reaming(size_mm);
    Session session = with_canal(with, 8.5);
    const Reamed done = ream(session, 1, 1800);
    for (const double force : done.force_n)
      EXPECT_LE(std::abs(force), with.settings.haptic.max_force_n + 1e-9);
    return std::pair(swing_at(done.force_n, 800, kTeethAtFull_hz),
                     swing_at(done.force_n, 800, 0.6 * kTeethAtFull_hz));
  };
  const auto [shaken, beside] = felt(11);
  const auto [smooth, none] = felt(9);
  EXPECT_GT(shaken, 0.02);
  EXPECT_GT(shaken, 5 * beside);
  EXPECT_LT(smooth, 0.2 * shaken);
  (void)none;
}

// A stiff coupling makes a large force of the teeth's wave: no more of it is felt than the table
// says. The hand presses with 2 N and follows the reamer too slowly to swing with it.
TEST(Chatter, NoMoreOfItIsFeltThanTheTableSays) {
  constexpr double kStiffness = 2000;
  const auto felt = [](double most_n) {
    Drilling with = reaming(12);
    with.settings.haptic.stiffness_n_per_m = kStiffness;
    with.with([&](CarvingSetup& setup) { setup.table.chatter_most_n = most_n; });
    Session session = with_canal(with, 8.5);
    std::vector<double> force_n;
    double slow_z = kTopHere_m + 0.002;
    for (int n = 1; n <= 2400; ++n) {
      const double z = session.tool_state().X_WP.p.z();
      slow_z = n < 400 ? kTopHere_m + 0.002 - 1e-5 * n : slow_z + 0.01 * (z - slow_z);
      HandInput hand;
      hand.input.X_WD.p = {0, 0, n < 400 ? slow_z : slow_z - 2 / kStiffness};
      if (n == 2) hand.command = {CommandKind::kPower, 1};
      (void)session.tick(std::span(&hand, 1));
      force_n.push_back(session.tool_state().force_W.z());
    }
    const double amplitude_m = session.save().world.carved->hands[0].chatter.amplitude_m;
    return std::pair(swing_at(force_n, 1800, kTeethAtFull_hz), kStiffness * amplitude_m);
  };
  ASSERT_EQ(reaming(12).setup->table.chatter_most_n, 0.3);
  const auto [whole, of_wave] = felt(0.3);
  EXPECT_LT(of_wave, 0.3);
  EXPECT_NEAR(whole, of_wave, 0.1 * of_wave);
  const auto [bounded, beyond] = felt(0.06);
  EXPECT_GT(beyond, 0.06);
  EXPECT_NEAR(bounded, 0.06, 0.1 * 0.06);
}

TEST(Chatter, AStateOnTheWayGivesTheSameBitsAndPulledBackItEnds) {
  const Drilling with = reaming(11);
  Session session = with_canal(with, 8.5);
  ASSERT_FALSE(of_kind(ream(session, 1, 1000), kChatter).empty());
  Session other = with.session();
  (void)go_on_as(other, session);
  (void)ream(session, 1001, 1300);
  (void)ream(other, 1001, 1300);
  EXPECT_EQ(other.state_hash(), session.state_hash());
  bool ended = false;
  for (int n = 0; n < 200; ++n) {
    HandInput hand;
    hand.input.X_WD.p = {0, 0, kTopHere_m + 0.005};
    (void)session.tick(std::span(&hand, 1));
    for (const Event& event : session.last_events()) ended = ended || event.kind == kChatterEnd;
  }
  EXPECT_TRUE(ended);
}

// What it has gone down into a flat face is gone, from its first tenth of a millimetre: what the
// same reamer takes that is sunk in so far at once.
TEST(Reaming, AWideReamerCutsFromItsFirstTenths) {
  constexpr double size_mm = 12;
  for (const double cell_mm : {0.25, 0.4}) {
    Drilling with;
    with.the_case = plate();
    with.settings.tray.clear();
    with.tray.clear();
    with.settings.carve.cell_m = 1e-3 * cell_mm;
    with.settings.carve.cortex_m = 0.0001;  // cancellous bone: it does not shake
    with.also("reamer:" + std::to_string(size_mm));
    Session session = with.session();
    double deep = 0;
    for (int n = 1; n <= 3000 && deep < 0.0003; ++n) {
      const HandInput hand = pressing(session, n, 1);
      (void)session.tick(std::span(&hand, 1));
      deep = kTopHere_m - session.tool_state().X_WP.p.z();
    }
    ASSERT_GE(deep, 0.0003) << size_mm << " at " << cell_mm;
    const CarvedField& field = *session.carving()->field(0);
    const double gone_mm3 = 1e9 * total(removed_volume(field));
    const auto reamer = make_cutter("reamer", 1e-3 * size_mm);
    ASSERT_TRUE(reamer);
    Carving whole(with.setup, 1, with.settings.haptic.stiffness_n_per_m);
    CarvedField sunk = *whole.field(0);
    (void)sunk.cut(*reamer, {Vec3(0, 0, kTopHere_m - deep), Quat::Identity()});
    const double front_mm3 = 1e9 * total(removed_volume(sunk));
    EXPECT_GT(gone_mm3, 0.85 * front_mm3) << size_mm << " at " << cell_mm;
    EXPECT_LT(gone_mm3, 1.1 * front_mm3) << size_mm << " at " << cell_mm;
  }
}

}  // namespace
}  // namespace osteon
