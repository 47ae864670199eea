#include "loops/haptic_stage.h"

#include <algorithm>

#include "loops/record_feed.h"
#include "loops/state_keeper.h"
#include "osteon/scene/tool_moment.h"

namespace osteon {
namespace {

// A window that has stopped drawing can tell nothing of a pedal any more.
constexpr double kOldestPedal_s = 0.25;
// A stall of this loop says nothing of the other's: one long tick counts no more than this.
constexpr double kLongestCountedTick_s = 0.002;
constexpr std::uint64_t kHealthTicks = 16 * kTelemetryTicks;

bool is_usable(const DeviceSample& sample) {
  return sample.connected && is_finite(sample.X_VD) && is_finite(sample.v_V) &&
         is_finite(sample.w_V);
}

}  // namespace

HapticStage::HapticStage(Session& session, HapticDevice& device, const HapticStageOptions& options,
                         LoopExchange& exchange, RecordFeed* feed, StateKeeper* keeper)
    : session_(session),
      device_(device),
      options_(options),
      exchange_(exchange),
      feed_(feed),
      keeper_(keeper),
      mapping_(options.mapping, options.user),
      assist_(options.user),
      gate_(device.info(), options.safety, options.off_because),
      freeze_(std::max(options.safety.ramp_in_s, options.tick_s)) {
  last_good_.X_WD = options.mapping.to_world(Pose{});
}

void HapticStage::step(double dt_s) {
  obey_gate_wishes();
  DeviceSample sample = device_.read();
  obey_hand_wishes(sample, dt_s);
  const ToolInput device_input = read_input(sample);
  const ToolInput input =
      freeze_.input(device_input, options_.freezes && has_fault(), options_.tick_s);
  // The tools before the bones: see Session.
  const OtherTools others = read_others();
  bool fresh = false;
  const BoneSnapshot& bones = exchange_.bones_to_haptic.read(&fresh);
  if (keeper_) keeper_->keep_hand(session_, options_.hand, bones.saved_step, others);

  const ToolState& tool = session_.haptic_tick(options_.hand, input, bones, others, next_command());
  touching_ = tool.contact_count > 0;
  if (mapping_.released()) gate_.ramp_in_again();
  ramp_after_fade(tool);
  const double age_s = bones_age(fresh, dt_s);
  DeviceWrench wrench = wanted(tool);
  wrench.force_V += mapping_.force_to_device(guidance(tool, dt_s));
  const DeviceWrench given =
      gate_.filter(wrench, sample, age_s, dt_s, assist_.force(sample.v_V, dt_s));
  give(over_ ? DeviceWrench{} : given);

  note_fault();
  if (feed_)
    feed_->push(options_.hand, session_.last_tick_record(options_.hand),
                session_.last_events(options_.hand));
  publish(tool, bones);
}

OtherTools HapticStage::read_others() {
  OtherTools others{};
  for (std::size_t h = 0; h < kMaxHands; ++h)
    if (options_.others[h]) others[h] = options_.others[h]->tool_to_hands[options_.hand].read();
  return others;
}

// A fault comes before what the user wishes, which waits for the next tick.
Command HapticStage::next_command() {
  Command command;
  if (fault_to_tell_)
    command = {CommandKind::kFault, static_cast<double>(told_)};
  else
    exchange_.to_haptic.pop(command);
  fault_to_tell_ = false;
  return command;
}

// The force has gone to zero for a change of instrument or state: it comes back as after a fault.
void HapticStage::ramp_after_fade(const ToolState& tool) {
  const bool fading = (tool.status & kTickFading) != 0;
  if (fading_ && !fading) gate_.ramp_in_again();
  fading_ = fading;
}

// What the user wishes off is no fault.
bool HapticStage::has_fault() const {
  return gate_.cause() != ForceOff::kNone && gate_.cause() != ForceOff::kSoftware;
}

void HapticStage::note_fault() {
  const ForceOff cause = gate_.cause();
  if (cause == told_) return;
  told_ = cause;
  fault_to_tell_ = has_fault();
}

void HapticStage::force_to_zero() {
  over_ = true;
  gate_.disable(ForceOff::kSoftware);
  device_.write({});
}

// The stylus' origin stands for the tool's: about it the torque does the work of a turn there, so
// that what the device gives and what the contacts store is one account.
DeviceWrench HapticStage::wanted(const ToolState& tool) const {
  DeviceWrench wrench{mapping_.force_to_device(tool.force_W), Vec3::Zero()};
  if (device_.info().drives_rotation())
    wrench.torque_V = mapping_.force_to_device(moment_about(tool.X_WP.p, tool, session_.portals()));
  return wrench;
}

// A window that has stopped drawing leads nobody any more. The session knows nothing of it: what
// the hand does because of it is in its input.
Vec3 HapticStage::guidance(const ToolState& tool, double dt_s) {
  const bool leads = wishes_.guide.on && wishes_age_s_ < kOldestPedal_s;
  const double counted_s = std::min(dt_s, kLongestCountedTick_s);
  const Vec3 force_W = guide_.force_W(leads ? wishes_.guide : GuideLine{}, tool.X_WD.p, counted_s);
  if (leads && gate_.enabled() && force_W.squaredNorm() > 0) status_.guided_s += counted_s;
  return force_W;
}

void HapticStage::give(const DeviceWrench& wrench) {
  status_.force_at_hand_V = wrench.force_V;
  status_.torque_at_hand_V = wrench.torque_V;
  device_.write(wrench);
}

void HapticStage::obey_gate_wishes() {
  GateWish wish{};
  while (exchange_.to_gate.pop(wish)) {
    if (wish == GateWish::kEnable)
      gate_.enable();
    else if (wish == GateWish::kCalibrate)
      device_.calibrate();
    else
      gate_.disable(ForceOff::kSoftware);
  }
}

// Pedals and view, from the window. In contact the axes stay: turning them would drag the tool.
void HapticStage::obey_hand_wishes(DeviceSample& sample, double dt_s) {
  bool fresh = false;
  wishes_ = exchange_.hand_wishes.read(&fresh);
  wishes_age_s_ = fresh ? 0 : wishes_age_s_ + std::min(dt_s, kLongestCountedTick_s);
  if (wishes_.has_dead_man && !(wishes_.dead_man_held && wishes_age_s_ < kOldestPedal_s))
    sample.dead_man_held = false;
  status_.dead_man_held = sample.dead_man_held;
  if (fresh && wishes_.turn_axes && !touching_) mapping_.align(wishes_.q_WV);
}

// An unusable reading holds the hand where it was last seen, at rest, so that neither the proxy nor
// the recording ever sees it; the gate trips at once and says why.
ToolInput HapticStage::read_input(const DeviceSample& sample) {
  if (!is_usable(sample)) {
    ++status_.bad_samples;
    gate_.disable(sample.connected ? ForceOff::kNotFinite : ForceOff::kDisconnect);
    last_good_.v_W.setZero();
    last_good_.w_W.setZero();
    return last_good_;
  }
  last_good_ = mapping_.to_world(sample, wishes_.clutch);
  return last_good_;
}

// The force is this tick's own, but the bones that it meets are as old as the physics left them.
double HapticStage::bones_age(bool fresh, double dt_s) {
  bones_age_s_ = fresh ? 0 : bones_age_s_ + std::min(dt_s, kLongestCountedTick_s);
  return bones_age_s_;
}

void HapticStage::publish(const ToolState& tool, const BoneSnapshot& bones) {
  exchange_.tool_to_physics.publish(tool);
  for (const Event& event : session_.last_events(options_.hand)) exchange_.events.push(event);
  if (exchange_.judging.load(std::memory_order_relaxed)) exchange_.judged.push(tool);
  for (std::size_t h = 0; h < kMaxHands; ++h)
    if (options_.others[h]) exchange_.tool_to_hands[h].publish(seen_from_outside(tool));
  telemetry_.peak_force_n =
      std::max(telemetry_.peak_force_n, static_cast<float>(tool.force_W.norm()));
  telemetry_.status |= tool.status;
  for (std::uint32_t i = 0; i < tool.contact_count; ++i)
    telemetry_.bones_mask |= std::uint64_t{1} << (tool.contacts[i].bone.index & 63u);
  if (tool.tick % kTelemetryTicks != 0) return;

  telemetry_.time_s = tool.time_s;
  exchange_.telemetry.push(telemetry_);  // full: the window is busy, the plot may have a gap
  telemetry_ = {};
  status_.safety = gate_.state();
  status_.cause = gate_.cause();
  status_.clutched = mapping_.clutched();
  if (tool.tick % kHealthTicks == 0) status_.health = device_.health();
  exchange_.device_status.publish(status_);
  exchange_.to_window.publish(RenderSnapshot{bones, tool});
}

}  // namespace osteon
