#include "segment/segment_work.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <memory>

#include "image/dice.h"
#include "osteon/anatomy/virtual_scan.h"
#include "osteon/image/label_tools.h"
#include "osteon/image/segment.h"
#include "osteon/mesh/isosurface.h"
#include "osteon/mesh/measure.h"
#include "osteon/scene/case_io.h"

namespace osteon {
namespace {

namespace fs = std::filesystem;

struct Ball {
  Vec3 centre_W;
  double radius_m;
};

// Two bones 0.2 mm apart: in half millimetre voxels their cortices run into each other.
const Ball kLarge{Vec3(0, 0, 0), 0.008}, kSmall{Vec3(0.0142, 0.001, 0), 0.006};

TriMesh mesh_of(const Ball& ball) {
  Aabb box;
  box.include(Vec3::Constant(-ball.radius_m - 0.002));
  box.include(Vec3::Constant(ball.radius_m + 0.002));
  return isosurface([&](const Vec3& p) { return p.norm() - ball.radius_m; }, box).value();
}

Volume scan_of_balls() {
  const TriMesh large = mesh_of(kLarge), small = mesh_of(kSmall);
  const ScannedBone bones[] = {{&large, {kLarge.centre_W, Quat::Identity()}},
                               {&small, {kSmall.centre_W, Quat::Identity()}}};
  ScanOptions options;
  options.flesh_m = 0.004;
  return virtual_scan({bones}, load_default_tissues().value(), options).value();
}

std::array<int, 3> voxel_of(const GridFrame& frame, const Vec3& p_W) {
  const Vec3 at = frame.voxel(scanner_pose_PW() * p_W);
  return {static_cast<int>(std::lround(at.x())), static_cast<int>(std::lround(at.y())),
          static_cast<int>(std::lround(at.z()))};
}

/// On the cortex, on the side away from the other ball.
Vec3 cortex_W(const Ball& ball, double side) {
  return ball.centre_W + Vec3(side * (ball.radius_m - 0.0006), 0, 0);
}

class SegmentWork : public ::testing::Test {
 protected:
  void SetUp() override {
    dir_ = fs::temp_directory_path() / ("osteon_segment_" + std::to_string(::getpid()));
    fs::create_directories(dir_);
  }
  void TearDown() override { fs::remove_all(dir_); }

  SegmentSaveOrder order_of(const LabelEdit& edit, const BoneLevels& levels) const {
    SegmentSaveOrder order;
    order.volume = edit.shared_volume();
    order.labels = edit.labels();
    for (const auto& [label, bone] : edit.bones()) order.names[label] = bone.name;
    order.levels = levels;
    order.out = dir_ / "case";
    return order;
  }
  fs::path dir_;
};

TEST_F(SegmentWork, AScanThatIsNotThereAndNothingToSaveAreSaid) {
  EXPECT_FALSE(open_scan({dir_ / "nowhere", {}, {}}));
  auto volume = std::make_shared<Volume>();
  volume->frame.size = {4, 4, 4};
  volume->values.assign(64, 0);
  LabelEdit edit = LabelEdit::begin(volume).value();
  EXPECT_FALSE(save_segments(order_of(edit, {})));
  (void)edit.add("lunate");
  const auto none = save_segments(order_of(edit, {}));
  ASSERT_FALSE(none);
  EXPECT_NE(none.error().message().find("no bone to save"), std::string::npos);
  EXPECT_FALSE(fs::exists(dir_ / "case"));
}

/// Share of agreement of a label with a ball's own voxels.
double agreement(const LabelEdit& edit, std::uint16_t label, const Ball& ball) {
  const GridFrame& frame = edit.labels().frame;
  Mask found{frame, {}}, truth{frame, {}};
  const Vec3 centre_P = scanner_pose_PW() * ball.centre_W;
  for (int k = 0; k < frame.size[2]; ++k)
    for (int j = 0; j < frame.size[1]; ++j)
      for (int i = 0; i < frame.size[0]; ++i) {
        found.values.push_back(edit.labels().at(i, j, k) == label);
        truth.values.push_back((frame.point_P(Vec3(i, j, k)) - centre_P).norm() < ball.radius_m);
      }
  return dice(found, truth);
}

void expect_surface_near(const CaseDef& def, const std::string& name, const Ball& ball) {
  const auto bone = std::find_if(def.bones.begin(), def.bones.end(),
                                 [&](const BoneDef& b) { return b.name == name; });
  ASSERT_NE(bone, def.bones.end());
  EXPECT_TRUE(topology(bone->mesh).closed());
  const Vec3 centre_P = scanner_pose_PW() * ball.centre_W;
  double sum = 0;
  for (const Vec3& v : bone->mesh.vertices)
    sum += std::abs((bone->X_WB * v - centre_P).norm() - ball.radius_m);
  // A third of a voxel, as the import promises.
  EXPECT_LT(sum / static_cast<double>(bone->mesh.vertices.size()), 0.0005 / 3);
}

// From a virtual scan of known bones, by the tools a hand would use, back to those bones.
TEST_F(SegmentWork, GrownSplitAndSavedBonesAreThoseThatWereScanned) {
  const auto volume = std::make_shared<const Volume>(scan_of_balls());
  const BoneLevels levels = find_bone_levels(*volume);
  LabelEdit edit = LabelEdit::begin(volume).value();
  GrowOptions grow;
  grow.range.lo = static_cast<int>(levels.threshold_hu);
  ASSERT_TRUE(grow_new_label(edit, voxel_of(volume->frame, cortex_W(kLarge, -1)), grow));
  ASSERT_EQ(edit.labels().at(0, 0, 0), 0);
  const auto in_small = voxel_of(volume->frame, kSmall.centre_W);
  ASSERT_EQ(edit.labels().at(in_small[0], in_small[1], in_small[2]), 1) << "they are connected";
  const auto part =
      split_label_between(edit, voxel_of(volume->frame, cortex_W(kLarge, -1)), in_small);
  ASSERT_TRUE(part) << part.error().message();
  ASSERT_TRUE(edit.rename(1, "lunate"));
  ASSERT_TRUE(edit.rename(*part, "capitate"));
  EXPECT_GT(agreement(edit, 1, kLarge), 0.95);
  EXPECT_GT(agreement(edit, *part, kSmall), 0.95);

  const auto saved = save_segments(order_of(edit, levels));
  ASSERT_TRUE(saved) << saved.error().message();
  EXPECT_EQ(saved->bones, 2u);
  EXPECT_EQ(saved->open_surfaces, 0u);
  const auto def = load_case(saved->folder);
  ASSERT_TRUE(def) << def.error().message();
  EXPECT_EQ(def->name, "case");
  expect_surface_near(*def, "lunate", kLarge);
  expect_surface_near(*def, "capitate", kSmall);
  EXPECT_EQ(def->bones[0].fma_id, 23712);
}

TEST_F(SegmentWork, ACaseIsReplacedOnlyWhenThatIsAskedForAndNeverHalf) {
  const auto volume = std::make_shared<const Volume>(scan_of_balls());
  const BoneLevels levels = find_bone_levels(*volume);
  LabelEdit edit = LabelEdit::begin(volume).value();
  ASSERT_TRUE(label_bodies(edit, {.range = {static_cast<int>(levels.threshold_hu), 32767}}));
  SegmentSaveOrder order = order_of(edit, levels);
  ASSERT_TRUE(save_segments(order));
  EXPECT_FALSE(save_segments(order)) << "it is there already";
  order.replace = true;
  order.names[1] = "hamate";
  EXPECT_FALSE(save_segments(order, [](const char*, double share) { return share < 0.5; }));
  EXPECT_EQ(load_case(order.out)->bones[0].name, "bone_1");
  ASSERT_TRUE(save_segments(order));
  EXPECT_EQ(load_case(order.out)->bones[0].name, "hamate");
  std::size_t left = 0;
  for (const auto& entry : fs::directory_iterator(dir_)) left += entry.exists() ? 1 : 0;
  EXPECT_EQ(left, 1u) << "the old one or a part of the new one is still beside it";
}

TEST_F(SegmentWork, ThePreviewLiesOnTheBone) {
  const auto volume = std::make_shared<const Volume>(scan_of_balls());
  const BoneLevels levels = find_bone_levels(*volume);
  LabelEdit edit = LabelEdit::begin(volume).value();
  ASSERT_TRUE(label_bodies(edit, {.range = {static_cast<int>(levels.threshold_hu), 32767}}));
  const auto preview = draw_preview(preview_order(edit, 1, levels));
  ASSERT_TRUE(preview) << preview.error().message();
  EXPECT_EQ(preview->version, edit.bones().at(1).version);
  const Vec3 a = scanner_pose_PW() * kLarge.centre_W, b = scanner_pose_PW() * kSmall.centre_W;
  for (const Vec3& p : preview->mesh_P.vertices) {
    const double off = std::min((p - a).norm() - kLarge.radius_m, (p - b).norm() - kSmall.radius_m);
    EXPECT_LT(std::abs(off), 0.001);
  }
}

}  // namespace
}  // namespace osteon
