#include "soft/soft_band.h"

#include <gtest/gtest.h>

#include "mesh/shapes.h"
#include "mesh/surface_checks.h"
#include "soft/soft_field.h"

namespace osteon {
namespace {

BandPoint point(std::size_t bone, const Vec3& p_W, bool attached) {
  BandPoint p;
  p.at = {bone, p_W};
  p.width = 0.004;
  p.thickness = 0.001;
  p.attached = attached;
  return p;
}

/// Two balls of 5 mm, 20 mm apart along x; a third of 6 mm stands between them.
class Balls : public testing::Test {
 protected:
  Balls() {
    for (const auto& [radius, x] : {std::pair(0.005, 0.0), {0.005, 0.020}, {0.006, 0.010}})
      balls_.push_back(make_ground(MeshDistance(test::sphere(radius, 24, Vec3(x, 0, 0)))));
    for (const SoftGround& ball : balls_) ground_.push_back(&ball);
  }
  std::vector<SoftGround> balls_;
  GroundView ground_;
};

TEST_F(Balls, EndsLieOnTheirBonesHoweverFarOffTheyWereGiven) {
  BandDescription band;
  band.path = {point(0, Vec3(0, 0, 0.009), true), point(1, Vec3(0.020, 0, 0.003), true)};
  const LaidBand laid = lay_band(band, ground_);
  ASSERT_EQ(laid.attachments.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i)
    EXPECT_LT(std::abs(balls_[i].surface.closest(laid.attachments[i]).signed_distance), 1e-9);
}

TEST_F(Balls, RunsOverTheBoneInItsWay) {
  BandDescription band;
  band.path = {point(0, Vec3(0.003, 0, 0.004), true), point(1, Vec3(0.017, 0, 0.004), true)};
  const LaidBand laid = lay_band(band, ground_);
  double nearest = 1;
  for (const BandSection& s : laid.sections)
    nearest = std::min(nearest, balls_[2].surface.closest(s.center).signed_distance);
  EXPECT_GT(nearest, 0.0003) << "about half the thickness over the ball in the way";
  EXPECT_GT(laid.length, 0.0142) << "longer than the straight way";
}

TEST_F(Balls, TheSurfaceIsWholeAndSunkOnlySlightlyIntoBone) {
  BandDescription band;
  band.path = {point(0, Vec3(0.003, 0, 0.004), true), point(1, Vec3(0.017, 0, 0.004), true)};
  SoftDescription soft;
  soft.cell = 0.0004;
  std::vector<Obstacle> obstacles;
  for (const SoftGround& ball : balls_) obstacles.push_back({&ball.surface, ball.box});
  const auto mesh = grow_band(lay_band(band, ground_), 0.0001, soft, obstacles);
  ASSERT_TRUE(mesh) << mesh.error().message();
  EXPECT_TRUE(checks::is_closed_manifold(*mesh));
  EXPECT_EQ(checks::euler_number(*mesh), 2);
  for (const SoftGround& ball : balls_)
    for (const Vec3& p : mesh->vertices)
      EXPECT_GT(ball.surface.closest(p).signed_distance, -0.0003);
}

TEST_F(Balls, LiesFlatOnTheBoneWhereItEndsThoughToldOtherwise) {
  BandDescription band;
  band.flat_W = Vec3(0, 0.6, 0.8);
  band.path = {point(0, Vec3(-0.001, 0, 0.005), true), point(1, Vec3(0.021, 0, 0.005), true)};
  const LaidBand laid = lay_band(band, ground_);
  for (const BandSection* end : {&laid.sections.front(), &laid.sections.back()}) {
    EXPECT_LT(std::abs(end->flat.y()), 0.2);
    EXPECT_LT(end->half_width, 0.5 * band.path[0].width) << "the tip is rounded";
  }
  EXPECT_LT(laid.sections.front().center.x(), laid.attachments[0].x() - 5e-4)
      << "a footprint goes on past the attachment";
}

TEST_F(Balls, AFreeEndStaysWhereItWasPut) {
  BandDescription band;
  band.path = {point(0, Vec3(0, 0, 0.005), true), point(0, Vec3(0, 0, 0.03), false)};
  const LaidBand laid = lay_band(band, ground_);
  EXPECT_EQ(laid.attachments.size(), 1u);
  EXPECT_LT((laid.sections.back().center - Vec3(0, 0, 0.03)).norm(), 1e-12);
}

}  // namespace
}  // namespace osteon
