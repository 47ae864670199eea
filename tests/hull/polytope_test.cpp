#include "polytope.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "cube_map.h"
#include "exact/predicates.h"
#include "quickhull.h"
#include "shapes.h"

namespace osteon::hull {
namespace {

using test::Points;

struct Grown {
  explicit Grown(Points given) : points(std::move(given)), cloud(points, finite_box(points)) {
    polytope.emplace(cloud, find_simplex(cloud).corners);
  }
  Points points;
  Cloud cloud;
  std::optional<Polytope> polytope;
};

const Vec3& corner(const Grown& grown, const Polytope::Facet& facet, std::size_t k) {
  return grown.points[grown.polytope->vertices()[facet.v[k]].source];
}

int side(const Grown& grown, const Polytope::Facet& facet, const Vec3& p) {
  return orient3d(corner(grown, facet, 0), corner(grown, facet, 1), corner(grown, facet, 2), p);
}

bool outside(const Grown& grown, const Vec3& p) {
  return std::any_of(grown.polytope->facets().begin(), grown.polytope->facets().end(),
                     [&](const Polytope::Facet& f) { return !f.gone() && side(grown, f, p) > 0; });
}

/// Every edge has its twin the other way, and no vertex is above any facet.
void expect_convex_and_closed(const Grown& grown) {
  const auto facets = grown.polytope->facets();
  std::set<std::uint32_t> vertices;
  std::size_t count = 0;
  for (std::uint32_t f = 0; f < facets.size(); ++f) {
    if (facets[f].gone()) continue;
    ++count;
    for (std::uint32_t s = 0; s < 3; ++s) {
      const std::uint32_t twin = facets[f].twin[s];
      ASSERT_FALSE(facets[twin >> 2].gone());
      EXPECT_EQ(facets[twin >> 2].twin[twin & 3], 4 * f + s);
      EXPECT_EQ(facets[twin >> 2].v[((twin & 3) + 1) % 3], facets[f].v[s]);
      vertices.insert(facets[f].v[s]);
    }
  }
  EXPECT_EQ(count, 2 * vertices.size() - 4);
  for (const Polytope::Facet& f : facets) {
    if (f.gone()) continue;
    for (const std::uint32_t v : vertices) {
      EXPECT_LE(side(grown, f, grown.points[grown.polytope->vertices()[v].source]), 0);
    }
  }
}

/// Adds all; before each, what `add` will say is known from all facets by exact arithmetic.
void grow_and_check(Grown& grown) {
  for (std::uint32_t i = 0; i < grown.points.size(); ++i) {
    const bool wanted = outside(grown, grown.points[i]);
    ASSERT_EQ(grown.polytope->add(i), wanted) << "point " << i;
  }
  expect_convex_and_closed(grown);
}

TEST(Polytope, StartsAsTheSimplex) {
  const Grown grown(test::box_corners());
  expect_convex_and_closed(grown);
  EXPECT_EQ(grown.polytope->facets().size(), 4u);
}

TEST(Polytope, TakesInWhatLiesOutsideAndNothingElse) {
  Random random(31);
  Grown ball(test::ball(random, 400));
  grow_and_check(ball);
  Grown sphere(test::sphere(random, 200));
  grow_and_check(sphere);
}

TEST(Polytope, LatticesFullOfTies) {
  for (const int n : {2, 3, 6}) {
    Random random(32);
    Points points = test::lattice(n);
    for (int trial = 0; trial < 5; ++trial) {
      test::shuffle(random, points);
      Grown grown(points);
      grow_and_check(grown);
    }
  }
  Grown sphere(test::lattice_sphere(306));
  grow_and_check(sphere);
}

TEST(Polytope, ThinnerThanRounding) {
  Random random(33);
  const Quat tilt = Quat(0.3, 0.5, -0.2, 0.7).normalized();
  for (const double thickness : {1e-12, 1e-14, 1e-16, 0.0}) {
    Points points = test::ball(random, 150);
    for (Vec3& p : points) {
      p.z() *= thickness;
      p = tilt * p;
    }
    Grown grown(points);
    grow_and_check(grown);
  }
}

TEST(Polytope, SmallIntegerPoints) {
  Random random(34);
  for (int trial = 0; trial < 200; ++trial) {
    const Points points = test::integer_points(random, 30, 4);
    const Cloud cloud(points, finite_box(points));
    if (find_simplex(cloud).failure) continue;
    Grown grown(points);
    grow_and_check(grown);
  }
}

TEST(Polytope, HighestRiseIsThatOfAllFacets) {
  Random random(35);
  for (const Points& points :
       {test::lattice_sphere(2009), test::lattice(5), test::ball(random, 500)}) {
    Grown grown(points);
    for (std::uint32_t i = 0; i < points.size(); ++i) grown.polytope->add(i);
    for (std::uint32_t face = 0; face < 6; ++face) {
      for (int k = 0; k < 25; ++k) {
        const Vec3 q = on_cube(face, 0.5 * (k / 5) - 1, 0.5 * (k % 5) - 1);
        double highest = 0;
        for (const Polytope::Facet& f : grown.polytope->facets()) {
          if (!f.gone()) highest = std::max(highest, f.rise(q));
        }
        EXPECT_NEAR(grown.polytope->highest_rise(q), highest, 1e-12 * highest);
      }
    }
  }
}

TEST(CubeMap, EveryDirectionHasItsCellAndBack) {
  Random random(36);
  for (int trial = 0; trial < 1000; ++trial) {
    const Vec3 q = random.direction();
    const CubeSpot spot = cube_spot(q);
    EXPECT_LT((spot.reach * on_cube(spot.face, spot.u, spot.v) - q).norm(), 1e-15);
    EXPECT_LT(cell_of(spot, 7), 6u * 49);
  }
  for (const Vec3& q : {Vec3(1, 1, 1), Vec3(-2, 2, 2), Vec3(0, 0, -3), Vec3(0, -1, 1)}) {
    const CubeSpot spot = cube_spot(q);
    EXPECT_EQ(Vec3(spot.reach * on_cube(spot.face, spot.u, spot.v)), q);
    EXPECT_LT(cell_of(spot, 7), 6u * 49);
  }
}

}  // namespace
}  // namespace osteon::hull
