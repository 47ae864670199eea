#include "osteon/render/anatomical_view.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <limits>
#include <utility>

#include "../scenes.h"
#include "osteon/base/random.h"
#include "osteon/mesh/mesh_io.h"

namespace osteon {
namespace {

struct Axes {
  Vec3 distal, dorsal, radial;
};

/// Right hand: dorsal = distal x radial; left: the mirror image.
Axes random_axes(Random& random, bool left) {
  const Quat q = random.rotation();
  return {q * Vec3::UnitX(), q * Vec3(0, 0, left ? -1 : 1), q * Vec3::UnitY()};
}

void expect_axes(const AnatomicalFrame& frame, const Axes& axes, double tolerance) {
  EXPECT_TRUE(frame.from_bones);
  EXPECT_GT(frame.distal_W.dot(axes.distal), 1 - tolerance);
  EXPECT_GT(frame.dorsal_W.dot(axes.dorsal), 1 - tolerance);
  EXPECT_GT(frame.radial_W.dot(axes.radial), 1 - tolerance);
  EXPECT_NEAR(frame.distal_W.dot(frame.dorsal_W), 0, 1e-9);
  EXPECT_NEAR(frame.distal_W.dot(frame.radial_W), 0, 1e-9);
  EXPECT_NEAR(frame.dorsal_W.dot(frame.radial_W), 0, 1e-9);
}

TEST(AnatomicalFrame, EmptyCaseGivesWorldAxes) {
  const AnatomicalFrame frame = anatomical_frame(Case{});
  EXPECT_FALSE(frame.from_bones);
  EXPECT_EQ(frame.dorsal_W, Vec3::UnitZ());
}

TEST(AnatomicalFrame, BonesOnALineOrWithoutPointsGiveWorldAxes) {
  const Case line = ball_hand(Vec3::UnitX(), Vec3::UnitX(), Vec3::UnitX());
  EXPECT_FALSE(anatomical_frame(line).from_bones);
  Case empty = ball_hand(Vec3::UnitX(), Vec3::UnitZ(), Vec3::UnitY());
  for (Bone& bone : empty.bones) bone.mesh = {};
  EXPECT_FALSE(anatomical_frame(empty).from_bones);
  Case broken = ball_hand(Vec3::UnitX(), Vec3::UnitZ(), Vec3::UnitY());
  for (Bone& bone : broken.bones) bone.X_WB.p.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(anatomical_frame(broken).from_bones);
}

TEST(AnatomicalFrame, FoundInAnyPoseOfEitherHand) {
  Random random(7);
  for (int k = 0; k < 40; ++k) {
    const Axes axes = random_axes(random, k % 2 == 1);
    // The pisiform tells the palm even when the side is wrong.
    Case hand = ball_hand(axes.distal, axes.dorsal, axes.radial);
    hand.side = "right";
    expect_axes(anatomical_frame(hand), axes, 0.02);
  }
}

/// Of a knee: proximal up, the front in the place of the back of the hand, lateral for radial.
TEST(AnatomicalFrame, KneeFoundInAnyPoseOfEitherLeg) {
  Random random(9);
  for (int k = 0; k < 20; ++k) {
    const Axes axes = random_axes(random, k % 2 == 1);
    const auto at = [&](double up, double front, double lateral) {
      return Vec3(up * axes.distal + front * axes.dorsal + lateral * axes.radial);
    };
    Case knee;
    const TriMesh ball = sphere_mesh(0.004);
    knee.bones.push_back(make_bone("femur", ball, at(0.2, 0, 0)));
    knee.bones.push_back(make_bone("tibia", ball, at(-0.2, 0, 0)));
    knee.bones.push_back(make_bone("fibula", ball, at(-0.21, -0.03, 0.03)));
    knee.bones.push_back(make_bone("patella", ball, at(0.04, 0.045, 0)));
    expect_axes(anatomical_frame(knee), axes, 0.06);
    const Camera near = close_up_camera(Camera{}, knee, BoneId{}, 1);
    EXPECT_LT((near.target_W - knee.bones[3].X_WB.p).norm(), 0.01);
  }
}

TEST(AnatomicalFrame, SideDecidesWithoutThePisiform) {
  Random random(8);
  for (const bool left : {false, true}) {
    const Axes axes = random_axes(random, left);
    Case hand = ball_hand(axes.distal, axes.dorsal, axes.radial);
    hand.bones.erase(hand.bones.begin() + 3);
    hand.side = left ? "left" : "right";
    expect_axes(anatomical_frame(hand), axes, 0.02);
  }
}

/// The shared reference bones: y runs proximally in their file's frame.
TEST(AnatomicalFrame, RealWrist) {
  const char* shared = std::getenv("OSTEON_SHARED");
  const std::filesystem::path folder =
      std::filesystem::path(shared ? shared : OSTEON_SOURCE_DIR "/../shared") / "anatomy" / "wrist";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no reference bones in " << folder;
  Case wrist;
  const std::pair<const char*, const char*> bones[] = {{"radius", "radius"},
                                                       {"ulna", "ulna"},
                                                       {"pisiform", "pisiform"},
                                                       {"triquetrum", "triquetrum"},
                                                       {"3mc", "metacarpal_3"}};
  for (const auto& [file, name] : bones) {
    auto mesh = load_mesh(folder / (std::string(file) + ".stl"), 1.0);
    ASSERT_TRUE(mesh.has_value()) << mesh.error().message();
    wrist.bones.push_back(make_bone(name, std::move(*mesh), Vec3::Zero()));
  }
  const AnatomicalFrame frame = anatomical_frame(wrist);
  EXPECT_TRUE(frame.from_bones);
  EXPECT_LT(frame.distal_W.y(), -0.95);
  // It is a right hand: seen from the back with the fingers up, the thumb is on the left.
  EXPECT_GT(frame.distal_W.cross(frame.radial_W).dot(frame.dorsal_W), 0.99);
}

TEST(PresetCamera, LooksFromItsSideWithFingersUp) {
  const Case hand = ball_hand(Vec3::UnitX(), Vec3::UnitZ(), Vec3::UnitY());
  const struct {
    ViewPreset preset;
    Vec3 from;
    bool orthographic;
  } presets[] = {
      {ViewPreset::kDorsal, Vec3::UnitZ(), false}, {ViewPreset::kPalmar, -Vec3::UnitZ(), false},
      {ViewPreset::kRadial, Vec3::UnitY(), false}, {ViewPreset::kUlnar, -Vec3::UnitY(), false},
      {ViewPreset::kAp, Vec3::UnitZ(), true},      {ViewPreset::kLateral, Vec3::UnitY(), true}};
  for (const auto& expected : presets) {
    const Camera camera = preset_camera(expected.preset, hand, 1.5);
    EXPECT_GT((camera.q_WC * Vec3::UnitZ()).dot(expected.from), 0.98);
    EXPECT_GT((camera.q_WC * Vec3::UnitY()).dot(Vec3::UnitX()), 0.98);
    EXPECT_EQ(camera.orthographic, expected.orthographic);
  }
}

TEST(PresetCamera, FramesEveryPointTightly) {
  Random random(9);
  for (const double aspect : {0.5, 1.0, 16.0 / 9}) {
    const Axes axes = random_axes(random, false);
    const Case hand = ball_hand(axes.distal, axes.dorsal, axes.radial);
    for (int k = 0; k < 6; ++k) {
      const Camera camera = preset_camera(static_cast<ViewPreset>(k), hand, aspect);
      const Viewport viewport{0, 0, static_cast<int>(900 * aspect), 900};
      double reach = 0;
      for (const Bone& bone : hand.bones) {
        for (const Vec3& p_B : bone.mesh.vertices) {
          const auto p = project(camera, viewport, bone.X_WB * p_B);
          ASSERT_TRUE(p.has_value());
          reach = std::max({reach, std::abs(2 * p->x / viewport.width - 1),
                            std::abs(2 * p->y / viewport.height - 1)});
        }
      }
      EXPECT_LT(reach, 0.96);
      EXPECT_GT(reach, 0.85);
    }
  }
}

/// Least and greatest place of the bones on the screen, each axis 0..1 from the lower left.
struct Extent {
  double left = 1e9, right = -1e9, bottom = 1e9, top = -1e9;
};
Extent extent_of(const Camera& camera, const Case& hand, double aspect) {
  const Viewport viewport{0, 0, static_cast<int>(900 * aspect), 900};
  Extent e;
  for (const Bone& bone : hand.bones) {
    for (const Vec3& p_B : bone.mesh.vertices) {
      const auto p = project(camera, viewport, bone.X_WB * p_B);
      if (!p) continue;
      e.left = std::min(e.left, p->x / viewport.width);
      e.right = std::max(e.right, p->x / viewport.width);
      e.bottom = std::min(e.bottom, 1 - p->y / viewport.height);
      e.top = std::max(e.top, 1 - p->y / viewport.height);
    }
  }
  return e;
}

TEST(PresetCamera, KeepsClearOfWhatCoversThePicture) {
  Random random(10);
  const CoveredEdges covered{0.15, 0.25, 0.05, 0.1};
  for (int k = 0; k < 24; ++k) {
    const Axes axes = random_axes(random, false);
    const Case hand = ball_hand(axes.distal, axes.dorsal, axes.radial);
    const double aspect = random.uniform(0.6, 2.4);
    const Extent e = extent_of(preset_camera(static_cast<ViewPreset>(k % 6), hand, aspect, covered),
                               hand, aspect);
    EXPECT_GT(e.left, 0.15);
    EXPECT_LT(e.right, 0.75);
    EXPECT_GT(e.bottom, 0.05);
    EXPECT_LT(e.top, 0.90);
    // As large as it can be, and in the middle of what is free.
    EXPECT_TRUE(e.right - e.left > 0.9 * 0.6 || e.top - e.bottom > 0.9 * 0.85);
    EXPECT_NEAR(e.left + e.right, 0.15 + 0.75, 0.02);
    EXPECT_NEAR(e.bottom + e.top, 0.05 + 0.90, 0.02);
  }
}

TEST(PresetCamera, ShowsALongForearmWhole) {
  Case hand = ball_hand(Vec3::UnitX(), Vec3::UnitZ(), Vec3::UnitY());
  hand.bones[0].mesh.vertices.emplace_back(-0.3, 0, 0);
  const Extent e = extent_of(preset_camera(ViewPreset::kDorsal, hand, 1.5), hand, 1.5);
  EXPECT_GT(e.bottom, 0.02);
  EXPECT_LT(e.top, 0.98);
}

TEST(CloseUpCamera, FramesTheBoneElseTheCarpusElseAll) {
  const Case hand = ball_hand(Vec3::UnitX(), Vec3::UnitZ(), Vec3::UnitY());
  const Camera from = preset_camera(ViewPreset::kRadial, hand, 1.5);
  const Camera bone = close_up_camera(from, hand, BoneId{0}, 1.5);
  const Camera carpus = close_up_camera(from, hand, BoneId{}, 1.5);
  EXPECT_LT(bone.distance_m, carpus.distance_m);
  EXPECT_LT(carpus.distance_m, from.distance_m);
  EXPECT_LT((bone.target_W - hand.bones[0].X_WB.p).norm(), 0.001);
  EXPECT_TRUE(bone.q_WC.isApprox(from.q_WC));
  Case plain = hand;
  for (Bone& b : plain.bones) b.name = "stone";
  EXPECT_NEAR(close_up_camera(from, plain, BoneId{}, 1.5).distance_m, from.distance_m, 1e-9);
  EXPECT_TRUE(is_finite(close_up_camera(from, Case{}, BoneId{7}, 1.5).eye_W()));
}

TEST(PresetCamera, EmptyCaseAndNonFinitePointsDoNoHarm) {
  EXPECT_TRUE(is_finite(preset_camera(ViewPreset::kDorsal, Case{}, 1.0).eye_W()));
  Case hand = ball_hand(Vec3::UnitX(), Vec3::UnitZ(), Vec3::UnitY());
  hand.bones[4].mesh.vertices[0].x() = std::numeric_limits<double>::infinity();
  const Camera camera = preset_camera(ViewPreset::kPalmar, hand, 0.0);
  EXPECT_TRUE(is_finite(camera.eye_W()));
}

}  // namespace
}  // namespace osteon
