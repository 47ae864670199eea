// A solid that was cut: as soft as beams say, parted by a slit, the same however the work is split.
#include "osteon/tissue/cut_solid_work.h"

#include <gtest/gtest.h>

#include "osteon/mesh/tri_mesh.h"

namespace osteon {
namespace {

// 24 x 16 x 6 mm, held by its low face.
std::shared_ptr<const PressedSolid> pressed_block() {
  static const auto block = [] {
    const Vec3 half(0.012, 0.008, 0.003);
    TriMesh mesh;
    for (int i = 0; i < 8; ++i)
      mesh.vertices.push_back(
          Vec3((i & 1) ? 1 : -1, (i & 2) ? 1 : -1, (i & 4) ? 1 : -1).cwiseProduct(half));
    mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                      {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    PressedSolidDef def;
    def.field = std::make_shared<const DistanceField>(
        std::move(*DistanceField::make(mesh, {0.0005, 0.006, 0.001})));
    def.box = {-half, half};
    def.held = [half](const Vec3& p) { return p.z() < -half.z() + 0.0005; };
    def.rests = [](const Vec3&) { return false; };
    return std::make_shared<const PressedSolid>(std::move(*PressedSolid::make(def)));
  }();
  return block;
}

std::vector<CutCell> all_left(const PressedSolid& whole) {
  std::vector<CutCell> cells(whole.cells());
  for (std::size_t e = 0; e < cells.size(); ++e) {
    cells[e].count = 1;
    cells[e].left[0] = 1;
    cells[e].middle[0] = whole.cell_lo(e) + Vec3::Constant(0.5 * whole.cell_m());
    cells[e].beyond = {1, 1, 1};
  }
  return cells;
}

std::shared_ptr<const PressedSolid> made(const std::shared_ptr<const PressedSolid>& whole,
                                         const std::vector<CutCell>& cells) {
  CutSolidWork work(whole, cells);
  int steps = 0;
  while (!work.step() && steps < 100000) ++steps;
  return work.take();
}

double yields(const PressedSolid& solid, const Vec3& p) {
  const SolidPush push = solid.push_at(p, Vec3::UnitZ());
  return solid.compliance(push, push);
}

TEST(CutSolidWork, WithNothingCutItIsTheWholeSolid) {
  const auto whole = pressed_block();
  const auto same = made(whole, all_left(*whole));
  ASSERT_TRUE(same);
  for (const Vec3& p : {Vec3(0, 0, 0.003), Vec3(0.006, -0.004, 0.003)})
    EXPECT_NEAR(yields(*same, p), yields(*whole, p), 0.03 * yields(*whole, p));
}

TEST(CutSolidWork, NothingLeftIsTakenAsTheWhole) {
  const auto whole = pressed_block();
  EXPECT_EQ(made(whole, std::vector<CutCell>(whole->cells())), whole);
}

// Half of every cell gone: the solid yields twice as much.
TEST(CutSolidWork, OfHalfTheFillingItYieldsTwiceAsMuch) {
  const auto whole = pressed_block();
  auto cells = all_left(*whole);
  for (CutCell& cell : cells) cell.left[0] = 0.5;
  const auto half = made(whole, cells);
  const Vec3 p(0.002, 0, 0.003);
  // The support stays as stiff as it was.
  EXPECT_NEAR(yields(*half, p) / yields(*whole, p), 2, 0.1);
}

// A slit through the middle: a push on one side does nothing to the other.
TEST(CutSolidWork, ASlitPartsWhatItRunsThrough) {
  const auto whole = pressed_block();
  auto cells = all_left(*whole);
  for (std::size_t e = 0; e < cells.size(); ++e) {
    const double lo = whole->cell_lo(e).x(), hi = lo + whole->cell_m();
    if (lo <= 0 && hi > 0) cells[e].beyond[0] = 0;
  }
  const auto slit = made(whole, cells);
  const Vec3 left(-0.009, 0, 0.003), right(0.009, 0, 0.003);
  const auto across = [&](const PressedSolid& solid) {
    const SolidPush here = solid.push_at(left, Vec3::UnitX()),
                    there = solid.push_at(right, Vec3::UnitX());
    return std::abs(solid.compliance(there, here));
  };
  EXPECT_GT(across(*whole), 1e-6);
  EXPECT_LT(across(*slit), 1e-9 + 1e-3 * across(*whole));
}

// The free half of a block cut off its base hangs on the ground alone: very soft, but finite.
TEST(CutSolidWork, WhatHangsOnNothingIsSoftAndFinite) {
  const auto whole = pressed_block();
  auto cells = all_left(*whole);
  for (CutCell& cell : cells) cell.beyond = {};
  const auto crumbs = made(whole, cells);
  const double c = yields(*crumbs, Vec3(0, 0, 0.003));
  EXPECT_TRUE(std::isfinite(c));
  EXPECT_GE(c, yields(*whole, Vec3(0, 0, 0.003)));
  EXPECT_LE(c, 25.0 / 900 + 1e-9);
}

}  // namespace
}  // namespace osteon
