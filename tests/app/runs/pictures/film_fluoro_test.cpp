// Shots of a bone's ball and a probe of steel beside it.
#include "runs/pictures/film_fluoro.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <optional>

#include "osteon/scene/tool.h"
#include "xray/phantoms.h"

namespace osteon {
namespace {

/// A long bar along x: narrow from the side, wide from the front.
std::shared_ptr<const Case> bar() {
  auto made = std::make_shared<Case>();
  made->name = "bar";
  Bone bone;
  bone.name = "femur";
  bone.mesh = testing_xray::box({-0.04, -0.01, -0.01}, {0.04, 0.01, 0.01});
  made->bones.push_back(std::move(bone));
  return made;
}

class FluoroShots : public ::testing::Test {
 protected:
  void SetUp() override {
    tray_ = {std::make_shared<const Tool>(make_wrist_probe())};
    auto made = FilmFluoro::create(*case_, tray_);
    ASSERT_TRUE(made) << made.error().message();
    fluoro_.emplace(std::move(*made));
    now_.bones = rest_snapshot(*case_);
    now_.hands = 1;
    now_.tools[0].X_WP.p = Vec3(0, 0.03, 0);
  }
  Result<XrayShot> shoot(double orbit_rad, std::uint64_t seed = 1) {
    FilmFluoro::ShotOrder order;
    order.orbit_rad = orbit_rad;
    order.side = 96;
    order.seed = seed;
    return fluoro_->shoot(now_, order);
  }
  /// Pixels that bone covers.
  static int covered(const XrayShot& shot) {
    int count = 0;
    for (const float mass : shot.density.of[static_cast<std::size_t>(XraySubstance::kBone)])
      count += mass > 0.1f;
    return count;
  }

  std::shared_ptr<const Case> case_ = bar();
  Tray tray_;
  std::optional<FilmFluoro> fluoro_;
  FilmMoment now_;
};

TEST_F(FluoroShots, AHandThatHoldsNothingKnownIsGivenNoDose) {
  now_.tools[0].instrument = 7;
  const auto shot = shoot(0);
  ASSERT_TRUE(shot);
  EXPECT_TRUE(shot->hands.empty());
  EXPECT_EQ(shot->grey.size(), 96u * 96u);
}

TEST_F(FluoroShots, TheHandStandsWhereItHoldsTheInstrument) {
  const auto shot = shoot(0);
  ASSERT_TRUE(shot);
  ASSERT_EQ(shot->hands.size(), 1u);
  EXPECT_NEAR((shot->hands[0].hand_W - now_.tools[0].X_WP * hand_on(*tray_[0])).norm(), 0, 1e-12);
  EXPECT_GT(shot->hands[0].total_mgy(), 0);
  EXPECT_GT(shot->dose.air_kerma_mgy, 0);
  EXPECT_EQ(shot->dose.shots, 1);
}

TEST_F(FluoroShots, TheArmTurnsAndNoiseIsNewWithEachSeed) {
  const auto front = shoot(0), side = shoot(std::numbers::pi / 2), again = shoot(0, 2);
  ASSERT_TRUE(front && side && again);
  EXPECT_NE(covered(*front), covered(*side));
  EXPECT_EQ(covered(*front), covered(*again));
  EXPECT_NE(front->grey, again->grey);
}

TEST_F(FluoroShots, ATurnThatIsNoNumberIsRefused) { EXPECT_FALSE(shoot(std::nan(""))); }

}  // namespace
}  // namespace osteon
