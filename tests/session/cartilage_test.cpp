// A bone that is felt and carved with the cartilage of its case.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "drilling.h"
#include "osteon/carve/removed.h"
#include "osteon/scene/carve_events.h"

namespace osteon {
namespace {

using testing::Drilling;
using testing::kTop_m;

constexpr double kLayer_m = 0.0015;
constexpr auto kCartilageAt = static_cast<std::size_t>(BoneTissue::kCartilage);
constexpr auto kCorticalAt = static_cast<std::size_t>(BoneTissue::kCortical);
constexpr auto kCancellousAt = static_cast<std::size_t>(BoneTissue::kCancellous);

/// The block of the other tests under 1.5 mm of cartilage, turned and set aside in World.
std::shared_ptr<const Case> covered_block(Felt felt, bool closed = true) {
  CaseDef def;
  def.name = "covered block";
  BoneDef bone;
  bone.name = "block";
  bone.mesh = testing::box_mesh(Vec3(0.005, 0.005, kTop_m));
  bone.X_WB.p = {0.01, 0, 0};
  bone.X_WB.q = Quat(Eigen::AngleAxisd(0.4, Vec3::UnitZ()));
  bone.felt = felt;
  SoftDef layer;
  layer.name = "layer";
  layer.kind = "cartilage";
  layer.tissue = "articular_cartilage";
  layer.bones = {"block"};
  layer.thickness_m = kLayer_m;
  layer.mesh_W = testing::box_mesh(Vec3(0.004, 0.004, 0.5 * kLayer_m));
  for (Vec3& v : layer.mesh_W.vertices) v = bone.X_WB * (v + Vec3(0, 0, kTop_m + 0.5 * kLayer_m));
  if (!closed) layer.mesh_W.triangles.pop_back();
  def.bones.push_back(bone);
  def.softs.push_back(layer);
  auto built = build_case(std::move(def));
  EXPECT_TRUE(built);
  return std::make_shared<const Case>(std::move(*built));
}

Drilling on_layer(const std::string& instrument, Felt felt = Felt::kCovered) {
  Drilling with(instrument);
  with.the_case = covered_block(felt);
  auto made = make_carving(*with.the_case, with.settings.tray, with.settings.carve);
  EXPECT_TRUE(made);
  with.setup = *made;
  return with;
}

struct Work {
  ByTissue gone_mm3{};
  std::vector<EventKind> kinds;
  double first_touch_m = 0;  ///< over the bone's top
  std::uint64_t hash = 0;
};

/// The hand comes down on the layer's middle and presses; `lean` leans the shaft about x. From tick
/// `again` on it goes on in a session that was given the state of the first one.
Work work(const Drilling& with, double lean, int ticks, double speed = 0.02, int again = 0) {
  auto owned = std::make_unique<Session>(with.session());
  Work out;
  const Pose X_WB = with.the_case->bones[0].X_WB;
  for (int n = 1; n <= ticks; ++n) {
    if (n == again) {
      const SessionState state = owned->save();
      owned = std::make_unique<Session>(with.session());
      EXPECT_TRUE(owned->restore(state));
    }
    Session& session = *owned;
    HandInput input;
    const double z = std::max(0.003 - speed * 0.001 * n, -0.004);
    input.input.X_WD.p = X_WB * Vec3(0.0003, 0.0002, kTop_m + z);
    input.input.X_WD.q = Quat(Eigen::AngleAxisd(lean, Vec3::UnitX()));
    if (n == 2) input.command = {CommandKind::kPower, 1.0};
    (void)session.tick(std::span(&input, 1));
    for (const Event& event : session.last_events()) out.kinds.push_back(event.kind);
    if (out.first_touch_m == 0 && session.tool_state().force_W.norm() > 0.05)
      out.first_touch_m = (X_WB.inverse() * session.tool_state().X_WP.p).z() - kTop_m;
  }
  out.gone_mm3 = removed_volume(*owned->carving()->field(0));
  for (double& volume : out.gone_mm3) volume *= 1e9;
  out.hash = owned->state_hash();
  return out;
}

std::size_t place_of(const Work& work, EventKind kind) {
  return static_cast<std::size_t>(std::find(work.kinds.begin(), work.kinds.end(), kind) -
                                  work.kinds.begin());
}

TEST(CaseCartilage, AShaverTakesItAndAnEventNamesIt) {
  constexpr double kLeaning = -std::numbers::pi / 3;
  const Work done = work(on_layer("shaver:3.5"), kLeaning, 1600);
  EXPECT_GT(done.gone_mm3[kCartilageAt], 0.5);
  EXPECT_EQ(done.gone_mm3[kCorticalAt] + done.gone_mm3[kCancellousAt], 0);
  EXPECT_LT(place_of(done, kCartilageEntered), done.kinds.size());
  EXPECT_EQ(place_of(done, kCortexEntered), done.kinds.size());
  // The same bone felt without its cartilage.
  const Work bare = work(on_layer("shaver:3.5", Felt::kField), kLeaning, 1600);
  EXPECT_EQ(total(bare.gone_mm3), 0);
  EXPECT_EQ(place_of(bare, kCartilageEntered), bare.kinds.size());
}

TEST(CaseCartilage, ADrillGoesThroughItAndThenIntoBone) {
  const Work done = work(on_layer("drill:3.2"), 0, 4000, 0.005);
  const double disc = std::numbers::pi * 1.6 * 1.6 * 1000 * kLayer_m;
  EXPECT_NEAR(done.gone_mm3[kCartilageAt], disc, 0.02 * disc);
  EXPECT_GT(done.gone_mm3[kCorticalAt], 1);
  const std::size_t cartilage = place_of(done, kCartilageEntered);
  const std::size_t cortex = place_of(done, kCortexEntered);
  EXPECT_LT(cartilage, cortex);
  EXPECT_LT(cortex, done.kinds.size());
}

// A probe's tip stands on the layer, not on the bone under it.
TEST(CaseCartilage, ItIsFelt) {
  const Work on_it = work(on_layer("drill:3.2"), 0, 200);
  EXPECT_NEAR(on_it.first_touch_m, kLayer_m, 0.0002);
  const Work under_it = work(on_layer("drill:3.2", Felt::kField), 0, 200);
  EXPECT_NEAR(under_it.first_touch_m, 0, 0.0002);
}

TEST(CaseCartilage, AStateThatIsPutBackGoesOnBitByBit) {
  const Drilling with = on_layer("drill:3.2");
  const Work whole = work(with, 0, 1500, 0.005), parted = work(with, 0, 1500, 0.005, 900);
  EXPECT_GT(whole.gone_mm3[kCartilageAt], 1);
  EXPECT_EQ(whole.hash, parted.hash);
  EXPECT_EQ(whole.gone_mm3, parted.gone_mm3);
}

TEST(CaseCartilage, ALayerThatIsNotClosedIsLeftOut) {
  const auto open = covered_block(Felt::kCovered, false);
  EXPECT_EQ(open->bones[0].covered, nullptr);
  const auto closed = covered_block(Felt::kCovered);
  ASSERT_NE(closed->bones[0].covered, nullptr);
  EXPECT_NE(open->bones[0].field->hash(), closed->bones[0].field->hash());
  EXPECT_EQ(open->bones[0].field->hash(), covered_block(Felt::kField)->bones[0].field->hash());
  EXPECT_NE(open->hash, closed->hash);
}

}  // namespace
}  // namespace osteon
