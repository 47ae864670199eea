#include "exact/predicates.h"

#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <limits>

#include "../shapes.h"
#include "exact/expansion.h"

namespace osteon::hull {
namespace {

using Rational = boost::multiprecision::cpp_rational;

int sign_of(const Rational& r) { return r.sign(); }

int rational_orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  Rational u[3], v[3], w[3];
  for (int k = 0; k < 3; ++k) {
    u[k] = Rational(b[k]) - Rational(a[k]);
    v[k] = Rational(c[k]) - Rational(a[k]);
    w[k] = Rational(d[k]) - Rational(a[k]);
  }
  return sign_of(w[0] * (u[1] * v[2] - u[2] * v[1]) + w[1] * (u[2] * v[0] - u[0] * v[2]) +
                 w[2] * (u[0] * v[1] - u[1] * v[0]));
}

int rational_orient2d(const Vec3& a, const Vec3& b, const Vec3& c, int i, int j) {
  const Rational ux = Rational(b[i]) - Rational(a[i]), uy = Rational(b[j]) - Rational(a[j]);
  const Rational vx = Rational(c[i]) - Rational(a[i]), vy = Rational(c[j]) - Rational(a[j]);
  return sign_of(ux * vy - uy * vx);
}

Vec3 in_cube(Random& random) {
  const double x = random.uniform(-1, 1);
  const double y = random.uniform(-1, 1);
  const double z = random.uniform(-1, 1);
  return {x, y, z};
}

void expect_exact(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  ASSERT_EQ(orient3d(a, b, c, d), rational_orient3d(a, b, c, d))
      << a.transpose() << " | " << b.transpose() << " | " << c.transpose() << " | "
      << d.transpose();
  ASSERT_EQ(orient2d(a, b, c, 0, 1), rational_orient2d(a, b, c, 0, 1));
  ASSERT_EQ(orient2d(a, b, d, 2, 0), rational_orient2d(a, b, d, 2, 0));
}

TEST(Predicates, SignConvention) {
  const Vec3 o(0, 0, 0), x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  EXPECT_EQ(orient3d(o, x, y, z), 1);
  EXPECT_EQ(orient3d(o, y, x, z), -1);
  EXPECT_EQ(orient2d(o, x, y, 0, 1), 1);
  EXPECT_EQ(orient2d(o, x, y, 1, 0), -1);
}

TEST(Predicates, EqualPoints) {
  const Vec3 a(0.1, 0.2, 0.3), b(-0.7, 1e-9, 12), c(3, 1, 4);
  EXPECT_EQ(orient3d(a, a, b, c), 0);
  EXPECT_EQ(orient3d(a, b, c, c), 0);
  EXPECT_TRUE(collinear(a, a, b));
  EXPECT_FALSE(collinear(a, b, c));
}

TEST(Predicates, RandomPointsAtManyScales) {
  Random random(1);
  for (int i = 0; i < 2000; ++i) {
    const double s = std::pow(10.0, std::floor(random.uniform(-12, 7)));
    const Vec3 a = s * in_cube(random);
    const Vec3 b = s * in_cube(random);
    const Vec3 c = s * in_cube(random);
    const Vec3 d = s * in_cube(random);
    expect_exact(a, b, c, d);
  }
}

/// d computed in the plane of the others: off by rounding, mostly, in either direction.
TEST(Predicates, RoundedOntoAPlane) {
  Random random(2);
  std::size_t undecided = 0;
  for (int i = 0; i < 3000; ++i) {
    const double s = std::pow(10.0, std::floor(random.uniform(-12, 7)));
    const Vec3 offset = s * std::pow(10.0, std::floor(random.uniform(-3, 5))) * in_cube(random);
    const Vec3 a = offset + s * in_cube(random);
    const Vec3 b = offset + s * in_cube(random);
    const Vec3 c = offset + s * in_cube(random);
    const double p = random.uniform(-2, 2);
    const double q = random.uniform(-2, 2);
    const Vec3 d = a + p * (b - a) + q * (c - a);
    expect_exact(a, b, c, d);
    expect_exact(a, b, Vec3(a + p * (b - a)), d);
    orient3d(a, b, c, d, &undecided);
  }
  EXPECT_GT(undecided, 1000u) << "the exact path was hardly tried";
}

/// Neighbouring doubles round (0.5, 0.5, 0.5) against a long diagonal plane (Kettner et al. 2008).
TEST(Predicates, NeighbouringDoubles) {
  const Vec3 b(12, 12, 12), c(24, 24, 24.000000000000004), d(13, 12.5, 12.25);
  for (int x = 0; x < 8; ++x) {
    for (int y = 0; y < 8; ++y) {
      for (int z = 0; z < 8; ++z) {
        const Vec3 a = Vec3::Constant(0.5) + 0x1p-53 * Vec3(x, y, z);
        expect_exact(a, b, c, d);
        expect_exact(d, a, b, c);
      }
    }
  }
}

TEST(Predicates, ExtremesOfDoubles) {
  Random random(3);
  for (const double s : {5e-324, 1e-310, 1e-200, 1e-100, 1e-80, 1e85, 1e100, 1e200, 1.7e308}) {
    for (int i = 0; i < 40; ++i) {
      const Vec3 a = s * in_cube(random);
      const Vec3 b = s * in_cube(random);
      const Vec3 c = s * in_cube(random);
      const Vec3 d = a + 0.25 * (b - a) + 0.5 * (c - a);
      if (!is_finite(d)) continue;
      expect_exact(a, b, c, d);
    }
  }
}

TEST(Predicates, HugeAndTinyTogether) {
  Random random(4);
  const auto any = [&random] {
    const double mantissa = random.uniform(-1, 1);
    const int exponent = static_cast<int>(random.uniform(-1070, 1020));
    return random.next() % 4 == 0 ? 0.0 : std::ldexp(mantissa, exponent);
  };
  const auto point = [&any] {
    const double x = any();
    const double y = any();
    const double z = any();
    return Vec3(x, y, z);
  };
  for (int i = 0; i < 500; ++i) {
    const Vec3 a = point();
    const Vec3 b = point();
    const Vec3 c = point();
    const Vec3 d = point();
    expect_exact(a, b, c, d);
  }
}

TEST(Predicates, NormalOfANeedle) {
  Random random(5);
  for (int i = 0; i < 200; ++i) {
    const Vec3 a = in_cube(random);
    const Vec3 b = in_cube(random);
    const Vec3 c = a + 0.5 * (b - a) + 1e-13 * in_cube(random);
    const Vec3 n = accurate_normal(a, b, c);
    for (int k = 0; k < 3; ++k) {
      const int p = (k + 1) % 3, q = (k + 2) % 3;
      const Rational exact = (Rational(b[p]) - Rational(a[p])) * (Rational(c[q]) - Rational(a[q])) -
                             (Rational(b[q]) - Rational(a[q])) * (Rational(c[p]) - Rational(a[p]));
      const double value = exact.convert_to<double>();
      EXPECT_NEAR(n[k], value, 4e-16 * std::abs(value));
    }
  }
}

TEST(Expansion, ProductsAndSumsAreExact) {
  Random random(6);
  for (int i = 0; i < 500; ++i) {
    const double a = random.uniform(-1, 1), b = 1e10 * random.normal(0, 1);
    const double c = 1e-9 * random.normal(0, 1), d = random.normal(0, 1);
    const auto left = product(Expansion<2>(two_diff(a, b)), Expansion<2>(two_sum(c, d)));
    Rational sum = 0;
    for (std::size_t k = 0; k < left.size(); ++k) sum += Rational(left.term(k));
    EXPECT_EQ(sum, (Rational(a) - Rational(b)) * (Rational(c) + Rational(d)));
  }
}

}  // namespace
}  // namespace osteon::hull
