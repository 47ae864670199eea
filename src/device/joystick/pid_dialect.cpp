#include "pid_dialect.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

namespace osteon {
namespace {

constexpr int kMostLoadTries = 60;
constexpr double kShutDown_s = 0.02;  // for each step of it
constexpr std::int64_t kResetPause_ns = 10'000'000;
constexpr std::uint8_t kGetDescriptor = 0x06, kGetReport = 0x01;

double scaled(std::span<const std::uint8_t> bytes, const HidField& field, const HidAxis& axis) {
  const double middle = 0.5 * static_cast<double>(field.logical_min + field.logical_max);
  const double half = static_cast<double>(field.logical_max) - middle;
  return axis.sign * axis.half_range * (static_cast<double>(read_field(bytes, field)) - middle) /
         half;
}

double step_of(const HidField& field, const HidAxis& axis) {
  return 2 * axis.half_range / static_cast<double>(field.logical_max - field.logical_min);
}

}  // namespace

Result<void> PidDialect::open(UsbLink& link) {
  const UsbSetup setup{0x81, kGetDescriptor, 0x2200, profile_.channel.interface_number,
                       UsbLink::kControlBytes};
  const UsbControlResult got = control_and_wait(link, setup, {}, 0.5);
  if (got.error != UsbError::kNone)
    return fail(
        std::string("the joystick does not give its report descriptor: ") + describe(got.error),
        profile_.info.name, "Plug it in again");
  auto reports = parse_hid_descriptor(got.data);
  if (!reports) return tl::unexpected(reports.error());
  auto layout = PidLayout::find(std::move(*reports), profile_);
  if (!layout) return tl::unexpected(layout.error());
  layout_ = std::move(*layout);
  start();
  return {};
}

void PidDialect::start() {
  step_ = Step::kPool;
  waiting_ = false;
  not_before_ns_ = 0;
  axis_ = 0;
  tries_ = 0;
  failure_ = "";
  status_ = {};
}

BringUp PidDialect::bring_up() const {
  if (step_ == Step::kReady) return BringUp::kReady;
  return step_ == Step::kFailed ? BringUp::kFailed : BringUp::kRunning;
}

void PidDialect::fail_with(const char* why) {
  step_ = Step::kFailed;
  failure_ = why;
}

void PidDialect::step(UsbLink& link) {
  if (step_ == Step::kReady || step_ == Step::kFailed) return;
  const UsbControlResult result = link.control();
  if (result.running || link.now_ns() < not_before_ns_) return;
  if (waiting_) {
    waiting_ = false;
    finish(result, link.now_ns());
  }
  begin(link);
}

bool PidDialect::set_report(UsbLink& link, const PidReport& report) {
  UsbSetup setup = set_output_report(profile_.channel.interface_number, report.id, report.size);
  if (report.kind == HidReport::kFeature)
    setup.value = static_cast<std::uint16_t>(0x0300 | report.id);
  return link.start_control(setup, report.view());
}

bool PidDialect::get_report(UsbLink& link, std::uint32_t collection) {
  const PidReport report = layout_->make(HidReport::kFeature, collection);
  return link.start_control(
      {0xA1, kGetReport, static_cast<std::uint16_t>(3 << 8 | report.id),
       profile_.channel.interface_number, static_cast<std::uint16_t>(report.size)},
      {});
}

bool PidDialect::control(UsbLink& link, std::uint32_t usage) {
  const std::uint32_t collection = layout_->control_collection();
  PidReport report = layout_->make(HidReport::kOutput, collection);
  layout_->choose(report, collection, usage);
  return set_report(link, report);
}

PidReport PidDialect::effect_report() const {
  PidReport report = layout_->make(HidReport::kOutput, pid::kSetEffect);
  layout_->set(report, pid::kSetEffect, pid::kBlockIndex, blocks_[axis_]);
  layout_->choose(report, pid::kSetEffect, pid::kConstantForce);
  layout_->set_ones(report, pid::kSetEffect, pid::kDuration);       // without end
  layout_->set_ones(report, pid::kSetEffect, pid::kTriggerButton);  // by no button
  layout_->set_largest(report, pid::kSetEffect, pid::kGain);
  layout_->set(report, pid::kAxesEnable, hid_usage(0x01, profile_.force_usages[axis_]), 1);
  return report;
}

// Starts the control transfer of the step.
void PidDialect::begin(UsbLink& link) {
  PidReport report;
  switch (step_) {
    case Step::kPool:
      waiting_ = get_report(link, pid::kPool);
      break;
    case Step::kReset:
      waiting_ = control(link, pid::kReset);
      break;
    case Step::kActuators:
      waiting_ = control(link, pid::kEnableActuators);
      break;
    case Step::kGain:
      report = layout_->make(HidReport::kOutput, pid::kDeviceGain);
      layout_->set_largest(report, pid::kDeviceGain, pid::kDeviceGainValue);
      waiting_ = set_report(link, report);
      break;
    case Step::kCreate:
      report = layout_->make(HidReport::kFeature, pid::kCreateEffect);
      layout_->choose(report, pid::kCreateEffect, pid::kConstantForce);
      waiting_ = set_report(link, report);
      break;
    case Step::kBlockLoad:
      waiting_ = get_report(link, pid::kBlockLoad);
      break;
    case Step::kSetEffect:
      waiting_ = set_report(link, effect_report());
      break;
    case Step::kStart:
      report = layout_->make(HidReport::kOutput, pid::kOperation);
      layout_->set(report, pid::kOperation, pid::kBlockIndex, blocks_[axis_]);
      layout_->choose(report, pid::kOperation, pid::kStart);
      layout_->set(report, pid::kOperation, pid::kLoopCount, 1);
      waiting_ = set_report(link, report);
      break;
    case Step::kReady:
    case Step::kFailed:
      break;
  }
}

// Takes in the answer to the step and chooses the next one.
void PidDialect::finish(const UsbControlResult& result, std::int64_t now_ns) {
  if (result.error != UsbError::kNone) return fail_with(describe(result.error));
  switch (step_) {
    case Step::kPool:
      return finish_pool(result.data);
    case Step::kReset:
      not_before_ns_ = now_ns + kResetPause_ns;
      step_ = Step::kActuators;
      return;
    case Step::kActuators:
      step_ = Step::kGain;
      return;
    case Step::kGain:
      step_ = Step::kCreate;
      return;
    case Step::kCreate:
      tries_ = 0;
      step_ = Step::kBlockLoad;
      return;
    case Step::kBlockLoad:
      return finish_block_load(result.data);
    case Step::kSetEffect:
      step_ = Step::kStart;
      return;
    case Step::kStart:
      return next_axis();
    case Step::kReady:
    case Step::kFailed:
      return;
  }
}

void PidDialect::finish_pool(std::span<const std::uint8_t> data) {
  if (layout_->get(data, HidReport::kFeature, pid::kPool, pid::kDeviceManaged, 0) != 1)
    return fail_with(
        "the joystick expects the host to manage its effect memory, which Osteon does not do");
  if (layout_->get(data, HidReport::kFeature, pid::kPool, pid::kSimultaneousMax, 3) < 3)
    return fail_with("the joystick plays fewer than three effects at once");
  step_ = Step::kReset;
}

void PidDialect::finish_block_load(std::span<const std::uint8_t> data) {
  if (layout_->names(data, HidReport::kFeature, pid::kBlockLoad, pid::kLoadSuccess)) {
    const auto index =
        layout_->get(data, HidReport::kFeature, pid::kBlockLoad, pid::kBlockIndex, 0);
    if (index < 1 || index > 255) return fail_with("the joystick gave an effect no number");
    blocks_[axis_] = static_cast<std::uint8_t>(index);
    step_ = Step::kSetEffect;
  } else if (layout_->names(data, HidReport::kFeature, pid::kBlockLoad, pid::kLoadFull)) {
    fail_with("the joystick has no room for another effect");
  } else if (++tries_ >= kMostLoadTries) {
    fail_with("the joystick does not load an effect");
  }
}

void PidDialect::next_axis() {
  if (++axis_ < 3) {
    step_ = Step::kCreate;
    return;
  }
  // What it said of its motors before they were enabled is past.
  status_ = {};
  step_ = Step::kReady;
}

bool PidDialect::read_axes(std::span<const std::uint8_t> bytes, JoystickReading& reading) const {
  for (std::size_t i = 0; i < 3; ++i) {
    const HidField& field = layout_->axes()[i];
    if (!field.in_range(read_field(bytes, field))) return false;  // "no value" in HID's words
    reading.p_V[static_cast<Eigen::Index>(i)] = scaled(bytes, field, profile_.axes[i]);
  }
  if (!layout_->rotation().in_range(read_field(bytes, layout_->rotation()))) return false;
  reading.turn_rad = scaled(bytes, layout_->rotation(), profile_.rotation);
  reading.buttons = 0;
  for (std::size_t i = 0; i < layout_->buttons().size(); ++i)
    if (read_field(bytes, layout_->buttons()[i]) != 0) reading.buttons |= 1u << i;
  return true;
}

// A switch that the report does not have counts as set.
void PidDialect::read_state(std::span<const std::uint8_t> bytes) {
  const auto flag = [&](std::uint32_t usage, int fallback) {
    return layout_->get(bytes, HidReport::kInput, pid::kState, usage, fallback) != 0;
  };
  status_.dead_man_held = flag(pid::kSafetySwitch, 1);
  const bool works =
      !flag(pid::kPaused, 0) && flag(pid::kActuatorsEnabled, 1) && flag(pid::kActuatorPower, 1);
  status_.refusal = works || step_ != Step::kReady ? ForceOff::kNone : ForceOff::kDeviceFault;
}

// Reports leave the device at a steady rate but reach us with jitter: a clock that follows the
// arrivals slowly, and at once when they are more than five periods off.
std::int64_t PidDialect::steady_time(std::int64_t arrival_ns) {
  const auto period_ns = static_cast<std::int64_t>(std::llround(1e9 / profile_.info.rate_hz));
  const std::int64_t expected_ns = steady_ns_ + period_ns;
  const std::int64_t off_ns = arrival_ns - expected_ns;
  const bool lost = steady_ns_ == 0 || std::llabs(off_ns) > 5 * period_ns;
  steady_ns_ = lost ? arrival_ns : expected_ns + off_ns / 16;
  return steady_ns_;
}

ReportKind PidDialect::read(const UsbPacket& packet, JoystickReading& reading) {
  if (layout_->is_state(packet.bytes)) {
    read_state(packet.bytes);
    return ReportKind::kStatus;
  }
  if (!layout_->is_reading(packet.bytes) || !read_axes(packet.bytes, reading))
    return ReportKind::kBad;
  reading.time_ns = steady_time(packet.time_ns);
  return ReportKind::kReading;
}

// Of the three axes the bus may take one a frame: the one whose force is farthest from what it has.
bool PidDialect::send(UsbLink& link, const DeviceWrench& wrench) {
  if (step_ != Step::kReady) return false;
  const HidField& magnitude = layout_->magnitude();
  const double largest =
      static_cast<double>(std::min(magnitude.logical_max, -magnitude.logical_min));
  for (std::size_t i = 0; i < 3; ++i) {
    PidReport report = layout_->make(HidReport::kOutput, pid::kSetConstantForce);
    layout_->set(report, pid::kSetConstantForce, pid::kBlockIndex, blocks_[i]);
    const double share = profile_.axes[i].sign * wrench.force_V[static_cast<Eigen::Index>(i)] /
                         profile_.full_scale_force_n;
    const auto steps = std::llround(std::clamp(share, -1.0, 1.0) * largest);
    layout_->set(report, pid::kSetConstantForce, pid::kMagnitude, steps);
    link.put(i, report.view(), static_cast<double>(steps));
  }
  return link.send();
}

void PidDialect::control_and_wait_for(UsbLink& link, std::uint32_t usage) {
  const auto idle = [&] { return !link.control().running; };
  if (wait_until(link, kShutDown_s, idle) && control(link, usage))
    wait_until(link, kShutDown_s, idle);
}

void PidDialect::shut_down(UsbLink& link) {
  if (!layout_ || link.gone()) return;
  if (step_ == Step::kReady) send(link, {});
  wait_until(link, kShutDown_s, [&] { return link.out_idle(); });
  control_and_wait_for(link, pid::kStopAll);
  control_and_wait_for(link, pid::kDisableActuators);
}

double PidDialect::resolution_m() const {
  double coarsest = 0;
  for (std::size_t i = 0; i < 3; ++i)
    coarsest = std::max(coarsest, step_of(layout_->axes()[i], profile_.axes[i]));
  return coarsest;
}

double PidDialect::resolution_rad() const {
  return step_of(layout_->rotation(), profile_.rotation);
}

}  // namespace osteon
