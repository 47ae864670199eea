#include "window/controllers/cases/bone_edit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "osteon/mesh/measure.h"
#include "osteon/scene/case_io.h"

namespace osteon {
namespace {

/// A ball of 10 mm on a grid of rings, three vertices of their own for each triangle.
TriMesh loose_ball() {
  constexpr int kRings = 12;
  const auto at = [](int i, int j) {
    const double theta = M_PI * i / kRings, phi = 2 * M_PI * (j % (2 * kRings)) / (2 * kRings);
    const bool pole = i == 0 || i == kRings;
    return Vec3(0.01 * Vec3(pole ? 0.0 : std::sin(theta) * std::cos(phi),
                            pole ? 0.0 : std::sin(theta) * std::sin(phi), std::cos(theta)));
  };
  TriMesh m;
  const auto add = [&m](const Vec3& a, const Vec3& b, const Vec3& c) {
    const auto first = static_cast<std::uint32_t>(m.vertices.size());
    m.vertices.insert(m.vertices.end(), {a, b, c});
    m.triangles.push_back({first, first + 1, first + 2});
  };
  for (int i = 0; i < kRings; ++i)
    for (int j = 0; j < 2 * kRings; ++j) {
      if (i > 0) add(at(i, j), at(i + 1, j), at(i, j + 1));
      if (i + 1 < kRings) add(at(i, j + 1), at(i + 1, j), at(i + 1, j + 1));
    }
  return m;
}

Case one_ball() {
  Case c;
  Bone bone;
  bone.name = "ball";
  bone.mesh = loose_ball();
  c.bones.push_back(std::move(bone));
  return c;
}

const Pose kX_WB{Vec3(0.1, 0.2, 0.3), Quat(0.8, 0.6, 0, 0)};

ToolState probe_at(const Vec3& p_B, bool button, bool grabbing) {
  ToolState tool;
  tool.X_WP.p = tool.X_WD.p = kX_WB * p_B;
  tool.buttons = button ? 1 : 0;
  tool.status = grabbing ? kTickGrabbing : kTickOk;
  return tool;
}

TEST(BoneEdit, NeedsABone) {
  EXPECT_FALSE(BoneEdit::begin(one_ball(), BoneId{}));
  EXPECT_FALSE(BoneEdit::begin(one_ball(), BoneId{7}));
  Case empty = one_ball();
  empty.bones[0].mesh = {};
  EXPECT_FALSE(BoneEdit::begin(empty, BoneId{0}));
}

TEST(BoneEdit, AMeshOfLooseTrianglesDoesNotTear) {
  BoneEdit edit = *BoneEdit::begin(one_ball(), BoneId{0});
  EXPECT_EQ(edit.edit().mesh().vertices.size(), 2u + 11 * 24);
  edit.grab(Vec3(0, 0, 0.011));
  EXPECT_TRUE(edit.by_mouse());
  EXPECT_GT(edit.edit().selected().size(), 20u);
  edit.drag(Vec3(0, 0, 0.001));
  edit.release();
  EXPECT_TRUE(edit.findings().sound()) << edit.findings().summary();
  EXPECT_EQ(edit.edit().undo_steps(), 1u);
  EXPECT_GT(edit.version(), 0u);
}

// The button grabs what is near the tip; the drag is the hand's way since the resistance began,
// turned into the bone's frame.
TEST(BoneEdit, TheProbeDragsWhileItsButtonIsHeld) {
  BoneEdit edit = *BoneEdit::begin(one_ball(), BoneId{0});
  const Vec3 top(0, 0, 0.0115);
  EXPECT_FALSE(edit.follow(probe_at(top, true, false), kX_WB));  // held from before
  EXPECT_FALSE(edit.follow(probe_at(top, false, false), kX_WB));
  const auto begun = edit.follow(probe_at(top, true, false), kX_WB);
  ASSERT_TRUE(begun);
  EXPECT_EQ(begun->kind, CommandKind::kGrab);
  EXPECT_EQ(begun->value, kGrabStiffness_n_per_m);
  ASSERT_TRUE(edit.by_probe());
  EXPECT_NEAR((edit.edit().grabbed_at() - Vec3(0, 0, 0.01)).norm(), 0, 1e-12);
  const Vec3 later = top + Vec3(0.0001, 0, 0);  // where the haptic loop took the command
  EXPECT_FALSE(edit.follow(probe_at(top, true, false), kX_WB));
  EXPECT_EQ(edit.edit().displacement(), Vec3::Zero());
  EXPECT_FALSE(edit.follow(probe_at(later, true, true), kX_WB));
  const Vec3 way(0.0005, -0.0003, 0.0012);
  EXPECT_FALSE(edit.follow(probe_at(later + way, true, true), kX_WB));
  EXPECT_NEAR((edit.edit().displacement() - way).norm(), 0, 1e-12);
  const auto ended = edit.follow(probe_at(later + way, false, true), kX_WB);
  ASSERT_TRUE(ended);
  EXPECT_EQ(ended->value, 0);
  EXPECT_FALSE(edit.edit().is_grabbed());
  EXPECT_EQ(edit.edit().undo_steps(), 1u);
}

TEST(BoneEdit, TheProbeGrabsNothingFromAfar) {
  BoneEdit edit = *BoneEdit::begin(one_ball(), BoneId{0});
  edit.follow(probe_at(Vec3(0, 0, 0.02), false, false), kX_WB);
  EXPECT_FALSE(edit.follow(probe_at(Vec3(0, 0, 0.02), true, false), kX_WB));
  EXPECT_FALSE(edit.edit().is_grabbed());
}

TEST(BoneEdit, FindingsFollowUndoAndRedo) {
  BoneEdit edit = *BoneEdit::begin(one_ball(), BoneId{0});
  edit.grab(Vec3(0, 0, 0.01));
  edit.drag(Vec3(0.001, 0.0005, -0.03));
  edit.release();
  EXPECT_FALSE(edit.findings().sound());
  edit.undo();
  EXPECT_TRUE(edit.findings().sound());
  edit.redo();
  EXPECT_FALSE(edit.findings().crossings.empty());
}

TEST(BoneEdit, TheSelectionMayChange) {
  BoneEdit edit = *BoneEdit::begin(one_ball(), BoneId{0});
  const std::size_t before = edit.preview(Vec3(0, 0, 0.01)).size();
  edit.grab(Vec3(0, 0, 0.01));
  edit.drag(Vec3(0, 0, 0.001));
  edit.set_selection({0.012, FallOff::kCone});
  EXPECT_GT(edit.edit().selected().size(), before);
  EXPECT_EQ(edit.edit().displacement(), Vec3(0, 0, 0.001));
  EXPECT_EQ(edit.preview(Vec3(0, 0, -0.01)).front().weight, 1);
}

// The saved case has the edited bone and all else as it was; it reads back.
TEST(BoneEdit, SavesANewCase) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::path(OSTEON_BINARY_DIR) / "test-files/bone_edit";
  fs::remove_all(folder);
  CaseDef def;
  def.name = "two";
  for (const char* name : {"first", "second"}) {
    BoneDef bone;
    bone.name = name;
    bone.mesh = loose_ball();
    bone.density_kg_per_m3 = 1234;
    def.bones.push_back(bone);
  }
  ASSERT_TRUE(save_case(def, folder / "case"));
  TriMesh edited = loose_ball();
  for (Vec3& v : edited.vertices) v *= 2;
  const std::string spec = (folder / "case").string();
  EXPECT_FALSE(save_edited_case(spec, "third", edited, folder / "out"));
  EXPECT_FALSE(fs::exists(folder / "out"));
  ASSERT_TRUE(save_edited_case(spec, "second", edited, folder / "out"));
  const auto back = load_case(folder / "out");
  ASSERT_TRUE(back) << back.error().message();
  ASSERT_EQ(back->bones.size(), 2u);
  EXPECT_EQ(back->bones[1].density_kg_per_m3, 1234);
  EXPECT_NEAR(back->bones[0].mesh.vertices[5].norm(), 0.01, 1e-8);
  EXPECT_NEAR(back->bones[1].mesh.vertices[5].norm(), 0.02, 1e-8);
  // What the card shows while editing is what the saved case has.
  EXPECT_NEAR(volume(back->bones[1].mesh) / volume(edited), 1, 1e-6);
  EXPECT_FALSE(save_edited_case(spec, "second", edited, folder / "out"));  // is there already
}

}  // namespace
}  // namespace osteon
