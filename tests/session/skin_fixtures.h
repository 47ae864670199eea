#pragma once

// A patch of skin over a bone, and what presses, cuts and pierces it.
#include <gtest/gtest.h>

#include "osteon/collide/primitive.h"
#include "osteon/physics/skin_setup.h"
#include "osteon/physics/soft_setup.h"
#include "osteon/physics/soft_world.h"
#include "osteon/session/session.h"
#include "recorded_run.h"
#include "session_fixtures.h"

namespace osteon::testing {

inline constexpr double kBallTip_m = 0.0025, kTrocar_m = 0.00275;
inline constexpr std::uint32_t kSkinBall = 0, kSkinBlade = 1, kSkinTrocar = 2, kSkinScope = 3,
                               kSkinPlate = 4;
inline const Vec3 kPlateHalf(0.006, 0.004, 0.0005);

// Skin at z = 0, or over a limb along y of that radius.
inline TriMesh skin_mesh(double limb_m = 0) {
  constexpr int kCells = 40;
  constexpr double kCell_m = 0.003;
  TriMesh mesh;
  for (int j = 0; j <= kCells; ++j)
    for (int i = 0; i <= kCells; ++i) {
      const double x = kCell_m * (i - kCells / 2), y = kCell_m * (j - kCells / 2);
      const double drop = limb_m > 0 ? limb_m - std::sqrt(limb_m * limb_m - x * x) : 0;
      mesh.vertices.emplace_back(x, y, -drop);
    }
  for (std::uint32_t j = 0; j < kCells; ++j)
    for (std::uint32_t i = 0; i < kCells; ++i) {
      const std::uint32_t a = j * (kCells + 1) + i, b = a + 1, c = a + kCells + 1, d = c + 1;
      mesh.triangles.push_back({a, b, d});
      mesh.triangles.push_back({a, d, c});
    }
  return mesh;
}

// A tendon under the half of the skin with negative x, its upper face and that edge.
inline TriMesh tendon_mesh(double deep_m) {
  TriMesh mesh;
  mesh.vertices = {{-0.030, -0.030, -deep_m},
                   {0, -0.030, -deep_m},
                   {0, 0.030, -deep_m},
                   {-0.030, 0.030, -deep_m}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

// `tendon_m`: how deep under the skin's top a tendon lies; 0: there is none.
inline std::shared_ptr<const Case> skin_case(double limb_m = 0, double tendon_m = 0) {
  CaseDef def;
  def.name = "skin over a bone";
  BoneDef bone;
  bone.name = "tibia";
  bone.X_WB.p = {0, 0, -0.060};
  bone.mesh = box_mesh(kBoxHalf);
  def.bones.push_back(bone);
  SoftDef soft;
  soft.name = soft.tissue = soft.kind = "skin";
  soft.mesh_W = skin_mesh(limb_m);
  def.softs.push_back(soft);
  if (tendon_m > 0) {
    soft.name = soft.tissue = soft.kind = "tendon";
    soft.mesh_W = tendon_mesh(tendon_m);
    def.softs.push_back(soft);
  }
  def.landmarks.push_back({"portal_al", Vec3::Zero(), -Vec3::UnitZ()});
  def.landmarks.push_back({"beside", Vec3(0.010, 0, 0), Vec3::Zero()});
  def.landmarks.push_back({"aside", Vec3(0.020, 0, 0), Vec3::Zero()});
  auto built = build_case(std::move(def));
  return built ? std::make_shared<const Case>(std::move(*built)) : nullptr;
}

inline Tool tool_with(const char* name, Primitive part) {
  Tool tool;
  tool.name = name;
  tool.parts.push_back(std::move(part));
  return tool;
}

// A ball; a blade in the plane of x and z, its tip down; a trocar and a scope of one width; a plate
// that lies flat, the tip in the middle of its lower face.
inline std::vector<Tool> skin_tools() {
  std::vector<Tool> out;
  const auto rod = [](double from, double to, double radius) {
    return make_rod(Vec3(0, 0, from), Vec3(0, 0, to), radius);
  };
  out.push_back(tool_with("ball", rod(kBallTip_m, kBallTip_m, kBallTip_m)));
  out.push_back(tool_with(
      "blade", make_box({Vec3(0, 0, 0.0042), Quat::Identity()}, Vec3(0.0008, 0.0002, 0.0042))));
  out.back().use.cuts = true;
  for (const char* name : {"trocar", "scope"}) {
    out.push_back(tool_with(name, rod(kTrocar_m, kTrocar_m, kTrocar_m)));
    out.back().shaft = {Vec3(0, 0, kTrocar_m), Vec3(0, 0, 0.150), kTrocar_m};
    out.back().parts.push_back(make_rod(out.back().shaft.p0, out.back().shaft.p1, kTrocar_m));
  }
  out.push_back(
      tool_with("plate", make_box({Vec3(0, 0, kPlateHalf.z()), Quat::Identity()}, kPlateHalf)));
  return out;
}

struct SkinRun {
  std::shared_ptr<const Case> the_case;
  SessionSettings settings;
  Tray tray;
  std::shared_ptr<const SoftSetup> softs;

  explicit SkinRun(double limb_m = 0, bool portals = false, double tendon_m = 0,
                   std::vector<std::string> patches = {"skin"})
      : the_case(skin_case(limb_m, tendon_m)) {
    std::vector<SkinTool> uses;
    for (Tool& tool : skin_tools()) {
      settings.tray.push_back(tool.name);
      uses.push_back(skin_tool(tool, tool.name == "trocar"));
      tray.push_back(std::make_shared<const Tool>(std::move(tool)));
    }
    settings.soft = std::move(patches);
    settings.haptic.max_force_n = 60;
    settings.haptic.max_slew_n_per_s = 1e5;
    settings.force_limit_n = 5;
    settings.portals.clear();
    if (portals) settings.portals = {"AL"};
    auto made = make_skin_patches(*the_case, settings.soft, {Vec3::UnitY()}, {});
    EXPECT_TRUE(made) << made.error().message();
    SoftSetup setup;
    if (made) add_skins(setup, std::move(*made), std::move(uses));
    settings.soft_hash = setup.hash;
    softs = std::make_shared<const SoftSetup>(std::move(setup));
  }
  Session session() const { return Session(the_case, settings, tray, nullptr, softs); }
  const SkinPatch& patch() const { return softs->skins[0]; }
};

// One for all tests.
inline const SkinRun& skin_run() {
  static const SkinRun run;
  return run;
}

/// A hand whose tool stands upright, its tip at `at`.
struct SkinHandAt {
  explicit SkinHandAt(Session& s) : session(s) {}

  Session& session;
  Vec3 at{0, 0, 0.020};
  Quat q = Quat::Identity();
  std::vector<Event> events;
  std::vector<double> force_z;  ///< of each tick
  double most_n = 0;            ///< on the skin in a step, as physics has it
  Recording* into = nullptr;

  void tick(const Command& command = {}) {
    ToolInput input;
    input.X_WD = {at, q};
    (void)session.tick(input, command);
    for (const Event& event : session.last_events()) events.push_back(event);
    force_z.push_back(session.tool_state().force_W.z());
    if (session.softs()) most_n = std::max(most_n, session.softs()->skin_readout(0).force_n[0]);
    if (into) keep_tick(*into, session, 250);
  }
  void take(std::uint32_t instrument, const Vec3& from) {
    at = from;
    tick({CommandKind::kTake, static_cast<double>(instrument)});
    for (int n = 0; n < 40; ++n) tick();
  }
  void move(const Vec3& to, int ticks) {
    const Vec3 from = at;
    for (int n = 1; n <= ticks; ++n) {
      at = from + n / static_cast<double>(ticks) * (to - from);
      tick();
    }
  }
  void rest(int ticks) { move(Vec3(at), ticks); }
  std::size_t count(EventKind kind) const {
    std::size_t sum = 0;
    for (const Event& event : events) sum += event.kind == kind ? 1 : 0;
    return sum;
  }
  const Event* first(EventKind kind) const {
    for (const Event& event : events)
      if (event.kind == kind) return &event;
    return nullptr;
  }
  /// Force on the tool when it rests at `where`, come from above.
  double felt_at(const Vec3& where) {
    move({where.x(), where.y(), 0.010}, 60);
    move(where, 120);
    rest(60);
    return session.tool_state().force_W.z();
  }
};

}  // namespace osteon::testing
