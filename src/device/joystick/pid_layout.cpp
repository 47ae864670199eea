#include "pid_layout.h"

#include <string>

namespace osteon {
namespace {

constexpr const char* kDescriptor = "HID report descriptor of the joystick";

// An axis of the Generic Desktop page among the inputs.
const HidField* find_axis(const HidReports& reports, std::uint16_t id) {
  for (const HidField& f : reports.fields)
    if (f.report == HidReport::kInput && !f.is_array && f.usage == hid_usage(0x01, id)) return &f;
  return nullptr;
}

Result<HidField> demand_axis(const HidReports& reports, std::uint16_t id) {
  const HidField* f = find_axis(reports, id);
  if (!f || f->logical_min >= f->logical_max)
    return fail("the joystick has no axis of usage 01:" + std::to_string(id) +
                    " (decimal) that its profile names",
                kDescriptor, "Correct [joystick.axes] in the profile");
  return *f;
}

}  // namespace

Result<PidLayout> PidLayout::find(HidReports reports, const JoystickProfile& profile) {
  PidLayout layout;
  layout.reports_ = std::move(reports);
  if (auto ok = layout.find_inputs(profile); !ok) return tl::unexpected(ok.error());
  if (auto ok = layout.find_effects(); !ok) return tl::unexpected(ok.error());
  for (const std::uint16_t force_usage : profile.force_usages)
    if (!layout.reports_.find(HidReport::kOutput, pid::kAxesEnable, hid_usage(0x01, force_usage)))
      return fail("no effect can be put on an axis that the profile names", kDescriptor,
                  "Correct 'force_usage' in the profile");
  return layout;
}

Result<void> PidLayout::find_inputs(const JoystickProfile& profile) {
  for (std::size_t i = 0; i < 3; ++i) {
    auto axis = demand_axis(reports_, profile.axes[i].usage);
    if (!axis) return tl::unexpected(axis.error());
    axes_[i] = *axis;
  }
  auto rotation = demand_axis(reports_, profile.rotation.usage);
  if (!rotation) return tl::unexpected(rotation.error());
  rotation_ = *rotation;
  for (const HidField& axis : {axes_[1], axes_[2], rotation_})
    if (axis.report_id != axes_[0].report_id)
      return fail("the axes come in different reports", kDescriptor, "Osteon needs them in one");
  for (const HidField& f : reports_.fields)
    if (f.report == HidReport::kInput && !f.is_array && (f.usage >> 16) == 0x09 && f.bits == 1 &&
        f.report_id == axes_[0].report_id && buttons_.size() < 32)
      buttons_.push_back(f);
  if (const HidField* f = reports_.find(HidReport::kInput, pid::kState, pid::kActuatorsEnabled))
    state_id_ = f->report_id;
  return {};
}

Result<HidField> PidLayout::demand_field(HidReport kind, std::uint32_t collection,
                                         std::uint32_t usage, const char* name) const {
  const HidField* f = reports_.find(kind, collection, usage);
  if (f) return *f;
  return fail(std::string("the joystick has no ") + name, kDescriptor,
              "It is not a force-feedback joystick of HID PID class 1.0 with constant forces");
}

Result<void> PidLayout::find_effects() {
  if (!reports_.uses_ids)
    return fail("the joystick does not number its reports", kDescriptor,
                "It is not a force-feedback joystick of HID PID class 1.0");
  control_collection_ = reports_.find(HidReport::kOutput, pid::kControl, pid::kReset)
                            ? pid::kControl
                            : pid::kControlReport;
  const struct {
    HidReport kind;
    std::uint32_t collection, usage;
    const char* name;
  } needed[] = {
      {HidReport::kOutput, pid::kSetEffect, pid::kBlockIndex, "report to set an effect"},
      {HidReport::kOutput, pid::kSetEffect, pid::kConstantForce,
       "constant force among its effects"},
      {HidReport::kOutput, pid::kSetConstantForce, pid::kBlockIndex, "report of constant force"},
      {HidReport::kOutput, pid::kSetConstantForce, pid::kMagnitude, "magnitude of constant force"},
      {HidReport::kOutput, pid::kOperation, pid::kBlockIndex, "report to start effects"},
      {HidReport::kOutput, pid::kOperation, pid::kStart, "operation to start effects"},
      {HidReport::kOutput, control_collection_, pid::kReset, "device control to reset"},
      {HidReport::kOutput, control_collection_, pid::kEnableActuators, "control to enable motors"},
      {HidReport::kOutput, control_collection_, pid::kStopAll, "device control to stop all"},
      {HidReport::kFeature, pid::kCreateEffect, pid::kConstantForce, "report to create effects"},
      {HidReport::kFeature, pid::kBlockLoad, pid::kBlockIndex, "report of loaded blocks"},
      {HidReport::kFeature, pid::kBlockLoad, pid::kLoadSuccess, "state of loaded blocks"},
      {HidReport::kFeature, pid::kPool, pid::kDeviceManaged, "report of its effect pool"},
  };
  for (const auto& n : needed)
    if (auto f = demand_field(n.kind, n.collection, n.usage, n.name); !f)
      return tl::unexpected(f.error());
  magnitude_ = *reports_.find(HidReport::kOutput, pid::kSetConstantForce, pid::kMagnitude);
  if (magnitude_.logical_min >= 0 || magnitude_.logical_max <= 0)
    return fail("the magnitude of its constant force has no sign", kDescriptor, "Osteon needs one");
  return {};
}

PidReport PidLayout::make(HidReport kind, std::uint32_t collection) const {
  PidReport report;
  report.kind = kind;
  for (const HidField& f : reports_.fields) {
    if (f.report != kind || !f.inside(collection)) continue;
    report.id = f.report_id;
    break;
  }
  report.size = std::min(reports_.bytes(kind, report.id), report.bytes.size());
  if (reports_.uses_ids) report.bytes[0] = report.id;
  return report;
}

void PidLayout::set(PidReport& report, std::uint32_t collection, std::uint32_t usage,
                    std::int64_t value) const {
  if (const HidField* f = reports_.find(report.kind, collection, usage))
    write_field({report.bytes.data(), report.size}, *f, value);
}

void PidLayout::set_largest(PidReport& report, std::uint32_t collection,
                            std::uint32_t usage) const {
  if (const HidField* f = reports_.find(report.kind, collection, usage))
    write_field({report.bytes.data(), report.size}, *f, f->logical_max);
}

void PidLayout::set_ones(PidReport& report, std::uint32_t collection, std::uint32_t usage) const {
  set(report, collection, usage, -1);
}

void PidLayout::choose(PidReport& report, std::uint32_t collection, std::uint32_t usage) const {
  if (const HidField* f = reports_.find(report.kind, collection, usage))
    write_field({report.bytes.data(), report.size}, *f, f->is_array ? array_value(*f, usage) : 1);
}

std::int64_t PidLayout::get(std::span<const std::uint8_t> bytes, HidReport kind,
                            std::uint32_t collection, std::uint32_t usage,
                            std::int64_t fallback) const {
  const HidField* f = reports_.find(kind, collection, usage);
  return f && bytes.size() >= reports_.bytes(kind, f->report_id) ? read_field(bytes, *f) : fallback;
}

bool PidLayout::names(std::span<const std::uint8_t> bytes, HidReport kind, std::uint32_t collection,
                      std::uint32_t usage) const {
  const HidField* f = reports_.find(kind, collection, usage);
  if (!f || bytes.size() < reports_.bytes(kind, f->report_id)) return false;
  return read_field(bytes, *f) == (f->is_array ? array_value(*f, usage) : 1);
}

bool PidLayout::is_report(std::span<const std::uint8_t> bytes, std::uint8_t id) const {
  if (bytes.size() != reports_.bytes(HidReport::kInput, id)) return false;
  return !reports_.uses_ids || bytes[0] == id;
}

bool PidLayout::is_state(std::span<const std::uint8_t> bytes) const {
  return has_state() && is_report(bytes, static_cast<std::uint8_t>(state_id_));
}

bool PidLayout::is_reading(std::span<const std::uint8_t> bytes) const {
  return is_report(bytes, axes_[0].report_id);
}

}  // namespace osteon
