#include "collide/exact_programme.h"

#include <CGAL/Gmpz.h>
#include <CGAL/QP_functions.h>
#include <CGAL/QP_models.h>
#include <gtest/gtest.h>

#include "collide/shapes.h"

namespace osteon::exact {
namespace {

CGAL::Gmpz gmp(const Int& value) { return CGAL::Gmpz(value.str()); }

}  // namespace

bool solve_hit(const Body& a, const Body& b, const Turn& X_AB) {
  CGAL::Quadratic_program<CGAL::Gmpz> programme(CGAL::SMALLER, false, 0, false, 0);
  int row = 0;
  const auto add = [&](const IVec& n, const Int& d) {
    programme.set_a(0, row, gmp(n.x));
    programme.set_a(1, row, gmp(n.y));
    programme.set_a(2, row, gmp(n.z));
    programme.set_b(row++, gmp(d));
  };
  for (std::size_t f = 0; f < a.normals.size(); ++f) add(a.normals[f], a.offsets[f]);
  for (std::size_t f = 0; f < b.normals.size(); ++f) {
    const IVec n = X_AB.turn(b.normals[f]);
    add(n, X_AB.norm * b.offsets[f] + dot(n, X_AB.p));
  }
  return !CGAL::solve_linear_program(programme, CGAL::Gmpz()).is_infeasible();
}

namespace {

// The judge itself must be able to say yes, no, and no to a false proof.
TEST(ExactOracle, KnowsTouchingFromNot) {
  const double h = 0.0078125;  // on the grid, so that touching is exact
  const Hull cube = shapes::box({h, h, h});
  const Body a = body(cube);
  EXPECT_TRUE(is_convex(a));
  for (const double gap : {-1e-15, 0.0, 1e-15}) {
    const Pose X_AB = snap(Pose{Vec3(2 * h + gap, 0, 0), Quat(0, 1, 0, 0)});
    const Turn turn(X_AB);
    EXPECT_EQ(solve_hit(a, a, turn), gap <= 0);
    EXPECT_EQ(proves_miss(a, a, turn, Vec3::UnitX()), gap > 0);
    EXPECT_FALSE(proves_miss(a, a, turn, -Vec3::UnitX()));
    EXPECT_FALSE(proves_miss(a, a, turn, Vec3::UnitY()));
    EXPECT_EQ(proves_hit(a, a, turn, Vec3(h, 0, 0)), gap <= 0);
    EXPECT_FALSE(proves_hit(a, a, turn, Vec3(h + 1e-14, 0, 0)));
    EXPECT_FALSE(proves_hit(a, a, turn, Vec3::Zero()));
  }
}

TEST(ExactOracle, TurnsAsThePoseDoes) {
  Random random(23);
  for (int i = 0; i < 20; ++i) {
    const Pose X = snap(shapes::random_pose(random, 0.03));
    const Vec3 v = snap(Vec3(0.01 * random.direction()), kLengthBits);
    const Turn turn(X);
    const IVec moved = turn.turn(integer(v, kLengthBits));
    const Vec3 expected = X.rotate(v);
    const double norm = turn.norm.convert_to<double>();
    const double unit = std::ldexp(1.0, kLengthBits);
    EXPECT_NEAR(moved.x.convert_to<double>() / norm / unit, expected.x(), 1e-15);
    EXPECT_NEAR(moved.y.convert_to<double>() / norm / unit, expected.y(), 1e-15);
    EXPECT_NEAR(moved.z.convert_to<double>() / norm / unit, expected.z(), 1e-15);
    const IVec back = turn.turn_back(moved);
    EXPECT_EQ(back.x, turn.norm * turn.norm * integer(v, kLengthBits).x);
  }
}

}  // namespace
}  // namespace osteon::exact
