// A spinal needle that finds the way of a portal through a patch of skin.
#include <algorithm>
#include <numbers>

#include "osteon/physics/soft_world.h"
#include "osteon/procedure/portal_watch.h"
#include "osteon/scene/instrument.h"
#include "osteon/scene/needle.h"
#include "osteon/scene/soft_events.h"
#include "skin_fixtures.h"

namespace osteon {
namespace {

using testing::kBoxHalf;
using testing::SkinHandAt;

// The needle of the instruments' table over skin under which a bone lies 40 mm deep.
struct NeedleRun {
  std::shared_ptr<const Case> the_case;
  SessionSettings settings;
  Tray tray;
  std::shared_ptr<const SoftSetup> softs;

  NeedleRun() {
    CaseDef def;
    def.name = "skin over a joint";
    BoneDef bone;
    bone.name = "tibia";
    bone.X_WB.p = {0, 0, -0.040 - kBoxHalf.z()};
    bone.mesh = testing::box_mesh(kBoxHalf);
    def.bones.push_back(bone);
    SoftDef soft;
    soft.name = soft.tissue = soft.kind = "skin";
    soft.mesh_W = testing::skin_mesh();
    def.softs.push_back(soft);
    const Vec3 in = -Vec3::UnitZ();
    def.landmarks = {{"portal_al", {0, -0.030, 0}, in},
                     {"portal_am", {0, 0, 0}, in},
                     {"tibial_tubercle", {0.040, -0.015, -0.010}}};
    auto built = build_case(std::move(def));
    EXPECT_TRUE(built) << built.error().message();
    the_case = std::make_shared<const Case>(std::move(*built));
    const auto instruments = load_instruments();
    const Instrument* needle =
        instruments ? find_instrument(*instruments, std::string(kSpinalNeedle)) : nullptr;
    EXPECT_TRUE(needle);
    if (!needle) return;
    tray = {std::make_shared<const Tool>(make_tool(*needle, needle->usual_size))};
    settings.tray = {std::string(kSpinalNeedle)};
    settings.soft = {"skin:portal_am"};
    settings.haptic.max_force_n = 60;
    settings.haptic.max_slew_n_per_s = 1e5;
    auto patches = make_skin_patches(*the_case, settings.soft, {Vec3::UnitX()}, {});
    auto uses = make_skin_tools(settings.tray);
    EXPECT_TRUE(patches && uses);
    SoftSetup setup;
    if (patches && uses) add_skins(setup, std::move(*patches), std::move(*uses));
    settings.soft_hash = setup.hash;
    softs = std::make_shared<const SoftSetup>(std::move(setup));
  }
  Session session() const { return Session(the_case, settings, tray, nullptr, softs); }
};

const NeedleRun& needle_run() {
  static const NeedleRun run;
  return run;
}

TEST(SpinalNeedle, OverTheSkinItIsNotFelt) {
  Session session = needle_run().session();
  SkinHandAt hand(session);
  hand.move({0, 0, 0.001}, 300);
  EXPECT_EQ(hand.most_n, 0);
  EXPECT_EQ(hand.count(kSkinPierced), 0u);
}

TEST(SpinalNeedle, ItGoesThroughWithLessThanTwoNewtonsAndMakesNoPortal) {
  Session session = needle_run().session();
  SkinHandAt hand(session);
  hand.move({0, 0, -0.025}, 1500);
  hand.rest(100);
  EXPECT_EQ(hand.count(kSkinPierced), 1u);
  EXPECT_GT(hand.most_n, 1);
  EXPECT_LT(hand.most_n, 2);
  EXPECT_LT(*std::max_element(hand.force_z.begin(), hand.force_z.end()), 2);
  EXPECT_EQ(hand.count(kPortalMade), 0u);
  EXPECT_EQ(session.tool_state().portal, kNoPortal);
  EXPECT_EQ(session.softs()->skin_readout(0).portals, 0u);
  hand.move({0, 0, 0.010}, 800);
  hand.rest(100);
  EXPECT_EQ(hand.count(kSkinLeft), 1u);
  EXPECT_EQ(session.tool_state().force_W, Vec3(0, 0, 0));
}

// Told from 8 mm on; as seen only where a scope in a portal has its tip in the picture.
TEST(SpinalNeedle, ItsHoleIsToldAndWhetherAScopeSeesItsTip) {
  const NeedleRun& run = needle_run();
  for (const bool looks : {false, true}) {
    Session session = run.session();
    SkinHandAt hand(session);
    hand.at = {0.002, 0.001, 0.020};
    PortalWatch watch(*run.the_case,
                      {{0, 1, 1, 1}, {std::nullopt, ScopeOptics{std::numbers::pi / 6, 0.9}}});
    watch.set_needles({1});
    ToolState scope;
    scope.tick = 1;
    scope.instrument = 1;
    scope.portal = looks ? 0 : kNoPortal;
    scope.X_WP.p = {0.002, -0.020, -0.012};
    scope.X_WP.q = Quat::FromTwoVectors(Vec3::UnitZ(), -Vec3::UnitY());
    std::vector<Event> told;
    const auto go_to = [&](double z) {
      hand.move({0.002, 0.001, z}, 300);
      const std::array<const ToolState*, 2> tools{&session.tool_state(), &scope};
      watch.add(tools, session.bones(), told);
    };
    go_to(-0.005);
    EXPECT_TRUE(told.empty());
    go_to(-0.014);
    ASSERT_EQ(told.size(), 1u);
    EXPECT_EQ(told[0].kind, kNeedleIn);
    EXPECT_EQ(told[0].subject, 1u);
    EXPECT_NEAR(told[0].values[0], -2, 0.2);
    EXPECT_NEAR(told[0].values[1], -1, 0.2);
    EXPECT_EQ(told[0].values[2], looks ? 1 : 0);
  }
}

// Nothing stops it in the joint but bone.
TEST(SpinalNeedle, BoneStopsIt) {
  Session session = needle_run().session();
  SkinHandAt hand(session);
  hand.move({0, 0, -0.030}, 1500);
  hand.rest(100);
  EXPECT_LT(std::abs(session.tool_state().force_W.z()), 2);
  hand.move({0, 0, -0.043}, 500);
  hand.rest(100);
  EXPECT_GT(session.tool_state().X_WP.p.z(), -0.0405);
  EXPECT_GT(session.tool_state().force_W.z(), 3);
}

}  // namespace
}  // namespace osteon
