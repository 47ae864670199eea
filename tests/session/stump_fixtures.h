#pragma once

// A stump that is a block on a bone, and the shipped instruments that clear it.
#include <gtest/gtest.h>

#include "osteon/mesh/append_mesh.h"
#include "osteon/physics/soft_setup.h"
#include "osteon/physics/stump_setup.h"
#include "osteon/scene/instrument.h"
#include "osteon/session/session.h"
#include "session_fixtures.h"

namespace osteon::testing {

inline const Vec3 kStumpHalf(0.005, 0.005, 0.006);
inline constexpr double kStumpsApart_m = 0.1;
inline constexpr double kStump_n_per_m = 800, kStumpCut_n = 30;

inline TriMesh box_at(const Vec3& half, const Vec3& middle) {
  TriMesh mesh = box_mesh(half);
  for (Vec3& p : mesh.vertices) p += middle;
  return mesh;
}

/// A ligament in two, on two bones side by side whose tops are at z = 0: on each stands a block of
/// 12 mm. Nothing is above them.
inline std::shared_ptr<const Case> stump_case() {
  CaseDef def;
  def.name = "a torn ligament";
  for (const bool second : {false, true}) {
    BoneDef bone;
    bone.name = second ? "femur" : "tibia";
    bone.X_WB.p = {second ? kStumpsApart_m : 0, 0, -kBoxHalf.z()};
    bone.mesh = box_mesh(kBoxHalf);
    def.bones.push_back(bone);
  }
  SoftDef soft;
  soft.name = "acl";
  soft.tissue = soft.kind = "ligament";
  soft.mesh_W = box_at(kStumpHalf, {0, 0, kStumpHalf.z()});
  append_mesh(soft.mesh_W, box_at(kStumpHalf, {kStumpsApart_m, 0, kStumpHalf.z()}));
  soft.bones = {"tibia", "femur"};
  soft.attachments = {{"foot", "tibia", {0, 0, 0}}, {"head", "femur", {kStumpsApart_m, 0, 0}}};
  def.softs.push_back(soft);
  auto built = build_case(std::move(def));
  EXPECT_TRUE(built) << built.error().message();
  return built ? std::make_shared<const Case>(std::move(*built)) : nullptr;
}

struct StumpRun {
  std::shared_ptr<const Case> the_case = stump_case();
  SessionSettings settings;
  Tray tray;
  std::shared_ptr<const SoftSetup> softs;

  StumpRun() {
    settings.soft = {"stumps"};
    settings.tray = {"shaver", "hook_probe", "rf_ablator", "basket_punch", "cannulated_drill:8"};
    settings.haptic.max_force_n = 40;
    const auto instruments = load_instruments();
    EXPECT_TRUE(instruments);
    for (const std::string& name : settings.tray) {
      const auto colon = name.find(':');
      const Instrument* found = find_instrument(*instruments, name.substr(0, colon));
      const std::size_t size =
          colon == std::string::npos ? found->usual_size : *find_size(*found, 8);
      tray.push_back(std::make_shared<const Tool>(make_tool(*found, size)));
    }
    auto made = make_stumps(*the_case, {kStump_n_per_m, kStumpCut_n});
    EXPECT_TRUE(made) << made.error().message();
    SoftSetup setup;
    if (made) add_solids(setup, std::move(*made));
    auto cutters = make_solid_cutters(settings.tray);
    EXPECT_TRUE(cutters) << cutters.error().message();
    if (cutters) add_cutters(setup, std::move(*cutters), 6);
    settings.soft_hash = setup.hash;
    softs = std::make_shared<const SoftSetup>(std::move(setup));
  }
  Session session() const { return Session(the_case, settings, tray, nullptr, softs); }
};

inline const StumpRun& stump_run() {
  static const StumpRun run;
  return run;
}

}  // namespace osteon::testing
