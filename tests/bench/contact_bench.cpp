// One contact query of a 32-corner probe that slides over a 700-corner bone hull, beside Bullet's
// GJK + EPA, libccd and FCL. Every library gets the same poses, one a millisecond of a slow stroke;
// lengths in millimetres for the peers, whose tolerances are absolute.
#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkPairDetector.h>
#include <BulletCollision/NarrowPhaseCollision/btPointCollector.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>
#include <benchmark/benchmark.h>
#include <ccd/ccd.h>
#include <ccd/quat.h>
#include <fcl/geometry/shape/convex.h>
#include <fcl/narrowphase/collision.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "contact_scene.h"
#include "osteon/base/percentiles.h"
#include "osteon/base/random.h"
#include "osteon/base/turn.h"
#include "osteon/collide/capsule_contact.h"
#include "osteon/collide/lp_contact.h"
#include "ratios.h"

namespace {

using namespace osteon::bench;
using osteon::Hull;
using osteon::Pose;
using osteon::Quat;
using osteon::Vec3;

void osteon_depth_cold(benchmark::State& state) {
  const Scene& s = scene();
  along_path(state, [&](const Pose& X) { return lp_depth(s.bone_body, s.probe_body, X).t <= 0; });
}
void osteon_depth_warm(benchmark::State& state) {
  const Scene& s = scene();
  osteon::LpBasis basis;
  along_path(state,
             [&](const Pose& X) { return lp_depth(s.bone_body, s.probe_body, X, &basis).t <= 0; });
}
// Each query of the path by itself: of seven times along it the least, which leaves out interrupts.
// The clock's own time, tens of nanoseconds, is in the figures.
void osteon_depth_warm_each(benchmark::State& state) {
  using Clock = std::chrono::steady_clock;
  constexpr int kPasses = 7;
  const Scene& s = scene();
  std::vector<std::int64_t> least(s.path.size(), std::numeric_limits<std::int64_t>::max());
  for (auto _ : state)
    for (int pass = 0; pass < kPasses; ++pass) {
      osteon::LpBasis basis;
      for (std::size_t i = 0; i < s.path.size(); ++i) {
        const Clock::time_point before = Clock::now();
        benchmark::DoNotOptimize(lp_depth(s.bone_body, s.probe_body, s.path[i], &basis));
        const std::chrono::nanoseconds took = Clock::now() - before;
        least[i] = std::min<std::int64_t>(least[i], took.count());
      }
    }
  osteon::Percentiles each;
  for (const std::int64_t ns : least) each.add_ns(ns);
  state.counters["p50_ns"] = static_cast<double>(each.quantile_ns(0.5));
  state.counters["p99_ns"] = static_cast<double>(each.quantile_ns(0.99));
  state.counters["p999_ns"] = static_cast<double>(each.quantile_ns(0.999));
}

void osteon_test_cold(benchmark::State& state) {
  const Scene& s = scene();
  along_path(state, [&](const Pose& X) { return lp_test(s.bone_body, s.probe_body, X).hit; });
}
void osteon_test_warm(benchmark::State& state) {
  const Scene& s = scene();
  osteon::LpBasis basis;
  along_path(state,
             [&](const Pose& X) { return lp_test(s.bone_body, s.probe_body, X, &basis).hit; });
}

// The probe as a rod with round ends, and as a hook of three such.
void osteon_capsule(benchmark::State& state) {
  const Scene& s = scene();
  along_path(state, [&](const Pose& X) {
    const Vec3 half = X.q * Vec3(0, 0, kProbeHalf - 0.001);
    return capsule_contact(s.bone_body, {X.p - half, X.p + half, 0.001}).gap <= 0;
  });
}
void osteon_capsule_chain(benchmark::State& state) {
  const Scene& s = scene();
  along_path(state, [&](const Pose& X) {
    const std::array<Vec3, 4> hook = {X * Vec3(0, 0, 0.04), X * Vec3(0, 0, 0),
                                      X * Vec3(0.001, 0, -0.004), X * Vec3(0.003, 0, -0.005)};
    double gap = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i + 1 < hook.size(); ++i)
      gap = std::min(gap, capsule_contact(s.bone_body, {hook[i], hook[i + 1], 0.001}).gap);
    return gap <= 0;
  });
}

std::unique_ptr<btConvexHullShape> bullet_shape(const Hull& hull) {
  auto shape = std::make_unique<btConvexHullShape>();
  for (const Vec3& v : hull.vertices)
    shape->addPoint(btVector3(btScalar(v.x() * 1e3), btScalar(v.y() * 1e3), btScalar(v.z() * 1e3)),
                    false);
  shape->recalcLocalAabb();
  shape->setMargin(0);
  return shape;
}

class BulletPair {
 public:
  btPointCollector query(const Pose& X) {
    btGjkPairDetector::ClosestPointInput input;
    input.m_transformA.setIdentity();
    input.m_transformB.setOrigin(
        btVector3(btScalar(X.p.x() * 1e3), btScalar(X.p.y() * 1e3), btScalar(X.p.z() * 1e3)));
    input.m_transformB.setRotation(
        btQuaternion(btScalar(X.q.x()), btScalar(X.q.y()), btScalar(X.q.z()), btScalar(X.q.w())));
    btGjkPairDetector detector(a_.get(), b_.get(), &simplex_, &epa_);
    btPointCollector out;
    detector.getClosestPoints(input, out, nullptr);
    return out;
  }

 private:
  std::unique_ptr<btConvexHullShape> a_ = bullet_shape(scene().bone);
  std::unique_ptr<btConvexHullShape> b_ = bullet_shape(scene().probe);
  btVoronoiSimplexSolver simplex_;
  btGjkEpaPenetrationDepthSolver epa_;
};

void bullet_gjk_epa(benchmark::State& state) {
  BulletPair pair;
  along_path(state, [&](const Pose& X) {
    const btPointCollector out = pair.query(X);
    return out.m_hasResult && out.m_distance <= 0;
  });
}

struct Felt {
  double depth = 0;
  Vec3 normal = Vec3::Zero();
};

// How smooth an answer is: the probe slides 20 mm over the bone, 0.2 mm deep, a tenth of a
// micrometre a step; the largest change of depth and of the normal over one step.
template <class Query>
void along_stroke(benchmark::State& state, const Query& query) {
  constexpr double kStep = 1e-7, kDepth = 0.0002;
  double depth_jump = 0, turn = 0;
  for (auto _ : state) {
    Felt last;
    for (int i = 0; i < 200000; ++i) {
      const double angle = i * kStep / kBoneHalf.y();
      const Vec3 u(std::cos(angle) * 0.8, std::sin(angle) * 0.8, 0.6);
      const Vec3 n = u.cwiseQuotient(kBoneHalf).normalized();
      const Pose X{u.cwiseProduct(kBoneHalf) + (kProbeHalf - kDepth) * n,
                   osteon::turn_between(Vec3::UnitZ(), n)};
      const Felt felt = query(X);
      if (i > 0) {
        depth_jump = std::max(depth_jump, std::abs(felt.depth - last.depth));
        turn = std::max(turn, (felt.normal - last.normal).norm());
      }
      last = felt;
    }
  }
  state.counters["depth_um_per_um"] = depth_jump / kStep;
  state.counters["turn_deg"] = turn * 180 / M_PI;
}

void smooth_osteon_depth(benchmark::State& state) {
  osteon::LpBasis basis;
  along_stroke(state, [&](const Pose& X) {
    const auto d = lp_depth(scene().bone_body, scene().probe_body, X, &basis);
    return Felt{-d.t, d.nhat_AB_A};
  });
}
void smooth_osteon_gap(benchmark::State& state) {
  osteon::LpBasis basis;
  along_stroke(state, [&](const Pose& X) {
    const auto d = lp_depth(scene().bone_body, scene().probe_body, X, &basis);
    return Felt{-d.gap, d.nhat_AB_A};
  });
}
void smooth_bullet_epa(benchmark::State& state) {
  BulletPair pair;
  along_stroke(state, [&](const Pose& X) {
    const btPointCollector out = pair.query(X);
    const btVector3& n = out.m_normalOnBInWorld;
    return Felt{-1e-3 * double(out.m_distance), Vec3(n.x(), n.y(), n.z())};
  });
}

struct CcdBody {
  const Hull* hull;
  Pose X;
};

ccd_vec3_t to_ccd(const Vec3& v) {
  ccd_vec3_t out;
  ccdVec3Set(&out, CCD_REAL(v.x()), CCD_REAL(v.y()), CCD_REAL(v.z()));
  return out;
}

void ccd_support(const void* object, const ccd_vec3_t* direction, ccd_vec3_t* out) {
  const auto& body = *static_cast<const CcdBody*>(object);
  const Vec3 n =
      body.X.q.conjugate() * Vec3(ccdVec3X(direction), ccdVec3Y(direction), ccdVec3Z(direction));
  const Vec3* best = nullptr;
  double top = -1e300;
  for (const Vec3& v : body.hull->vertices)
    if (const double h = n.dot(v); h > top) {
      top = h;
      best = &v;
    }
  *out = to_ccd(1e3 * (body.X * *best));
}

void ccd_center(const void* object, ccd_vec3_t* out) {
  *out = to_ccd(1e3 * static_cast<const CcdBody*>(object)->X.p);
}

ccd_t ccd_settings() {
  ccd_t ccd;
  CCD_INIT(&ccd);
  ccd.support1 = ccd.support2 = ccd_support;
  ccd.center1 = ccd.center2 = ccd_center;
  ccd.max_iterations = 200;
  ccd.epa_tolerance = CCD_REAL(1e-4);
  ccd.mpr_tolerance = CCD_REAL(1e-4);
  return ccd;
}

template <class Solver>
void libccd(benchmark::State& state, const Solver& solver) {
  const ccd_t ccd = ccd_settings();
  const CcdBody a{&scene().bone, {}};
  along_path(state, [&](const Pose& X) {
    const CcdBody b{&scene().probe, X};
    ccd_real_t depth;
    ccd_vec3_t direction, position;
    return solver(&a, &b, &ccd, &depth, &direction, &position) == 0;
  });
}
void libccd_gjk_epa(benchmark::State& state) { libccd(state, ccdGJKPenetration); }
void libccd_mpr(benchmark::State& state) { libccd(state, ccdMPRPenetration); }

std::shared_ptr<fcl::Convexd> fcl_shape(const Hull& hull) {
  auto vertices = std::make_shared<std::vector<fcl::Vector3d>>();
  for (const Vec3& v : hull.vertices) vertices->push_back(1e3 * v);
  auto faces = std::make_shared<std::vector<int>>();
  for (const auto& t : hull.triangles)
    faces->insert(faces->end(),
                  {3, static_cast<int>(t[0]), static_cast<int>(t[1]), static_cast<int>(t[2])});
  return std::make_shared<fcl::Convexd>(vertices, static_cast<int>(hull.triangles.size()), faces);
}

void fcl_collide(benchmark::State& state) {
  const auto a = fcl_shape(scene().bone);
  const auto b = fcl_shape(scene().probe);
  fcl::CollisionRequestd request(1, true);
  request.gjk_solver_type = fcl::GJKSolverType::GST_LIBCCD;
  along_path(state, [&](const Pose& X) {
    fcl::Transform3d X_AB = fcl::Transform3d::Identity();
    X_AB.linear() = X.q.toRotationMatrix();
    X_AB.translation() = 1e3 * X.p;
    fcl::CollisionResultd result;
    return fcl::collide(a.get(), fcl::Transform3d::Identity(), b.get(), X_AB, request, result) > 0;
  });
}

BENCHMARK(osteon_depth_cold);
BENCHMARK(osteon_depth_warm);
BENCHMARK(osteon_depth_warm_each)->Iterations(1);
BENCHMARK(osteon_test_cold);
BENCHMARK(osteon_test_warm);
BENCHMARK(osteon_capsule);
BENCHMARK(osteon_capsule_chain);
BENCHMARK(bullet_gjk_epa);
BENCHMARK(libccd_gjk_epa);
BENCHMARK(libccd_mpr);
BENCHMARK(fcl_collide);
BENCHMARK(smooth_osteon_depth)->Iterations(1);
BENCHMARK(smooth_osteon_gap)->Iterations(1);
BENCHMARK(smooth_bullet_epa)->Iterations(1);

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> depth_peers = {"bullet_gjk_epa", "libccd_gjk_epa", "libccd_mpr",
                                                "fcl_collide",    "glpk_depth",     "clp_depth"};
  return osteon::bench::run(
      argc, argv, {{"osteon_depth_warm", depth_peers}, {"osteon_depth_cold", depth_peers}});
}
