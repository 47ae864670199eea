#pragma once

#include <memory>
#include <span>

#include "osteon/physics/bone_world.h"
#include "osteon/record/recording.h"
#include "osteon/session/session.h"

namespace osteon {

/// The physics of a session, on cache lines of its own: it has a thread.
class alignas(64) WorldHalf {
 public:
  WorldHalf(std::shared_ptr<const Case> the_case, const SessionSettings& settings);

  const BoneSnapshot& step(std::span<const ToolState* const> tools, const Command& command);
  const BoneSnapshot& bones() const { return world_.snapshot(); }
  const StepRecord& record() const { return record_; }
  std::uint64_t hash() const;
  void save(WorldState& into) const;
  void restore(const WorldState& from);

 private:
  void obey(const Command& command);
  void keep(std::uint32_t mark);

  BoneWorld world_;
  std::uint64_t keep_every_;  ///< steps
  std::array<WorldMark, kMaxMarks> marks_{};
  std::array<std::uint64_t, kMaxMarks> mark_hashes_{};
  StepRecord record_;
};

}  // namespace osteon
