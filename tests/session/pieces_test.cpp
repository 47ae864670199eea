// Bone that is cut off in a session falls off, and what is left weighs less.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "drilling.h"
#include "osteon/carve/removed.h"
#include "osteon/physics/soft_setup.h"
#include "osteon/scene/carve_events.h"

namespace osteon {
namespace {

using testing::Drilling;
using testing::kTop_m;

// The block of 10 x 10 x 8 mm is sawn through with a burr of 1 mm at that height, as if it had been
// done before.
std::shared_ptr<CarvingState> sawn_through(const Drilling& with, double z_m) {
  Carving carving(with.setup, 1, with.settings.haptic.stiffness_n_per_m);
  CarvedField field = *carving.field(0);
  const auto burr = make_cutter("burr", 0.001);
  EXPECT_TRUE(burr);
  for (double y = -0.006; y <= 0.0061; y += 0.0004)
    (void)field.cut(*burr, {Vec3(-0.007, y, z_m), Quat::Identity()},
                    {Vec3(0.007, y, z_m), Quat::Identity()});
  auto state = std::make_shared<CarvingState>(carving.save());
  state->bones[0] = field.save();
  return state;
}

void put_carved(Session& session, std::shared_ptr<const CarvingState> carved) {
  SessionState state = session.save();
  state.world.carved = std::move(carved);
  ASSERT_TRUE(session.restore(state));
}

std::vector<Event> rest_above(Session& session, int ticks) {
  std::vector<Event> events;
  for (int n = 0; n < ticks; ++n) {
    const HandInput hand = testing::down_at(0, 0);
    (void)session.tick(std::span(&hand, 1));
    for (const Event& event : session.last_events()) events.push_back(event);
  }
  return events;
}

TEST(CarvedPieces, WhatIsSawnOffFallsOffAndIsTold) {
  const Drilling with;
  Session session = with.session();
  put_carved(session, sawn_through(with, 0.002));
  EXPECT_EQ(session.bones().loose.count, 0u);
  const double sawn = 1e9 * total(removed_volume(*session.carving()->field(0)));
  const auto events = rest_above(session, 300);
  const auto told = std::find_if(events.begin(), events.end(),
                                 [](const Event& e) { return e.kind == kPieceOff; });
  ASSERT_NE(told, events.end());
  EXPECT_NEAR(told->values[0], 10 * 10 * 1.5, 35);  // by nodes 0.4 mm apart
  EXPECT_NEAR(1e9 * total(removed_volume(*session.carving()->field(0))), sawn + 150, 5);
  EXPECT_EQ(std::count_if(events.begin(), events.end(),
                          [](const Event& e) { return e.kind == kPieceOff; }),
            1);
  // It lies on what is left, as far under its old place as the burr was wide.
  ASSERT_EQ(session.bones().loose.count, 1u);
  ASSERT_EQ(session.carving()->pieces().size(), 1u);
  const FallenPiece& piece = session.carving()->pieces()[0];
  EXPECT_NEAR(1e9 * piece.shape->volume_m3(), 150, 35);
  EXPECT_NEAR(piece.X_WB.p.z(), -0.001, 3e-4);
  EXPECT_LT(piece.X_WB.p.head<2>().norm(), 3e-4);
  EXPECT_NEAR(session.carving()->mass_kg(piece, 0.01), 0.01 * 1.5 / 8, 0.0005);
  // A hand meets what is left, 2.5 mm under where the top was.
  for (int n = 1; n <= 500; ++n) {
    HandInput hand = testing::down_at(static_cast<std::uint64_t>(n), 0, 0.02, 0.004);
    (void)session.tick(std::span(&hand, 1));
  }
  EXPECT_NEAR(session.tool_state().X_WP.p.z(), kTop_m - 0.0025, 2e-4);
}

// An osteotome of 12 mm goes down through the block, which is 10 mm wide. Its edge is thinner than
// the field's cells: only where the whole blade went through is the block in two.
TEST(CarvedPieces, ABladeThatComesOutBelowHasCutTheBlockInTwo) {
  const Drilling with("osteotome:12");
  Session session = with.session();
  std::vector<Event> events;
  for (std::uint64_t n = 0; n < 9000; ++n) {
    const HandInput hand = testing::down_at(n, 1, 0.004, 0.020);
    (void)session.tick(std::span(&hand, 1));
    for (const Event& event : session.last_events()) events.push_back(event);
  }
  const auto count = [&](EventKind kind) {
    return std::count_if(events.begin(), events.end(),
                         [&](const Event& e) { return e.kind == kind; });
  };
  EXPECT_EQ(count(kBreached), 1);
  ASSERT_EQ(count(kPieceOff), 1);
  EXPECT_LT(session.tool_state().X_WP.p.z(), -0.010);
  // The blade is 2 mm thick and stands off the middle by 0.2 mm: 3.8 mm are left on one side.
  const auto off = std::find_if(events.begin(), events.end(),
                                [](const Event& e) { return e.kind == kPieceOff; });
  EXPECT_NEAR(off->values[0], 10 * 3.8 * 8, 40);
}

// The look for pieces comes with certain steps: from a state between two of them it is the same.
TEST(CarvedPieces, FromAStateOnTheWayTheSameFalls) {
  const Drilling with;
  Session session = with.session();
  put_carved(session, sawn_through(with, 0.002));
  rest_above(session, 61);
  const auto back = state_from_bytes(to_bytes(session.save()));
  ASSERT_TRUE(back) << back.error().message();
  Session other = with.session();
  ASSERT_TRUE(other.restore(*back));
  rest_above(session, 200);
  rest_above(other, 200);
  EXPECT_EQ(other.state_hash(), session.state_hash());
  const auto later = state_from_bytes(to_bytes(session.save()));
  ASSERT_TRUE(later);
  ASSERT_TRUE(other.restore(*later));
  rest_above(session, 200);
  rest_above(other, 200);
  EXPECT_EQ(other.state_hash(), session.state_hash());
}

TEST(CarvedPieces, ARestorePointPutsAPieceBack) {
  const Drilling with;
  Session session = with.session();
  put_carved(session, sawn_through(with, 0.002));
  HandInput hand = testing::down_at(0, 0);
  hand.command = {CommandKind::kMark, 1};
  (void)session.tick(std::span(&hand, 1));
  rest_above(session, 300);
  ASSERT_EQ(session.bones().loose.count, 1u);
  hand.command = {CommandKind::kRestore, 1};
  (void)session.tick(std::span(&hand, 1));
  rest_above(session, 3);
  EXPECT_EQ(session.bones().loose.count, 0u);
  rest_above(session, 300);
  EXPECT_EQ(session.bones().loose.count, 1u);
}

// The stored bytes hold the piece's shape; damaged ones are refused.
TEST(CarvedPieces, AStoredStateHoldsThePiece) {
  const Drilling with;
  Session session = with.session();
  put_carved(session, sawn_through(with, 0.002));
  rest_above(session, 150);
  const std::string bytes = to_bytes(session.save());
  const auto back = state_from_bytes(bytes);
  ASSERT_TRUE(back) << back.error().message();
  const auto& pieces = back->world.carved->pieces.pieces;
  ASSERT_EQ(pieces.size(), 1u);
  EXPECT_EQ(pieces[0].shape->hash(), session.carving()->pieces()[0].shape->hash());
  EXPECT_EQ(to_bytes(*back), bytes);
  for (std::size_t cut = 8; cut < bytes.size(); cut += bytes.size() / 97)
    EXPECT_FALSE(state_from_bytes(std::string_view(bytes).substr(0, cut))) << cut;
}

// Half of the block sawn off along its lower half's top: mass and centre are those of the rest.
TEST(CarvedPieces, ABoneLosesTheMassOfWhatIsGone) {
  const Drilling with;
  Session session = with.session();
  put_carved(session, sawn_through(with, 0.0005));
  rest_above(session, 300);
  Carving carving(with.setup, 1, with.settings.haptic.stiffness_n_per_m);
  EXPECT_EQ(carving.loss(0, 0.01).mass_kg, 0);
  carving.restore(*session.save().world.carved);
  const BoneLoss loss = carving.loss(0, 0.01);
  EXPECT_NEAR(loss.mass_kg, 0.005, 0.0003);
  EXPECT_LT((loss.first_B / loss.mass_kg - Vec3(0, 0, 0.002)).norm(), 3e-4);
  const double xx = loss.mass_kg * 0.01 * 0.01 / 12, zz = loss.mass_kg * 0.004 * 0.004 / 3;
  EXPECT_NEAR(loss.second_B(0, 0), xx, 0.06 * xx);
  EXPECT_NEAR(loss.second_B(2, 2), zz, 0.15 * zz);
}

// Beside the block a ligament lies under its overhang: the plate that is sawn off falls onto it.
struct OverBand : Drilling {
  double z_m = -0.002;  ///< of the ligament's middle, under the plate's place
  explicit OverBand(bool stopped) {
    auto softs = std::make_shared<SoftSetup>();
    SoftBand band;
    band.name = "band";
    band.from = band.to = BoneId{0};
    band.from_B = {0.012, -0.030, z_m};
    band.to_B = {0.012, 0.030, z_m};
    band.radius_m = 0.002;
    softs->bands.push_back(band);
    band.from_B.x() = band.to_B.x() = 0.018;
    softs->bands.push_back(band);
    softs->hash = hash_of(softs->bands);
    if (stopped) let_pieces_be_stopped(*softs);
    settings.soft = {"ligaments"};
    settings.soft_hash = softs->hash;
    on = std::move(softs);
  }
  std::shared_ptr<const SoftSetup> on;
  Session soft_session() const { return Session(the_case, settings, tray, setup, on); }
};

// The plate, put over the two ligaments beside the block, falls: onto them where pieces meet soft
// parts, past them where not.
TEST(CarvedPieces, APieceOfBoneComesToRestOnSoftParts) {
  for (const bool stopped : {true, false}) {
    const OverBand with(stopped);
    Session session = with.soft_session();
    put_carved(session, sawn_through(with, 0.002));
    (void)rest_above(session, 100);
    ASSERT_EQ(session.carving()->pieces().size(), 1u);
    SessionState state = session.save();
    auto carved = std::make_shared<CarvingState>(*state.world.carved);
    FallenPiece& piece = carved->pieces.pieces[0];
    piece.X_WB.p += Vec3(0.015, 0, 0.001);
    piece.is = FallenPiece::Is::kMoving;
    state.world.carved = carved;
    ASSERT_TRUE(session.restore(state));
    (void)rest_above(session, 1000);
    ASSERT_EQ(session.carving()->pieces().size(), stopped ? 1u : 0u);  // else it fell out of sight
    if (!stopped) continue;
    const FallenPiece& lies = session.carving()->pieces()[0];
    EXPECT_EQ(lies.is, FallenPiece::Is::kResting);
    double lowest = 1;
    for (const Vec3& p_B : lies.shape->points_B()) lowest = std::min(lowest, (lies.X_WB * p_B).z());
    EXPECT_NEAR(lowest, with.z_m + 0.002, 5e-4);
    // Cut away, they hold it no more; and a state of it goes on the same.
    Session other = with.soft_session();
    ASSERT_TRUE(other.restore(session.save()));
    (void)rest_above(session, 100);
    (void)rest_above(other, 100);
    EXPECT_EQ(other.state_hash(), session.state_hash());
  }
}

}  // namespace
}  // namespace osteon
