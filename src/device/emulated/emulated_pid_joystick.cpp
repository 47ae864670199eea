#include "emulated_pid_joystick.h"

#include <algorithm>
#include <cmath>

#include "joystick_descriptors.h"

namespace osteon {
namespace {

void put16(std::span<std::uint8_t> packet, std::size_t at, std::int64_t value) {
  packet[at] = static_cast<std::uint8_t>(value);
  packet[at + 1] = static_cast<std::uint8_t>(value >> 8);
}

std::int64_t axis_value(double share) { return std::llround(std::clamp(share, -1.0, 1.0) * 32767); }

}  // namespace

UsbEntry EmulatedPidJoystick::entry() const {
  return {0x1209, 0x0002, serial_, pid_joystick_descriptors().product, "", ""};
}

bool EmulatedPidJoystick::control(const UsbSetup& setup, std::span<const std::uint8_t> out,
                                  std::span<std::uint8_t> in, std::size_t& in_size) {
  const int kind = setup.value >> 8;
  const auto id = static_cast<std::uint8_t>(setup.value);
  if (setup.request_type == 0x21 && setup.request == 0x09) {  // SET_REPORT
    if (out.empty() || out[0] != id) return false;
    return kind == 2 ? output_report(out) : kind == 3 && create_effect(out);
  }
  if (setup.request_type == 0xA1 && setup.request == 0x01)  // GET_REPORT
    return kind == 3 && feature_report(id, in, in_size);
  JoystickDescriptors descriptors = pid_joystick_descriptors(out_endpoint_);
  descriptors.serial = serial_.c_str();
  return answer_descriptor(descriptors, setup, in, in_size);
}

void EmulatedPidJoystick::take_out(std::uint8_t endpoint, std::span<const std::uint8_t> bytes) {
  if (has_out_endpoint(endpoint)) output_report(bytes);
}

EmulatedPidJoystick::Effect* EmulatedPidJoystick::effect(std::uint8_t block) {
  if (block < 1 || block > kEffects) return nullptr;
  Effect& e = effects_[block - 1u];
  return e.used ? &e : nullptr;
}

bool EmulatedPidJoystick::output_report(std::span<const std::uint8_t> bytes) {
  if (bytes.empty()) return false;
  switch (bytes[0]) {
    case 1:
      return set_effect(bytes);
    case 5: {
      Effect* e = bytes.size() == 4 ? effect(bytes[1]) : nullptr;
      if (!e) return false;
      const auto magnitude = static_cast<std::int16_t>(bytes[2] | bytes[3] << 8);
      e->magnitude = std::clamp<std::int16_t>(magnitude, -10000, 10000);
      last_force_ns_ = now_ns_;
      return true;
    }
    case 10:
      return bytes.size() == 4 && operate(bytes[1], bytes[2]);
    case 11:
      if (bytes.size() != 2 || !effect(bytes[1])) return false;
      *effect(bytes[1]) = Effect{};
      return true;
    case 12:
      return bytes.size() == 2 && device_control(bytes[1]);
    case 13:
      if (bytes.size() != 2) return false;
      device_gain_ = bytes[1];
      return true;
    default:
      return false;
  }
}

bool EmulatedPidJoystick::set_effect(std::span<const std::uint8_t> bytes) {
  Effect* e = bytes.size() == 21 ? effect(bytes[1]) : nullptr;
  if (!e || bytes[2] != 1) return false;
  // This firmware plays endless effects alone: a duration that ends is refused.
  if ((bytes[3] | bytes[4] << 8) <= 0x7FFF) return false;
  e->gain = bytes[11];
  e->axes = bytes[13] & 0x07;
  return true;
}

bool EmulatedPidJoystick::operate(std::uint8_t block, std::uint8_t operation) {
  Effect* e = effect(block);
  if (!e || operation < 1 || operation > 3) return false;
  if (operation == 2) stop_all();
  e->playing = operation != 3;
  return true;
}

void EmulatedPidJoystick::stop_all() {
  for (Effect& e : effects_) e.playing = false;
}

bool EmulatedPidJoystick::device_control(std::uint8_t what) {
  switch (what) {
    case 1:
    case 2:
      actuators_on_ = what == 1;
      break;
    case 3:
      stop_all();
      break;
    case 4:
      effects_.fill({});
      actuators_on_ = paused_ = false;
      break;
    case 5:
    case 6:
      paused_ = what == 5;
      break;
    default:
      return false;
  }
  state_changed_ = true;
  return true;
}

bool EmulatedPidJoystick::create_effect(std::span<const std::uint8_t> bytes) {
  if (bytes.size() != 4 || bytes[0] != 5 || bytes[1] != 1) return false;
  loaded_ = 0;
  full_ = true;
  for (std::size_t i = 0; i < room_; ++i) {
    if (effects_[i].used) continue;
    effects_[i] = Effect{};
    effects_[i].used = true;
    loaded_ = static_cast<std::uint8_t>(i + 1);
    full_ = false;
    break;
  }
  return true;
}

bool EmulatedPidJoystick::feature_report(std::uint8_t id, std::span<std::uint8_t> in,
                                         std::size_t& in_size) {
  if (in.size() < 5) return false;
  in_size = 5;
  if (id == 7) {  // pool: 1024 bytes, 40 effects, managed here
    const std::uint8_t pool[5] = {7, 0x00, 0x04, kEffects, 0x01};
    std::copy(pool, pool + 5, in.begin());
    return true;
  }
  if (id != 6) return false;
  const bool slow = slow_loads_ > 0;
  if (slow) --slow_loads_;
  in[0] = 6;
  in[1] = slow ? std::uint8_t{0} : loaded_;
  in[2] = slow ? 3 : full_ ? 2 : loaded_ == 0 ? 3 : 1;
  put16(in, 3, 1024);
  return true;
}

void EmulatedPidJoystick::set_switches(bool safety, bool power) {
  safety_ = safety;
  power_ = power;
  state_changed_ = true;
}

int EmulatedPidJoystick::effects_playing() const {
  return static_cast<int>(
      std::count_if(effects_.begin(), effects_.end(), [](const Effect& e) { return e.playing; }));
}

void EmulatedPidJoystick::drive() {
  Vec3 share_H = Vec3::Zero();
  // A time-out forgets the magnitudes: else the first axis to be heard of would wake the others.
  if (now_ns_ - last_force_ns_ >= kTimeout_ns)
    for (Effect& e : effects_) e.magnitude = 0;
  const bool live = actuators_on_ && !paused_ && safety_ && power_;
  for (const Effect& e : effects_) {
    if (!live || !e.playing) continue;
    for (int i = 0; i < 3; ++i)
      if ((e.axes >> i & 1) != 0) share_H[i] += e.magnitude / 10000.0 * (e.gain / 255.0);
  }
  share_H = (device_gain_ / 255.0 * kFullScale_n) * share_H.cwiseMax(-1.0).cwiseMin(1.0);
  mechanics_.set_motors(Vec3(share_H.x(), -share_H.z(), share_H.y()));
}

void EmulatedPidJoystick::advance(std::int64_t now_ns) {
  now_ns_ = now_ns;
  drive();
  mechanics_.advance(now_ns);
  fresh_ = fresh_ || now_ns % JoystickMechanics::kStep_ns == 0;
}

std::size_t EmulatedPidJoystick::give_in(std::uint8_t endpoint, std::span<std::uint8_t> packet) {
  if (endpoint != 0x81) return 0;
  if (state_changed_) return give_state(packet);
  return fresh_ ? give_axes(packet) : 0;
}

std::size_t EmulatedPidJoystick::give_state(std::span<std::uint8_t> packet) {
  state_changed_ = false;
  packet[0] = 2;
  packet[1] = static_cast<std::uint8_t>((paused_ ? 1 : 0) | (actuators_on_ ? 2 : 0) |
                                        (safety_ ? 4 : 0) | (power_ ? 16 : 0));
  packet[2] = effects_playing() > 0 ? 1 : 0;
  return 3;
}

std::size_t EmulatedPidJoystick::give_axes(std::span<std::uint8_t> packet) {
  fresh_ = false;
  const Vec3& p_V = mechanics_.hand().pose().p;
  const double mm[3] = {1e3 * p_V.x(), 1e3 * p_V.z(), -1e3 * p_V.y()};
  packet[0] = 1;
  for (std::size_t i = 0; i < 3; ++i)
    put16(packet, 1 + 2 * i, axis_value(mm[i] / kHalfRange_mm[i]));
  constexpr double kHalfTurn_rad = 3.141592653589793;
  const double turn = std::remainder(mechanics_.turn_about(Vec3::UnitZ()), 2 * kHalfTurn_rad);
  put16(packet, 7, axis_value(turn / kHalfTurn_rad));
  packet[9] = static_cast<std::uint8_t>(mechanics_.buttons());
  return 10;
}

}  // namespace osteon
