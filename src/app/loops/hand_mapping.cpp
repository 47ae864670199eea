#include "loops/hand_mapping.h"

#include <cmath>

namespace osteon {

Quat patient_axes() {
  const double half = std::sqrt(0.5);
  return {half, half, 0, 0};
}

HandMapping::HandMapping(const DeviceMapping& start, const MappingSettings& settings)
    : mapping_(start), clutch_button_(settings.clutch_button), p_W_(start.X_WV.p) {}

void HandMapping::put_tool_at(const Vec3& p_W) {
  mapping_.X_WV.p = p_W - mapping_.X_WV.q * (mapping_.scale * p_V_);
}

ToolInput HandMapping::to_world(const DeviceSample& sample, bool clutch_pedal) {
  const bool by_button = clutch_button_ >= 0 && ((sample.buttons >> clutch_button_) & 1u) != 0;
  const bool was = clutched_;
  clutched_ = clutch_pedal || by_button;
  released_ = was && !clutched_;
  p_V_ = sample.X_VD.p;
  if (!seen_) p_W_ = mapping_.to_world(sample.X_VD).p;
  seen_ = true;
  if (clutched_) put_tool_at(p_W_);

  ToolInput input;
  input.X_WD = mapping_.to_world(sample.X_VD);
  // Rounding must not let a held tool creep.
  if (clutched_) input.X_WD.p = p_W_;
  p_W_ = input.X_WD.p;
  if (!clutched_) input.v_W = mapping_.X_WV.q * (mapping_.scale * sample.v_V);
  input.w_W = mapping_.X_WV.q * sample.w_V;
  input.buttons = sample.buttons;
  return input;
}

void HandMapping::align(const Quat& q_WV) {
  mapping_.X_WV.q = q_WV;
  put_tool_at(p_W_);
}

Vec3 HandMapping::force_to_device(const Vec3& force_W) const {
  return clutched_ ? Vec3(Vec3::Zero()) : mapping_.force_to_device(force_W);
}

}  // namespace osteon
