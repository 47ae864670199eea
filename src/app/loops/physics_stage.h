#pragma once

#include <span>
#include <vector>

#include "loops/loop_exchange.h"
#include "osteon/session/session.h"

namespace osteon {

class RecordFeed;
class StateKeeper;

/// What the physics loop does once a step, without thread or clock: the world's step under the
/// newest tool, record, publish.
class PhysicsStage {
 public:
  /// All must outlive the stage; `feed` and `keeper` may be null (no recording). One exchange for
  /// each hand of the session.
  PhysicsStage(Session& session, std::span<LoopExchange* const> hands, RecordFeed* feed,
               StateKeeper* keeper = nullptr);
  PhysicsStage(Session& session, LoopExchange& exchange, RecordFeed* feed);
  void step();

 private:
  Session& session_;
  std::vector<LoopExchange*> hands_;
  RecordFeed* feed_;
  StateKeeper* keeper_ = nullptr;
};

}  // namespace osteon
