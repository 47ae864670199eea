// What removes bone without a motor, or with a blade: curette, shaver, osteotome, punch.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "drilling.h"
#include "mesh/shapes.h"
#include "osteon/carve/removed.h"
#include "osteon/scene/carve_events.h"

namespace osteon {
namespace {

using testing::Drilling;
using testing::kTop_m;

double by_hand_mm3(const Session& session) {
  return 1e9 * total(removed_volume(*session.carving()->field(0)));
}

// The tool stands over the middle of the block's top, its shaft upwards, and is pressed on it.
constexpr double kLeant = std::numbers::pi / 3;
struct HandWork {
  double press_m = 0.003;  // the hand wants the tip so far under the top
  double draw_m = 0;       // to and fro along x
  double lean_rad = 0;     // of the shaft about x: -kLeant leans it over, +y of Tool downwards
  double power = 0;
};

ByTissue tissues_gone(const Drilling& with, const HandWork& hand, int ticks = 1600) {
  Session session = with.session();
  for (int n = 1; n <= ticks; ++n) {
    HandInput input;
    const double t = 0.001 * n, phase = 2 * std::numbers::pi * 2 * t;
    const double z = std::max(0.002 - 0.02 * t, -hand.press_m);
    const double x = hand.draw_m * std::sin(phase);
    input.input.X_WD.p = {x, 0, kTop_m + z};
    input.input.v_W = {hand.draw_m * 4 * std::numbers::pi * std::cos(phase), 0, 0};
    input.input.X_WD.q = Quat(Eigen::AngleAxisd(hand.lean_rad, Vec3::UnitX()));
    if (n == 2) input.command = {CommandKind::kPower, hand.power};
    (void)session.tick(std::span(&input, 1));
  }
  ByTissue gone = removed_volume(*session.carving()->field(0));
  for (double& volume : gone) volume *= 1e9;
  return gone;
}

double gone_by_hand(const std::string& instrument, const HandWork& hand) {
  return total(tissues_gone(Drilling(instrument), hand));
}

double share_of(const ByTissue& gone, BoneTissue tissue) {
  return gone[static_cast<std::size_t>(tissue)];
}

// By the nearest node.
bool node_is_left(const CarvedField& field, const Vec3& p_B) {
  const BlockGrid& grid = field.grid();
  std::array<int, 3> block{}, in{};
  for (std::size_t a = 0; a < 3; ++a) {
    const auto axis = static_cast<Eigen::Index>(a);
    const int node = static_cast<int>(std::lround((p_B[axis] - grid.lo[axis]) / grid.cell_m));
    block[a] = node / 8;
    in[a] = node % 8;
  }
  const std::int16_t* cuts = field.cuts(grid.index(block));
  return !cuts || cuts[64 * in[2] + 8 * in[1] + in[0]] > 0;
}

TEST(CarvingByHand, ACuretteRemovesWhatItIsDrawnAlong) {
  const HandWork facing{.lean_rad = -kLeant};
  HandWork drawn = facing;
  drawn.draw_m = 0.003;
  EXPECT_EQ(gone_by_hand("bone_curette:3", facing), 0);
  EXPECT_GT(gone_by_hand("bone_curette:3", drawn), 0.05);
  // With its back it only slides.
  drawn.lean_rad = kLeant;
  EXPECT_EQ(gone_by_hand("bone_curette:3", drawn), 0);
}

TEST(CarvingByHand, AnOsteotomeGoesInByTheBlowsOnIt) {
  const double pushed = gone_by_hand("osteotome:4", {});
  const double struck = gone_by_hand("osteotome:4", {.power = 1});
  EXPECT_LT(pushed, 1);
  EXPECT_GT(struck, pushed + 2);
}

// One bone of two walls: a plate of 1 mm, 2 mm of air, and a block under it.
std::shared_ptr<const Case> two_walls() {
  CaseDef def;
  def.name = "two walls";
  BoneDef bone;
  bone.name = "walls";
  bone.felt = Felt::kField;
  for (const auto& [half_z, middle_z] : {std::pair(0.0005, 0.0035), std::pair(0.0025, -0.0015)}) {
    const TriMesh box = testing::box_mesh(Vec3(0.005, 0.005, half_z));
    const auto first = static_cast<std::uint32_t>(bone.mesh.vertices.size());
    for (const Vec3& p : box.vertices) bone.mesh.vertices.push_back(p + Vec3(0, 0, middle_z));
    for (const auto& t : box.triangles)
      bone.mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  }
  def.bones.push_back(bone);
  auto built = build_case(std::move(def));
  EXPECT_TRUE(built);
  return std::make_shared<const Case>(std::move(*built));
}

TEST(CarvingByHand, AnOsteotomeThatBreachesIsStoppedByTheNextWall) {
  Drilling with("osteotome:4");
  with.the_case = two_walls();
  auto made = make_carving(*with.the_case, with.settings.tray, with.settings.carve);
  ASSERT_TRUE(made);
  with.setup = *made;
  Session session = with.session();
  int breached = 0;
  for (int n = 1; n <= 4000 && (breached == 0 || n < breached + 800); ++n) {
    HandInput input;
    input.input.X_WD.p = {0, 0, kTop_m + std::max(0.001 - 0.02 * 0.001 * n, -0.007)};
    if (n == 2) input.command = {CommandKind::kPower, 1.0};
    if (breached > 0 && n == breached + 1) input.command = {CommandKind::kPower, 0.0};
    (void)session.tick(std::span(&input, 1));
    if (breached == 0 && session.tool_state().X_WP.p.z() < 0.0025) breached = n;
  }
  ASSERT_GT(breached, 0);
  EXPECT_NEAR(session.tool_state().X_WP.p.z(), 0.001, 0.0008);
  EXPECT_GT(session.tool_state().force_W.z(), 1);
}

// Cartilage of 1 mm over a cortex of 1.2 mm, instead of bare bone.
Drilling on_cartilage(const std::string& instrument) {
  Drilling with(instrument);
  with.with([](CarvingSetup& setup) {
    setup.layers.layers = {{0, BoneTissue::kCartilage},
                           {0.001, BoneTissue::kCortical},
                           {0.0022, BoneTissue::kCancellous}};
  });
  return with;
}

TEST(CarvingByHand, AShaverTakesCartilageAndStopsAtBone) {
  HandWork hand{.lean_rad = -kLeant, .power = 1};
  const ByTissue gone = tissues_gone(on_cartilage("shaver:3.5"), hand);
  EXPECT_GT(share_of(gone, BoneTissue::kCartilage), 0.5);
  EXPECT_EQ(share_of(gone, BoneTissue::kCortical) + share_of(gone, BoneTissue::kCancellous), 0);
  // On bare bone it slides, and with its back to the cartilage too; a burr does not.
  EXPECT_EQ(gone_by_hand("shaver:3.5", hand), 0);
  EXPECT_GT(gone_by_hand("microdrill:3", {.power = 1}), 1);
  hand.lean_rad = kLeant;
  EXPECT_EQ(total(tissues_gone(on_cartilage("shaver:3.5"), hand)), 0);
}

// A condyle of 10 mm under 1 mm of cartilage, and a tube laid flat on its top, the shaft along x:
// it touches so far behind its tip.
ByTissue gone_beside_the_tip(double behind_tip_m, bool window_down) {
  constexpr double kRound_m = 0.010, kTube_m = 0.00175;
  Drilling with("shaver:3.5");
  CaseDef def;
  def.name = "condyle";
  BoneDef bone;
  bone.name = "condyle";
  bone.mesh = test::sphere(kRound_m, 24);
  bone.felt = Felt::kField;
  def.bones.push_back(bone);
  auto built = build_case(std::move(def));
  EXPECT_TRUE(built);
  with.the_case = std::make_shared<const Case>(std::move(*built));
  auto made = make_carving(*with.the_case, with.settings.tray, with.settings.carve);
  EXPECT_TRUE(made);
  with.setup = *made;
  with.with([](CarvingSetup& setup) {
    setup.layers.layers = {{0, BoneTissue::kCartilage}, {0.001, BoneTissue::kCortical}};
  });
  Mat3 R_WT;
  const Vec3 y_T(0, 0, window_down ? -1 : 1), z_T = Vec3::UnitX();
  R_WT << y_T.cross(z_T), y_T, z_T;
  Session session = with.session();
  for (int n = 1; n <= 1200; ++n) {
    HandInput input;
    const double z = std::max(0.001 - 0.02 * 0.001 * n, -0.0015);
    input.input.X_WD = {Vec3(-behind_tip_m, 0, kRound_m + kTube_m + z), Quat(R_WT)};
    if (n == 2) input.command = {CommandKind::kPower, 1.0};
    (void)session.tick(std::span(&input, 1));
  }
  EXPECT_GT(session.tool_state().force_W.z(), 0.3);  // it is pressed on it
  ByTissue gone = removed_volume(*session.carving()->field(0));
  for (double& volume : gone) volume *= 1e9;
  return gone;
}

TEST(CarvingByHand, AShaverCutsAlongItsWindowAndNotBesideIt) {
  const ByTissue gone = gone_beside_the_tip(0.005, true);
  EXPECT_GT(share_of(gone, BoneTissue::kCartilage), 0.3);
  EXPECT_EQ(share_of(gone, BoneTissue::kCortical), 0);
  EXPECT_EQ(total(gone_beside_the_tip(0.005, false)), 0);  // its back
  EXPECT_EQ(total(gone_beside_the_tip(0.012, true)), 0);   // its tube, behind the window
}

// What it does not cut it does not enter.
TEST(CarvingByHand, AShaverThatRestsOnBoneTellsOfNoTissue) {
  const Drilling with("shaver:3.5");
  Session session = with.session();
  std::size_t told = 0;
  for (int n = 1; n <= 400; ++n) {
    HandInput input;
    input.input.X_WD.p = {0, 0, kTop_m + std::max(0.002 - 0.00002 * n, -0.003)};
    input.input.X_WD.q = Quat(Eigen::AngleAxisd(-kLeant, Vec3::UnitX()));
    if (n == 2) input.command = {CommandKind::kPower, 1.0};
    (void)session.tick(std::span(&input, 1));
    for (const Event& event : session.last_events()) told += event.kind == kCortexEntered;
  }
  EXPECT_GT(session.tool_state().force_W.norm(), 0.5);
  EXPECT_EQ(told, 0u);
}

// The punch hooks its foot under the block's lower edge, leant over by 40.5 degrees so that its
// shaft is free: the edge lies at y = 0, z = 2.75 mm of Tool, and the bite takes what of the bone
// is within 1.5 mm of y and below z = 3 mm. Bone above the bite stays.
TEST(CarvingByHand, AKerrisonBitesWhenItsJawShutsAndNotBefore) {
  const double lean = 40.5 * std::numbers::pi / 180, slope = std::tan(lean);
  const Drilling with("kerrison_punch:3");
  Session session = with.session();
  const Quat q(Eigen::AngleAxisd(lean, Vec3::UnitX()));
  const Vec3 there = Vec3(0, -0.005, -kTop_m) - q * Vec3(0, 0, 0.00275);
  double before = 0;
  for (int n = 1; n <= 400; ++n) {
    HandInput input;
    input.input.X_WD.q = q;
    input.input.X_WD.p = there - Vec3(0, std::max(0.004 - 0.00002 * n, 0.0), 0);
    if (n == 3) input.command = {CommandKind::kJaw, 1};
    if (n == 300) before = by_hand_mm3(session);
    if (n == 301) input.command = {CommandKind::kJaw, 0};
    (void)session.tick(std::span(&input, 1));
  }
  EXPECT_EQ(before, 0);
  EXPECT_LT((session.tool_state().X_WP.p - there).norm(), 2e-4);
  const double bite = 3 * (1.5 * 0.25 + slope * 1.5 * 1.5 / 2 - slope * 0.25 * 0.25 / 2);
  EXPECT_NEAR(by_hand_mm3(session), bite, 0.15 * bite);
  const CarvedField& field = *session.carving()->field(0);
  EXPECT_FALSE(node_is_left(field, there + q * Vec3(0, 0.001, 0.0024)));
  EXPECT_TRUE(node_is_left(field, there + q * Vec3(0, 0.001, 0.0036)));
  EXPECT_TRUE(node_is_left(field, there + q * Vec3(0, 0.0025, 0.0024)));
}

}  // namespace
}  // namespace osteon
