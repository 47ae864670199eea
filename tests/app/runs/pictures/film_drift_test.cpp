// A film through a scope while an ablator works between two balls, the upper one a roof.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <memory>

#include "osteon/physics/joint_water.h"
#include "osteon/render/renderer.h"
#include "runs/hands/tray.h"
#include "runs/pictures/film_view.h"
#include "xray/phantoms.h"

namespace osteon {
namespace {

std::shared_ptr<const Case> two_balls() {
  auto made = std::make_shared<Case>();
  made->name = "two balls";
  for (const double side : {1.0, -1.0}) {
    Bone bone;
    bone.name = side > 0 ? "femur" : "tibia";
    bone.mesh = testing_xray::ball(Vec3::Zero(), 0.010, 48);
    bone.X_WB.p.z() = 0.016 * side;
    made->bones.push_back(std::move(bone));
  }
  return made;
}

int pixels_apart(const Image& a, const Image& b, int least) {
  int count = 0;
  for (std::size_t k = 0; k + 2 < std::min(a.rgb.size(), b.rgb.size()); k += 3) {
    int most = 0;
    for (std::size_t c = k; c < k + 3; ++c) most = std::max(most, std::abs(a.rgb[c] - b.rgb[c]));
    count += most > least;
  }
  return count;
}

class FilmDrift : public ::testing::Test {
 protected:
  void SetUp() override {
    if (auto context = OffscreenContext::create(); !context)
      GTEST_SKIP() << "no OpenGL without a window here: " << context.error().message();
    settings_.tray = {"arthroscope_30", "rf_ablator"};
    auto tray = make_tray(settings_.tray, settings_.probe_radius_m);
    ASSERT_TRUE(tray) << tray.error().message();
    tray_ = *tray;
  }

  /// The scope's tip 15 mm beside, looking along x and upwards; the ablator's in the middle.
  FilmMoment moment(double time_s, double power) const {
    FilmMoment now;
    now.time_s = time_s;
    now.bones = rest_snapshot(*case_);
    now.bones.water.on = true;
    now.bones.water.pump_pa = FluidDrive().pump_pa;
    now.bones.water.outlet_open = FluidDrive().outlet_open;
    now.bones.water.pressure_pa = 45 * kPa_per_mmHg;
    now.hands = 2;
    Mat3 looks;  // Tool's axes in World: its shaft lies backwards, its lens looks upwards
    looks.col(0) = -Vec3::UnitY();
    looks.col(1) = Vec3::UnitZ();
    looks.col(2) = -Vec3::UnitX();
    now.tools[0].X_WP = {Vec3(-0.015, 0, 0), Quat(looks)};
    now.tools[1].X_WP = {Vec3(0, 0.004, 0), Quat::FromTwoVectors(Vec3::UnitZ(), Vec3::UnitX())};
    now.tools[1].instrument = 1;
    now.tools[1].power = power;
    for (std::size_t h = 0; h < 2; ++h) now.tools[h].tick = 1;
    return now;
  }
  /// The last of pictures of two seconds.
  Image last_picture(double power) {
    FilmPainter::Order order;
    order.view = FilmView::kScope;
    order.width = order.height = 200;
    auto painter = FilmPainter::create(case_, settings_, tray_, true, order);
    EXPECT_TRUE(painter) << painter.error().message();
    Image image;
    for (int k = 0; painter && k <= 20; ++k) {
      auto drawn = painter->draw(moment(0.1 * k, power));
      EXPECT_TRUE(drawn) << drawn.error().message();
      if (drawn) image = std::move(*drawn);
    }
    return image;
  }

  std::shared_ptr<const Case> case_ = two_balls();
  SessionSettings settings_;
  Tray tray_;
};

TEST_F(FilmDrift, AnAblatorsBubblesAreSeenAndAreTheSameInEachFilm) {
  const Image idle = last_picture(0), works = last_picture(1);
  ASSERT_EQ(idle.rgb.size(), 3u * 200 * 200);
  ASSERT_EQ(works.rgb.size(), idle.rgb.size());
  EXPECT_GT(pixels_apart(idle, works, 12), 100);
  EXPECT_EQ(pixels_apart(works, last_picture(1), 0), 0);
}

}  // namespace
}  // namespace osteon
