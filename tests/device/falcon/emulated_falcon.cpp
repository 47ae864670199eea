#include "device/falcon/emulated_falcon.h"

#include <algorithm>
#include <cmath>

#include "falcon/falcon_kinematics.h"

namespace osteon::testing {
namespace {

constexpr std::uint16_t kBaud9600 = 0x4138, kBaudLoad = 0x15, kBaudNormal = 2;
constexpr std::array<std::uint8_t, 2> kStatus{0x01, 0x60};
constexpr std::size_t kLargestPacket = 64;

// clang-format off
constexpr std::uint8_t kDevice[] = {
    0x12, 0x01, 0x00, 0x02, 0x00, 0x00, 0x00, 0x40,        // USB 2.0, class by interface
    0x03, 0x04, 0x48, 0xCB, 0x00, 0x06, 0x01, 0x02, 0x03, 0x01,  // 0403:cb48, FT232B
};
constexpr std::uint8_t kConfiguration[] = {
    0x09, 0x02, 0x20, 0x00, 0x01, 0x01, 0x00, 0xC0, 0x32,  // 32 bytes, own power
    0x09, 0x04, 0x00, 0x00, 0x02, 0xFF, 0xFF, 0xFF, 0x02,  // interface 0: vendor's
    0x07, 0x05, 0x81, 0x02, 0x40, 0x00, 0x00,              // IN 0x81, bulk, 64 bytes
    0x07, 0x05, 0x02, 0x02, 0x40, 0x00, 0x00,              // OUT 0x02, likewise
};
// clang-format on

}  // namespace

JoystickDescriptors falcon_descriptors() {
  return {kDevice, kConfiguration, {}, "FALCON HAPTIC", "FN0001"};
}

std::vector<std::uint8_t> pretended_firmware(std::size_t size) {
  std::vector<std::uint8_t> bytes(size);
  for (std::size_t i = 0; i < size; ++i) bytes[i] = static_cast<std::uint8_t>(i * 37 + 11);
  return bytes;
}

EmulatedFalcon::EmulatedFalcon(std::vector<std::uint8_t> firmware, const HandParams& hand)
    : firmware_(std::move(firmware)), hand_(hand) {
  take_hold(Vec3(0, 0, -0.02));
}

void EmulatedFalcon::take_hold(const Vec3& p_V) {
  want(p_V);
  hand_.reset(wanted_F_);
  last_counts_ = true_counts();
}

void EmulatedFalcon::want(const Vec3& p_V, const Vec3& v_V) {
  wanted_F_.p = p_V + falcon::kCentre_F;
  wanted_v_F_ = v_V;
}

Vec3 EmulatedFalcon::position_V() const { return hand_.pose().p - falcon::kCentre_F; }

std::array<int, 3> EmulatedFalcon::true_counts() const {
  const auto angles = falcon::joint_angles(hand_.pose().p);
  if (!angles) return last_counts_;
  const Vec3 counts = falcon::counts_of(*angles);
  std::array<int, 3> whole{};
  for (std::size_t i = 0; i < 3; ++i)
    whole[i] = static_cast<int>(std::lround(counts[static_cast<Eigen::Index>(i)]));
  return whole;
}

bool EmulatedFalcon::control(const UsbSetup& setup, std::span<const std::uint8_t>,
                             std::span<std::uint8_t> in, std::size_t& in_size) {
  if (setup.request_type != 0x40) {
    JoystickDescriptors descriptors = falcon_descriptors();
    descriptors.serial = serial.c_str();
    return answer_descriptor(descriptors, setup, in, in_size);
  }
  requests_.push_back({setup.request, setup.value});
  switch (setup.request) {
    case 0:
      if (setup.value == 1) to_host_.clear();
      return setup.value <= 2;
    case 1:
      if (setup.value & 0x0100) {
        const bool high = (setup.value & 1) != 0;
        // DTR holds the processor in reset; letting go starts its boot loader.
        if (high && !dtr_) {
          state_ = State::kBoot;
          heard_.clear();
          command_ = {};
        }
        dtr_ = high;
      }
      return true;
    case 3:
      baud_ = setup.value;
      return true;
    case 9:
      latency_ms_ = setup.value;
      return setup.value > 0;
    case 2:
    case 4:
      return true;
    default:
      return false;
  }
}

void EmulatedFalcon::take_out(std::uint8_t endpoint, std::span<const std::uint8_t> bytes) {
  if (endpoint != 0x02 || dead) return;
  for (const std::uint8_t byte : bytes) hear(byte);
}

// At another speed than the processor's own the bytes are noise to it.
void EmulatedFalcon::hear(std::uint8_t byte) {
  if (state_ == State::kBoot && baud_ == kBaud9600) hear_greeting(byte);
  if ((state_ == State::kGreeted || state_ == State::kLoading) && baud_ == kBaudLoad && !dtr_)
    hear_firmware(byte);
  if (state_ == State::kRunning && baud_ == kBaudNormal) hear_command(byte);
}

void EmulatedFalcon::hear_greeting(std::uint8_t byte) {
  heard_.push_back(byte);
  const std::size_t n = heard_.size();
  if (n < 3 || heard_[n - 3] != 0x0a || heard_[n - 2] != 0x43 || heard_[n - 1] != 0x0d) return;
  heard_.clear();
  if (deaf_greetings-- > 0) return;
  if (leading_zero) say({0x00});
  say({0x0a, 0x44, 0x2c, 0x0d});
  state_ = State::kGreeted;
}

void EmulatedFalcon::hear_firmware(std::uint8_t byte) {
  if (state_ == State::kGreeted) {
    if (byte != 0x41) return;
    say({0x41});
    state_ = State::kLoading;
    loaded_ = 0;
    return;
  }
  const bool wrong = loaded_ == wrong_echo_at;
  say({static_cast<std::uint8_t>(wrong ? ~byte : byte)});
  if (byte != firmware_[loaded_]) {
    state_ = State::kStuck;
    return;
  }
  if (++loaded_ < firmware_.size()) return;
  state_ = State::kRunning;
  homed_ = 0;
}

void EmulatedFalcon::hear_command(std::uint8_t byte) {
  if (!reader_.feed(byte)) return;
  command_ = decode_command(reader_.packet());
  answer();
}

void EmulatedFalcon::say(std::initializer_list<std::uint8_t> bytes) {
  to_host_.insert(to_host_.end(), bytes);
}

void EmulatedFalcon::answer() {
  FalconReport report;
  const auto counts = true_counts();
  for (std::size_t i = 0; i < 3; ++i)
    report.encoders[i] = counts[i] + ((homed_ >> i & 1) ? 0 : offsets_[i]);
  if (nonsense) report.encoders = {30000, -30000, 30000};
  report.homed = homed_;
  report.grip = grip_;
  for (const std::uint8_t byte : encode(report)) to_host_.push_back(byte);
}

// Data at once, else the two status bytes alone when the latency is over.
std::size_t EmulatedFalcon::give_in(std::uint8_t endpoint, std::span<std::uint8_t> packet) {
  const bool due = now_ns_ - said_ns_ >= latency_ms_ * 1'000'000ll;
  if (endpoint != 0x81 || (to_host_.empty() && !due)) return 0;
  said_ns_ = now_ns_;
  std::copy(kStatus.begin(), kStatus.end(), packet.begin());
  const std::size_t n = std::min(to_host_.size(), kLargestPacket - kStatus.size());
  std::copy_n(to_host_.begin(), n, packet.begin() + kStatus.size());
  to_host_.erase(to_host_.begin(), to_host_.begin() + static_cast<std::ptrdiff_t>(n));
  return n + kStatus.size();
}

Vec3 EmulatedFalcon::motor_force() const {
  const auto J = falcon::angle_jacobian(hand_.pose().p);
  if (state_ != State::kRunning || !J) return Vec3::Zero();
  const Vec3 counts(command_.motors[0], command_.motors[1], command_.motors[2]);
  return J->transpose() * (counts / falcon::kCountsPerNm);
}

void EmulatedFalcon::advance(std::int64_t now_ns) {
  now_ns_ = now_ns;
  if (stepped_ns_ < 0) stepped_ns_ = now_ns;
  while (now_ns - stepped_ns_ >= 1'000'000) {
    stepped_ns_ += 1'000'000;
    step();
  }
}

void EmulatedFalcon::step() {
  hand_.step(0.001, wanted_F_, wanted_v_F_, force_F_);
  // The command of this frame acts from the next step on.
  force_F_ = motor_force();
  const auto counts = true_counts();
  for (std::size_t i = 0; i < 3; ++i) {
    const bool passed_mark = (counts[i] >= 0) != (last_counts_[i] >= 0);
    if (runs() && command_.homing && passed_mark)
      homed_ = static_cast<std::uint8_t>(homed_ | 1 << i);
  }
  last_counts_ = counts;
}

// The motors have a supply of their own, but the converter that gave them commands is gone, and
// with it the processor's reset line.
void EmulatedFalcon::disconnected() {
  to_host_.clear();
  command_ = {};
  baud_ = 0;
}

void EmulatedFalcon::switch_off_and_on() {
  disconnected();
  state_ = State::kBoot;
  heard_.clear();
  homed_ = 0;
}

}  // namespace osteon::testing
