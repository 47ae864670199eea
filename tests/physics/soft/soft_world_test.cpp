// Soft parts by themselves: what is no ligament is refused, and what cannot be solved is let go.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "osteon/physics/band_strands.h"
#include "osteon/physics/soft_world.h"
#include "osteon/scene/build_case.h"
#include "osteon/scene/soft_events.h"
#include "osteon/tissue/rod.h"

namespace osteon {
namespace {

constexpr double kBandStiffnessOfRod_n = 1500;

SoftBand taut_band() {
  SoftBand band;
  band.name = "band";
  band.from = BoneId{0};
  band.to = BoneId{1};
  band.to_B = Vec3(0.03, 0, 0);
  band.radius_m = 0.003;
  band.fibres = {{0.03 / 1.05, 6000, 0.002}};
  return band;
}

Tool rod_along_y() {
  Tool tool;
  tool.parts.push_back(make_rod(Vec3(0, -0.02, 0), Vec3(0, 0.02, 0), 0.001));
  return tool;
}
std::shared_ptr<const SoftSetup> setup_of(const SoftBand& band, bool by_strands) {
  SoftSetup setup;
  setup.bands = {band};
  setup.hash = 1;
  setup.by_strands = by_strands;
  return std::make_shared<const SoftSetup>(std::move(setup));
}

struct World {
  std::vector<std::shared_ptr<const Tool>> tray;
  SoftWorld softs;
  BoneSnapshot bones;
  ToolState tool;

  explicit World(const SoftBand& band = taut_band(), const Tool& held = rod_along_y(),
                 bool by_strands = false)
      : tray{std::make_shared<const Tool>(held)},
        softs(setup_of(band, by_strands), tray, 2000, 5, 0.002) {
    bones.count = 2;
    tool.tick = 1;
  }
  void step(double z_m) {
    ++bones.step;
    tool.X_WP.p = {0.015, 0, z_m};
    const ToolState* const one = &tool;
    softs.step(std::span(&one, 1), bones);
  }
  void press() {
    for (double z = 0.008; z > 0.002; z -= 0.0002) step(z);
  }
};

TEST(SoftWorld, TellsTheTickWhatIsNearAndNothingElse) {
  World world;
  world.step(0.05);
  EXPECT_EQ(world.softs.contacts(0).count, 0u);
  world.step(0.007);
  ASSERT_EQ(world.softs.contacts(0).count, 1u);
  EXPECT_LT((world.softs.contacts(0).all[0].nhat_W - Vec3::UnitZ()).norm(), 1e-12);
  EXPECT_EQ(world.softs.readout(0).force_n[0], 0);
}

TEST(SoftWorld, ABoneThatIsNoNumberLetsItsBandGo) {
  World world;
  world.press();
  ASSERT_GT(world.softs.readout(0).force_n[0], 0.5);
  world.bones.bones[1].X_WB.p.x() = std::numeric_limits<double>::quiet_NaN();
  world.step(0.002);
  ASSERT_FALSE(world.softs.events().empty());
  EXPECT_EQ(world.softs.events()[0].kind, kSoftLost);
  EXPECT_TRUE(is_finite(world.softs.events()[0].p_W));
  EXPECT_EQ(world.softs.contacts(0).count, 0u);
  EXPECT_EQ(world.softs.readout(0).force_n[0], 0);
  world.bones.bones[1].X_WB.p.x() = 0;
  world.step(0.002);
  EXPECT_EQ(world.softs.contacts(0).count, 0u);  // until a restore point
}

TEST(SoftWorld, AToolThatIsNoNumberTouchesNothing) {
  World world;
  world.press();
  world.step(std::numeric_limits<double>::infinity());
  EXPECT_EQ(world.softs.contacts(0).count, 0u);
  EXPECT_FALSE(world.softs.state().bands[0].lost);
}

TEST(SoftWorld, BonesPulledApartTearIt) {
  SoftBand band = taut_band();
  band.failure_n = 400;
  World world(band);
  world.step(0.05);
  EXPECT_TRUE(world.softs.events().empty());
  world.bones.bones[1].X_WB.p.x() = 0.002;
  world.step(0.05);
  ASSERT_EQ(world.softs.events().size(), 1u);
  EXPECT_EQ(world.softs.events()[0].kind, kSoftTorn);
  EXPECT_EQ(world.softs.events()[0].hand, kNoHand);
  EXPECT_GT(world.softs.events()[0].values[0], 400);
}

// Bones that part slowly tear what is left of it strand by strand: the first at its share of the
// failure load, the last at a quarter more for itself; the tension falls all the way.
TEST(SoftWorld, BonesPulledApartTearWhatIsLeftStrandByStrand) {
  for (const int strands : {61, 30, 6}) {
    SoftBand band = taut_band();
    band.failure_n = 400;
    World world(band, rod_along_y(), true);
    SoftState state = world.softs.save();
    for (int i = strands; i < kStrands; ++i) state.bands[0].gone |= std::uint64_t{1} << i;
    world.softs.restore(state, 0);
    double peak_n = 0, apart_m = 0, first_m = 0;
    std::vector<double> left;
    while (!world.softs.state().bands[0].torn && apart_m < 0.003) {
      apart_m += 2e-7;
      world.bones.bones[1].X_WB.p.x() = apart_m;
      world.step(0.05);
      const std::uint64_t gone = world.softs.state().bands[0].gone;
      if (gone != state.bands[0].gone && first_m == 0) first_m = apart_m;
      peak_n = std::max(peak_n, world.softs.readout(0).tension_n);
      for (const Event& event : world.softs.events())
        if (event.kind == kSoftStrandsTorn) left.push_back(event.values[0]);
    }
    ASSERT_TRUE(world.softs.state().bands[0].torn) << strands;
    ASSERT_EQ(world.softs.events().back().kind, kSoftTorn);
    const double weakest = strand_strength(weakest_strand(state.bands[0].gone));
    EXPECT_NEAR(peak_n, 400 * weakest * strands / kStrands, 0.005 * peak_n) << strands;
    double strongest = 0;
    for (int i = 0; i < strands; ++i) strongest = std::max(strongest, strand_strength(i));
    EXPECT_NEAR(world.softs.events().back().values[0], 400 * strongest / kStrands, 0.05);
    EXPECT_NEAR(apart_m - first_m, 400 * (strongest - weakest) / 6000 * 0.03 / 1.05, 2e-6);
    EXPECT_TRUE(std::is_sorted(left.rbegin(), left.rend()));
    EXPECT_GE(left.size(), strands == 61 ? 9u : 0u);
  }
}

TEST(SoftWorld, AStateOfAnotherKindDoesNotFit) {
  World world;
  EXPECT_TRUE(world.softs.fits(world.softs.state()));
  EXPECT_FALSE(world.softs.fits(SoftState{}));
  SoftState odd = world.softs.state();
  odd.hands[2].count = 1;
  odd.hands[2].near[0].contact.band = 7;
  EXPECT_FALSE(world.softs.fits(odd));
}

// A plate that lies flat, 20 mm wide across the band and `along_m` along it, 1.5 mm thick.
Tool plate(double along_m) {
  Tool tool;
  tool.parts.push_back(make_box({}, Vec3(along_m / 2, 0.01, 0.00075)));
  return tool;
}

// The rod that a box was taken for is 5.4 mm thick all round.
TEST(SoftWorld, APlateIsFeltWhereItsFaceIs) {
  World world(taut_band(), plate(0.0015));
  const double touch_m = taut_band().radius_m + 0.00075;
  for (double z = 0.008; z > touch_m; z -= 0.0002) world.step(z);
  EXPECT_EQ(world.softs.readout(0).force_n[0], 0);
  world.step(touch_m - 0.0002);
  EXPECT_GT(world.softs.readout(0).force_n[0], 0);
}

// Its face is as narrow as the rod is thick: the string is bent by the same.
TEST(SoftWorld, ANarrowPlateOnItsFacePressesAsARodAcross) {
  World narrow(taut_band(), plate(0.001)), rod;
  const double lower = 0.001 - 0.00075;  // the rod's surface is so much farther from its middle
  for (double z = 0.008; z > -0.004; z -= 0.0002) {
    rod.step(z + lower);
    narrow.step(z);
    const double force_n = rod.softs.readout(0).force_n[0];
    ASSERT_NEAR(narrow.softs.readout(0).force_n[0], force_n, 1e-9 + 1e-6 * force_n) << z;
  }
  EXPECT_GT(rod.softs.readout(0).force_n[0], 5) << "far through the band's rest place";
}

TEST(SoftWorld, APlateThatGoesByBesideABandDoesNotPressIt) {
  Tool tool;
  tool.parts.push_back(make_box({Vec3(0, 0.02, 0), Quat::Identity()}, Vec3(0.001, 0.01, 0.00075)));
  World world(taut_band(), tool);
  for (double z = 0.008; z > -0.008; z -= 0.0002) {
    world.step(z);
    ASSERT_EQ(world.softs.readout(0).force_n[0], 0) << z;
  }
}

// The same string as an elastic rod of 20 segments, thin in bending, that hangs on two grips drawn
// apart and is loaded in the middle: how far it gives way there.
double rod_bends(double force_n) {
  constexpr double kLength = 0.03, kRadius = 5e-5, kPull = 0.0015;
  RodDef def;
  def.points_W = {Vec3(0, 0, 0), Vec3(kLength, 0, 0)};
  def.radius_m = kRadius;
  def.segments = 20;
  def.material.young_pa = kBandStiffnessOfRod_n / (3.14159265358979 * kRadius * kRadius);
  def.material.poisson = 0.3;
  def.material.density_kg_per_m3 = 1000;
  def.material.damping_per_s = 300;
  auto rod = make_rod(def);
  if (!rod) return -1;
  RodSupports supports;
  supports.grips = {{}, {Vec3(kPull, 0, 0), Vec3::Zero(), Vec3(kLength, 0, 0), 0.05}};
  for (std::uint32_t axis = 0; axis < 3; ++axis) {
    supports.axes.push_back({0, axis, 0});
    supports.axes.push_back({20, axis, 1});
  }
  supports.loads.push_back({10, Vec3(0, 0, -force_n), 0.1});
  RodStepper stepper(std::move(*rod), supports, 0.001);
  RodState state = stepper.start_state();
  for (int i = 0; i < 400; ++i) stepper.step(state);
  return -state.at_W[10].z();
}

TEST(SoftWorld, GivesWayAsAnElasticRodOfManySegments) {
  SoftBand band = taut_band();
  band.fibres = {{0.03, kBandStiffnessOfRod_n, 1e-6}};
  band.to_B = Vec3(0.0315, 0, 0);
  band.surface_n_per_m = 1e9;  // all of the way is the string's
  const BandSpan span{band.from_B, band.to_B};
  const BandContact contact{0, 0, Vec3::UnitZ(), 0};
  for (const double bent : {0.001, 0.003, 0.005}) {
    const double z = band.radius_m + 0.001 - bent;
    const Capsule shaft{Vec3(0.01575, -0.02, z), Vec3(0.01575, 0.02, z), 0.001};
    const BandPress press = press_band(band, span, round_box(shaft), contact, band.surface_n_per_m);
    ASSERT_NEAR(press.bent_m, bent, 1e-6);
    EXPECT_NEAR(rod_bends(press.force_n), bent, 0.02 * bent);
  }
}

}  // namespace
}  // namespace osteon
