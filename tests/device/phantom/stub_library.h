#pragma once

#include <dlfcn.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "device/phantom/stub_hd/stub_hd.h"
#include "phantom/hd_session.h"
#include "phantom/phantom_device.h"

namespace osteon::testing {

/// The stub libHD.so: the product's side of it by the product's own loader, the test's side by
/// name.
struct StubLibrary {
  StubLibrary() {
    const std::vector<std::string> path{STUB_HD};
    api = load_hd_api(path).value();
    library_ = dlopen(STUB_HD, RTLD_NOW | RTLD_LOCAL);
    bind(arm, "stub_hd_arm");
    bind(reset, "stub_hd_reset");
    bind(step, "stub_hd_step");
    bind(stall, "stub_hd_stall");
    bind(want, "stub_hd_want");
    bind(plug, "stub_hd_plug");
    bind(now_ns, "stub_hd_now_ns");
    bind(scheduler_runs, "stub_hd_scheduler_runs");
    bind(misuses, "stub_hd_misuses");
    reset();
    left = arm("Left Device");
    right = arm("Right Device");
  }

  std::shared_ptr<HdSession> session() const { return std::make_shared<HdSession>(api, now_ns); }

  HdApi api;
  StubArm* (*arm)(const char*) = nullptr;
  void (*reset)() = nullptr;
  void (*step)(int) = nullptr;
  void (*stall)(int) = nullptr;
  void (*want)(StubArm*, const double*, const double*, const double*) = nullptr;
  void (*plug)(StubArm*, bool) = nullptr;
  std::int64_t (*now_ns)() = nullptr;
  bool (*scheduler_runs)() = nullptr;
  std::uint64_t (*misuses)() = nullptr;
  StubArm* left = nullptr;
  StubArm* right = nullptr;

 private:
  template <class Function>
  void bind(Function*& call, const char* name) {
    call = reinterpret_cast<Function*>(dlsym(library_, name));
    ASSERT_TRUE(call) << name;
  }
  void* library_ = nullptr;
};

inline Vec3 motor_force(const StubArm& arm) {
  return {arm.motor_n[0], arm.motor_n[1], arm.motor_n[2]};
}

/// Where the hand wants the arm, in the library's frame.
inline void want(StubArm& arm, const Vec3& p_mm, const Vec3& v_mm_per_s = Vec3::Zero()) {
  for (int i = 0; i < 3; ++i) {
    arm.wanted_p_mm[i] = p_mm[i];
    arm.wanted_v_mm_per_s[i] = v_mm_per_s[i];
  }
}

}  // namespace osteon::testing
