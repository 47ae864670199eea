#include "loops/runtime.h"

#include <chrono>
#include <utility>

#include "loops/loop_clock.h"
#include "loops/stop_signal.h"
#include "osteon/base/check.h"
#include "osteon/base/clock.h"

namespace osteon {
namespace {
constexpr int kPriority = 1;
constexpr int kMemory = 2;
constexpr auto kDrainPause = std::chrono::milliseconds(20);

std::vector<HandPlan> one_hand(const RunPlan& plan, std::unique_ptr<HapticDevice> device) {
  std::vector<HandPlan> hands;
  hands.push_back({std::move(device), plan.mapping, plan.mapping_settings, plan.force_enabled,
                   plan.off_because, true});
  return hands;
}

std::vector<std::unique_ptr<LoopExchange>> make_exchanges(const Session& session) {
  std::vector<std::unique_ptr<LoopExchange>> exchanges;
  for (std::size_t h = 0; h < session.hands(); ++h)
    exchanges.push_back(std::make_unique<LoopExchange>(session.bones()));
  return exchanges;
}

std::vector<LoopExchange*> pointers(const std::vector<std::unique_ptr<LoopExchange>>& exchanges) {
  std::vector<LoopExchange*> out;
  for (const auto& exchange : exchanges) out.push_back(exchange.get());
  return out;
}

}  // namespace

Runtime::Hand::Hand(Session& session, HandPlan&& plan, LoopExchange& own,
                    const HapticStageOptions& options, RecordFeed* feed, StateKeeper* keeper)
    : device(std::move(plan.device)),
      exchange(own),
      stage(session, *device, options, own, feed, keeper) {
  if (plan.force_enabled) exchange.to_gate.push(GateWish::kEnable);
}

Runtime::Runtime(const RunPlan& plan, std::unique_ptr<HapticDevice> device,
                 std::unique_ptr<RecordFeed> feed)
    : Runtime(plan, one_hand(plan, std::move(device)), std::move(feed)) {}

Runtime::Runtime(const RunPlan& plan, std::vector<HandPlan> hands, std::unique_ptr<RecordFeed> feed,
                 Tray tray)
    : Runtime(plan, std::move(hands), std::move(feed),
              Session(plan.the_case, plan.settings, std::move(tray), plan.carving, plan.softs)) {}

Runtime::Runtime(const RunPlan& plan, std::vector<HandPlan> hands, std::unique_ptr<RecordFeed> feed,
                 Session begun)
    : session_(std::move(begun)),
      feed_(std::move(feed)),
      keeper_(feed_ ? std::make_unique<StateKeeper>(session_) : nullptr),
      haptic_period_s_(plan.settings.haptic.tick_s),
      physics_period_s_(plan.settings.physics.step_s),
      exchanges_(make_exchanges(session_)),
      physics_(session_, pointers(exchanges_), feed_.get(), keeper_.get()) {
  demand(hands.size() == session_.hands(), "a run needs one device for each hand in its settings");
  tell_begun();
  make_hands(plan, std::move(hands));
}

// What each loop would have told of the ticks and steps that were done before.
void Runtime::tell_begun() {
  for (std::size_t h = 0; h < session_.hands(); ++h) {
    const ToolState& tool = session_.tool_state(h);
    if (tool.tick == 0) continue;
    LoopExchange& own = *exchanges_[h];
    own.tool_to_physics.publish(tool);
    own.to_window.publish(RenderSnapshot{session_.bones(), tool});
    for (std::size_t other = 0; other < session_.hands(); ++other)
      if (other != h) own.tool_to_hands[other].publish(seen_from_outside(tool));
  }
}

void Runtime::make_hands(const RunPlan& plan, std::vector<HandPlan>&& hands) {
  for (std::size_t h = 0; h < hands.size(); ++h) {
    HapticStageOptions options;
    options.mapping = hands[h].mapping;
    options.user = sane(hands[h].mapping_settings);
    options.safety = plan.safety;
    options.tick_s = haptic_period_s_;
    options.off_because = hands[h].off_because;
    options.freezes = hands[h].freezes;
    options.hand = h;
    for (std::size_t other = 0; other < hands.size(); ++other)
      if (other != h) options.others[other] = exchanges_[other].get();
    hands_.push_back(std::make_unique<Hand>(session_, std::move(hands[h]), *exchanges_[h], options,
                                            feed_.get(), keeper_.get()));
  }
}

Runtime::~Runtime() {
  (void)stop();
  for (const auto& hand : hands_)
    if (hand->device) hand->device->close();
}

void Runtime::start() {
  if (running_.exchange(true)) return;
  for (const auto& hand : hands_)
    hand->thread = std::thread([this, &hand = *hand] { run_haptic(hand); });
  physics_thread_ = std::thread([this] { run_physics(); });
  if (feed_) writer_thread_ = std::thread([this] { run_writer(); });
}

Result<void> Runtime::stop() {
  running_.store(false);
  for (const auto& hand : hands_)
    if (hand->thread.joinable()) hand->thread.join();
  for (std::thread* thread : {&physics_thread_, &writer_thread_})
    if (thread->joinable()) thread->join();
  for (const auto& hand : hands_)
    if (hand->device) hand->stage.force_to_zero();
  if (!feed_ || closed_) return {};
  closed_ = true;
  return feed_->finish();
}

std::unique_ptr<HapticDevice> Runtime::take_device(std::size_t hand) {
  return std::move(hands_[hand]->device);
}

bool Runtime::send(const Command& command, std::size_t hand) {
  bool sent = true;
  if (is_for_physics(command.kind)) sent = exchange(0).to_physics.push(command);
  if (is_for_physics_alone(command.kind)) return sent;
  if (!is_for_physics(command.kind)) return exchange(hand).to_haptic.push(command);
  for (const auto& each : exchanges_) sent = each->to_haptic.push(command) && sent;
  return sent;
}

void Runtime::judge_ticks() {
  for (const auto& each : exchanges_) each->judging.store(true, std::memory_order_relaxed);
}

void Runtime::set_force_enabled(bool enabled) {
  for (std::size_t h = 0; h < hands(); ++h) set_force_enabled(enabled, h);
}

void Runtime::set_force_enabled(bool enabled, std::size_t hand) {
  exchange(hand).to_gate.push(enabled ? GateWish::kEnable : GateWish::kDisable);
}

void Runtime::drain_records_once() {
  if (!feed_) return;
  feed_->drain();
  if (const auto state = keeper_->take()) feed_->add(*state);
}

std::string Runtime::recording_failure() const {
  return feed_ ? feed_->early_end() : std::string();
}

std::string Runtime::realtime_warning() const {
  int all = kPriority | kMemory;
  for (const auto& hand : hands_) {
    const int grant = hand->grant.load();
    if (grant < 0) return {};
    all &= grant;
  }
  return describe_grant((all & kPriority) != 0, (all & kMemory) != 0).warning;
}

void Runtime::run_haptic(Hand& hand) {
  const LoopToEnd until_closed;
  const bool memory = lock_memory();
  const bool priority = request_priority();
  hand.grant.store((priority ? kPriority : 0) | (memory ? kMemory : 0));
  LoopClock clock(haptic_period_s_);
  std::int64_t last_ns = steady_now_ns();
  while (running_.load(std::memory_order_relaxed) && !stop_requested()) {
    clock.wait();
    const std::int64_t now_ns = steady_now_ns();
    hand.stage.step(static_cast<double>(now_ns - last_ns) * 1e-9);
    last_ns = now_ns;
    if (clock.tick_done()) hand.exchange.haptic_stats.publish(clock.stats());
  }
  hand.stage.force_to_zero();
  // The program is ending and nobody may be left to do it.
  if (stop_requested()) hand.device->close();
}

void Runtime::run_physics() {
  // The watchdog ends the force when the bones are old: other programs must not make them so. No
  // real-time priority: where physics is too slow, it would take the haptic loop's time as well.
  (void)request_early_turns();
  LoopClock clock(physics_period_s_);
  while (running_.load(std::memory_order_relaxed)) {
    clock.wait();
    physics_.step();
    if (clock.tick_done()) exchange(0).physics_stats.publish(clock.stats());
  }
}

void Runtime::run_writer() {
  while (running_.load(std::memory_order_relaxed)) {
    if (feed_->drain() == 0) std::this_thread::sleep_for(kDrainPause);
    if (const auto state = keeper_->take()) feed_->add(*state);
  }
}

}  // namespace osteon
