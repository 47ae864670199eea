#pragma once

// Bullet's deformable body on the box of tissue that our solvers step. In the precision that the
// program which includes this is built with: both builds of Bullet cannot be in one program.
#include <BulletSoftBody/btDeformableBodySolver.h>
#include <BulletSoftBody/btDeformableMultiBodyDynamicsWorld.h>
#include <BulletSoftBody/btDeformableNeoHookeanForce.h>
#include <BulletSoftBody/btSoftBodyHelpers.h>
#include <BulletSoftBody/btSoftBodyRigidBodyCollisionConfiguration.h>
#include <benchmark/benchmark.h>
#include <btBulletDynamicsCommon.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "osteon/tissue/tet_solid.h"

namespace osteon::bench {

inline constexpr SolidMaterial kFat{3000, 0.45, 1000, 5};

inline HexGrid tissue_box(std::int64_t cells) {
  const auto n = static_cast<std::uint32_t>(cells);
  return {{2 * n, n, n}, 0.003, Vec3::Zero()};
}

inline void count(benchmark::State& state, std::size_t elements) {
  state.counters["elements"] = static_cast<double>(elements);
  state.counters["element_steps_per_s"] = benchmark::Counter(
      static_cast<double>(elements), benchmark::Counter::kIsIterationInvariantRate);
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

inline void bullet_deformable(benchmark::State& state, bool implicit) {
  const HexGrid grid = tissue_box(state.range(0));
  BulletBox bullet(grid, implicit);
  const double dt = implicit ? 0.002 : 1e-4;
  for (auto _ : state) bullet.world->stepSimulation(dt, 1, dt);
  count(state, 6ull * grid.cells[0] * grid.cells[1] * grid.cells[2]);
}

}  // namespace osteon::bench
