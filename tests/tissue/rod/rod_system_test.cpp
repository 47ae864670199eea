#include "rod/rod_system.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include "osteon/base/random.h"

namespace osteon::rods {
namespace {

constexpr RodNumbers kElasticAlone{0.4, 1.5, 2e-5, 1.5e-5, 0, 0};

Rod rod_of(int segments) {
  RodDef def;
  def.points_W = {Vec3::Zero(), {0.002 * segments, 0, 0}};
  def.segments = segments;
  def.material = {1e6, 0.3, 1000, 5};
  auto made = make_rod(def);
  EXPECT_TRUE(made) << made.error().message();
  return *made;
}

Vec3 random_vec(Random& random, double size) {
  return size * Vec3(random.uniform() - 0.5, random.uniform() - 0.5, random.uniform() - 0.5);
}

/// A rod bent, stretched and twisted at random, on its way from somewhere else.
struct BentRod {
  Rod rod;
  std::vector<double> span;
  RodSystem system;

  explicit BentRod(int segments, std::uint64_t seed = 7)
      : rod(rod_of(segments)),
        span(spans(rod, std::vector<bool>(rod.segments(), false))),
        system(rod, span, std::vector<double>(rod.segments(), 3e-10)) {
    Random random(seed);
    for (std::size_t i = 0; i < rod.start_W.size(); ++i)
      for (const long row : {kPlace, kAimPlace, kStartPlace, kForce})
        system.set_three(row, i, rod.start_W[i] + random_vec(random, 0.001));
    for (std::size_t i = 0; i < rod.segments(); ++i)
      for (const long row : {kFrame, kAimFrame, kStartFrame})
        system.set_quat(row, i, turned_by(rod.start_R_WS[i], random_vec(random, 0.8)));
  }

  std::size_t unknowns() const { return 6 * rod.segments() + 3; }
  /// Row and place of an unknown.
  std::pair<long, std::size_t> unknown(std::size_t k) const {
    const std::size_t nodes = 3 * (rod.segments() + 1);
    if (k < nodes) return {static_cast<long>(k % 3), k / 3};
    return {static_cast<long>(3 + (k - nodes) % 3), (k - nodes) / 3};
  }
  std::size_t index(std::size_t k) const {
    const auto [row, place] = unknown(k);
    return system.index(row, place);
  }
  Eigen::MatrixXd matrix() const {
    const auto size = static_cast<Eigen::Index>(unknowns());
    Eigen::MatrixXd out(size, size);
    RodSystem::Values unit = system.values_of(kWay), column;
    std::fill(unit.begin(), unit.end(), 0.0);
    for (std::size_t c = 0; c < unknowns(); ++c) {
      unit[index(c)] = 1;
      system.multiply(unit, column);
      unit[index(c)] = 0;
      for (std::size_t r = 0; r < unknowns(); ++r)
        out(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c)) = column[index(r)];
    }
    return out;
  }
  /// Energy with one unknown moved.
  double energy_moved(std::size_t k, double by) {
    for (long row = kWay; row < kWay + 6; ++row)
      for (std::size_t i = 0; i <= rod.segments(); ++i) system.at(row, i) = 0;
    const auto [row, place] = unknown(k);
    system.at(kWay + row, place) = by;
    system.go(1, kTriedPlace);
    return elastic_energy_j(rod, span, system.pose(kTriedPlace));
  }
};

class RodOfSegments : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(FewAndMany, RodOfSegments, ::testing::Values(1, 2, 3, 4, 7, 8, 9, 25));

TEST_P(RodOfSegments, SlopeIsThatOfTheEnergy) {
  BentRod bent(GetParam());
  for (std::size_t i = 0; i <= bent.rod.segments(); ++i)
    bent.system.set_three(kForce, i, Vec3::Zero());
  const RodSection& s = bent.rod.section;
  bent.system.assemble({s.shear_n, s.stretch_n, s.bend_n_m2, s.twist_n_m2, 0, 0}, false);
  double largest = 0;
  for (std::size_t k = 0; k < bent.unknowns(); ++k) {
    const auto [row, place] = bent.unknown(k);
    largest = std::max(largest, std::abs(bent.system.at(kSlope + row, place)));
  }
  ASSERT_GT(largest, 1e-6);
  for (std::size_t k = 0; k < bent.unknowns(); ++k) {
    const auto [row, place] = bent.unknown(k);
    const double by = row < 3 ? 1e-8 : 1e-5;
    const double slope = (bent.energy_moved(k, by) - bent.energy_moved(k, -by)) / (2 * by);
    EXPECT_NEAR(bent.system.at(kSlope + row, place), slope, 1e-5 * largest) << k;
  }
}

TEST_P(RodOfSegments, MatrixIsPositiveAndSolvedFromBothEnds) {
  BentRod bent(GetParam());
  RodNumbers numbers = kElasticAlone;
  numbers.per_step2 = 1e6;
  numbers.damped_per_step = 5e3;
  bent.system.assemble(numbers, true);
  bent.system.hold_axis(0, 1);
  bent.system.hold_frame(bent.rod.segments() - 1);
  const Eigen::MatrixXd a = bent.matrix();
  EXPECT_LT((a - a.transpose()).norm(), 1e-12 * a.norm());
  EXPECT_GT(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(a).eigenvalues().minCoeff(), 0);

  bent.system.take_slope();
  RodSystem::Values x = bent.system.values_of(kWay);
  Eigen::VectorXd right(a.rows());
  for (std::size_t k = 0; k < bent.unknowns(); ++k)
    right[static_cast<Eigen::Index>(k)] = x[bent.index(k)];
  bent.system.factor();
  bent.system.solve(x);
  const Eigen::VectorXd want = a.ldlt().solve(right);
  Eigen::VectorXd found(want.size());
  for (std::size_t k = 0; k < bent.unknowns(); ++k)
    found[static_cast<Eigen::Index>(k)] = x[bent.index(k)];
  EXPECT_GT(want.norm(), 0);
  EXPECT_LT((found - want).norm(), 1e-9 * want.norm());
}

TEST_P(RodOfSegments, AFewPlacesHaveTheSlopeOfAll) {
  BentRod bent(GetParam());
  bent.system.assemble(kElasticAlone, false);
  const RodSystem::Values want = bent.system.values_of(kSlope);
  for (long first = 0; first <= GetParam(); first += kRowGuard) {
    for (long row = kSlope; row < kSlope + 6; ++row)
      for (std::size_t i = 0; i <= bent.rod.segments(); ++i) bent.system.at(row, i) = 1e30;
    bent.system.assemble_part(kElasticAlone, first, first + kRowGuard);
    for (long row = 0; row < 6; ++row)
      for (long i = first; i < std::min<long>(first + kRowGuard, GetParam() + (row < 3)); ++i) {
        const auto place = static_cast<std::size_t>(i);
        EXPECT_EQ(bent.system.at(kSlope + row, place), want[bent.system.index(row, place)]);
      }
  }
}

// All rows after a round's work with one width of registers.
std::vector<double> rows_after(const RodWork& work, int segments) {
  BentRod bent(segments);
  RodNumbers numbers = kElasticAlone;
  numbers.per_step2 = 1e6;
  const RodRows& rows = bent.system.rows();
  work.assemble(numbers, rows, true, 0, rows.segments + 1);
  bent.system.take_slope();
  std::vector<double> factors(
      static_cast<std::size_t>(2 * kPairFactors * segments + kMiddleFactors)),
      scratch(static_cast<std::size_t>(6 * segments));
  work.factor(rows, factors.data());
  work.solve(rows, factors.data(), rows.row(kWay), scratch.data());
  work.go(rows, 1, rows.row(kTriedPlace));
  std::vector<double> out{work.largest(rows, 1000)};
  for (long row = 0; row < kRodRows; ++row)
    out.insert(out.end(), rows.row(row), rows.row(row) + segments + (row < kFrame ? 1 : 0));
  return out;
}

TEST_P(RodOfSegments, RegistersOfAllWidthsGiveTheSameBits) {
  const std::vector<double> base = rows_after(kRodWorkBase, GetParam());
  EXPECT_GT(base.front(), 0);
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2")) {
    EXPECT_EQ(base, rows_after(kRodWorkAvx2, GetParam()));
  }
  if (__builtin_cpu_supports("avx512f")) {
    EXPECT_EQ(base, rows_after(kRodWorkAvx512, GetParam()));
  }
#endif
}

}  // namespace
}  // namespace osteon::rods
