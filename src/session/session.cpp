#include "osteon/session/session.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "bones_age.h"
#include "haptic_command.h"
#include "osteon/base/hash.h"

namespace osteon {
namespace {

// Everything of one thread stays on cache lines of its own.
constexpr std::size_t kCacheLine = 64;

struct alignas(kCacheLine) HapticHalf {
  HapticLoop loop;
  HapticParams params;
  BonesAge age;
  TickRecord record;

  // All that the next tick depends on, but for what it will consume.
  std::uint64_t hash() const {
    Hasher hasher;
    hasher.add(loop.state_hash());
    hasher.add(record.tick);
    hasher.add(age.step());
    hasher.add(age.first_tick());
    hasher.add(params.stiffness_n_per_m);
    hasher.add(params.friction_scale);
    hasher.add(static_cast<std::uint8_t>(params.force_on));
    // Only then, so that older recordings keep their hashes.
    if (params.grab_n_per_m > 0) hasher.add(params.grab_n_per_m);
    return hasher.value();
  }
};

struct alignas(kCacheLine) PhysicsHalf {
  BoneWorld world;
  StepRecord record;
};

PhysicsParams physics_of(const SessionSettings& settings) {
  PhysicsParams params = settings.physics;
  params.contact_n_per_m = std::max(params.contact_n_per_m, settings.haptic.stiffness_n_per_m);
  return params;
}

bool is_hold(const Command& command) {
  return command.kind == CommandKind::kHoldBones && command.value >= 0 && command.value <= 1;
}

}  // namespace

struct Session::Impl {
  Impl(std::shared_ptr<const Case> c, const SessionSettings& settings)
      : the_case(c),
        tool(std::make_shared<const Tool>(make_wrist_probe(settings.probe_radius_m))),
        haptic{HapticLoop(c, tool), settings.haptic, {}, {}},
        physics{BoneWorld(c, physics_of(settings)), {}},
        ticks_per_step(static_cast<std::uint64_t>(
            std::round(settings.physics.step_s / settings.haptic.tick_s))) {}

  std::shared_ptr<const Case> the_case;
  std::shared_ptr<const Tool> tool;
  HapticHalf haptic;
  PhysicsHalf physics;

  // For `tick` alone.
  std::uint64_t ticks_per_step;
  Command for_next_step;
  int last_steps = 0;
};

Session::Session(std::shared_ptr<const Case> the_case, const SessionSettings& settings) {
  assert(check_settings(settings));
  impl_ = std::make_unique<Impl>(std::move(the_case), settings);
}
Session::~Session() = default;
Session::Session(Session&&) noexcept = default;

const ToolState& Session::tick(const ToolInput& input, const Command& command) {
  const ToolState& tool = haptic_tick(input, impl_->physics.world.snapshot(), command);
  // Between two steps the newest command counts.
  if (command.kind == CommandKind::kHoldBones) impl_->for_next_step = command;
  impl_->last_steps = tool.tick % impl_->ticks_per_step == 0 ? 1 : 0;
  if (impl_->last_steps == 1) {
    (void)physics_step(tool, impl_->for_next_step);
    impl_->for_next_step = {};
  }
  return tool;
}

const ToolState& Session::haptic_tick(const ToolInput& input, const BoneSnapshot& bones,
                                      const Command& command) {
  HapticHalf& half = impl_->haptic;
  TickRecord& record = half.record;
  apply_command(command, half.params);
  ++record.tick;
  const double age_s = half.age.at(record.tick, bones.step, half.params.tick_s);
  const ToolState& tool = half.loop.tick(input, bones, age_s, half.params);
  assert(tool.tick == record.tick);
  record.input = input;
  record.bone_step = bones.step;
  record.command = command;
  record.force_W = tool.force_W;
  record.p_WP = tool.X_WP.p;
  record.status = tool.status;
  record.state_hash = 0;
  if (record.tick % kHashInterval == 0) {
    Hasher hasher;
    hasher.add(half.hash());
    hasher.add(hash_of(bones));
    record.state_hash = hasher.value();
  }
  return tool;
}

const BoneSnapshot& Session::physics_step(const ToolState& tool, const Command& command) {
  PhysicsHalf& half = impl_->physics;
  if (is_hold(command)) half.world.set_hold(command.value >= 0.5);
  const BoneSnapshot& bones = half.world.step(tool);
  half.record = {bones.step, tool.tick, command};
  return bones;
}

const TickRecord& Session::last_tick_record() const { return impl_->haptic.record; }
const StepRecord& Session::last_step_record() const { return impl_->physics.record; }
int Session::last_steps() const { return impl_->last_steps; }
const Case& Session::the_case() const { return *impl_->the_case; }
const Tool& Session::tool() const { return *impl_->tool; }
const BoneSnapshot& Session::bones() const { return impl_->physics.world.snapshot(); }

std::uint64_t Session::state_hash() const {
  Hasher hasher;
  hasher.add(impl_->haptic.hash());
  hasher.add(impl_->physics.world.state_hash());
  return hasher.value();
}

RecordingHeader recording_header(const Case& the_case, const SessionSettings& settings,
                                 const std::string& case_source,
                                 const std::string& osteon_version) {
  return {the_case.name, case_source,       the_case.hash,
          settings.seed, to_json(settings), osteon_version};
}

}  // namespace osteon
