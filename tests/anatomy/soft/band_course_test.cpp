#include "soft/band_course.h"

#include <gtest/gtest.h>

#include <cmath>

namespace osteon {
namespace {

constexpr std::size_t kSpans = 40;
constexpr double kLength = 0.03;

BandSection section(const Vec3& center, const Vec3& along, const Vec3& flat) {
  BandSection s;
  s.center = center;
  s.along = along;
  s.flat = flat;
  s.across = flat.cross(along);
  return s;
}

/// Along x from the origin, flat side to z; `insertion` sections of 1 mm more at either end.
LaidBand straight(std::size_t insertion = 0) {
  LaidBand band;
  const double step = kLength / kSpans;
  for (std::size_t i = insertion; i > 0; --i)
    band.sections.push_back(
        section(Vec3(-1e-3 * static_cast<double>(i), 0, 0), Vec3::UnitX(), Vec3::UnitZ()));
  for (std::size_t i = 0; i <= kSpans; ++i)
    band.sections.push_back(
        section(Vec3(step * static_cast<double>(i), 0, 0), Vec3::UnitX(), Vec3::UnitZ()));
  for (std::size_t i = 1; i <= insertion; ++i)
    band.sections.push_back(
        section(Vec3(kLength + 1e-3 * static_cast<double>(i), 0, 0), Vec3::UnitX(), Vec3::UnitZ()));
  band.first = insertion;
  band.last = insertion + kSpans;
  band.length = kLength;
  return band;
}

/// A quarter of a circle of this length in the plane of x and z, first along x, then down.
LaidBand quarter(double length, bool unequal_steps = false) {
  LaidBand band;
  const double radius = length / (0.5 * M_PI);
  for (std::size_t i = 0; i <= kSpans; ++i) {
    double share = static_cast<double>(i) / kSpans;
    if (unequal_steps) share *= share;
    const double a = 0.5 * M_PI * share;
    band.sections.push_back(section(radius * Vec3(std::sin(a), 0, std::cos(a)),
                                    Vec3(std::cos(a), 0, -std::sin(a)),
                                    Vec3(std::sin(a), 0, std::cos(a))));
  }
  band.last = kSpans;
  for (std::size_t i = 0; i < kSpans; ++i)
    band.length += (band.sections[i + 1].center - band.sections[i].center).norm();
  return band;
}

void expect_same(const Pose& X, const Pose& wanted, double within) {
  EXPECT_LT((X.p - wanted.p).norm(), within);
  EXPECT_LT(X.q.angularDistance(wanted.q), within);
}

TEST(BandCourse, ACourseThatStaysMovesNothing) {
  for (const Vec3& p : {Vec3(0.011, 0.002, -0.001), Vec3(0, 0, 0), Vec3(0.2, 0, 0), Vec3(-1, 1, 1)})
    expect_same(motion_along(straight(), straight(), p), Pose{}, 1e-12);
  expect_same(motion_along(quarter(0.03), quarter(0.03), Vec3(0.01, 0.001, 0.01)), Pose{}, 1e-12);
}

TEST(BandCourse, ACourseThatMovesRigidlyTakesAlongWhatLiesBesideIt) {
  const Pose X{Vec3(0.01, -0.02, 0.03), Quat(Eigen::AngleAxisd(1.1, Vec3(1, 2, 3).normalized()))};
  LaidBand moved = straight();
  for (BandSection& s : moved.sections)
    s = section(X * s.center, X.rotate(s.along), X.rotate(s.flat));
  expect_same(motion_along(straight(), moved, Vec3(0.02, 0.003, 0.001)), X, 1e-12);
}

/// The closed form of a bent bar: what stood across the middle line at a share of it stands across
/// the arc at that share, as far beside it, however long the bar has become.
TEST(BandCourse, ABentCourseTurnsItByTheAngleAtItsShare) {
  for (const double length : {0.03, 0.024}) {
    for (const bool unequal : {false, true}) {
      const LaidBand bent = quarter(length, unequal);
      const double radius = length / (0.5 * M_PI);
      for (const double share : {0.0, 0.2, 0.5, 0.9, 1.0}) {
        const Vec3 at(share * kLength, 0.002, 0.001);
        const Pose X = motion_along(straight(), bent, at);
        const double a = 0.5 * M_PI * share;
        const Vec3 wanted =
            (radius + 0.001) * Vec3(std::sin(a), 0, std::cos(a)) + 0.002 * Vec3::UnitY();
        EXPECT_LT((X * at - wanted).norm(), 3e-5) << share;
        EXPECT_LT((X.rotate(Vec3::UnitX()) - Vec3(std::cos(a), 0, -std::sin(a))).norm(), 0.03);
        EXPECT_LT((X.rotate(Vec3::UnitY()) - Vec3::UnitY()).norm(), 1e-9);
      }
    }
  }
}

TEST(BandCourse, WhatLiesBeyondAnEndGoesWithTheEnd) {
  const LaidBand bent = quarter(0.03);
  const double radius = 0.03 / (0.5 * M_PI);
  const Pose X = motion_along(straight(), bent, Vec3(0.035, 0, 0));
  EXPECT_LT((X * Vec3(0.035, 0, 0) - Vec3(radius, 0, -0.005)).norm(), 3e-4);
}

/// Roots in bone are no part of the way.
TEST(BandCourse, InsertionsDoNotCount) {
  const LaidBand bent = quarter(0.03);
  const Vec3 at(0.0075, 0, 0);
  const Pose X = motion_along(straight(6), bent, at), wanted = motion_along(straight(), bent, at);
  expect_same(X, wanted, 1e-12);
}

}  // namespace
}  // namespace osteon
