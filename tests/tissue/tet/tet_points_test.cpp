#include "tet/tet_points.h"

#include <gtest/gtest.h>

#include "osteon/base/random.h"
#include "tet/tet_explicit.h"

namespace osteon {
namespace {

struct PointCase {
  TetOrder order;
  bool corotated;
};

/// A block of tetrahedra whose nodes are moved at random.
struct ShakenBlock {
  TetSolid solid;
  std::vector<Vec3> moved_m;

  ShakenBlock(const PointCase& c, double by_m) {
    TetSolidDef def;
    def.mesh = split_into_tetrahedra({{3, 2, 2}, 0.01, Vec3::Zero()});
    def.material = {1e5, 0.4, 1000, 0};
    def.order = c.order;
    def.corotated = c.corotated;
    solid = *make_tet_solid(def);
    Random random(11);
    for (std::size_t i = 0; i < solid.rest_W.size(); ++i)
      moved_m.push_back(by_m *
                        Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)));
  }
  SolidState::Field field() const {
    SolidState::Field out;
    for (std::size_t k = 0; k < 3; ++k)
      for (const Vec3& v : moved_m) out[k].push_back(v[static_cast<Eigen::Index>(k)]);
    return out;
  }
};

double far_apart(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double sum = 0, size = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    sum += (a[i] - b[i]).squaredNorm();
    size += b[i].squaredNorm();
  }
  EXPECT_GT(size, 0);
  return std::sqrt(sum / size);
}

class TetPointRowsOf : public ::testing::TestWithParam<PointCase> {};
INSTANTIATE_TEST_SUITE_P(AllKinds, TetPointRowsOf,
                         ::testing::Values(PointCase{TetOrder::kLinear, false},
                                           PointCase{TetOrder::kLinear, true},
                                           PointCase{TetOrder::kQuadratic, false},
                                           PointCase{TetOrder::kQuadratic, true}));

TEST_P(TetPointRowsOf, ForcesAreThoseOfTheElements) {
  // The larger shake turns elements inside out.
  for (const double by_m : {0.001, 0.012}) {
    const ShakenBlock block(GetParam(), by_m);
    const TetPointRows rows(block.solid);
    TetPointScratch scratch;
    rows.rotate(block.moved_m, scratch);
    const std::vector<Mat3> turned = rotations(block.solid, block.field());

    const std::vector<Vec3> none(block.moved_m.size(), Vec3::Zero());
    std::vector<Vec3> want = none, found = none;
    add_elastic(block.solid, block.field(), turned, 1, want);
    rows.add_elastic(block.moved_m, scratch, found);
    EXPECT_LT(far_apart(found, want), 1e-11);

    want = found = none;
    add_stiffness(block.solid, turned, block.moved_m, 0.3, want);
    rows.add_stiffness(block.moved_m, 0.3, scratch, found);
    EXPECT_LT(far_apart(found, want), 1e-11);
  }
}

TEST_P(TetPointRowsOf, NodesTurnAsTheMeanOfTheirPoints) {
  ShakenBlock block(GetParam(), 0.0005);
  const Mat3 turn = Eigen::AngleAxisd(0.7, Vec3(1, 2, -1).normalized()).toRotationMatrix();
  for (std::size_t i = 0; i < block.moved_m.size(); ++i)
    block.moved_m[i] += (turn - Mat3::Identity()) * block.solid.rest_W[i];
  const TetPointRows rows(block.solid);
  TetPointScratch scratch;
  rows.rotate(block.moved_m, scratch);
  for (const Mat3& r : rows.node_rotations(scratch)) {
    EXPECT_LT((r.transpose() * r - Mat3::Identity()).norm(), 1e-13);
    EXPECT_LT((r - (GetParam().corotated ? turn : Mat3(Mat3::Identity()))).norm(), 0.3);
    if (GetParam().corotated) {
      EXPECT_GT((r - turn).norm(), 1e-6);
    }
  }
}

TEST_P(TetPointRowsOf, RegistersOfAllWidthsGiveTheSameBits) {
  const ShakenBlock block(GetParam(), 0.004);
  // Points of one element alone, so that a register is not full.
  std::vector<unsigned> node(10 * 8, 0);
  std::vector<double> slope(30 * 8, 0.0), volume(8, 0.0);
  Random random(3);
  for (std::size_t p = 0; p < 5; ++p) {
    volume[p] = random.uniform(0.5, 1);
    for (std::size_t a = 0; a < 10; ++a) node[a * 8 + p] = static_cast<unsigned>((7 * a + p) % 30);
    for (std::size_t k = 0; k < 30; ++k) slope[k * 8 + p] = random.uniform(-30, 30);
  }
  const auto reckoned = [&](const tets::TetWork& work) {
    std::vector<double> turn(9 * 8), force(30 * 8), out;
    const tets::TetRows rows{
        node.data(), slope.data(), volume.data(), turn.data(), force.data(), 10, 5, 8};
    const tets::TetModuli by{3e4, 7e4, 9e4};
    const double* v = block.moved_m.front().data();
    const auto keep = [&](const std::vector<double>& from) {
      for (std::size_t k = 0; k < from.size(); ++k)
        if (k % 8 < 5) out.push_back(from[k]);
    };
    work.rotate(rows, v);
    keep(turn);
    work.elastic(rows, by, v, 1);
    keep(force);
    work.stiffness(rows, by, v, 0.5);
    keep(force);
    work.neo_hookean(rows, by, v);
    keep(force);
    work.nearest(turn.data(), 5, 8);
    keep(turn);
    return out;
  };
  const std::vector<double> base = reckoned(tets::kTetWorkBase);
  for (const double x : base) ASSERT_TRUE(std::isfinite(x));
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2")) {
    EXPECT_EQ(base, reckoned(tets::kTetWorkAvx2));
  }
  if (__builtin_cpu_supports("avx512f")) {
    EXPECT_EQ(base, reckoned(tets::kTetWorkAvx512));
  }
#endif
}

TEST(TetPointRows, NeoHookeanForceIsTheSlopeOfTheEnergy) {
  for (const TetOrder order : {TetOrder::kLinear, TetOrder::kQuadratic}) {
    const ShakenBlock block({order, false}, 0.0005);
    SolidState state = state_at_rest(block.solid.rest_W.size(), false);
    state.moved_m = block.field();
    const TetPointRows rows(block.solid);
    TetPointScratch scratch;
    std::vector<Vec3> force(block.moved_m.size(), Vec3::Zero());
    rows.add_neo_hookean(block.moved_m, scratch, force);
    double largest = 0;
    for (const Vec3& f : force) largest = std::max(largest, f.norm());
    ASSERT_GT(largest, 0);
    constexpr double kBy = 1e-8;
    for (std::size_t i = 0; i < force.size(); i += 5)
      for (std::size_t k = 0; k < 3; ++k) {
        const auto moved = [&](double by) {
          SolidState there = state;
          there.moved_m[k][i] += by;
          return explicit_energy(block.solid, there).strain_j;
        };
        EXPECT_NEAR(force[i][static_cast<Eigen::Index>(k)], -(moved(kBy) - moved(-kBy)) / (2 * kBy),
                    1e-5 * largest);
      }
  }
}

}  // namespace
}  // namespace osteon
