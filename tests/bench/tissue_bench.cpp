// Soft bodies: what a step of an element costs, beside Bullet's deformable body on the same box of
// tissue (six tetrahedra a cube, neo-Hookean, explicit and implicit, without contact) in the same
// run.
//   element_steps_per_s   elements times steps a second, one core
#include <BulletSoftBody/btDeformableBodySolver.h>
#include <BulletSoftBody/btDeformableMultiBodyDynamicsWorld.h>
#include <BulletSoftBody/btDeformableNeoHookeanForce.h>
#include <BulletSoftBody/btSoftBodyHelpers.h>
#include <BulletSoftBody/btSoftBodyRigidBodyCollisionConfiguration.h>
#include <benchmark/benchmark.h>
#include <btBulletDynamicsCommon.h>

#include <memory>
#include <stdexcept>

#include "osteon/tissue/hex_solid.h"
#include "osteon/tissue/tet_solid.h"

namespace {

using namespace osteon;

constexpr SolidMaterial kFat{3000, 0.45, 1000, 5};

HexGrid box(std::int64_t cells) {
  const auto n = static_cast<std::uint32_t>(cells);
  return {{2 * n, n, n}, 0.003, Vec3::Zero()};
}

void count(benchmark::State& state, std::size_t elements) {
  state.counters["elements"] = static_cast<double>(elements);
  state.counters["element_steps_per_s"] = benchmark::Counter(
      static_cast<double>(elements), benchmark::Counter::kIsIterationInvariantRate);
}

// One face held, gravity on, already bent.
void hexahedra(benchmark::State& state) {
  HexSolidDef def;
  def.grid = box(state.range(0));
  def.material = kFat;
  const auto made = make_hex_solid(def);
  if (!made) throw std::runtime_error(made.error().message());
  const HexSolid& solid = *made;
  Supports supports;
  supports.gravity_m_per_s2 = {0, 0, -9.81};
  supports.entries = 1;
  for (const std::uint32_t s : solid.nodes)
    if (solid.place(s)[0] == 0)
      for (std::uint32_t k = 0; k < 3; ++k) supports.held.push_back({s, k, 0, 0, 0});
  SolidState at = rest_state(solid);
  HexScratch scratch;
  const double dt = stable_step_s(solid);
  for (int n = 0; n < 50; ++n) step(solid, supports, dt, at, scratch);
  for (auto _ : state) step(solid, supports, dt, at, scratch);
  count(state, solid.elements);
}

// An implicit step of a bent corotated block of linear tetrahedra.
void corotated_tetrahedra(benchmark::State& state) {
  TetSolidDef def;
  def.mesh = split_into_tetrahedra(box(state.range(0)));
  def.material = {1e6, 0.45, 1100, 5};
  def.order = TetOrder::kLinear;
  def.corotated = true;
  const auto made = make_tet_solid(def);
  if (!made) throw std::runtime_error(made.error().message());
  Supports supports;
  supports.gravity_m_per_s2 = {0, 0, -9.81};
  supports.entries = 1;
  for (std::uint32_t i = 0; i < made->rest_W.size(); ++i)
    for (std::uint32_t k = 0; k < 3; ++k)
      if (made->rest_W[i].x() < 1e-9) supports.held.push_back({i, k, 0, 0, 0});
  const TetStepper stepper(*made, supports, 0.002);
  SolidState at = stepper.rest_state();
  for (auto _ : state)
    if (!stepper.step(at)) throw std::runtime_error("no balance");
  count(state, made->elements.size());
}

// Bullet's soft body of tetrahedra in its deformable world, without contact.
struct BulletBox {
  btSoftBodyRigidBodyCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  btDbvtBroadphase broadphase;
  btDeformableBodySolver* deformable = new btDeformableBodySolver;
  btDeformableMultiBodyConstraintSolver solver;
  std::unique_ptr<btDeformableMultiBodyDynamicsWorld> world;
  std::unique_ptr<btDeformableNeoHookeanForce> force;
  btSoftBody* body = nullptr;

  explicit BulletBox(const HexGrid& grid, bool implicit) {
    solver.setDeformableSolver(deformable);
    world = std::make_unique<btDeformableMultiBodyDynamicsWorld>(&dispatcher, &broadphase, &solver,
                                                                 &configuration, deformable);
    world->setGravity(btVector3(0, 0, -9.81));
    world->getWorldInfo().m_gravity.setValue(0, 0, -9.81);
    world->setImplicit(implicit);
    const TetMesh mesh = split_into_tetrahedra(grid);
    std::vector<btVector3> points;
    for (const Vec3& p : mesh.vertices) points.emplace_back(p.x(), p.y(), p.z());
    body = new btSoftBody(&world->getWorldInfo(), static_cast<int>(points.size()), points.data(),
                          nullptr);
    for (const Tetrahedron& t : mesh.tets)
      body->appendTetra(static_cast<int>(t[0]), static_cast<int>(t[1]), static_cast<int>(t[2]),
                        static_cast<int>(t[3]));
    body->setTotalMass(1000 * 27e-9 * grid.cells[0] * grid.cells[1] * grid.cells[2]);
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
      if (mesh.vertices[i].x() < 1e-9) body->setMass(static_cast<int>(i), 0);
    btSoftBodyHelpers::generateBoundaryFaces(body);
    body->m_cfg.collisions = 0;
    body->initializeDmInverse();
    body->m_tetraScratches.resize(body->m_tetras.size());
    body->m_tetraScratchesTn.resize(body->m_tetras.size());
    world->addSoftBody(body);
    const double mu = shear_modulus_pa(kFat);
    force = std::make_unique<btDeformableNeoHookeanForce>(mu, bulk_modulus_pa(kFat) - 2.0 / 3 * mu,
                                                          0.01);
    world->addForce(body, force.get());
  }
  ~BulletBox() {
    world->removeForce(body, force.get());
    world->removeSoftBody(body);
    delete body;
    world.reset();
    delete deformable;
  }
};

void bullet_deformable(benchmark::State& state, bool implicit) {
  const HexGrid grid = box(state.range(0));
  BulletBox bullet(grid, implicit);
  const double dt = implicit ? 0.002 : 1e-4;
  for (auto _ : state) bullet.world->stepSimulation(dt, 1, dt);
  count(state, 6ull * grid.cells[0] * grid.cells[1] * grid.cells[2]);
}

void bullet_explicit_tetrahedra(benchmark::State& state) { bullet_deformable(state, false); }
void bullet_implicit_tetrahedra(benchmark::State& state) { bullet_deformable(state, true); }

BENCHMARK(hexahedra)->Arg(8)->Arg(16)->Arg(22)->Unit(benchmark::kMicrosecond);
BENCHMARK(corotated_tetrahedra)->Arg(5)->Unit(benchmark::kMicrosecond);
BENCHMARK(bullet_explicit_tetrahedra)->Arg(5)->Arg(16)->Unit(benchmark::kMicrosecond);
BENCHMARK(bullet_implicit_tetrahedra)->Arg(5)->Unit(benchmark::kMicrosecond);

}  // namespace
