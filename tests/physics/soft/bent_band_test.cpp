// The surface of a bent band: its middle goes where the string goes, its footprints stay.
#include "soft/bent_band.h"

#include <gtest/gtest.h>

#include <cmath>

namespace osteon {
namespace {

constexpr double kBandLength_m = 0.030;
const BandSpan kBandRest{{0, 0, 0}, {kBandLength_m, 0, 0}};

StringBend middle_bend(double bent_m, double dent_m = 0, double share = 0.5) {
  StringBend bend;
  bend.share = share;
  bend.bent_m = bent_m;
  bend.dent_m = dent_m;
  bend.round_m = 0.004;
  return bend;
}

Vec3 way_of(const Vec3& p, const StringBend& bend) {
  return bent_points(std::span(&p, 1), kBandRest, std::span(&bend, 1))[0] - p;
}

TEST(BentBand, ItsMiddleLineIsTheStringOfTwoLegs) {
  const StringBend bend = middle_bend(0.003, 0, 0.4);
  const double s = 0.4 * kBandLength_m;
  for (const double x : {0.2 * s, 0.5 * s})
    EXPECT_NEAR(way_of({x, 0, 0}, bend).z(), -0.003 * x / s, 1e-12);
  for (const double x : {0.7, 0.9})
    EXPECT_NEAR(way_of({x * kBandLength_m, 0, 0}, bend).z(), -0.003 * (1 - x) / 0.6, 1e-12);
  // Under the part the corner is round: less than a tenth of the bend is missing.
  const double under = way_of({s, 0, 0}, bend).z();
  EXPECT_LT(under, -0.0027);
  EXPECT_GT(under, -0.003);
}

TEST(BentBand, FootprintsStayAndNothingJumps) {
  const StringBend bend = middle_bend(0.004, 0.0005);
  for (const double z : {-0.003, 0.0, 0.003}) {
    EXPECT_EQ(way_of({-0.001, 0.001, z}, bend), Vec3(0, 0, 0));
    EXPECT_EQ(way_of({kBandLength_m + 0.001, 0, z}, bend), Vec3(0, 0, 0));
    Vec3 before = way_of({0, 0, z}, bend);
    for (double x = 0; x < kBandLength_m + 0.001; x += 5e-5) {
      const Vec3 now = way_of({x, 0, z}, bend);
      ASSERT_LT((now - before).norm(), 8e-5) << x;
      before = now;
    }
  }
}

// A section turns with the middle line: its upper point goes along the band, by the leg's slope.
TEST(BentBand, SectionsTurnWithTheMiddleLine) {
  const StringBend bend = middle_bend(0.003);
  const double slope = 0.003 / (0.5 * kBandLength_m), o = 0.002;
  const Vec3 up = way_of({0.2 * kBandLength_m, 0, o}, bend);
  const Vec3 middle = way_of({0.2 * kBandLength_m, 0, 0}, bend);
  const double c = 1 / std::sqrt(1 + slope * slope);
  EXPECT_NEAR((up - middle).x(), o * slope * c, 1e-12);
  EXPECT_NEAR((up - middle + Vec3(0, 0, o)).norm(), o, 1e-12);
}

TEST(BentBand, ThePartDentsItsOwnSideAlone) {
  const StringBend bend = middle_bend(0, 0.0005);
  const double x = 0.5 * kBandLength_m;
  EXPECT_NEAR(way_of({x, 0, 0.003}, bend).z(), -0.0005, 1e-12);
  EXPECT_EQ(way_of({x, 0, -0.003}, bend), Vec3(0, 0, 0));
  EXPECT_EQ(way_of({x + 0.009, 0, 0.003}, bend), Vec3(0, 0, 0));
}

// The bones have turned the string since rest: what pushes across it then pushes across it at rest.
TEST(BentBand, TheSideIsThatOfTheStringAsItStands) {
  StringBend bend = middle_bend(0.003);
  bend.along_W = Vec3::UnitY();
  bend.nhat_W = -Vec3::UnitX();
  const Vec3 way = way_of({0.5 * kBandLength_m, 0, 0}, bend);
  EXPECT_LT(way.y(), -0.0025);
  EXPECT_NEAR(way.x(), 0, 1e-9);
}

TEST(BentBand, WhatIsNotANumberBendsNothing) {
  const Vec3 p(0.015, 0, 0.003);
  for (int k = 0; k < 4; ++k) {
    StringBend bend = middle_bend(0.003);
    (k == 0   ? bend.bent_m
     : k == 1 ? bend.share
     : k == 2 ? bend.dent_m
              : bend.nhat_W.x()) = std::nan("");
    EXPECT_EQ(way_of(p, bend), Vec3(0, 0, 0)) << k;
  }
  const StringBend bend = middle_bend(0.003);
  EXPECT_EQ(bent_points(std::span(&p, 1), {{0, 0, 0}, {0, 0, 0}}, std::span(&bend, 1))[0], p);
}

}  // namespace
}  // namespace osteon
