// A layer of cartilage of known thickness on a bone of known shape.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "carve/carve_fixtures.h"
#include "osteon/carve/carved_surface.h"
#include "osteon/carve/node_moments.h"
#include "osteon/carve/removed.h"
#include "osteon/mesh/measure.h"

namespace osteon {
namespace {

using namespace test;

constexpr double kHalfTurn = std::numbers::pi;
constexpr auto kCartilage = static_cast<std::size_t>(BoneTissue::kCartilage);
constexpr auto kCortical = static_cast<std::size_t>(BoneTissue::kCortical);
constexpr auto kCancellous = static_cast<std::size_t>(BoneTissue::kCancellous);

TriMesh box_from_to(const Vec3& lo, const Vec3& hi) {
  TriMesh mesh = box_mesh(0.5 * (hi - lo));
  for (Vec3& v : mesh.vertices) v += 0.5 * (lo + hi);
  return mesh;
}

constexpr double kTop = 0.006, kThick = 0.002;

/// A cube of 12 mm under a layer of 2 mm, which leaves a margin of 1 mm bare.
const std::shared_ptr<const UncutField>& covered_box() {
  static const auto field = [] {
    const auto body = value(
        CoveredSurface::make(box_mesh(Vec3::Constant(kTop)),
                             {box_from_to({-0.005, -0.005, kTop}, {0.005, 0.005, kTop + kThick})}));
    return value(UncutField::make(body));
  }();
  return field;
}

CarvedField fresh_covered() { return value(CarvedField::make(covered_box(), {}, 4096)); }

TriMesh round_ball(double radius, bool outward) {
  TriMesh mesh;
  constexpr std::uint32_t kRings = 60, kAround = 120;
  mesh.vertices.emplace_back(0, 0, radius);
  for (std::uint32_t i = 1; i < kRings; ++i)
    for (std::uint32_t j = 0; j < kAround; ++j) {
      const double a = kHalfTurn * i / kRings, b = 2 * kHalfTurn * j / kAround;
      mesh.vertices.emplace_back(radius * std::sin(a) * std::cos(b),
                                 radius * std::sin(a) * std::sin(b), radius * std::cos(a));
    }
  mesh.vertices.emplace_back(0, 0, -radius);
  const auto at = [](std::uint32_t i, std::uint32_t j) {
    return 1 + (i - 1) * kAround + j % kAround;
  };
  const auto last = static_cast<std::uint32_t>(mesh.vertices.size() - 1);
  for (std::uint32_t j = 0; j < kAround; ++j) {
    mesh.triangles.push_back({0, at(1, j), at(1, j + 1)});
    for (std::uint32_t i = 1; i + 1 < kRings; ++i) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
    mesh.triangles.push_back({last, at(kRings - 1, j + 1), at(kRings - 1, j)});
  }
  if (!outward)
    for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

TriMesh round_shell(double inner, double outer) {
  TriMesh mesh = round_ball(outer, true);
  const TriMesh in = round_ball(inner, false);
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), in.vertices.begin(), in.vertices.end());
  for (const Triangle& t : in.triangles)
    mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  return mesh;
}

/// Volume of what two balls share, at that distance.
double ball_lens(double a, double b, double d) {
  if (d >= a + b) return 0;
  const double s = a + b - d;
  return kHalfTurn * s * s * (d * d + 2 * d * (a + b) - 3 * (a - b) * (a - b)) / (12 * d);
}

/// Of a ball, what lies over a plane at that height over its middle.
double ball_cap(double r, double h) {
  if (h >= r) return 0;
  const double s = r - std::max(h, -r);
  return kHalfTurn * s * s * (3 * r - s) / 3;
}

TEST(Cartilage, ABallThroughALayerRemovesWhatLiesInEachTissue) {
  Random random(11);
  for (int n = 0; n < 12; ++n) {
    CarvedField field = fresh_covered();
    const double r = random.uniform(0.0015, 0.0025);
    Pose X;
    X.p = {random.uniform(-0.002, 0.002), random.uniform(-0.002, 0.002),
           kTop + random.uniform(-0.001, 0.002)};
    const CarveStep step = field.cut(cutter("burr", 2000 * r), X);
    const double z = kTop - X.p.z();
    const double cartilage = ball_cap(r, z) - ball_cap(r, z + kThick),
                 bone = ball_cap(r, -1) - ball_cap(r, z);
    const ByTissue removed = removed_volume(field);
    EXPECT_NEAR(removed[kCartilage], cartilage, 0.005 * cartilage) << "radius " << r;
    EXPECT_NEAR(removed[kCortical] + removed[kCancellous], bone, 0.005 * (bone + cartilage));
    // The cortex begins under the cartilage, not under what is touched.
    EXPECT_NEAR(removed[kCortical], ball_cap(r, z - 0.0012) - ball_cap(r, z),
                0.005 * (bone + cartilage));
    EXPECT_NEAR(step.removed_m3[kCartilage], cartilage, 0.05 * cartilage);
  }
}

TEST(Cartilage, ADrillThroughALayerRemovesACylinderOfEachTissue) {
  CarvedField field = fresh_covered();
  const double r = 0.002;
  const auto reamer = cutter("reamer", 2000 * r);
  Pose from = pose_along({0.0003, -0.0004, kTop + 0.004}, Vec3::UnitZ()), to = from;
  to.p.z() = kTop - 0.004;  // the front's rim is in bone
  field.cut(reamer, from, to);
  const ByTissue removed = removed_volume(field);
  EXPECT_NEAR(removed[kCartilage], kHalfTurn * r * r * kThick, 0.005 * kHalfTurn * r * r * kThick);
  EXPECT_NEAR(removed[kCortical], kHalfTurn * r * r * 0.0012, 0.005 * kHalfTurn * r * r * 0.0012);
}

// The margin that the layer leaves bare is bone up to its surface.
TEST(Cartilage, BesideTheLayerThereIsNone) {
  CarvedField field = fresh_covered();
  Pose X;
  X.p = {0.006, 0, 0.003};
  field.cut(cutter("burr", 3), X);
  const ByTissue removed = removed_volume(field);
  EXPECT_EQ(removed[kCartilage], 0);
  EXPECT_NEAR(total(removed), 0.5 * ball_cap(0.0015, -1), 0.005 * ball_cap(0.0015, -1));
}

TEST(Cartilage, OnABallTheShellIsCartilage) {
  const double inner = 0.008, outer = 0.0095;
  const auto body =
      value(CoveredSurface::make(round_ball(inner, true), {round_shell(inner, outer)}));
  const auto uncut = value(UncutField::make(body));
  // Meshes lie within their balls: closed forms are for balls of the same volume.
  const double a = std::cbrt(volume(round_ball(inner, true)) * 0.75 / kHalfTurn);
  const double b = std::cbrt(volume(round_ball(outer, true)) * 0.75 / kHalfTurn);
  Random random(12);
  for (int n = 0; n < 8; ++n) {
    CarvedField field = value(CarvedField::make(uncut, {}, 4096));
    const double r = random.uniform(0.002, 0.003), d = random.uniform(0.0075, 0.0100);
    Pose X;
    X.p = d * random.direction();
    field.cut(cutter("burr", 2000 * r), X);
    const double all = ball_lens(b, r, d), bone = ball_lens(a, r, d);
    const ByTissue removed = removed_volume(field);
    EXPECT_NEAR(total(removed), all, 0.005 * all);
    EXPECT_NEAR(removed[kCartilage], all - bone, 0.005 * all);
  }
}

TEST(Cartilage, WhatIsLeftOfBoneAndLayerAreSurfacesOfTheirOwn) {
  CarvedField field = fresh_covered();
  Pose X;
  X.p = {0, 0, kTop + 0.0005};
  field.cut(cutter("burr", 4), X);
  const TriMesh layer = box_from_to({-0.005, -0.005, kTop}, {0.005, 0.005, kTop + kThick});
  const TriMesh body = value(carved_mesh(field));
  const TriMesh bone = value(carved_mesh(field, covered_box()->bare()));
  const TriMesh left = value(carved_mesh(field, value(covered_box()->make_beside(layer))));
  for (const TriMesh* mesh : {&body, &bone, &left}) EXPECT_TRUE(topology(*mesh).closed());
  const ByTissue removed = removed_volume(field);
  const double cube = std::pow(2 * kTop, 3), slab = 0.01 * 0.01 * kThick;
  EXPECT_NEAR(volume(bone), cube - removed[kCortical] - removed[kCancellous], 0.001 * cube);
  EXPECT_NEAR(volume(left), slab - removed[kCartilage], 0.01 * slab);
  EXPECT_NEAR(volume(body), volume(bone) + volume(left), 0.002 * cube);
  EXPECT_FALSE(covered_box()->make_beside(box_mesh(Vec3::Constant(0.02))));
}

// By whole nodes: within half a cell of the walls of each tissue's part.
TEST(Cartilage, TheNodesThatAreGoneFollowTheVolumesOfEachTissue) {
  CarvedField field = fresh_covered();
  RemovedTissue gone(field);
  EXPECT_EQ(gone.of(field), RemovedTissue::Counts{});
  const double h = field.grid().cell_m, cell_m3 = h * h * h;
  const Cutter burr = cutter("burr", 4);
  CarveState between;
  RemovedTissue::Counts then{};
  for (int n = 0; n < 8; ++n) {
    Pose X;
    X.p = {-0.002 + 0.0005 * n, 0.0002 * n, kTop};
    field.cut(burr, X);
    const RemovedTissue::Counts counts = gone.of(field);
    EXPECT_EQ(counts, RemovedTissue(field).of(field)) << "what changed alone, and all anew";
    const ByTissue volume = removed_volume(field);
    for (std::size_t t = 0; t < counts.size(); ++t)
      EXPECT_NEAR(cell_m3 * static_cast<double>(counts[t]), volume[t], 0.06 * total(volume)) << t;
    if (n != 3) continue;
    between = field.save();
    then = counts;
  }
  ASSERT_TRUE(field.restore(between));
  EXPECT_EQ(gone.of(field), then) << "as it was at the state that is put back";
}

TEST(Cartilage, TheOrderOfCutsAndAStateThatIsPutBackChangeNothing) {
  CarvedField one = fresh_covered(), two = fresh_covered();
  Pose A, B;
  A.p = {0.001, 0, kTop + 0.001};
  B.p = {0, 0.001, kTop};
  const Cutter burr = cutter("burr", 4);
  one.cut(burr, A);
  const CarveState between = one.save();
  one.cut(burr, B);
  two.cut(burr, B);
  two.cut(burr, A);
  EXPECT_EQ(one.hash(), two.hash());
  EXPECT_EQ(removed_volume(one), removed_volume(two));
  ASSERT_TRUE(two.restore(between));
  two.cut(burr, B);
  EXPECT_EQ(one.hash(), two.hash());
  EXPECT_EQ(removed_volume(one), removed_volume(two));
  // A state of the bone alone is one of another bone.
  CarvedField alone = value(CarvedField::make(covered_box()->bare(), {}, 4096));
  EXPECT_FALSE(alone.restore(between));
}

TEST(Cartilage, ABonesMassKnowsNothingOfIt) {
  CarvedField field = fresh_covered();
  const auto whole = whole_nodes(*covered_box()->bare()).count;
  const double cell = field.grid().cell_m;
  EXPECT_NEAR(static_cast<double>(whole) * cell * cell * cell, std::pow(2 * kTop, 3),
              0.03 * std::pow(2 * kTop, 3));
  RemovedNodes removed(field);
  Pose X;
  X.p = {0, 0, kTop + 0.0022};
  field.cut(cutter("burr", 4), X);  // not down to the bone
  EXPECT_GT(removed_volume(field)[kCartilage], 1e-9);
  EXPECT_EQ(removed.of(field).count, 0);
}

TEST(Cartilage, BothFieldsCountForMemory) {
  const auto body = value(
      CoveredSurface::make(box_mesh(Vec3::Constant(kTop)),
                           {box_from_to({-0.005, -0.005, kTop}, {0.005, 0.005, kTop + kThick})}));
  UncutFieldOptions options;
  options.most_bytes = covered_box()->bytes() - 1000;
  ASSERT_GT(covered_box()->bytes(), covered_box()->bare()->bytes());
  const auto refused = UncutField::make(body, options);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message().find("MB"), std::string::npos);
}

}  // namespace
}  // namespace osteon
