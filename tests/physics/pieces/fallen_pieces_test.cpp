#include "osteon/physics/fallen_pieces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "physics/physics_fixtures.h"
#include "pieces/piece_surroundings.h"

namespace osteon {
namespace {

constexpr double kPieceStep_s = 0.002, kPieceCell_m = 0.00025;

template <class Height>
std::shared_ptr<const PieceShape> piece_of(double half_m, const Height& height_m) {
  PieceGrid grid;
  grid.cell_m = kPieceCell_m;
  const int half = static_cast<int>(std::ceil(half_m / kPieceCell_m)) + 2;
  grid.nodes = {2 * half + 1, 2 * half + 1, 2 * half + 1};
  grid.lo_B = -kPieceCell_m * Vec3(half, half, half);
  for (int k = -half; k <= half; ++k)
    for (int j = -half; j <= half; ++j)
      for (int i = -half; i <= half; ++i)
        grid.heights.push_back(static_cast<std::int16_t>(
            std::lround(1e6 * height_m(Vec3(kPieceCell_m * Vec3(i, j, k))))));
  return PieceShape::from(std::move(grid));
}

std::shared_ptr<const PieceShape> ball_piece(double radius_m) {
  return piece_of(radius_m, [=](const Vec3& p) { return p.norm() - radius_m; });
}

std::shared_ptr<const PieceShape> cube_piece(double half_m) {
  return piece_of(half_m, [=](const Vec3& p) { return p.cwiseAbs().maxCoeff() - half_m; });
}

// A table of 60 x 60 x 10 mm whose top is z = 0 in its own frame, turned about y.
std::shared_ptr<const Case> table(double slope_deg = 0) {
  auto the_case = std::make_shared<Case>();
  the_case->name = "table";
  Bone bone;
  bone.name = "table";
  Hull hull = testing::box_hull({0, 0, -0.005}, {0.03, 0.03, 0.005});
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {-1.0, 1.0}) {
      const Vec3 n = sign * Vec3::Unit(axis);
      hull.planes.push_back({n, axis < 2 ? 0.03 : (sign > 0 ? 0.0 : 0.01)});
    }
  bone.mesh = to_mesh(hull);
  bone.pieces = {hull};
  const double a = slope_deg * std::numbers::pi / 180;
  bone.X_WB.q = Quat(std::cos(a / 2), 0, std::sin(a / 2), 0);
  the_case->bones.push_back(bone);
  return the_case;
}

struct PieceRig {
  explicit PieceRig(std::shared_ptr<const Case> c, std::vector<std::string> tray = {"grasper"})
      : the_case(std::move(c)),
        setup(std::make_shared<const PiecesSetup>(make_pieces(*the_case, tray).value())),
        pieces(setup),
        bones(rest_snapshot(*the_case)) {
    tool.X_WP.p = Vec3(0, 0, 1);
  }
  void add(std::shared_ptr<const PieceShape> shape, const Vec3& middle_W,
           const Quat& q = Quat::Identity()) {
    EXPECT_TRUE(pieces.add(std::move(shape), {middle_W, q}));
  }
  void step(int count = 1) {
    const ToolState* const tools[] = {&tool};
    for (int n = 0; n < count; ++n) pieces.step(tools, bones, {}, false, kPieceStep_s);
  }
  // The tool goes there in steps of 0.1 mm.
  void go(const Vec3& to) {
    const Vec3 from = tool.X_WP.p;
    const int n = std::max(1, static_cast<int>((to - from).norm() / 0.0001));
    for (int k = 1; k <= n; ++k) {
      tool.X_WP.p = from + (to - from) * (double(k) / n);
      step();
    }
  }
  // A cube of 2 mm comes to rest, and the mouth of open jaws is put about it.
  void lay_before_jaws() {
    add(cube_piece(0.001), Vec3(0, 0, 0.001));
    step(300);
    const SoftGripper& jaws = *setup->tray.front().jaws;
    tool.X_WP.p = middle() - (jaws.hinge_T + 0.6 * jaws.length_m * jaws.along_T);
  }
  void set_jaw(double opening) {
    tool.jaw = opening;
    step();
  }
  const FallenPiece& piece(std::size_t i = 0) const { return pieces.state().pieces.at(i); }
  Vec3 middle(std::size_t i = 0) const { return piece(i).X_WB * piece(i).shape->middle_B(); }
  bool told(PieceNews::Is is) const {
    return std::any_of(pieces.news().begin(), pieces.news().end(),
                       [&](const PieceNews& news) { return news.is == is; });
  }

  std::shared_ptr<const Case> the_case;
  std::shared_ptr<const PiecesSetup> setup;
  FallenPieces pieces;
  BoneSnapshot bones;
  ToolState tool;
};

Quat about(double rad, const Vec3& axis) {
  return Quat(Eigen::AngleAxisd(rad, Vec3(axis.normalized())));
}

TEST(FallenPieces, WithoutPiecesNothingHappens) {
  PieceRig rig(table());
  rig.step(10);
  EXPECT_TRUE(rig.pieces.empty());
  EXPECT_EQ(rig.pieces.shown().count, 0u);
  EXPECT_FALSE(rig.pieces.add(nullptr, {}));
  EXPECT_FALSE(rig.pieces.add(ball_piece(0.001), {Vec3(std::nan(""), 0, 0), Quat::Identity()}));
}

TEST(FallenPieces, NoMoreThanThereIsRoomFor) {
  PieceRig rig(table());
  const auto shape = ball_piece(0.001);
  for (std::size_t i = 0; i < kMaxLooseBones; ++i)
    EXPECT_TRUE(rig.pieces.add(shape, {Vec3(0, 0, 0.01), Quat::Identity()}));
  EXPECT_FALSE(rig.pieces.add(shape, {Vec3(0, 0, 0.01), Quat::Identity()}));
}

/// A soft floor whose surface lies at a height, until it is taken away.
struct SoftFloor : PieceSoftGround {
  double top_m = 0.004;
  PiecePush at(const Vec3& p_W) const override { return {top_m - p_W.z(), Vec3::UnitZ()}; }
  bool may_meet(const Vec3& center_W, double radius_m) const override {
    return center_W.z() - radius_m <= top_m;
  }
};

// Once what it rests on is gone, it stays until it is stirred, and then lies on the table.
TEST(FallenPieces, ItRestsOnASoftPartUntilThatIsTakenAway) {
  PieceRig rig(table());
  SoftFloor floor;
  rig.add(cube_piece(0.001), Vec3(0, 0, 0.008));
  const ToolState* const tools[] = {&rig.tool};
  const auto step = [&](int count) {
    for (int n = 0; n < count; ++n)
      rig.pieces.step(tools, rig.bones, {}, false, kPieceStep_s, &floor);
  };
  step(300);
  EXPECT_EQ(rig.piece().is, FallenPiece::Is::kResting);
  EXPECT_NEAR(rig.middle().z(), floor.top_m + 0.001, 2e-4);
  floor.top_m = -1;
  step(50);
  EXPECT_EQ(rig.piece().is, FallenPiece::Is::kResting);
  rig.pieces.stir();
  step(300);
  EXPECT_EQ(rig.piece().is, FallenPiece::Is::kResting);
  EXPECT_NEAR(rig.middle().z(), 0.001, 2e-4);
}

// In air with drag k: v = (g / k) (1 - exp(-k t)).
TEST(FallenPieces, ItFallsThroughAir) {
  PieceRig rig(table());
  rig.add(ball_piece(0.002), Vec3(0, 0, 0.04));
  rig.step(15);
  EXPECT_NEAR(rig.piece().v_W.z(), -9.81 * (1 - std::exp(-0.03)), 0.01 * 0.29);
}

// A bone of the patient is covered: 15 mm over it a piece is still in the limb.
TEST(FallenPieces, InALimbSoftPartsHoldIt) {
  Case patient = *table();
  patient.bones[0].fma_id = 23466;
  PieceRig rig(std::make_shared<const Case>(patient), {"hook_probe"});
  rig.add(cube_piece(0.002), Vec3(0, 0, 0.01));
  rig.add(cube_piece(0.002), Vec3(0.02, 0, 0.02));  // outside it falls until it is in the limb
  rig.step(300);
  EXPECT_EQ(rig.piece(0).is, FallenPiece::Is::kResting);
  EXPECT_EQ(rig.middle(0), Vec3(0, 0, 0.01));
  EXPECT_NEAR(rig.middle(1).z(), 0.014, 0.002);
  // An instrument pushes it aside, and there it stays.
  rig.tool.X_WP.p = Vec3(-0.012, 0, 0.01);
  rig.go(Vec3(0.003, 0, 0.01));
  const Vec3 pushed = rig.middle(0);
  EXPECT_GT(pushed.x(), 0.003);
  rig.tool.X_WP.p = Vec3(0, 0, 1);
  rig.step(300);
  EXPECT_LT((rig.middle(0) - pushed).norm(), 0.002);
}

TEST(FallenPieces, ItComesToRestOnATable) {
  PieceRig rig(table());
  rig.add(cube_piece(0.002), Vec3(0, 0, 0.01), about(0.2, Vec3::UnitX()));
  rig.step(2000);
  EXPECT_EQ(rig.piece().is, FallenPiece::Is::kResting);
  EXPECT_NEAR(rig.middle().z(), 0.002, 1.5e-4);
  const std::uint64_t hash = rig.pieces.hash();
  rig.step(100);
  EXPECT_EQ(rig.pieces.hash(), hash);
}

// Friction of 0.3 holds a cube up to 16.7 degrees.
TEST(FallenPieces, OnASlopeItStaysOrSlidesByItsFriction) {
  for (const double slope : {8.0, 30.0}) {
    PieceRig rig(table(slope));
    const Quat q = rig.bones.bones[0].X_WB.q;
    rig.add(cube_piece(0.002), q * Vec3(-0.01, 0, 0.0021), q);
    const Vec3 before = rig.middle();
    rig.step(400);
    const double moved_m = rig.pieces.empty() ? 1.0 : (rig.middle() - before).norm();
    if (slope < 16)
      EXPECT_LT(moved_m, 0.001) << slope;
    else
      EXPECT_GT(moved_m, 0.02) << slope;
  }
}

TEST(FallenPieces, AnInstrumentPushesItAlong) {
  PieceRig rig(table(), {"hook_probe"});
  rig.add(cube_piece(0.002), Vec3(0, 0, 0.002));
  rig.tool.X_WP.p = Vec3(-0.012, 0, 0.0015);
  rig.step(300);
  EXPECT_EQ(rig.piece().is, FallenPiece::Is::kResting);
  rig.go(Vec3(0.003, 0, 0.0015));
  EXPECT_GT(rig.middle().x(), 0.003);
  EXPECT_LT(rig.middle().x(), 0.012);
  EXPECT_NEAR(rig.middle().z(), 0.002, 0.001);
}

TEST(FallenPieces, JawsHoldItUntilTheyOpen) {
  PieceRig rig(table());
  ASSERT_TRUE(rig.setup->tray.front().jaws);
  rig.lay_before_jaws();
  rig.set_jaw(0);
  EXPECT_NE(rig.piece().is, FallenPiece::Is::kHeld) << "these jaws were shut all the time";
  rig.set_jaw(1);
  rig.set_jaw(0);
  ASSERT_EQ(rig.piece().is, FallenPiece::Is::kHeld);
  EXPECT_TRUE(rig.told(PieceNews::Is::kHeld));
  const Vec3 in_jaws = rig.middle() - rig.tool.X_WP.p;
  rig.go(rig.tool.X_WP.p + Vec3(0.01, 0, 0.02));
  EXPECT_LT((rig.middle() - rig.tool.X_WP.p - in_jaws).norm(), 1e-9);
  rig.set_jaw(1);
  EXPECT_TRUE(rig.told(PieceNews::Is::kLetGo));
  rig.step(500);
  EXPECT_NE(rig.piece().is, FallenPiece::Is::kHeld);
  EXPECT_LT(rig.middle().z(), 0.004);
}

TEST(FallenPieces, WhatIsDrawnIntoBoneSlipsOutOfTheJaws) {
  PieceRig rig(table());
  rig.lay_before_jaws();
  rig.set_jaw(1);
  rig.set_jaw(0);
  ASSERT_EQ(rig.piece().is, FallenPiece::Is::kHeld);
  rig.tool.X_WP.p.z() -= 0.0045;
  rig.step();
  EXPECT_NE(rig.piece().is, FallenPiece::Is::kHeld);
  EXPECT_TRUE(rig.told(PieceNews::Is::kLetGo));
}

/// A soft floor that stops what jaws carry: thick, or so thin that nothing stands deep in it.
struct StoppingFloor : SoftFloor {
  double half_m = 1;  ///< of how thick it is
  bool thin_ones = false, knows_half = false;
  PiecePush at(const Vec3& p_W) const override {
    const double depth_m = half_m - std::abs(p_W.z() - (top_m - half_m));
    return {depth_m, Vec3::UnitZ(), knows_half ? depth_m / half_m : 0};
  }
  bool stops_carried() const override { return true; }
  bool thin_ones_stop() const override { return thin_ones; }
  bool heeds_thin = false;
  bool suction_heeds_thin() const override { return heeds_thin; }
};

// How far below the floor's top the lowest point of a cube of 6 mm was as it slipped; 0: it did
// not.
double slips_at_m(StoppingFloor floor) {
  floor.top_m = -1;
  PieceRig rig(table());
  rig.add(cube_piece(0.003), Vec3(0, 0, 0.003));
  rig.step(300);
  const SoftGripper& jaws = *rig.setup->tray.front().jaws;
  rig.tool.X_WP.p = rig.middle() - (jaws.hinge_T + 0.6 * jaws.length_m * jaws.along_T);
  rig.set_jaw(1);
  rig.set_jaw(0);
  rig.tool.X_WP.p.z() += 0.020;
  rig.step();
  EXPECT_EQ(rig.piece().is, FallenPiece::Is::kHeld);
  floor.top_m = rig.middle().z() - 0.0035;
  const ToolState* const tools[] = {&rig.tool};
  for (int n = 0; n < 150; ++n) {
    const double deep_m = floor.top_m - (rig.middle().z() - 0.003);
    rig.tool.X_WP.p.z() -= 0.00005;
    rig.pieces.step(tools, rig.bones, {}, false, kPieceStep_s, &floor);
    if (rig.piece().is != FallenPiece::Is::kHeld) return deep_m;
  }
  return 0;
}

TEST(FallenPieces, WhatJawsCarrySlipsWhereItStands3MillimetresDeepInASoftPart) {
  EXPECT_NEAR(slips_at_m({}), 0.003, 2e-4);
}

// A floor of 2 mm: without its middle known the cube is half through, and with it near that.
TEST(FallenPieces, WhatJawsCarrySlipsAtAThinSoftPartWhereThatStopsIt) {
  StoppingFloor thin;
  thin.half_m = 0.001;
  EXPECT_EQ(slips_at_m(thin), 0) << "so it was before thin parts stopped anything";
  thin.thin_ones = thin.knows_half = true;
  EXPECT_NEAR(slips_at_m(thin), 0.0008, 2e-4);
  StoppingFloor thicker;
  thicker.half_m = 0.0028;
  EXPECT_EQ(slips_at_m(thicker), 0);
  thicker.thin_ones = true;
  EXPECT_NEAR(slips_at_m(thicker), 0.0033, 3e-4);
}

TEST(FallenPieces, HandsThatAreElsewhereHoldNothing) {
  PieceRig rig(table());
  rig.add(cube_piece(0.001), Vec3(0, 0, 0.02));
  FallenPiecesState state = rig.pieces.state();
  state.pieces[0].is = FallenPiece::Is::kHeld;
  state.pieces[0].hand = 0;
  ASSERT_TRUE(FallenPieces::fits(state, 1));
  rig.pieces.restore(state);
  rig.pieces.let_all_go();
  rig.step(3);
  EXPECT_EQ(rig.piece().is, FallenPiece::Is::kMoving);
  EXPECT_LT(rig.middle().z(), 0.02);
}

TEST(FallenPieces, SuctionTakesASmallPieceAway) {
  PieceRig rig(table(), {"suction:4"});
  rig.add(ball_piece(0.0008), Vec3(0, 0, 0.0008));
  rig.step(300);
  rig.tool.X_WP.p = Vec3(0, 0, 0.0045);
  rig.tool.power = 1;
  bool sucked = false;
  for (int n = 0; n < 500 && !sucked; ++n) {
    rig.step();
    sucked = rig.told(PieceNews::Is::kSucked);
  }
  EXPECT_TRUE(sucked);
  EXPECT_TRUE(rig.pieces.empty());
}

// A ball of 6 mm lies on the table; the cannula comes over it and draws.
void suck_a_ball(PieceRig& rig) {
  rig.add(ball_piece(0.003), Vec3(0, 0, 0.003));
  rig.step(300);
  rig.tool.X_WP.p = Vec3(0, 0, 0.0085);
  rig.tool.power = 1;
  rig.step(500);
}

TEST(FallenPieces, ALargePieceSticksToTheSuction) {
  PieceRig rig(table(), {"suction:4"});
  suck_a_ball(rig);
  ASSERT_EQ(rig.piece().is, FallenPiece::Is::kHeld);
  EXPECT_TRUE(rig.piece().drawn);
  rig.tool.power = 0;
  rig.step(2);
  EXPECT_EQ(rig.piece().is, FallenPiece::Is::kMoving);
}

// What suction holds is pushed into bone, by more than it can hold: bone takes it off the bore, and
// it is not held anew and let go in every step while it is pushed out.
TEST(FallenPieces, WhatBoneTakesOffTheSuctionIsNotHeldAgainAtOnce) {
  PieceRig rig(table(), {"suction:4"});
  suck_a_ball(rig);
  ASSERT_EQ(rig.piece().is, FallenPiece::Is::kHeld);
  int let_go = 0;
  for (int n = 0; n < 200; ++n) {
    if (rig.tool.X_WP.p.z() > 0.0055) rig.tool.X_WP.p.z() -= 0.0001;
    rig.step();
    let_go += rig.told(PieceNews::Is::kLetGo);
  }
  EXPECT_GE(let_go, 1);
  EXPECT_LE(let_go, 10);
}

// What suction holds is in the middle of a part 2 mm thick: how often it is let go in 100 steps.
int let_go_in_thin(bool heeds_thin) {
  PieceRig rig(table(), {"suction:4"});
  suck_a_ball(rig);
  EXPECT_EQ(rig.piece().is, FallenPiece::Is::kHeld);
  StoppingFloor floor;
  floor.half_m = 0.001;
  floor.thin_ones = floor.knows_half = true;
  floor.heeds_thin = heeds_thin;
  floor.top_m = rig.middle().z() + floor.half_m;
  const ToolState* const tools[] = {&rig.tool};
  int let_go = 0;
  for (int n = 0; n < 100; ++n) {
    rig.pieces.step(tools, rig.bones, {}, false, kPieceStep_s, &floor);
    let_go += rig.told(PieceNews::Is::kLetGo);
  }
  return let_go;
}

TEST(FallenPieces, WhatAThinPartTakesOffTheSuctionIsNotHeldAgainAtOnce) {
  EXPECT_GT(let_go_in_thin(false), 50) << "so it was before suction heeded thin parts";
  const int heeding = let_go_in_thin(true);
  EXPECT_GE(heeding, 1);
  EXPECT_LE(heeding, 5);
}

TEST(FallenPieces, BeyondAllBonesItIsGone) {
  PieceRig rig(table());
  rig.add(ball_piece(0.002), Vec3(0.2, 0, 0));
  rig.step();
  EXPECT_TRUE(rig.told(PieceNews::Is::kOut));
  EXPECT_TRUE(rig.pieces.empty());
}

TEST(FallenPieces, ToolsThatAreNotNumbersPushNothing) {
  PieceRig rig(table());
  rig.add(cube_piece(0.002), Vec3(0, 0, 0.002));
  rig.tool.X_WP.p.x() = std::nan("");
  for (const double opening : {1.0, 0.0}) {
    rig.tool.jaw = opening;
    rig.step(50);
  }
  EXPECT_TRUE(is_finite(rig.piece().X_WB));
  EXPECT_NE(rig.piece().is, FallenPiece::Is::kHeld);
}

TEST(FallenPieces, FromAStateOnTheWayItGoesOnBitByBit) {
  PieceRig a(table(12)), b(table(12));
  a.add(cube_piece(0.002), Vec3(0, 0, 0.01), about(0.5, Vec3(1, 2, 0)));
  a.step(40);
  b.pieces.restore(a.pieces.state());
  for (int n = 0; n < 200; ++n) {
    a.step();
    b.step();
    ASSERT_EQ(a.pieces.hash(), b.pieces.hash()) << n;
  }
}

TEST(FallenPieces, StatesThatCannotBeAreRefused) {
  PieceRig rig(table());
  rig.add(cube_piece(0.001), Vec3(0, 0, 0.02));
  const FallenPiecesState good = rig.pieces.state();
  EXPECT_TRUE(FallenPieces::fits(good, 1));
  EXPECT_FALSE(FallenPieces::fits(good, 0));  // no such bone
  FallenPiecesState bad = good;
  bad.pieces[0].shape = nullptr;
  EXPECT_FALSE(FallenPieces::fits(bad, 1));
  bad = good;
  bad.pieces[0].X_WB.p.x() = std::nan("");
  EXPECT_FALSE(FallenPieces::fits(bad, 1));
  bad = good;
  bad.pieces[0].is = FallenPiece::Is::kHeld;  // by no hand
  EXPECT_FALSE(FallenPieces::fits(bad, 1));
  bad = good;
  bad.pieces.resize(kMaxLooseBones + 1, good.pieces[0]);
  EXPECT_FALSE(FallenPieces::fits(bad, 1));
}

}  // namespace
}  // namespace osteon
