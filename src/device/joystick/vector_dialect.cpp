#include "vector_dialect.h"

namespace osteon {

void VectorDialect::start() {
  status_ = {};
  sent_ = followed_ = false;
}

ReportKind VectorDialect::read(const UsbPacket& packet, JoystickReading& reading) {
  VectorState state;
  if (!decode(packet.bytes, state)) return ReportKind::kBad;
  update_status(state);
  reading.time_ns = unwrapped_ns(state.time_us);
  reading.p_V = state.p_V;
  reading.turn_rad = state.turn_rad;
  reading.buttons = state.buttons;
  reading.instrument = state.instrument;
  return ReportKind::kReading;
}

// The device's 32-bit microseconds wrap after 71 minutes; a device that was reset starts at zero.
std::int64_t VectorDialect::unwrapped_ns(std::uint32_t time_us) {
  time_us_ += static_cast<std::uint32_t>(time_us - last_time_us_);
  last_time_us_ = time_us;
  return 1000 * time_us_;
}

void VectorDialect::update_status(const VectorState& state) {
  status_.homed = (state.status & VectorState::kHomed) != 0;
  status_.dead_man_held = (state.status & VectorState::kDeadManOpen) == 0;
  status_.motor_heat = state.motor_heat;
  status_.refusal = ForceOff::kNone;
  const bool timed_out = (state.status & VectorState::kTimedOut) != 0;
  // Until our first command has arrived the device has nothing to follow and says so.
  if (sent_ && !timed_out) followed_ = true;
  if (followed_ && timed_out) status_.refusal = ForceOff::kWatchdog;
  if ((state.status & VectorState::kTooWarm) != 0) status_.refusal = ForceOff::kTemperature;
  if ((state.status & VectorState::kFault) != 0) status_.refusal = ForceOff::kDeviceFault;
}

bool VectorDialect::write(UsbLink& link, const VectorCommand& command) const {
  return with_torque_ ? link.write(0, encode_with_torque(command)) : link.write(0, encode(command));
}

bool VectorDialect::send(UsbLink& link, const DeviceWrench& wrench) {
  VectorCommand command;
  command.flags = VectorCommand::kMotorsOn;
  if (home_wanted_) command.flags |= VectorCommand::kHome;
  home_wanted_ = false;
  command.sequence = ++sequence_;
  command.force_V = wrench.force_V;
  command.torque_V = wrench.torque_V;
  sent_ = true;
  return write(link, command);
}

void VectorDialect::shut_down(UsbLink& link) {
  VectorCommand off;
  off.sequence = ++sequence_;
  write(link, off);
  wait_until(link, 0.05, [&] { return link.out_idle(); });
}

}  // namespace osteon
