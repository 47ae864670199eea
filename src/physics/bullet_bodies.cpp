#include "bullet_bodies.h"

#include <btBulletDynamicsCommon.h>

#include <vector>

namespace osteon {
namespace {

btVector3 to_bullet(const Vec3& v) {
  return {static_cast<btScalar>(v.x()), static_cast<btScalar>(v.y()), static_cast<btScalar>(v.z())};
}

btTransform to_bullet(const Pose& X) {
  const btQuaternion q(static_cast<btScalar>(X.q.x()), static_cast<btScalar>(X.q.y()),
                       static_cast<btScalar>(X.q.z()), static_cast<btScalar>(X.q.w()));
  return btTransform(q, to_bullet(X.p));
}

Pose from_bullet(const btTransform& X) {
  const btQuaternion q = X.getRotation();
  const btVector3& p = X.getOrigin();
  return {Vec3(p.x(), p.y(), p.z()), Quat(q.w(), q.x(), q.y(), q.z()).normalized()};
}

}  // namespace

struct BulletBodies::Impl {
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  btDbvtBroadphase broad_phase;
  btSequentialImpulseConstraintSolver solver;
  btDiscreteDynamicsWorld world{&dispatcher, &broad_phase, &solver, &configuration};
  std::vector<std::unique_ptr<btBoxShape>> shapes;
  std::vector<std::unique_ptr<btRigidBody>> bodies;

  Impl() { world.setGravity(btVector3(0, 0, 0)); }
  ~Impl() {
    for (const auto& body : bodies) world.removeRigidBody(body.get());
  }
};

BulletBodies::BulletBodies() : impl_(std::make_unique<Impl>()) {}
BulletBodies::~BulletBodies() = default;
BulletBodies::BulletBodies(BulletBodies&&) noexcept = default;

void BulletBodies::add(const MassProperties& mass, const Vec3& half_extent) {
  impl_->shapes.push_back(std::make_unique<btBoxShape>(to_bullet(half_extent)));
  btRigidBody::btRigidBodyConstructionInfo info(static_cast<btScalar>(mass.mass_kg), nullptr,
                                                impl_->shapes.back().get(),
                                                to_bullet(mass.moments));
  auto body = std::make_unique<btRigidBody>(info);
  // A body at rest must feel the next push.
  body->setActivationState(DISABLE_DEACTIVATION);
  body->setFlags(0);
  // Group and mask 0: springs hold the bones in their places, not each other.
  impl_->world.addRigidBody(body.get(), 0, 0);
  impl_->bodies.push_back(std::move(body));
}

void BulletBodies::set(std::size_t body, const Pose& X_WI, const Vec3& v_W, const Vec3& w_W) {
  btRigidBody& b = *impl_->bodies[body];
  b.setCenterOfMassTransform(to_bullet(X_WI));
  b.setLinearVelocity(to_bullet(v_W));
  b.setAngularVelocity(to_bullet(w_W));
}

void BulletBodies::advance(double dt_s) {
  constexpr int kNoSubsteps = 0;  // one step of exactly dt_s
  impl_->world.stepSimulation(static_cast<btScalar>(dt_s), kNoSubsteps);
}

Pose BulletBodies::pose(std::size_t body) const {
  return from_bullet(impl_->bodies[body]->getWorldTransform());
}

}  // namespace osteon
