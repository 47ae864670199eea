#pragma once

#include <memory>
#include <string>
#include <vector>

#include "osteon/physics/soft_setup.h"
#include "osteon/scene/tool_set.h"
#include "session_fixtures.h"

namespace osteon::testing {

inline constexpr double kBandGap_m = 0.030;
/// Where the middle of the band between the boxes is at rest.
inline const Vec3 kBandMiddle(kBoxHalf.x() + kBandGap_m / 2, 0, 0);
inline constexpr double kBandRadius_m = 0.003, kShaftRadius_m = 0.0015;

/// Two boxes with a ligament between them along x, and a table that knows it.
inline std::shared_ptr<const Case> band_case(const std::string& finding = {}) {
  CaseDef def;
  def.name = "two boxes and a band";
  for (int i = 0; i < 2; ++i) {
    BoneDef bone;
    bone.name = i == 0 ? "femur" : "tibia";
    bone.X_WB.p = {i * (2 * kBoxHalf.x() + kBandGap_m), 0, 0};
    bone.mesh = box_mesh(kBoxHalf);
    def.bones.push_back(bone);
  }
  SoftDef soft;
  soft.name = "acl";
  soft.tissue = "ligament";
  soft.kind = "ligament";
  // As much in it as in a round one of 3 mm.
  const double half = kBandRadius_m * std::sqrt(std::numbers::pi) / 2;
  soft.mesh_W = box_mesh(Vec3(kBandGap_m / 2, half, half));
  for (Vec3& p : soft.mesh_W.vertices) p += kBandMiddle;
  soft.bones = {"femur", "tibia"};
  soft.attachments = {{"acl_femur", "femur", kBandMiddle - Vec3(kBandGap_m / 2, 0, 0)},
                      {"acl_tibia", "tibia", kBandMiddle + Vec3(kBandGap_m / 2, 0, 0)}};
  def.softs.push_back(soft);
  if (!finding.empty()) def.findings.push_back({finding, "midsubstance", "torn"});
  auto built = build_case(std::move(def));
  if (!built) return nullptr;
  return std::make_shared<const Case>(std::move(*built));
}

inline constexpr double kBandStiffness_n = 6000, kBandStrain = 0.05, kBandToe = 0.002;
inline constexpr double kBandSurface_n_per_m = 800;

/// One bundle that is taut by kBandStrain at rest.
inline LigamentTable band_table(double strain = kBandStrain, double failure_n = 2160) {
  LigamentTable table;
  table.toe_strain = kBandToe;
  LigamentRow row;
  row.name = "acl";
  row.part = "acl";
  row.failure_n = failure_n;
  LigamentBundle bundle;
  bundle.name = "all";
  bundle.stiffness_n = kBandStiffness_n;
  bundle.strain = strain;
  row.bundles.push_back(bundle);
  table.ligaments.push_back(row);
  table.torn.push_back({"acl_tear", "", "acl", 0, {}});
  return table;
}

/// A straight shaft across the band, its tip 20 mm behind it.
inline Tool shaft_tool() {
  Tool tool;
  tool.name = "shaft";
  tool.parts.push_back(make_rod(Vec3(0, 0, 0), Vec3(0, 0, 0.060), kShaftRadius_m));
  return tool;
}

struct BandRun {
  std::shared_ptr<const Case> the_case;
  SessionSettings settings;
  Tray tray = {std::make_shared<const Tool>(shaft_tool())};
  std::shared_ptr<const SoftSetup> softs;

  explicit BandRun(const LigamentTable& table = band_table(), const std::string& finding = {})
      : the_case(band_case(finding)) {
    settings.soft = {"ligaments"};
    settings.tray = {"shaft"};
    settings.haptic.max_force_n = 40;
    auto made = make_soft_setup(*the_case, table, settings.soft, kBandSurface_n_per_m);
    if (!made) return;
    softs = std::make_shared<const SoftSetup>(std::move(*made));
    settings.soft_hash = softs->hash;
  }
  Session session() const { return Session(the_case, settings, tray, nullptr, softs); }
};

/// The shaft stands along y beside the band; its axis is `z_m` above the band's middle line.
inline ToolInput shaft_at(double z_m, double v_m_per_s = 0, double x_m = 0) {
  ToolInput input;
  input.X_WD.p = kBandMiddle + Vec3(x_m, 0.020, z_m);
  input.X_WD.q = Quat(std::sqrt(0.5), std::sqrt(0.5), 0, 0);  // z of the tool to -y
  input.v_W = {0, 0, v_m_per_s};
  return input;
}

/// Height of the shaft's axis where it touches.
inline constexpr double kTouch_m = kBandRadius_m + kShaftRadius_m;

}  // namespace osteon::testing
