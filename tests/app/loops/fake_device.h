#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "osteon/device/haptic_device.h"
#include "osteon/scene/build_case.h"
#include "osteon/scene/path.h"

namespace osteon::test {

/// What a fake device saw; outlives it.
struct DeviceLog {
  std::vector<Vec3> forces_V;
  bool closed = false;
};

inline DeviceInfo fake_device_info(std::string name) {
  DeviceInfo info;
  info.name = std::move(name);
  info.peak_force_n = 8;
  info.continuous_force_n = 8;
  info.max_stiffness_n_per_m = 3000;
  info.workspace_m = Vec3::Constant(0.4);
  return info;
}

/// A device whose readings a function of the tick gives.
class FakeDevice : public HapticDevice {
 public:
  using Script = std::function<DeviceSample(std::uint64_t tick)>;
  FakeDevice(Script script, DeviceLog& log) : script_(std::move(script)), log_(log) {}
  const DeviceInfo& info() const override { return info_; }
  DeviceSample read() override { return script_(tick_++); }
  void write_force(const Vec3& force_V) override { log_.forces_V.push_back(force_V); }
  void close() override { log_.closed = true; }

 private:
  Script script_;
  DeviceLog& log_;
  DeviceInfo info_ = fake_device_info("fake");
  std::uint64_t tick_ = 0;
};

/// Box of the given half sides about the origin, outward.
inline TriMesh box(const Vec3& half) {
  TriMesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.vertices.emplace_back((i & 1 ? 1 : -1) * half.x(), (i & 2 ? 1 : -1) * half.y(),
                               (i & 4 ? 1 : -1) * half.z());
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

/// Two blocks of 20 mm: "near" with its top at z = 0, "far" 30 mm along x.
inline std::shared_ptr<const Case> blocks_case() {
  CaseDef def;
  def.name = "blocks";
  for (int i = 0; i < 2; ++i) {
    BoneDef bone;
    bone.name = i == 0 ? "near" : "far";
    bone.X_WB.p = Vec3(0.03 * i, 0, -0.010);
    bone.mesh = box(Vec3::Constant(0.010));
    def.bones.push_back(bone);
  }
  auto made = build_case(std::move(def));
  return made ? std::make_shared<const Case>(std::move(*made)) : nullptr;
}

/// A hand that comes down onto "near" from 3 mm above, presses to 2 mm past its top, slides
/// 6 mm and rests.
inline DeviceSample press_and_slide(std::uint64_t tick) {
  const double t = static_cast<double>(tick) * 0.001;
  DeviceSample sample;
  sample.time_ns = static_cast<std::int64_t>(tick) * 1'000'000;
  const bool falls = t < 0.1;
  const bool slides = !falls && t < 0.7;
  sample.X_VD.p.x() = falls ? 0.0 : slides ? (t - 0.1) * 0.01 : 0.006;
  sample.X_VD.p.z() = falls ? 0.003 - t * 0.05 : -0.002;
  sample.v_V = Vec3(slides ? 0.01 : 0.0, 0, falls ? -0.05 : 0.0);
  return sample;
}

/// For an emulated hand: down onto "near", and pressing on it for ever.
inline ProbePath pressing_path() {
  ProbePath path;
  for (const auto& [time_s, z_mm] : {std::pair{0.0, 4.0}, {0.2, -2.0}, {600.0, -2.0}}) {
    PathSample sample;
    sample.time_s = time_s;
    sample.X_WD.p = Vec3(0, 0, 1e-3 * z_mm);
    path.samples.push_back(sample);
  }
  return path;
}

}  // namespace osteon::test
