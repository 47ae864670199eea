#include "loops/runtime.h"

#include <chrono>

#include "loops/loop_clock.h"
#include "loops/stop_signal.h"
#include "osteon/base/clock.h"

namespace osteon {
namespace {
constexpr int kPriority = 1;
constexpr int kMemory = 2;
constexpr auto kDrainPause = std::chrono::milliseconds(20);
}  // namespace

Runtime::Runtime(const RunPlan& plan, std::unique_ptr<HapticDevice> device,
                 std::unique_ptr<RecordFeed> feed)
    : session_(plan.the_case, plan.settings),
      device_(std::move(device)),
      feed_(std::move(feed)),
      haptic_period_s_(plan.settings.haptic.tick_s),
      physics_period_s_(plan.settings.physics.step_s),
      exchange_(session_.bones()),
      haptic_(session_, *device_,
              {plan.mapping, sane(plan.mapping_settings), plan.safety, haptic_period_s_,
               plan.off_because},
              exchange_, feed_.get()),
      physics_(session_, exchange_, feed_.get()) {
  if (plan.force_enabled) exchange_.to_gate.push(GateWish::kEnable);
}

Runtime::~Runtime() {
  (void)stop();
  if (device_) device_->close();
}

void Runtime::start() {
  if (running_.exchange(true)) return;
  haptic_thread_ = std::thread([this] { run_haptic(); });
  physics_thread_ = std::thread([this] { run_physics(); });
  if (feed_) writer_thread_ = std::thread([this] { run_writer(); });
}

Result<void> Runtime::stop() {
  running_.store(false);
  for (std::thread* thread : {&haptic_thread_, &physics_thread_, &writer_thread_})
    if (thread->joinable()) thread->join();
  if (device_) haptic_.force_to_zero();
  if (!feed_ || closed_) return {};
  closed_ = true;
  return feed_->finish();
}

std::unique_ptr<HapticDevice> Runtime::take_device() { return std::move(device_); }

bool Runtime::send(const Command& command) {
  const bool for_physics = command.kind == CommandKind::kHoldBones;
  return for_physics ? exchange_.to_physics.push(command) : exchange_.to_haptic.push(command);
}

void Runtime::set_force_enabled(bool enabled) {
  exchange_.to_gate.push(enabled ? GateWish::kEnable : GateWish::kDisable);
}

std::string Runtime::recording_failure() const {
  return feed_ ? feed_->early_end() : std::string();
}

std::string Runtime::realtime_warning() const {
  const int grant = grant_.load();
  if (grant < 0) return {};
  return describe_grant((grant & kPriority) != 0, (grant & kMemory) != 0).warning;
}

void Runtime::run_haptic() {
  const LoopToEnd until_closed;
  const bool memory = lock_memory();
  const bool priority = request_priority();
  grant_.store((priority ? kPriority : 0) | (memory ? kMemory : 0));
  LoopClock clock(haptic_period_s_);
  std::int64_t last_ns = steady_now_ns();
  while (running_.load(std::memory_order_relaxed) && !stop_requested()) {
    clock.wait();
    const std::int64_t now_ns = steady_now_ns();
    haptic_.step(static_cast<double>(now_ns - last_ns) * 1e-9);
    last_ns = now_ns;
    if (clock.tick_done()) exchange_.haptic_stats.publish(clock.stats());
  }
  haptic_.force_to_zero();
  // The program is ending and nobody may be left to do it.
  if (stop_requested()) device_->close();
}

void Runtime::run_physics() {
  // The watchdog ends the force when the bones are old: other programs must not make them so. No
  // real-time priority: where physics is too slow, it would take the haptic loop's time as well.
  (void)request_early_turns();
  LoopClock clock(physics_period_s_);
  while (running_.load(std::memory_order_relaxed)) {
    clock.wait();
    physics_.step();
    if (clock.tick_done()) exchange_.physics_stats.publish(clock.stats());
  }
}

void Runtime::run_writer() {
  while (running_.load(std::memory_order_relaxed))
    if (feed_->drain() == 0) std::this_thread::sleep_for(kDrainPause);
}

}  // namespace osteon
