#include "osteon/mesh/mesh_edit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "mesh/shapes.h"
#include "mesh/surface_checks.h"
#include "osteon/base/random.h"

namespace osteon {
namespace {

const SoftSelection kSoft{0.006, FallOff::kSmooth};

MeshEdit ball() { return *MeshEdit::begin(test::sphere(0.01, 20)); }

TEST(MeshEdit, RefusesWhatCannotBeEdited) {
  EXPECT_FALSE(MeshEdit::begin({}));
  TriMesh stray = test::cube();
  stray.triangles[4][2] = 99;
  const auto refused = MeshEdit::begin(stray);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message().find("triangle 4"), std::string::npos);
  TriMesh nan = test::cube();
  nan.vertices[6].z() = std::nan("");
  EXPECT_FALSE(MeshEdit::begin(nan));
  MeshEdit edit = ball();
  EXPECT_FALSE(edit.grab(1000000, kSoft));
  EXPECT_FALSE(edit.grab(0, {0, FallOff::kCone}));
  EXPECT_FALSE(edit.grab(0, {std::nan(""), FallOff::kCone}));
  EXPECT_FALSE(edit.select(kSoft));
}

TEST(MeshEdit, NothingHappensWithoutAGrab) {
  MeshEdit edit = ball();
  const std::uint64_t hash = checks::hash_of(edit.mesh());
  edit.drag(Vec3(1, 1, 1));
  EXPECT_TRUE(edit.commit().sound());
  edit.cancel();
  EXPECT_FALSE(edit.undo());
  EXPECT_FALSE(edit.redo());
  EXPECT_FALSE(edit.is_changed());
  EXPECT_TRUE(edit.turned_now().empty());
  EXPECT_EQ(checks::hash_of(edit.mesh()), hash);
}

TEST(MeshEdit, ADragMovesByWeights) {
  MeshEdit edit = ball();
  const TriMesh before = edit.mesh();
  const std::uint32_t top = edit.nearest_vertex(Vec3(0.001, 0.0003, 1));
  EXPECT_EQ(top, 0u);
  ASSERT_TRUE(edit.grab(top, kSoft));
  const Vec3 pull(0.0002, -0.0001, 0.001);
  edit.drag(Vec3(5, 5, 5));
  edit.drag(Vec3(std::nan(""), 0, 0));
  edit.drag(pull);
  EXPECT_EQ(edit.displacement(), pull);
  EXPECT_EQ(edit.grabbed_at(), before.vertices[top]);
  EXPECT_EQ(edit.mesh().vertices[top], before.vertices[top] + pull);
  std::vector<double> weight(before.vertices.size(), 0);
  for (const SoftWeight& s : edit.selected()) weight[s.vertex] = s.weight;
  for (std::size_t v = 0; v < weight.size(); ++v)
    EXPECT_EQ(edit.mesh().vertices[v],
              weight[v] > 0 ? Vec3(before.vertices[v] + weight[v] * pull) : before.vertices[v]);
  EXPECT_TRUE(edit.commit().sound());
  EXPECT_EQ(edit.undo_steps(), 1u);
  EXPECT_TRUE(edit.is_changed());
}

TEST(MeshEdit, TheFallOffMayChangeDuringADrag) {
  MeshEdit wide = ball(), changed = ball();
  const SoftSelection wider{0.012, FallOff::kDome};
  ASSERT_TRUE(wide.grab(0, wider));
  wide.drag(Vec3(0, 0, 0.002));
  ASSERT_TRUE(changed.grab(0, kSoft));
  changed.drag(Vec3(0, 0, 0.002));
  EXPECT_FALSE(changed.select({-1, FallOff::kDome}));
  EXPECT_EQ(changed.displacement(), Vec3(0, 0, 0.002));
  ASSERT_TRUE(changed.select(wider));
  EXPECT_EQ(checks::hash_of(changed.mesh()), checks::hash_of(wide.mesh()));
  EXPECT_EQ(changed.undo_steps(), 0u);
  changed.commit();
  ASSERT_TRUE(changed.undo());
  EXPECT_EQ(checks::hash_of(changed.mesh()), checks::hash_of(ball().mesh()));
}

// A drag through the other side: the report must say so, and undo must bring the ball back.
TEST(MeshEdit, SaysWhenTheSurfaceCrossesItself) {
  MeshEdit edit = ball();
  const std::uint64_t whole = checks::hash_of(edit.mesh());
  ASSERT_TRUE(edit.grab(0, kSoft));
  edit.drag(Vec3(0.0004, 0.0003, -0.025));
  EXPECT_FALSE(edit.turned_now().empty());
  const EditFindings live = edit.check();
  const EditFindings found = edit.commit();
  EXPECT_FALSE(found.crossings.empty());
  EXPECT_FALSE(found.turned.empty());
  EXPECT_EQ(live.crossings, found.crossings);
  EXPECT_EQ(live.turned, found.turned);
  EXPECT_EQ(edit.check().crossings, found.crossings);
  EXPECT_NE(found.summary().find("inverted"), std::string::npos) << found.summary();
  EXPECT_NE(found.summary().find("cross"), std::string::npos);
  ASSERT_TRUE(edit.undo());
  EXPECT_TRUE(edit.check().sound());
  EXPECT_EQ(edit.check().summary(), "sound");
  EXPECT_EQ(checks::hash_of(edit.mesh()), whole);
}

// Pulled sideways with hardly any fall-off, the neighbours' triangles turn over and nothing else
// touches.
TEST(MeshEdit, SaysWhenATriangleTurnsOver) {
  MeshEdit edit = ball();
  ASSERT_TRUE(edit.grab(1 + 9 * 40, {1e-6, FallOff::kCone}));
  ASSERT_EQ(edit.selected().size(), 1u);
  edit.drag(Vec3(0, 0, 0.003));
  const EditFindings found = edit.commit();
  EXPECT_FALSE(found.turned.empty());
}

// Against a model: a list of whole meshes.
TEST(MeshEdit, UndoAndRedoFollowAList) {
  Random random(41);
  MeshEdit edit = ball();
  std::vector<std::uint64_t> list{checks::hash_of(edit.mesh())};
  std::size_t at = 0;
  for (int step = 0; step < 400; ++step) {
    const std::uint64_t choice = random.next() % 5;
    if (choice < 2) {
      ASSERT_TRUE(edit.grab(static_cast<std::uint32_t>(random.next() % 700), kSoft));
      const Vec3 direction = random.direction();
      edit.drag(0.0005 * direction);
      if (choice == 1 && random.next() % 3 == 0) {
        edit.cancel();
      } else {
        edit.commit();
        list.resize(at + 1);
        list.push_back(checks::hash_of(edit.mesh()));
        ++at;
      }
    } else if (choice < 4) {
      EXPECT_EQ(edit.undo(), at > 0);
      if (at > 0) --at;
    } else {
      EXPECT_EQ(edit.redo(), at + 1 < list.size());
      if (at + 1 < list.size()) ++at;
    }
    ASSERT_EQ(checks::hash_of(edit.mesh()), list[at]);
    ASSERT_EQ(edit.undo_steps(), at);
    ASSERT_EQ(edit.redo_steps(), list.size() - 1 - at);
    ASSERT_EQ(edit.is_changed(), at > 0);
  }
}

TEST(MeshEdit, AFullHistoryForgetsTheOldest) {
  MeshEdit edit = *MeshEdit::begin(test::sphere(0.01, 20), 20000);
  for (int step = 0; step < 30; ++step) {
    ASSERT_TRUE(edit.grab(0, kSoft));
    edit.drag(Vec3(0, 0, 1e-5));
    edit.commit();
  }
  EXPECT_GT(edit.forgotten_steps(), 0u);
  EXPECT_EQ(edit.forgotten_steps() + edit.undo_steps(), 30u);
  while (edit.undo()) continue;
  EXPECT_TRUE(edit.is_changed());  // what was forgotten stays
  edit.mark_saved();
  EXPECT_FALSE(edit.is_changed());
  ASSERT_TRUE(edit.redo());
  EXPECT_TRUE(edit.is_changed());
}

TEST(MeshEdit, ADragIsCommittedByTheNextGrab) {
  MeshEdit edit = ball();
  ASSERT_TRUE(edit.grab(0, kSoft));
  edit.drag(Vec3(0, 0, 0.001));
  ASSERT_TRUE(edit.grab(200, kSoft));
  EXPECT_EQ(edit.undo_steps(), 1u);
  edit.commit();  // nothing moved
  EXPECT_EQ(edit.undo_steps(), 1u);
}

}  // namespace
}  // namespace osteon
