// A band in two: closed stumps, as far apart as is said, and as much left as is left.
#include "soft/band_stumps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <numbers>

namespace osteon {
namespace {

constexpr double kCordLength_m = 0.030, kCordRadius_m = 0.004;
constexpr std::uint32_t kCordRings = 41, kCordSides = 24;
const BandSpan kCordSpan{{0, 0, 0}, {kCordLength_m, 0, 0}};

std::uint32_t cord_point(std::uint32_t ring, std::uint32_t side) {
  return 2 + ring * kCordSides + side % kCordSides;
}

// A closed cord along x.
TriMesh stump_cord() {
  TriMesh mesh;
  mesh.vertices = {{0, 0, 0}, {kCordLength_m, 0, 0}};
  for (std::uint32_t r = 0; r < kCordRings; ++r)
    for (std::uint32_t s = 0; s < kCordSides; ++s) {
      const double turn = 2 * std::numbers::pi * s / kCordSides;
      mesh.vertices.emplace_back(kCordLength_m * r / (kCordRings - 1),
                                 kCordRadius_m * std::cos(turn), kCordRadius_m * std::sin(turn));
    }
  for (std::uint32_t s = 0; s < kCordSides; ++s) {
    mesh.triangles.push_back({0, cord_point(0, s + 1), cord_point(0, s)});
    mesh.triangles.push_back({1, cord_point(kCordRings - 1, s), cord_point(kCordRings - 1, s + 1)});
    for (std::uint32_t r = 0; r + 1 < kCordRings; ++r) {
      const std::uint32_t a = cord_point(r, s), b = cord_point(r, s + 1), c = cord_point(r + 1, s),
                          d = cord_point(r + 1, s + 1);
      mesh.triangles.push_back({a, b, c});
      mesh.triangles.push_back({b, d, c});
    }
  }
  return mesh;
}

double stump_volume(const TriMesh& mesh) {
  double six = 0;
  for (const Triangle& t : mesh.triangles)
    six += mesh.vertices[t[0]].dot(mesh.vertices[t[1]].cross(mesh.vertices[t[2]]));
  return six / 6;
}

// Points on one another are one, triangles of no area none: then each edge has two sides.
bool stumps_are_closed(const TriMesh& mesh) {
  std::map<std::array<double, 3>, std::uint32_t> places;
  std::vector<std::uint32_t> place;
  for (const Vec3& p : mesh.vertices)
    place.push_back(
        places.try_emplace({p.x(), p.y(), p.z()}, static_cast<std::uint32_t>(places.size()))
            .first->second);
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const Triangle& t : mesh.triangles) {
    const std::array<std::uint32_t, 3> w{place[t[0]], place[t[1]], place[t[2]]};
    if (w[0] == w[1] || w[1] == w[2] || w[2] == w[0]) continue;
    for (int k = 0; k < 3; ++k) ++edges[{w[k], w[(k + 1) % 3]}];
  }
  for (const auto& [edge, times] : edges) {
    const auto back = edges.find({edge.second, edge.first});
    if (times != 1 || back == edges.end()) return false;
  }
  return !edges.empty();
}

TEST(BandStumps, TwoClosedStumpsAsFarApartAsSaid) {
  const TriMesh rest = stump_cord();
  ASSERT_TRUE(stumps_are_closed(rest));
  const double gap = 0.002, whole = stump_volume(rest);
  ASSERT_GT(whole, 0);
  for (const double share : {0.1, 0.31, 0.5, 0.77, 0.9}) {
    TriMesh cut{stump_points(rest, kCordSpan, share, gap), rest.triangles};
    EXPECT_TRUE(stumps_are_closed(cut)) << share;
    EXPECT_NEAR(stump_volume(cut) / whole, 1 - gap / kCordLength_m, 0.01) << share;
    const double at = share * kCordLength_m;
    std::size_t near = 0, far = 0;
    for (std::size_t v = 0; v < rest.vertices.size(); ++v) {
      const double x = cut.vertices[v].x();
      EXPECT_GT(std::abs(x - at), gap / 2 - 1e-12);
      near += std::abs(x - (at - gap / 2)) < 1e-12 ? 1u : 0u;
      far += std::abs(x - (at + gap / 2)) < 1e-12 ? 1u : 0u;
      EXPECT_LE(std::hypot(cut.vertices[v].y(), cut.vertices[v].z()), kCordRadius_m + 1e-12);
    }
    EXPECT_GE(near, 2 * kCordSides);
    EXPECT_GE(far, 2 * kCordSides);
    EXPECT_EQ(cut.vertices[0], rest.vertices[0]);  // the footprints stay
    EXPECT_EQ(cut.vertices[1], rest.vertices[1]);
  }
}

TEST(BandStumps, WhatIsTooCoarseOrNoNumberStaysWhole) {
  TriMesh coarse = stump_cord();
  for (Vec3& p : coarse.vertices) p.x() = p.x() < 0.5 * kCordLength_m ? 0 : kCordLength_m;
  EXPECT_EQ(stump_points(coarse, kCordSpan, 0.5, 0.002), coarse.vertices);
  const TriMesh rest = stump_cord();
  const double none = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(stump_points(rest, kCordSpan, none, 0.002), rest.vertices);
  EXPECT_EQ(stump_points(rest, kCordSpan, 0.5, none), rest.vertices);
  EXPECT_EQ(stump_points(rest, {}, 0.5, 0.002), rest.vertices);
}

// A taut band draws back as far as it was stretched, a slack one gapes as the blade leaves it.
TEST(BandStumps, TheGapIsWhatItWasStretchedBy) {
  SoftBand band;
  band.fibres = {{0.028, 6000, 0.002}, {0.031, 6000, 0.002}};
  EXPECT_NEAR(stump_gap_m(band, kCordSpan), 0.002, 1e-12);
  band.fibres = {{0.034, 6000, 0.002}};
  EXPECT_NEAR(stump_gap_m(band, kCordSpan), 0.0015, 1e-12);
}

}  // namespace
}  // namespace osteon
