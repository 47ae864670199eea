#pragma once

#include "loops/loop_exchange.h"
#include "osteon/session/session.h"

namespace osteon {

class RecordFeed;

/// What the physics loop does once a step, without thread or clock: the world's step under the
/// newest tool, record, publish.
class PhysicsStage {
 public:
  /// All must outlive the stage; `feed` may be null (no recording).
  PhysicsStage(Session& session, LoopExchange& exchange, RecordFeed* feed);
  void step();

 private:
  Session& session_;
  LoopExchange& exchange_;
  RecordFeed* feed_;
};

}  // namespace osteon
