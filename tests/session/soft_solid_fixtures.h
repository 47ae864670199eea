#pragma once

// A meniscus that is a block on a bone, and a ball that presses it.
#include <gtest/gtest.h>

#include "osteon/physics/soft_setup.h"
#include "osteon/session/session.h"
#include "session_fixtures.h"

namespace osteon::testing {

inline const Vec3 kMeniscusHalf(0.012, 0.008, 0.003);
inline constexpr double kMeniscus_n_per_m = 900, kBallRadius_m = 0.001;
inline constexpr double kBlockTop_m =
    0.003 + kBallRadius_m;  // of the ball's middle where it touches

// The bone is far below, so that a hook can come from under the block.
inline std::shared_ptr<const Case> meniscus_case(const Vec3& bone_half = kBoxHalf) {
  CaseDef def;
  def.name = "a block on a bone";
  BoneDef bone;
  bone.name = "tibia";
  bone.X_WB.p = {0, 0, -0.040};
  bone.mesh = box_mesh(bone_half);
  def.bones.push_back(bone);
  SoftDef soft;
  soft.name = "medial_meniscus";
  soft.tissue = soft.kind = "meniscus";
  soft.mesh_W = box_mesh(kMeniscusHalf);
  soft.bones = {"tibia"};
  def.softs.push_back(soft);
  auto built = build_case(std::move(def));
  return built ? std::make_shared<const Case>(std::move(*built)) : nullptr;
}

struct MeniscusRun {
  std::shared_ptr<const Case> the_case;
  SessionSettings settings;
  Tray tray;
  std::shared_ptr<const SoftSetup> softs;

  explicit MeniscusRun(std::shared_ptr<const Case> of = meniscus_case()) : the_case(std::move(of)) {
    Tool ball;
    ball.name = "ball";
    ball.parts.push_back(make_rod(Vec3::Zero(), Vec3::Zero(), kBallRadius_m));
    tray = {std::make_shared<const Tool>(ball)};
    settings.soft = {"menisci"};
    settings.tray = {"ball"};
    settings.haptic.max_force_n = 40;
    auto made = make_soft_solids(*the_case, settings.soft, kMeniscus_n_per_m);
    EXPECT_TRUE(made) << made.error().message();
    SoftSetup setup;
    if (made) add_solids(setup, std::move(*made));
    settings.soft_hash = setup.hash;
    softs = std::make_shared<const SoftSetup>(std::move(setup));
  }
  Session session() const { return Session(the_case, settings, tray, nullptr, softs); }
};

// One for all tests: the block's stiffness takes a while to make.
inline const MeniscusRun& meniscus_run() {
  static const MeniscusRun run;
  return run;
}

}  // namespace osteon::testing
