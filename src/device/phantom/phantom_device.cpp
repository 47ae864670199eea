#include "phantom_device.h"

#include <utility>

#include "arm_models.h"
#include "osteon/base/file.h"
#include "osteon/device/profile.h"

namespace osteon {
namespace {

Result<DeviceInfo> load_arm_profile(const char* file) {
  const auto data = find_data_dir();
  if (!data) return tl::unexpected(data.error());
  return load_device_profile(*data / "assets" / "devices" / file);
}

ArmSetup setup_for(const ArmReport& report, const DeviceInfo& info) {
  ArmSetup setup;
  if (!report.workspace_m.empty()) setup.centre_m = report.workspace_m.center();
  setup.peak_force_n = info.peak_force_n;
  setup.peak_torque_nm = info.drives_rotation() ? info.peak_torque_nm : 0;
  setup.has_dead_man = info.has_dead_man;
  setup.calibration_styles = report.calibration_styles;
  return setup;
}

}  // namespace

PhantomDevice::PhantomDevice(std::shared_ptr<HdSession> session, ServoArm& arm, DeviceInfo info)
    : session_(std::move(session)), arm_(&arm), info_(std::move(info)), last_(arm.newest()) {}

PhantomDevice::~PhantomDevice() { PhantomDevice::close(); }

Result<std::unique_ptr<HapticDevice>> PhantomDevice::open(std::shared_ptr<HdSession> session,
                                                          const std::string& config_name) {
  DeviceInfo info;
  const auto describe = [&](const ArmReport& report) -> Result<ArmSetup> {
    const ArmModel model = arm_model(report.model, report.output_dof);
    const auto profile = load_arm_profile(model.profile);
    if (!profile) return tl::unexpected(profile.error());
    info = limited_by(*profile, report);
    info.name = kArmName;
    info.has_dead_man = model.has_dead_man;
    info.serial = config_name;
    return setup_for(report, info);
  };
  const auto arm = session->add(config_name, describe);
  if (!arm) return tl::unexpected(arm.error());
  return std::unique_ptr<HapticDevice>(
      new PhantomDevice(std::move(session), **arm, std::move(info)));
}

DeviceSample PhantomDevice::read() {
  if (arm_) last_ = arm_->newest();
  return last_.sample;
}

void PhantomDevice::write_force(const Vec3& force_V) {
  if (arm_) arm_->order({force_V, torque_V_});
  torque_V_.setZero();
}

void PhantomDevice::close() {
  if (!arm_) return;
  session_->remove(*arm_);
  arm_ = nullptr;
  session_.reset();
  last_.sample.connected = false;
}

DeviceHealth PhantomDevice::health() const { return last_.health; }

void PhantomDevice::calibrate() {
  if (arm_) arm_->wish_calibration();
}

}  // namespace osteon
