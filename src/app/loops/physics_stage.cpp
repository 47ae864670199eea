#include "loops/physics_stage.h"

#include <array>

#include "loops/record_feed.h"
#include "loops/state_keeper.h"
#include "osteon/physics/soft_world.h"

namespace osteon {

PhysicsStage::PhysicsStage(Session& session, std::span<LoopExchange* const> hands, RecordFeed* feed,
                           StateKeeper* keeper)
    : session_(session), hands_(hands.begin(), hands.end()), feed_(feed), keeper_(keeper) {}

PhysicsStage::PhysicsStage(Session& session, LoopExchange& exchange, RecordFeed* feed)
    : session_(session), hands_{&exchange}, feed_(feed) {}

void PhysicsStage::step() {
  Command command;
  hands_.front()->to_physics.pop(command);
  std::array<const ToolState*, kMaxHands> tools{};
  for (std::size_t h = 0; h < hands_.size(); ++h) tools[h] = &hands_[h]->tool_to_physics.read();
  const BoneSnapshot& bones = session_.physics_step(std::span(tools).first(hands_.size()), command);
  if (keeper_ && bones.saved_step == bones.step) keeper_->keep_world(session_);
  // Recorded before it is published: a tick that consumes it finds its record already there.
  if (feed_) feed_->push(session_.last_step_record());
  if (const SoftWorld* softs = session_.softs())
    hands_.front()->pushes_to_window.publish(softs->pushes());
  // A hand that cannot know yet what was cut goes on with the snapshot it has.
  for (std::size_t h = 0; h < hands_.size(); ++h)
    if (session_.told(h)) hands_[h]->bones_to_haptic.publish(bones);
}

}  // namespace osteon
