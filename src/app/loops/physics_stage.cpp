#include "loops/physics_stage.h"

#include "loops/record_feed.h"

namespace osteon {

PhysicsStage::PhysicsStage(Session& session, LoopExchange& exchange, RecordFeed* feed)
    : session_(session), exchange_(exchange), feed_(feed) {}

void PhysicsStage::step() {
  Command command;
  exchange_.to_physics.pop(command);
  const BoneSnapshot& bones = session_.physics_step(exchange_.tool_to_physics.read(), command);
  // Recorded before it is published: a tick that consumes it finds its record already there.
  if (feed_) feed_->push(session_.last_step_record());
  exchange_.bones_to_haptic.publish(bones);
}

}  // namespace osteon
