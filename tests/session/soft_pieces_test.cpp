// Pieces of a meniscus that were cut off in a session: a block on a bone, cut by a shipped blade.
#include <gtest/gtest.h>

#include <algorithm>

#include "driven_hand.h"
#include "osteon/physics/fallen_pieces.h"
#include "osteon/physics/soft_cut_state.h"
#include "osteon/physics/soft_world.h"
#include "osteon/scene/instrument.h"
#include "osteon/scene/soft_events.h"
#include "recorded_run.h"
#include "soft_solid_fixtures.h"

namespace osteon {
namespace {

using testing::begin_recording;
using testing::DrivenHand;
using testing::expect_same_replays;
using testing::go_on_as;
using testing::kMeniscusHalf;
using testing::posed;

enum : std::uint32_t { kPieceBall, kPieceBlade, kPieceGrasper, kPieceSuction };

// What falls off the block lands on the bone.
const Vec3 kFloorHalf(0.04, 0.04, 0.02);

struct PiecesRun : testing::MeniscusRun {
  explicit PiecesRun(bool lie = true, bool meet = false, bool tear = false, bool hook = false,
                     bool stop = false)
      : MeniscusRun(testing::meniscus_case(kFloorHalf)) {
    const auto instruments = load_instruments();
    EXPECT_TRUE(instruments);
    for (const char* name : {"scalpel_11", "grasper", "suction"}) {
      const Instrument* found = find_instrument(*instruments, name);
      settings.tray.emplace_back(name);
      tray.push_back(std::make_shared<const Tool>(make_tool(*found, found->usual_size)));
    }
    SoftSetup setup = *softs;
    auto cutters = make_solid_cutters(settings.tray);
    auto grippers = make_soft_grippers(settings.tray);
    auto pieces = make_pieces(*the_case, settings.tray);
    EXPECT_TRUE(cutters && grippers && pieces);
    if (cutters) add_cutters(setup, std::move(*cutters), 6);
    if (grippers) add_grippers(setup, std::move(*grippers));
    if (pieces && lie) add_pieces(setup, std::make_shared<const PiecesSetup>(std::move(*pieces)));
    if (meet) let_pieces_meet_softs(setup);
    if (tear) let_bridges_tear(setup);
    if (hook) let_hooks_tear_and_punches_bite(setup);
    if (stop) let_pieces_be_stopped(setup);
    if (stop) let_thin_parts_stop_pieces(setup);
    settings.soft_hash = setup.hash;
    softs = std::make_shared<const SoftSetup>(std::move(setup));
  }
};

const PiecesRun& pieces_run() {
  static const PiecesRun run;
  return run;
}

/// As sessions are made now: pieces lie on what is left of the block, too.
const PiecesRun& meeting_run() {
  static const PiecesRun run(true, true);
  return run;
}

/// And the block stops what jaws carry.
const PiecesRun& stopping_run() {
  static const PiecesRun run(true, true, false, false, true);
  return run;
}

/// And jaws tear off what little holds.
const PiecesRun& tearing_run() {
  static const PiecesRun run(true, true, true);
  return run;
}

const Quat kPieceUpright = posed({-1, 0, 0}, {0, 0, 1});  // the blade is drawn along y
const Quat kPieceFromEnd = posed({0, 0, 1}, {1, 0, 0});   // jaws that come from +x
const Quat kPieceFlat = posed({0, 0, 1}, {0, 1, 0});      // the blade is drawn along x
constexpr double kCut_m = 0.007, kLow_m = -0.003;
constexpr double kAway_m = 0.05;  // along x: no piece is near there

struct PieceHand : DrivenHand {
  explicit PieceHand(Session& s) : DrivenHand(s, {kAway_m, 0, 0.012}) { store_every = 250; }

  void take(std::uint32_t instrument, const Quat& pose, const Vec3& from) {
    at = from;
    q = pose;
    DrivenHand::take(instrument);
  }
  void jaws(double open) { tick({CommandKind::kJaw, open}); }
  // The top of the block's end, and away. Its bottom stays: the rim holds it.
  void cut_end_off() {
    until_it_comes_off();
    move({kCut_m, 0.012, kLow_m}, 500);
    rest(100);
    move({kAway_m, 0.012, kLow_m}, 50);
  }
  // A flat slit from the end, then one down to it.
  void until_it_comes_off() {
    const double flat = 0.0005;
    take(kPieceBlade, kPieceFlat, {0.022, -0.010, flat});
    move({kCut_m - 0.006, -0.010, flat}, 2000);
    take(kPieceBlade, kPieceUpright, {kCut_m, -0.012, kMeniscusHalf.z() + 0.002});
    move({kCut_m, -0.012, kLow_m}, 300);
    for (int n = 1; n <= 2000 && count(kSoftPiece) == 0; ++n)
      move({kCut_m, -0.012 + 0.024 * n / 2000, kLow_m}, 1);
  }
  Event first(EventKind kind) const {
    const auto found = std::find_if(events.begin(), events.end(),
                                    [&](const Event& event) { return event.kind == kind; });
    return found == events.end() ? Event{} : *found;
  }
};

std::span<const FallenPiece> lying(const Session& session) { return session.softs()->lying(); }

Vec3 middle_W(const FallenPiece& piece) { return piece.X_WB * piece.shape->middle_B(); }

// The end is cut off and lies on the bone.
Vec3 where_it_comes_to_rest(PieceHand& hand) {
  hand.cut_end_off();
  hand.rest(1500);
  const auto all = lying(hand.session);
  return all.empty() ? Vec3(Vec3::Zero()) : middle_W(all[0]);
}

// The bone lies 17 mm under the block; nothing holds what falls.
TEST(SoftPieces, WhatIsCutOffFallsAndComesToRest) {
  Session session = pieces_run().session();
  PieceHand hand(session);
  hand.cut_end_off();
  ASSERT_EQ(hand.count(kSoftPiece), 1u);
  ASSERT_EQ(lying(session).size(), 1u);
  const FallenPiece& piece = lying(session)[0];
  const double told_mm3 = hand.first(kSoftPiece).values[0];
  EXPECT_NEAR(1e9 * piece.shape->volume_m3(), told_mm3, 0.1 * told_mm3);
  // The block gives way under the blade: the flat slit lies lower or higher by up to a millimetre.
  EXPECT_GT(told_mm3, 5 * 16 * 1.5);
  EXPECT_LT(told_mm3, 5 * 16 * 3.5);
  const double slits_mm3 = 1e9 * session.softs()->removed_m3(0) - told_mm3;
  EXPECT_GT(slits_mm3, 0.3 * 16 * (5 + 2));
  EXPECT_LT(slits_mm3, 1.2 * 16 * (12 + 6));
  EXPECT_EQ(piece.soft, 0u);
  EXPECT_EQ(session.softs()->pieces(0), 1u);
  ASSERT_EQ(session.bones().loose.count, 1u);
  EXPECT_EQ(session.bones().loose.bones[0].soft, 0u);
  EXPECT_EQ(session.bones().loose.bones[0].shape, piece.shape->hash());
  ASSERT_EQ(session.softs()->pushes().piece_count, 1u);
  EXPECT_EQ(session.softs()->pushes().pieces[0], piece.shape);
  const auto surface = piece.shape->surface();
  ASSERT_TRUE(surface);
  hand.rest(1500);
  EXPECT_EQ(lying(session)[0].is, FallenPiece::Is::kResting);
  EXPECT_LT(middle_W(lying(session)[0]).z(), -0.004);
}

// The bottom of the block's end, which the rim holds, holds it up; an instrument that takes hold of
// it finds it there.
TEST(SoftPieces, WhatIsCutOffLiesOnWhatIsLeft) {
  EXPECT_NE(meeting_run().softs->hash, pieces_run().softs->hash);
  Session session = meeting_run().session();
  PieceHand hand(session);
  const Vec3 at = where_it_comes_to_rest(hand);
  ASSERT_EQ(lying(session).size(), 1u);
  EXPECT_EQ(lying(session)[0].is, FallenPiece::Is::kResting);
  EXPECT_GT(at.z(), 0.0005);
  EXPECT_LT(at.z(), kMeniscusHalf.z());
  double least_m = 1;
  for (const Vec3& p_B : lying(session)[0].shape->points_B())
    least_m = std::min(least_m, (lying(session)[0].X_WB * p_B).z());
  EXPECT_GT(least_m, -0.0015) << "the slit lies up to a millimetre lower than it was led";
}

TEST(SoftPieces, AStateKeepsOneThatLiesOnASoftPartAndAReplayIsTheSame) {
  const PiecesRun& run = meeting_run();
  Session session = run.session();
  Recording recording = begin_recording(run);
  PieceHand hand(session);
  hand.into = &recording;
  hand.until_it_comes_off();
  hand.rest(300);
  ASSERT_EQ(lying(session).size(), 1u);
  Session other = run.session();
  (void)go_on_as(other, session);
  PieceHand second(other);
  second.at = hand.at;
  second.q = hand.q;
  for (PieceHand* h : {&hand, &second}) h->rest(400);
  EXPECT_EQ(other.state_hash(), session.state_hash());
  expect_same_replays(recording, run, session, {0.0, 2.0});
}

// Cut through from top to bottom its two sides hang on the rim, each on its own.
TEST(SoftPieces, WhatTheRimHoldsDoesNotComeOff) {
  Session session = pieces_run().session();
  PieceHand hand(session);
  hand.take(kPieceBlade, kPieceUpright, {0.004, -0.012, kMeniscusHalf.z() + 0.002});
  hand.move({0.004, -0.012, kMeniscusHalf.z() - 0.009}, 300);
  hand.move({0.004, 0.012, kMeniscusHalf.z() - 0.009}, 2000);
  hand.rest(100);
  EXPECT_EQ(hand.count(kSoftPiece), 0u);
  EXPECT_LT(1e9 * session.softs()->removed_m3(0), 0.8 * 16 * 6);
  EXPECT_GT(1e9 * session.softs()->removed_m3(0), 0.4 * 16 * 6);
}

TEST(SoftPieces, WithoutASetUpForThemTheyAreGone) {
  const PiecesRun run(false);
  EXPECT_NE(run.softs->hash, pieces_run().softs->hash);
  Session session = run.session();
  PieceHand hand(session);
  hand.cut_end_off();
  EXPECT_EQ(hand.count(kSoftPiece), 1u);
  EXPECT_TRUE(lying(session).empty());
  EXPECT_EQ(session.bones().loose.count, 0u);
}

// Jaws hold the end of a block that no rim holds, as it is cut off: they have the piece. The cuts
// are those of another session, up to the step before the piece was found.
TEST(SoftPieces, WhatJawsHoldAsItComesOffTheyHave) {
  PiecesRun run;
  SoftSetup setup = *run.softs;
  setup.solids[0].hangs = nullptr;
  run.softs = std::make_shared<const SoftSetup>(std::move(setup));
  std::shared_ptr<const SoftCutState> cuts;
  {
    Session cutting = run.session();
    PieceHand blade(cutting);
    const double low = kMeniscusHalf.z() - 0.009;
    blade.take(kPieceBlade, kPieceUpright, {0.006, -0.012, kMeniscusHalf.z() + 0.002});
    blade.move({0.006, -0.012, low}, 300);
    for (int n = 1; n <= 2000 && cutting.softs()->pieces(0) == 0; ++n) {
      cuts = cutting.save().world.softs.cut;
      blade.move({0.006, -0.012 + 0.024 * n / 2000, low}, 1);
    }
    ASSERT_EQ(cutting.softs()->pieces(0), 1u);
  }
  Session session = run.session();
  PieceHand hand(session);
  hand.take(kPieceGrasper, kPieceFromEnd, {0.030, 0, 0});
  hand.jaws(1);
  hand.move({0.0075, 0, 0}, 300);
  hand.jaws(0);
  hand.rest(150);
  ASSERT_EQ(hand.count(kSoftHeld), 1u);
  SessionState state = session.save();
  state.world.softs.cut = cuts;
  ASSERT_TRUE(session.restore(state));
  hand.rest(100);
  ASSERT_EQ(hand.count(kSoftPiece), 1u);
  ASSERT_EQ(lying(session).size(), 1u);
  EXPECT_EQ(lying(session)[0].is, FallenPiece::Is::kHeld);
  EXPECT_EQ(hand.count(kSoftFreed), 1u);
  // It goes where the hand goes, and no meniscus pulls at it.
  const Vec3 before = middle_W(lying(session)[0]);
  hand.move(hand.at + Vec3(0.020, 0, 0.010), 200);
  hand.rest(50);
  EXPECT_LT((middle_W(lying(session)[0]) - before - Vec3(0.020, 0, 0.010)).norm(), 1e-4);
  EXPECT_LT(session.tool_state().force_W.norm(), 0.05);
  hand.jaws(1);
  hand.rest(10);
  EXPECT_EQ(hand.count(kSoftPieceLetGo), 1u);
  EXPECT_EQ(hand.first(kSoftPieceLetGo).subject, 0u);
  EXPECT_NE(lying(session)[0].is, FallenPiece::Is::kHeld);
}

void pick_up_what_lies(PieceHand& hand, const Session& session) {
  const Vec3 at = where_it_comes_to_rest(hand);
  ASSERT_EQ(lying(session).size(), 1u);
  hand.take(kPieceGrasper, Quat::Identity(), {at.x(), at.y(), at.z() + 0.030});
  hand.jaws(1);
  hand.move({at.x(), at.y(), at.z()}, 300);
  hand.jaws(0);
  hand.rest(20);
  ASSERT_EQ(hand.count(kSoftPieceHeld), 1u);
}

// Picked up from where it lies, carried off and let go beyond all bones: it is out.
TEST(SoftPieces, JawsTakeOneThatLiesAndCarryItOut) {
  Session session = pieces_run().session();
  PieceHand hand(session);
  ASSERT_NO_FATAL_FAILURE(pick_up_what_lies(hand, session));
  hand.move(hand.at + Vec3(0, 0, 0.060), 300);
  hand.move({0.3, 0, 0.06}, 600);
  EXPECT_EQ(lying(session)[0].is, FallenPiece::Is::kHeld);
  hand.jaws(1);
  hand.rest(200);
  EXPECT_EQ(hand.count(kSoftPieceOut), 1u);
  EXPECT_TRUE(lying(session).empty());
  EXPECT_EQ(session.bones().loose.count, 0u);
}

// How much of a piece's surface lies in the whole end of the block.
double share_in_block(const FallenPiece& piece) {
  const auto& points = piece.shape->points_B();
  const auto is_inside = [&](const Vec3& p_B) {
    return ((piece.X_WB * p_B).cwiseAbs() - kMeniscusHalf).maxCoeff() < -3e-4;
  };
  return static_cast<double>(std::count_if(points.begin(), points.end(), is_inside)) /
         static_cast<double>(points.size());
}

// Carried against the whole end of the block, too thin for anything to stand 3 mm deep in it, it
// slips from the jaws as half of it is inside; where nothing stops it, it goes on into the block.
TEST(SoftPieces, WhatJawsCarrySlipsFromThemAtASoftPart) {
  for (const PiecesRun* const run : {&stopping_run(), &meeting_run()}) {
    const bool stopped = run == &stopping_run();
    Session session = run->session();
    PieceHand hand(session);
    ASSERT_NO_FATAL_FAILURE(pick_up_what_lies(hand, session)) << stopped;
    // Up, beside the whole end of the block, and down to its height.
    hand.move(hand.at + Vec3(0, 0, 0.020), 300);
    hand.move({hand.at.x() - 0.045, 0, hand.at.z()}, 500);
    hand.move(hand.at - Vec3(0, 0, 0.020), 300);
    hand.move({hand.at.x(), 0, hand.at.z() - middle_W(lying(session)[0]).z()}, 300);
    ASSERT_EQ(lying(session)[0].is, FallenPiece::Is::kHeld) << stopped;
    EXPECT_EQ(share_in_block(lying(session)[0]), 0);
    double share = 0;
    for (int n = 0; n < 1000 && lying(session)[0].is == FallenPiece::Is::kHeld; ++n) {
      share = share_in_block(lying(session)[0]);
      hand.move(hand.at + Vec3(3.5e-5, 0, 0), 1);
    }
    hand.rest(10);
    EXPECT_EQ(hand.count(kSoftPieceLetGo), stopped ? 1u : 0u);
    if (stopped)
      EXPECT_NEAR(share, 0.5, 0.05);
    else
      EXPECT_GT(share, 0.7);
  }
}

TEST(SoftPieces, ItSticksToSuctionThatIsNarrowerThanItIs) {
  Session session = pieces_run().session();
  PieceHand hand(session);
  const Vec3 at = where_it_comes_to_rest(hand);
  ASSERT_EQ(lying(session).size(), 1u);
  hand.take(kPieceSuction, Quat::Identity(), {at.x(), at.y(), at.z() + 0.030});
  hand.tick({CommandKind::kPower, 1});
  hand.move({at.x(), at.y(), at.z() + 0.0035}, 400);
  hand.rest(100);
  ASSERT_EQ(lying(session).size(), 1u);
  ASSERT_EQ(lying(session)[0].is, FallenPiece::Is::kHeld);
  EXPECT_TRUE(lying(session)[0].drawn);
  hand.tick({CommandKind::kPower, 0});
  hand.rest(10);
  EXPECT_EQ(hand.count(kSoftPieceLetGo), 1u);
}

TEST(SoftPieces, UndoBringsTheWholeBack) {
  Session session = pieces_run().session();
  PieceHand hand(session);
  hand.rest(10);
  hand.tick({CommandKind::kMark, 0});
  hand.rest(10);
  hand.cut_end_off();
  ASSERT_EQ(lying(session).size(), 1u);
  hand.tick({CommandKind::kMark, 1});
  hand.rest(200);
  hand.tick({CommandKind::kRestore, 0});
  hand.rest(10);
  EXPECT_TRUE(lying(session).empty());
  EXPECT_EQ(session.bones().loose.count, 0u);
  EXPECT_EQ(session.softs()->removed_m3(0), 0);
  hand.tick({CommandKind::kRestore, 1});
  hand.rest(10);
  EXPECT_EQ(lying(session).size(), 1u);
}

TEST(SoftPieces, AStateKeepsThemAndAReplayIsTheSame) {
  const PiecesRun& run = pieces_run();
  Session session = run.session();
  Recording recording = begin_recording(run);
  PieceHand hand(session);
  hand.into = &recording;
  hand.until_it_comes_off();
  hand.rest(20);  // it falls
  ASSERT_EQ(lying(session).size(), 1u);
  ASSERT_EQ(lying(session)[0].is, FallenPiece::Is::kMoving);
  Session other = run.session();
  (void)go_on_as(other, session);
  PieceHand second(other);
  second.at = hand.at;
  second.q = hand.q;
  for (PieceHand* h : {&hand, &second}) h->rest(400);
  EXPECT_EQ(other.state_hash(), session.state_hash());
  expect_same_replays(recording, run, session, {0.0, 2.0});
}

TEST(SoftPieces, StatesThatCannotBeAreRefused) {
  Session session = pieces_run().session();
  PieceHand hand(session);
  hand.cut_end_off();
  const SessionState good = session.save();
  ASSERT_TRUE(good.world.softs.pieces);
  ASSERT_EQ(good.world.softs.pieces->pieces.size(), 1u);
  const auto with = [&](const std::function<void(FallenPiecesState&)>& change) {
    SessionState state = good;
    FallenPiecesState pieces = *state.world.softs.pieces;
    change(pieces);
    state.world.softs.pieces = std::make_shared<const FallenPiecesState>(std::move(pieces));
    return session.restore(state).has_value();
  };
  EXPECT_TRUE(with([](FallenPiecesState&) {}));
  EXPECT_FALSE(with([](FallenPiecesState& s) { s.pieces[0].soft = 1; }));
  EXPECT_FALSE(with([](FallenPiecesState& s) { s.pieces[0].soft = kNoSoftPart; }));
  EXPECT_FALSE(with([](FallenPiecesState& s) { s.pieces[0].hand = 2; }));
  EXPECT_FALSE(with(
      [](FallenPiecesState& s) { s.pieces.resize(kMaxLooseSofts + 1, FallenPiece(s.pieces[0])); }));
}

constexpr double kNarrow_m = 0.0007;

// The top of the block's end hangs by what the blade has left, `left_m` wide.
void cut_flap(PieceHand& hand, double left_m) {
  const double flat = 0.0005;
  hand.take(kPieceBlade, kPieceFlat, {0.022, -0.010, flat});
  hand.move({kCut_m - 0.006, -0.010, flat}, 2000);
  // The blade widens upwards: over the slit its edge is 1.45 mm ahead of its tip, in the mean.
  const double end = kMeniscusHalf.y() - left_m - 0.00145;
  hand.take(kPieceBlade, kPieceUpright, {kCut_m, -0.012, kMeniscusHalf.z() + 0.002});
  hand.move({kCut_m, -0.012, kLow_m}, 300);
  hand.move({kCut_m, end, kLow_m}, 2000);
  hand.move({kCut_m, end, kMeniscusHalf.z() + 0.010}, 300);
  hand.rest(1500);  // the stiffness follows
}

// And jaws that come from the end hold it.
void hold_flap(PieceHand& hand, double left_m) {
  cut_flap(hand, left_m);
  const double over = kMeniscusHalf.z() + 0.0055;  // no more than the flap is in their mouth
  hand.take(kPieceGrasper, kPieceFromEnd, {kAway_m, 0, over});
  hand.jaws(1);
  hand.move({0.009, 0, over}, 300);
  hand.jaws(0);
  hand.rest(150);
}

// Pulled, a flap tears off at its bridge's section times what tissue bears, and the jaws have it.
TEST(SoftPieces, JawsTearAFlapOffWhereLittleOfItIsLeft) {
  Session session = tearing_run().session();
  PieceHand hand(session);
  hold_flap(hand, kNarrow_m);
  ASSERT_EQ(hand.count(kSoftHeld), 1u);
  ASSERT_EQ(hand.count(kSoftPiece), 0u);
  const double before = session.softs()->removed_m3(0);
  for (int n = 0; n < 3500 && hand.count(kSoftTorn) == 0; ++n)
    hand.move(hand.at + Vec3(5e-6, 0, 5e-6), 1);
  ASSERT_EQ(hand.count(kSoftTorn), 1u);
  const Event torn = hand.first(kSoftTorn);
  EXPECT_EQ(tearing_run().the_case->softs[torn.subject].name, "medial_meniscus");
  EXPECT_EQ(torn.hand, 0);
  // 2 MPa on a bridge 2.5 mm high, give or take a node of its width.
  EXPECT_NEAR(torn.values[0], 2e6 * kNarrow_m * 0.0025, 2e6 * 0.0003 * 0.0025);
  EXPECT_GE(torn.values[1], torn.values[0]);
  EXPECT_LT(torn.values[1], torn.values[0] + 1);
  EXPECT_LT((torn.p_W - Vec3(kCut_m, 0.0072, 0.0018)).norm(), 0.003);
  hand.rest(100);
  ASSERT_EQ(hand.count(kSoftPiece), 1u);
  EXPECT_EQ(hand.count(kSoftPieceHeld), 1u);
  EXPECT_GT(session.softs()->removed_m3(0), before);
  ASSERT_EQ(lying(session).size(), 1u);
  hand.move({kAway_m, 0, 0.010}, 200);
  EXPECT_GT(middle_W(lying(session)[0]).x(), 0.03);
}

// Wider, it bears what the jaws can pull; and before jaws tore anything none tore.
TEST(SoftPieces, AFlapThatHangsByMoreIsNotTornOff) {
  for (const bool wide : {true, false}) {
    Session session = wide ? tearing_run().session() : meeting_run().session();
    PieceHand hand(session);
    hold_flap(hand, wide ? 0.009 : kNarrow_m);
    ASSERT_EQ(hand.count(kSoftHeld), 1u);
    for (int n = 0; n < 8000 && hand.count(kSoftSlipped) == 0; ++n)
      hand.move(hand.at + Vec3(5e-6, 0, 5e-6), 1);
    EXPECT_EQ(hand.count(kSoftSlipped), 1u) << wide;
    EXPECT_EQ(hand.count(kSoftTorn), 0u) << wide;
    EXPECT_EQ(hand.count(kSoftPiece), 0u) << wide;
  }
}

/// And so does a hook.
const PiecesRun& hooking_run() {
  static const PiecesRun run(true, true, true, true);
  return run;
}

// A ball that pushes the flap's free side along y, where no bone is behind it, until it tears off
// or the ball is `far_m` on.
void push_flap_aside(PieceHand& hand, double far_m) {
  const Vec3 beside(kCut_m + 0.0025, -kMeniscusHalf.y() - 0.003, 0.0019);
  hand.take(kPieceBall, Quat::Identity(), beside + Vec3(0, -0.010, 0.020));
  hand.move(beside, 200);
  for (int n = 0; n < far_m / 5e-6 && hand.count(kSoftTorn) == 0; ++n)
    hand.move(hand.at + Vec3(0, 5e-6, 0), 1);
}

// As jaws do: at its bridge's section times what tissue bears; what comes off lies loose.
TEST(SoftPieces, AHookTearsAFlapOffWhereLittleOfItIsLeft) {
  EXPECT_NE(hooking_run().softs->hash, tearing_run().softs->hash);
  Session session = hooking_run().session();
  PieceHand hand(session);
  cut_flap(hand, kNarrow_m);
  push_flap_aside(hand, 0.018);
  ASSERT_EQ(hand.count(kSoftTorn), 1u);
  const Event torn = hand.first(kSoftTorn);
  EXPECT_EQ(torn.hand, 0);
  EXPECT_NEAR(torn.values[0], 2e6 * kNarrow_m * 0.0025, 2e6 * 0.0003 * 0.0025);
  EXPECT_GE(torn.values[1], torn.values[0]);
  EXPECT_LT(torn.values[1], torn.values[0] + 1);
  hand.rest(100);
  EXPECT_EQ(hand.count(kSoftPiece), 1u);
  EXPECT_EQ(hand.count(kSoftPieceHeld), 0u);
  ASSERT_EQ(lying(session).size(), 1u);
}

// One that hangs by more gives way and stays; so does the narrow one where hooks tear nothing.
TEST(SoftPieces, AHookTearsNoFlapThatHangsByMore) {
  for (const bool wide : {true, false}) {
    Session session = wide ? hooking_run().session() : tearing_run().session();
    PieceHand hand(session);
    cut_flap(hand, wide ? 0.009 : kNarrow_m);
    push_flap_aside(hand, 0.010);
    EXPECT_EQ(hand.count(kSoftTorn), 0u) << wide;
    EXPECT_EQ(hand.count(kSoftPiece), 0u) << wide;
    EXPECT_GT(hand.count(kSoftBegin), 0u) << wide;
  }
}

// Pressed onto what is left of the block it is not pulled, however hard.
TEST(SoftPieces, AFlapThatIsPressedOnWhatLiesUnderItIsNotTornOff) {
  Session session = hooking_run().session();
  PieceHand hand(session);
  cut_flap(hand, kNarrow_m);
  hand.take(kPieceBall, Quat::Identity(), {kCut_m + 0.0025, 0, 0.030});
  hand.move({kCut_m + 0.0025, 0, 0.006}, 200);
  double most_n = 0;
  for (int n = 0; n < 4000; ++n) {
    hand.move(hand.at - Vec3(0, 0, 5e-6), 1);
    most_n = std::max(most_n, session.softs()->solid_readout(0).force_n[0]);
  }
  EXPECT_GT(most_n, 1.2 * 2e6 * kNarrow_m * 0.0025);
  EXPECT_EQ(hand.count(kSoftTorn), 0u);
}

TEST(SoftPieces, AFlapThatAHookTearsOffReplaysTheSame) {
  Session session = hooking_run().session();
  Recording recording = begin_recording(hooking_run());
  PieceHand hand(session);
  hand.into = &recording;
  cut_flap(hand, kNarrow_m);
  push_flap_aside(hand, 0.018);
  hand.rest(100);
  ASSERT_EQ(hand.count(kSoftTorn), 1u);
  expect_same_replays(recording, hooking_run(), session, {0.0, 5.0, 7.0});
}

TEST(SoftPieces, AFlapTornOffReplaysTheSameFromTheStartAndFromTheMiddle) {
  Session session = tearing_run().session();
  Recording recording = begin_recording(tearing_run());
  PieceHand hand(session);
  hand.into = &recording;
  hold_flap(hand, kNarrow_m);
  hand.move(hand.at + Vec3(0.0165, 0, 0.0165), 3300);
  hand.rest(100);
  ASSERT_EQ(hand.count(kSoftTorn), 1u);
  ASSERT_EQ(hand.count(kSoftPieceHeld), 1u);
  expect_same_replays(recording, tearing_run(), session, {0.0, 7.0, 9.5});
}

}  // namespace
}  // namespace osteon
