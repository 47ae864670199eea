#include "osteon/mesh/repair.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "mesh/shapes.h"
#include "osteon/base/random.h"
#include "osteon/mesh/measure.h"
#include "osteon/mesh/mesh_io.h"
#include "osteon/mesh/self_crossing.h"

namespace osteon {
namespace {

using test::cube;
using test::flip;
using test::soup;

TEST(Repair, EmptyMesh) {
  TriMesh m;
  EXPECT_EQ(repair(m).summary(), "nothing to repair");
  m.vertices = {Vec3(1, 2, 3)};
  EXPECT_EQ(repair(m).unused_vertices, 1u);
  EXPECT_TRUE(m.vertices.empty());
}

TEST(Repair, OneTriangleStaysOpen) {
  TriMesh m;
  m.vertices = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
  m.triangles = {{0, 1, 2}};
  const RepairReport report = repair(m);
  EXPECT_EQ(m.triangles.size(), 1u);
  EXPECT_EQ(report.filled_holes, 0u);
  EXPECT_EQ(report.open_holes, 1u);
  EXPECT_EQ(report.flipped_triangles, 0u);
}

TEST(Repair, OneDegenerateTriangleGoes) {
  for (const Vec3& third : {Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(1, 5e-8, 0)}) {
    TriMesh m;
    m.vertices = {Vec3(0, 0, 0), Vec3(1, 0, 0), third};
    m.triangles = {{0, 1, 2}};
    EXPECT_EQ(repair(m).degenerate_triangles, 1u);
    EXPECT_TRUE(m.triangles.empty());
    EXPECT_TRUE(m.vertices.empty());
  }
}

TEST(Repair, AFlatSheetStaysASheet) {
  TriMesh m;
  for (int i = 0; i < 9; ++i) m.vertices.emplace_back(i % 3, i / 3, 0);
  for (std::uint32_t i : {0u, 1u, 3u, 4u}) {
    m.triangles.push_back({i, i + 1, i + 4});
    m.triangles.push_back({i, i + 4, i + 3});
  }
  const RepairReport report = repair(m);
  EXPECT_EQ(m.triangles.size(), 8u);
  EXPECT_EQ(report.open_holes, 1u);
  EXPECT_EQ(report.summary(), "left 1 hole open");
}

TEST(Repair, SoundMeshIsLeftAlone) {
  TriMesh m = test::sphere(0.01, 8);
  const TriMesh before = m;
  EXPECT_EQ(repair(m).summary(), "nothing to repair");
  EXPECT_TRUE(m.triangles.size() == before.triangles.size());
  EXPECT_NEAR(volume(m), volume(before), 1e-18);
}

TEST(Repair, WeldsASoup) {
  TriMesh m = soup(cube());
  const RepairReport report = repair(m);
  EXPECT_EQ(report.welded_vertices, 28u);
  EXPECT_EQ(m.vertices.size(), 8u);
  EXPECT_TRUE(topology(m).closed());
  EXPECT_NEAR(volume(m), 1, 1e-12);
}

TEST(Repair, WeldsAcrossTheBordersOfItsGrid) {
  Random random(5);
  for (int i = 0; i < 50; ++i) {
    TriMesh m = soup(cube(0.5, 1e-7 * Vec3::Constant(i)));
    for (Vec3& v : m.vertices) v += 2e-8 * random.direction();
    repair(m);
    EXPECT_EQ(m.vertices.size(), 8u);
    EXPECT_TRUE(topology(m).closed());
  }
}

TEST(Repair, DoesNotWeldBeyondTheDistance) {
  TriMesh m = test::joined(cube(0.5), cube(0.5, Vec3(1 + 2e-7, 0, 0)));
  EXPECT_EQ(repair(m).welded_vertices, 0u);
  EXPECT_EQ(topology(m).components, 2u);
}

TEST(Repair, FlipsTurnedTriangles) {
  TriMesh m = cube();
  for (const std::size_t t : {1u, 4u, 7u}) flip(m.triangles[t]);
  EXPECT_EQ(repair(m).flipped_triangles, 3u);
  EXPECT_TRUE(topology(m).closed());
  EXPECT_NEAR(volume(m), 1, 1e-12);
}

TEST(Repair, TurnsAnInsideOutCube) {
  TriMesh m = cube(0.5, Vec3(3, 4, 5));
  for (Triangle& t : m.triangles) flip(t);
  EXPECT_EQ(repair(m).flipped_triangles, 12u);
  EXPECT_NEAR(volume(m), 1, 1e-12);
}

TEST(Repair, ACubeInsideACubeIsItsCavity) {
  for (const bool inner_turned : {false, true}) {
    TriMesh inner = cube(0.2, Vec3(0.1, 0, 0));
    if (inner_turned)
      for (Triangle& t : inner.triangles) flip(t);
    TriMesh m = test::joined(inner, cube());
    const RepairReport report = repair(m);
    EXPECT_EQ(report.flipped_triangles, inner_turned ? 0u : 12u);
    EXPECT_NEAR(volume(m), 1 - 0.064, 1e-12);
    EXPECT_TRUE(topology(m).closed());
  }
}

TEST(Repair, ACubeInsideACavityIsSolidAgain) {
  TriMesh m = test::joined(test::joined(cube(0.1), cube(0.2)), cube());
  repair(m);
  EXPECT_NEAR(volume(m), 1 - 0.064 + 0.008, 1e-12);
}

TEST(Repair, CubesSideBySideAreBothSolid) {
  TriMesh m = test::joined(cube(), cube(0.5, Vec3(1.5, 0, 0)));
  for (std::size_t t = 12; t < 24; ++t) flip(m.triangles[t]);
  repair(m);
  EXPECT_NEAR(volume(m), 2, 1e-12);
}

TEST(Repair, FillsAMissingTriangleAndAMissingFace) {
  for (const std::size_t missing : {1u, 2u}) {
    TriMesh m = cube();
    m.triangles.resize(12 - missing);
    const RepairReport report = repair(m);
    EXPECT_EQ(report.filled_holes, 1u);
    EXPECT_EQ(report.open_holes, 0u);
    EXPECT_TRUE(topology(m).closed());
    EXPECT_NEAR(volume(m), 1, 1e-12);
  }
}

TEST(Repair, FillsAHoleInATurnedSurface) {
  TriMesh m = cube();
  for (Triangle& t : m.triangles) flip(t);
  m.triangles.resize(10);
  repair(m);
  EXPECT_TRUE(topology(m).closed());
  EXPECT_NEAR(volume(m), 1, 1e-12);
}

// A tube: two round holes, as where a long bone was cut.
TriMesh tube(std::uint32_t around, double length) {
  TriMesh m;
  for (std::uint32_t j = 0; j < around; ++j) {
    const double phi = 2 * M_PI * j / around;
    m.vertices.emplace_back(std::cos(phi), std::sin(phi), 0);
    m.vertices.emplace_back(std::cos(phi), std::sin(phi), length);
  }
  for (std::uint32_t j = 0; j < around; ++j) {
    const std::uint32_t a = 2 * j, b = 2 * ((j + 1) % around);
    m.triangles.push_back({a, b, b + 1});
    m.triangles.push_back({a, b + 1, a + 1});
  }
  return m;
}

TEST(Repair, ClosesBothEndsOfATube) {
  TriMesh m = tube(64, 4);
  const RepairReport report = repair(m);
  EXPECT_EQ(report.filled_holes, 2u);
  EXPECT_TRUE(topology(m).closed());
  EXPECT_NEAR(volume(m), 4 * 32 * std::sin(2 * M_PI / 64), 1e-9);
}

// A shaft as a scan cuts it has more edges on its rim than a least area is worth.
TEST(Repair, CapsTheFlatEndsOfAFineShaft) {
  constexpr std::uint32_t kAround = 1500;
  TriMesh m = tube(kAround, 10);
  const RepairReport report = repair(m);
  EXPECT_EQ(report.capped_ends, 2u);
  EXPECT_EQ(report.summary(), "capped 2 open ends");
  EXPECT_TRUE(topology(m).closed());
  EXPECT_NEAR(volume(m), 10 * 0.5 * kAround * std::sin(2 * M_PI / kAround), 1e-9);
}

TEST(Repair, CapsARimThatIsNotConvex) {
  TriMesh m = tube(1000, 10);
  for (Vec3& v : m.vertices) {
    const double r = 1 + 0.4 * std::cos(5 * std::atan2(v.y(), v.x()));
    v.x() *= r;
    v.y() *= r;
  }
  repair(m);
  EXPECT_TRUE(topology(m).closed());
  // Of r = 1 + a cos 5 phi the area is pi (1 + a^2 / 2).
  EXPECT_NEAR(volume(m), 10 * M_PI * (1 + 0.4 * 0.4 / 2), 0.01);
  EXPECT_TRUE(self_crossings(m).empty());
}

// Both walls of a hollow shaft get lids: the marrow is a cavity, and the volume that of the wall.
TEST(Repair, CapsAHollowShaft) {
  TriMesh m = tube(400, 10);
  const auto outer = static_cast<std::uint32_t>(m.vertices.size());
  const TriMesh inner = tube(400, 10);
  for (const Vec3& v : inner.vertices)
    m.vertices.push_back(Vec3(0.6 * v.x(), 0.6 * v.y(), 0.01 + 0.998 * v.z()));
  for (const Triangle& t : inner.triangles)
    m.triangles.push_back({t[0] + outer, t[1] + outer, t[2] + outer});
  EXPECT_EQ(repair(m).capped_ends, 4u);
  EXPECT_TRUE(topology(m).closed());
  EXPECT_NEAR(volume(m), (10 - 0.36 * 9.98) * 200 * std::sin(2 * M_PI / 400), 1e-9);
}

TriMesh wavy(TriMesh m) {
  for (Vec3& v : m.vertices) v.z() += 0.5 * std::cos(3 * std::atan2(v.y(), v.x()));
  return m;
}

TEST(Repair, LeavesHolesThatAreTooLarge) {
  TriMesh m = wavy(tube(201, 4));
  EXPECT_EQ(repair(m).open_holes, 2u);
  RepairOptions options;
  options.largest_hole_edges = 201;
  EXPECT_EQ(repair(m, options).filled_holes, 2u);
  EXPECT_TRUE(topology(m).closed());
}

TEST(Repair, ALidFollowsAConcaveRim) {
  // An L-shaped prism without its top: the lid must be the L, not its hull.
  const std::vector<Vec3> corners = {Vec3(0, 0, 0), Vec3(3, 0, 0), Vec3(3, 1, 0),
                                     Vec3(1, 1, 0), Vec3(1, 3, 0), Vec3(0, 3, 0)};
  TriMesh m;
  for (const Vec3& c : corners) {
    m.vertices.push_back(c);
    m.vertices.push_back(c + Vec3(0, 0, 2));
  }
  for (std::uint32_t j = 0; j < 6; ++j) {
    const std::uint32_t a = 2 * j, b = 2 * ((j + 1) % 6);
    m.triangles.push_back({a, b, b + 1});
    m.triangles.push_back({a, b + 1, a + 1});
  }
  EXPECT_EQ(repair(m).filled_holes, 2u);
  EXPECT_TRUE(topology(m).closed());
  EXPECT_NEAR(volume(m), 10, 1e-12);
}

TEST(Repair, TwoHolesThatTouchInACorner) {
  TriMesh m = test::sphere(1, 8);
  // Two opposite triangles around the north pole share that vertex alone.
  std::vector<std::size_t> polar;
  for (std::size_t t = 0; t < m.triangles.size(); ++t)
    if (m.triangles[t][0] == 0) polar.push_back(t);
  const double whole = volume(m);
  m.triangles.erase(m.triangles.begin() + static_cast<std::ptrdiff_t>(polar[8]));
  m.triangles.erase(m.triangles.begin() + static_cast<std::ptrdiff_t>(polar[0]));
  EXPECT_EQ(repair(m).filled_holes, 2u);
  EXPECT_TRUE(topology(m).closed());
  EXPECT_NEAR(volume(m), whole, 1e-12);
}

TEST(Repair, AMoebiusStripIsReported) {
  TriMesh m;
  constexpr std::uint32_t kAround = 24;
  for (std::uint32_t j = 0; j < kAround; ++j) {
    const double phi = 2 * M_PI * j / kAround;
    const Vec3 out(std::cos(phi), std::sin(phi), 0);
    const Vec3 across = std::cos(phi / 2) * out + std::sin(phi / 2) * Vec3::UnitZ();
    m.vertices.push_back(3 * out - across);
    m.vertices.push_back(3 * out + across);
  }
  for (std::uint32_t j = 0; j < kAround; ++j) {
    const bool last = j + 1 == kAround;
    const std::uint32_t a = 2 * j, b = last ? 1 : a + 2, c = last ? 0 : a + 3;
    m.triangles.push_back({a, b, c});
    m.triangles.push_back({a, c, a + 1});
  }
  const RepairReport report = repair(m);
  EXPECT_GT(report.misoriented_edges, 0u);
  EXPECT_FALSE(topology(m).closed());
}

TEST(Repair, DropsDuplicatesWhateverTheirFacing) {
  TriMesh m = cube();
  m.triangles.push_back(m.triangles[3]);
  m.triangles.push_back({m.triangles[5][1], m.triangles[5][2], m.triangles[5][0]});
  m.triangles.push_back({m.triangles[7][0], m.triangles[7][2], m.triangles[7][1]});
  EXPECT_EQ(repair(m).duplicate_triangles, 3u);
  EXPECT_TRUE(topology(m).closed());
  EXPECT_NEAR(volume(m), 1, 1e-12);
}

TEST(Repair, ADoubleSidedCubeBecomesOneCube) {
  TriMesh m = cube();
  for (std::size_t t = 0; t < 12; ++t) {
    Triangle back = m.triangles[t];
    flip(back);
    m.triangles.push_back(back);
  }
  EXPECT_EQ(repair(m).duplicate_triangles, 12u);
  EXPECT_TRUE(topology(m).closed());
  EXPECT_NEAR(volume(m), 1, 1e-12);
}

TEST(Repair, AFoldGoesWhole) {
  TriMesh m = cube();
  m.vertices.emplace_back(2, 2, 2);
  m.triangles.push_back({0, 1, 8});
  m.triangles.push_back({1, 0, 8});
  EXPECT_EQ(repair(m).duplicate_triangles, 2u);
  EXPECT_TRUE(topology(m).closed());
  EXPECT_EQ(m.vertices.size(), 8u);
}

TEST(Repair, AFinGoes) {
  TriMesh m = cube();
  for (Triangle& t : m.triangles) flip(t);
  m.vertices.emplace_back(0, 0, 0);
  m.vertices.emplace_back(0.1, 0, 0);
  m.triangles.push_back({0, 1, 8});
  m.triangles.push_back({8, 1, 9});
  const RepairReport report = repair(m);
  EXPECT_EQ(report.fin_triangles, 2u);
  EXPECT_EQ(report.non_manifold_edges, 0u);
  EXPECT_TRUE(topology(m).closed());
  EXPECT_EQ(m.vertices.size(), 8u);
  EXPECT_NEAR(volume(m), 1, 1e-12);
}

// As large as the cube itself: which of the two was meant is not for us to say.
TEST(Repair, ALargeFlangeIsReported) {
  TriMesh m = cube();
  m.vertices.emplace_back(20, 20, 20);
  m.triangles.push_back({0, 1, 8});
  for (std::size_t t = 0; t < 12; ++t) flip(m.triangles[t]);
  const RepairReport report = repair(m);
  EXPECT_EQ(report.non_manifold_edges, 1u);
  EXPECT_GT(report.open_holes, 0u);
  m.triangles.pop_back();
  EXPECT_NEAR(volume(m), 1, 1e-12) << "the cube itself must face outwards";
}

TEST(Repair, AFlatTriangleGoesWithoutAGap) {
  // The corner 8 halves the edge 0-1 on one side only; a flat triangle closes the gap.
  TriMesh m = cube();
  m.vertices.push_back((m.vertices[0] + m.vertices[1]) / 2);
  m.triangles.erase(std::find(m.triangles.begin(), m.triangles.end(), Triangle{0, 1, 5}));
  m.triangles.push_back({0, 8, 5});
  m.triangles.push_back({8, 1, 5});
  m.triangles.push_back({0, 1, 8});
  ASSERT_TRUE(topology(m).closed());
  const RepairReport report = repair(m);
  EXPECT_EQ(report.degenerate_triangles, 1u);
  EXPECT_EQ(report.filled_holes, 0u);
  EXPECT_EQ(m.triangles.size(), 14u);
  EXPECT_TRUE(topology(m).closed());
  EXPECT_NEAR(volume(m), 1, 1e-12);
  for (const Triangle& t : m.triangles) {
    const Vec3& a = m.vertices[t[0]];
    EXPECT_GT((m.vertices[t[1]] - a).cross(m.vertices[t[2]] - a).norm(), 1e-6);
  }
}

TEST(Repair, IsDoneAfterOnce) {
  TriMesh m = soup(test::sphere(0.01, 10));
  flip(m.triangles[3]);
  m.triangles.erase(m.triangles.begin() + 17);
  repair(m);
  const TriMesh once = m;
  EXPECT_EQ(repair(m).summary(), "nothing to repair");
  EXPECT_TRUE(m.vertices == once.vertices && m.triangles == once.triangles);
}

// Whatever was done to a sphere, its volume and its closed surface come back.
TEST(Repair, MendsARandomlyBrokenSphere) {
  Random random(99);
  for (int round = 0; round < 60; ++round) {
    const TriMesh whole = test::sphere(0.02, 12, 0.1 * random.direction());
    TriMesh m = soup(whole);
    for (Vec3& v : m.vertices) v += 1e-8 * random.direction();
    for (std::size_t i = m.triangles.size(); i-- > 1;)
      std::swap(m.triangles[i], m.triangles[random.next() % (i + 1)]);
    for (int i = 0; i < 40; ++i) flip(m.triangles[random.next() % m.triangles.size()]);
    for (int i = 0; i < 5; ++i)
      m.triangles.push_back(m.triangles[random.next() % m.triangles.size()]);
    for (int i = 0; i < 4; ++i)
      m.triangles.erase(m.triangles.begin() +
                        static_cast<std::ptrdiff_t>(random.next() % m.triangles.size()));
    repair(m);
    const Topology shape = topology(m);
    EXPECT_TRUE(shape.closed()) << round;
    EXPECT_EQ(shape.components, 1u) << round;
    EXPECT_EQ(m.vertices.size(), whole.vertices.size()) << round;
    EXPECT_NEAR(volume(m) / volume(whole), 1, 0.03) << round;
  }
}

TEST(Repair, NeverFailsOnRandomTriangles) {
  Random random(123);
  for (int round = 0; round < 300; ++round) {
    TriMesh m;
    const std::uint64_t vertices = 3 + random.next() % 12;
    for (std::uint64_t i = 0; i < vertices; ++i) m.vertices.push_back(random.direction());
    const std::uint64_t triangles = random.next() % 60;
    for (std::uint64_t i = 0; i < triangles; ++i) {
      Triangle t{};
      for (std::uint32_t& v : t) v = static_cast<std::uint32_t>(random.next() % vertices);
      m.triangles.push_back(t);
    }
    const RepairReport report = repair(m);
    const Topology shape = topology(m);
    EXPECT_EQ(report.non_manifold_edges, shape.non_manifold_edges);
    EXPECT_EQ(report.misoriented_edges, shape.misoriented_edges);
    if (report.open_holes == 0) {
      EXPECT_EQ(shape.boundary_edges, 0u);
    }
    for (const Triangle& t : m.triangles)
      for (const std::uint32_t v : t) ASSERT_LT(v, m.vertices.size());
  }
}

TEST(Repair, SummaryReadsWell) {
  RepairReport report;
  report.welded_vertices = 2834;
  report.filled_holes = 1;
  report.open_holes = 2;
  EXPECT_EQ(report.summary(), "welded 2834 vertices, filled 1 hole, left 2 holes open");
}

TEST(WeldVertices, ZeroDistanceJoinsEqualCoordinatesOnly) {
  TriMesh m = soup(cube());
  m.vertices[0].x() += 1e-15;
  m.vertices[1].x() = -0.0;
  m.vertices[2].x() = 0.0;
  m.vertices[2].tail<2>() = m.vertices[1].tail<2>();
  weld_vertices(m, 0);
  EXPECT_EQ(m.triangles[0][1], m.triangles[0][2]) << "the two zeros are equal";
  EXPECT_NE(m.triangles[0][0], m.triangles[1][0]);
}

TEST(WeldVertices, AgreesWithTheSlowWay) {
  Random random(31);
  for (int round = 0; round < 30; ++round) {
    TriMesh m;
    for (std::uint32_t i = 0; i < 300; ++i) {
      const double x = std::floor(random.uniform(-20, 20));
      const double y = std::floor(random.uniform(-2, 2));
      m.vertices.emplace_back(0.3 * x, 0.3 * y, -0.1 * x);
      if (i % 3 == 2) m.triangles.push_back({i - 2, i - 1, i});
    }
    const double distance = round % 2 ? 0.35 : 0.0;
    std::vector<std::size_t> stays(300);
    std::size_t joined = 0;
    for (std::size_t i = 0; i < 300; ++i) {
      stays[i] = i;
      for (std::size_t j = 0; j < i; ++j) {
        if (stays[j] != j || (m.vertices[i] - m.vertices[j]).norm() > distance) continue;
        stays[i] = j;
        ++joined;
        break;
      }
    }
    const std::vector<Vec3> before = m.vertices;
    EXPECT_EQ(weld_vertices(m, distance), joined);
    for (std::size_t i = 0; i < 300; ++i)
      EXPECT_EQ(m.vertices[m.triangles[i / 3][i % 3]], before[stays[i]]);
  }
}

// The fifteen bones of a real wrist, where the reference data are there.
TEST(Repair, RealBones) {
  const auto dir = test::shared_folder() / "anatomy/wrist";
  if (!std::filesystem::is_directory(dir)) GTEST_SKIP() << "no reference bones in " << dir;
  int bones = 0;
  for (const auto& entry : std::filesystem::directory_iterator(dir)) {
    auto mesh = load_mesh(entry.path(), 1);
    ASSERT_TRUE(mesh) << mesh.error().message();
    const RepairReport report = repair(*mesh);
    const Topology shape = topology(*mesh);
    EXPECT_TRUE(shape.closed()) << entry.path().filename() << ": " << report.summary();
    EXPECT_GT(volume(*mesh), 1e-7) << entry.path().filename();
    ++bones;
  }
  EXPECT_EQ(bones, 15);
}

}  // namespace
}  // namespace osteon
