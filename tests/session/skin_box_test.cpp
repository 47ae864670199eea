// A plate on skin in a session, against the closed form of a membrane under tension on springs.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "count_allocations.h"
#include "osteon/physics/skin_state.h"
#include "osteon/physics/soft_world.h"
#include "osteon/scene/tool_rods.h"
#include "osteon/session/session.h"
#include "recorded_run.h"
#include "skin_fixtures.h"

namespace osteon {
namespace {

using testing::go_on_as;
using testing::kPlateHalf;
using testing::kSkinPlate;
using testing::skin_run;
using testing::SkinHandAt;

// Of a disc of radius a that bears evenly, with the mean way of it: pi a^2 k / (1 - 2 I1 K1), of
// a / b, b^2 the tension over the foundation k. On a sheet without end.
double closed_n_per_m(double radius_m) {
  const SheetMaterial& m = skin_run().patch().sheet->material();
  const double x = radius_m * std::sqrt(m.foundation_n_per_m3 / m.tension_n_per_m);
  const double bears = 1 - 2 * std::cyl_bessel_i(1.0, x) * std::cyl_bessel_k(1.0, x);
  return std::numbers::pi * radius_m * radius_m * m.foundation_n_per_m3 / bears;
}

double disc_of_face_m() {
  return std::sqrt(4 * kPlateHalf.x() * kPlateHalf.y() / std::numbers::pi);
}

// Of a slight push, flat, its lower face at z.
double felt_per_m(SkinHandAt& hand) {
  const double one = hand.felt_at({0, 0, -0.0002}), two = hand.felt_at({0, 0, -0.0006});
  return (two - one) / 0.0004;
}

TEST(SkinPlate, AFlatFaceIsAsStiffAsADiscOfItsAreaAndNotAsARod) {
  Session session = skin_run().session();
  SkinHandAt hand(session);
  hand.take(kSkinPlate, {0, 0, 0.010});
  const double felt = felt_per_m(hand), wanted = closed_n_per_m(disc_of_face_m());
  const Capsule rod = tool_rods(*skin_run().tray[kSkinPlate]).at(0);
  std::printf("felt %.0f N/m, disc of the face %.0f, rod of the box %.0f\n", felt, wanted,
              closed_n_per_m(rod.radius));
  EXPECT_NEAR(felt / wanted, 1, 0.12) << "the patch ends 15 mm from its middle, held there";
  EXPECT_GT(felt, 1.6 * closed_n_per_m(rod.radius));
}

// What a newton presses in: as far less as the face is larger.
TEST(SkinPlate, ANewtonPressesItInLessFlatThanOnItsSide) {
  Session session = skin_run().session();
  SkinHandAt hand(session);
  hand.take(kSkinPlate, {0, 0, 0.020});
  const double flat = felt_per_m(hand);
  hand.at = {0, 0, 0.020};
  hand.q = Quat(Eigen::AngleAxisd(0.5 * std::numbers::pi, Vec3::UnitX()));
  hand.rest(50);
  // On its long narrow side, whose middle is so far beside the tip's.
  const Vec3 side(0, kPlateHalf.z(), kPlateHalf.y());
  const double narrow =
      (hand.felt_at(side - Vec3(0, 0, 0.0006)) - hand.felt_at(side - Vec3(0, 0, 0.0002))) / 0.0004;
  const double strip_m = std::sqrt(4 * kPlateHalf.x() * kPlateHalf.z() / std::numbers::pi);
  EXPECT_NEAR(narrow / closed_n_per_m(strip_m), 1, 0.15);
  EXPECT_LT(narrow, 0.7 * flat);
}

TEST(SkinPlate, TiltedAndSlidItHasNoSteps) {
  Session session = skin_run().session();
  SkinHandAt hand(session);
  hand.take(kSkinPlate, {0, 0, 0.010});
  hand.move({0, 0, -0.002}, 200);
  hand.rest(100);
  hand.force_z.clear();
  for (int n = 0; n < 3000; ++n) {
    const double t = 0.001 * n, w = 2 * std::numbers::pi;
    hand.q = Quat(Eigen::AngleAxisd(0.15 * std::sin(w * t), Vec3::UnitY())) *
             Quat(Eigen::AngleAxisd(0.1 * std::sin(0.7 * w * t), Vec3::UnitX()));
    hand.at = {0.006 * std::sin(0.5 * w * t), 0.002, -0.002};
    hand.tick();
  }
  const double peak = *std::max_element(hand.force_z.begin(), hand.force_z.end());
  EXPECT_GT(peak, 1);
  for (std::size_t n = 1; n < hand.force_z.size(); ++n)
    ASSERT_LT(std::abs(hand.force_z[n] - hand.force_z[n - 1]), 0.02 * peak) << n;
}

TEST(SkinPlate, PressingItAllocatesNothing) {
  Session session = skin_run().session();
  SkinHandAt hand(session);
  hand.take(kSkinPlate, {0, 0, 0.010});
  hand.events.reserve(1000);
  hand.force_z.reserve(10000);
  hand.move({0, 0, -0.002}, 100);
  const std::uint64_t before = testing::allocations();
  hand.move({0.004, 0.003, -0.003}, 300);
  EXPECT_EQ(testing::allocations(), before);
  EXPECT_GT(session.tool_state().force_W.z(), 1);
}

TEST(SkinPlate, AStateInTheMiddleOfAPressGoesOnTheSame) {
  Session session = skin_run().session();
  SkinHandAt hand(session);
  hand.take(kSkinPlate, {0, 0, 0.010});
  hand.q = Quat(Eigen::AngleAxisd(0.1, Vec3::UnitY()));
  hand.move({0.002, 0, -0.001}, 203);
  Session other = skin_run().session();
  const SessionState back = go_on_as(other, session);
  SkinHandAt again(other);
  again.at = hand.at;
  again.q = hand.q;
  for (SkinHandAt* one : {&hand, &again}) {
    one->force_z.clear();
    one->move({-0.003, 0.002, -0.002}, 201);
  }
  EXPECT_EQ(other.state_hash(), session.state_hash());
  EXPECT_EQ(again.force_z, hand.force_z);
  EXPECT_GT(hand.force_z.back(), 0.5);
}

// The word of a state's bytes at which those of another first differ.
std::size_t first_other(const std::string& bytes, const SessionState& other) {
  const std::string with = to_bytes(other);
  const auto differ = std::mismatch(bytes.begin(), bytes.end(), with.begin());
  return static_cast<std::size_t>(differ.first - bytes.begin()) / 8 * 8;
}

SessionState with_hand(const SessionState& state, const SkinHand& hand) {
  SkinState skin = *state.world.softs.skin;
  skin.hands[0][0] = hand;
  SessionState out = state;
  out.world.softs.skin = std::make_shared<const SkinState>(std::move(skin));
  return out;
}

// Version 28 of the state's bytes knew neither the place on a box nor how much of it presses, and
// no portals that were made in skin: the word that counts them, nor skin that is felt no more, nor
// cuts that are held open.
TEST(SkinPlate, AStateFromBeforeBoxesIsReadWithoutThem) {
  Session session = skin_run().session();
  SkinHandAt hand(session);
  hand.take(kSkinPlate, {0, 0, 0.010});
  hand.move({0.002, 0, -0.001}, 203);
  const SessionState state = session.save();
  const SkinHand now = state.world.softs.skin->hands[0][0];
  ASSERT_TRUE(now.near);
  SkinHand other_core = now, other_radius = now, in_wound = now, without = now;
  in_wound.in_wound = true;
  other_core.contact.core = Vec3(11, 12, 13);
  other_radius.radius_m = 14;
  without.contact.core = Vec3::Zero();
  without.radius_m = 0;
  std::string bytes = to_bytes(state);
  ASSERT_EQ(bytes[0], 38);
  const std::size_t core = first_other(bytes, with_hand(state, other_core));
  const std::size_t radius = first_other(bytes, with_hand(state, other_radius));
  const std::size_t wound = first_other(bytes, with_hand(state, in_wound));
  SkinState skin = *state.world.softs.skin;
  skin.patches[0].made_count = 1;
  SessionState with_portal = state;
  with_portal.world.softs.skin = std::make_shared<const SkinState>(std::move(skin));
  const std::size_t portals = first_other(bytes, with_portal);
  skin = *state.world.softs.skin;
  skin.bares = SkinBare::kPortals;
  SessionState bares = state;
  bares.world.softs.skin = std::make_shared<const SkinState>(std::move(skin));
  const std::size_t bare = first_other(bytes, bares);
  skin = *state.world.softs.skin;
  skin.patches[0].has_lips = true;
  SessionState lips = state;
  lips.world.softs.skin = std::make_shared<const SkinState>(std::move(skin));
  const std::size_t held = first_other(bytes, lips);
  ASSERT_LT(portals, held);
  ASSERT_LT(held, bare);
  ASSERT_LT(bare, core);
  ASSERT_LT(core, radius);
  ASSERT_LT(radius, wound);
  bytes.erase(wound, 8);
  bytes.erase(radius, 8);
  bytes.erase(core, 24);
  bytes.erase(bare, 8);
  bytes.erase(held, 16);
  bytes.erase(portals, 8);
  testing::erase_more_bands(bytes, state);
  bytes[0] = 28;
  const auto back = state_from_bytes(bytes);
  ASSERT_TRUE(back) << back.error().message();
  EXPECT_EQ(to_bytes(*back), to_bytes(with_hand(state, without)));
}

}  // namespace
}  // namespace osteon
