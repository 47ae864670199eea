#include "surface/surface_changes.h"

#include <gtest/gtest.h>

#include "../scenes.h"

namespace osteon {
namespace {

const Aabb kBox{Vec3(0, 0, 0), Vec3(1, 1, 1)};

TEST(SurfaceChanges, WhatChangedAnywhereIsNotKnown) {
  SurfaceChanges changes;
  const std::uint64_t begin = changes.version();
  EXPECT_TRUE(changes.known_since(begin));
  EXPECT_TRUE(changes.since(begin).empty());
  changes.within(3, kBox);
  EXPECT_TRUE(changes.known_since(begin));
  changes.anywhere();
  EXPECT_FALSE(changes.known_since(begin));
  EXPECT_TRUE(changes.known_since(changes.version()));
  EXPECT_TRUE(changes.since(changes.version()).empty());
}

TEST(SurfaceChanges, TellsWhatCameAfterAVersion) {
  SurfaceChanges changes;
  changes.within(1, kBox);
  const std::uint64_t middle = changes.version();
  changes.within(2, kBox);
  changes.within(7, {});  // nowhere
  EXPECT_GT(changes.version(), middle + 1);
  const auto after = changes.since(middle);
  ASSERT_EQ(after.size(), 1u);
  EXPECT_EQ(after[0].model, 2u);
  EXPECT_EQ(after[0].box_M.hi, kBox.hi);
}

TEST(SurfaceChanges, OfVeryManyTheOldestAreForgotten) {
  SurfaceChanges changes;
  const std::uint64_t begin = changes.version();
  for (int k = 0; k < 10000; ++k) changes.within(1, kBox);
  EXPECT_FALSE(changes.known_since(begin));
  EXPECT_TRUE(changes.known_since(changes.version() - 100));
  EXPECT_EQ(changes.since(changes.version() - 100).size(), 100u);
}

ShadedMesh square() {
  ShadedMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {9, 9, 9}};
  mesh.normals.assign(5, {0, 0, 1});
  mesh.shades.assign(5, {255, 128, 128, 128});
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

TEST(ChangedBox, HoldsTheTrianglesOfWhatMoved) {
  const ShadedMesh before = square();
  EXPECT_TRUE(changed_box(before, before).empty());
  EXPECT_TRUE(changed_box({}, {}).empty());
  ShadedMesh now = before;
  now.positions[3] = {0, 2, 1};
  const Aabb box = changed_box(before, now);
  EXPECT_EQ(box.lo, Vec3(0, 0, 0));
  EXPECT_EQ(box.hi, Vec3(1, 2, 1));
  now = before;
  now.shades[4].cavity = 3;  // no triangle has it
  EXPECT_TRUE(changed_box(before, now).empty());
  now.shades[1].openness = 3;
  EXPECT_EQ(changed_box(before, now).hi, Vec3(1, 1, 0));
}

TEST(ChangedBox, HoldsTrianglesThatCameAndWent) {
  const ShadedMesh before = square();
  ShadedMesh now = before;
  now.triangles.push_back({0, 1, 4});
  EXPECT_EQ(changed_box(before, now).hi, Vec3(9, 9, 9));
  EXPECT_EQ(changed_box(now, before).hi, Vec3(9, 9, 9));
  EXPECT_EQ(changed_box({}, before).hi, Vec3(1, 1, 0));
  EXPECT_EQ(changed_box(before, {}).hi, Vec3(1, 1, 0));
}

}  // namespace
}  // namespace osteon
