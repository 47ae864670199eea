#pragma once

#include <array>
#include <memory>
#include <mutex>
#include <string>

#include "servo_arm.h"

namespace osteon {

/// What the library says of an arm that it has just found. Zero: it does not say.
struct ArmReport {
  std::string model;
  double max_force_n = 0;
  double max_continuous_force_n = 0;
  double max_stiffness_n_per_m = 0;
  double max_torque_nm = 0;
  double max_continuous_torque_nm = 0;
  int output_dof = 0;
  double rate_hz = 0;
  Aabb workspace_m;  ///< in the library's frame; empty: not told
  hd::Enum calibration_styles = 0;
};

/// The library's one servo loop, shared by all arms. The loop is stopped while an arm comes or
/// goes, as the library demands: the force of the others is zero for that time.
class HdSession {
 public:
  explicit HdSession(const HdApi& api, ServoArm::Clock now_ns) : api_(api), now_ns_(now_ns) {}
  ~HdSession();
  HdSession(const HdSession&) = delete;
  HdSession& operator=(const HdSession&) = delete;

  /// Finds the arm of that name ("Left Device"; empty: the default one). `describe` makes the setup
  /// of its servo loop from the report (its handle is filled in after). The arm lives until
  /// `remove`.
  template <class Describe>
  Result<ServoArm*> add(const std::string& config_name, const Describe& describe);
  /// Zero force, then released.
  void remove(ServoArm& arm);

 private:
  static constexpr std::size_t kMostArms = 4;

  static unsigned servo_pass(void* session);
  static unsigned wait_for_rest(void* wait);
  void tick_all();
  Result<hd::Handle> init(const std::string& config_name);
  ArmReport report() const;
  Result<ServoArm*> install(std::size_t slot, const ArmSetup& setup);
  std::size_t free_slot() const;
  void start();
  void stop();
  /// The newest error that concerns a device, the library's list emptied.
  hd::ErrorCode take_error() const;

  const HdApi api_;
  const ServoArm::Clock now_ns_;
  std::mutex changing_;  ///< held while arms come and go; the servo loop is stopped then
  std::array<std::unique_ptr<ServoArm>, kMostArms> arms_;
  bool running_ = false;
  hd::ULong loop_ = 0;
};

template <class Describe>
Result<ServoArm*> HdSession::add(const std::string& config_name, const Describe& describe) {
  const std::lock_guard lock(changing_);
  const std::size_t slot = free_slot();
  if (slot == kMostArms)
    return fail("no more arms can be opened", config_name, "Close another one");
  stop();
  const auto handle = init(config_name);
  if (!handle) {
    start();
    return tl::unexpected(handle.error());
  }
  Result<ArmSetup> setup = describe(report());
  if (!setup) {
    api_.disable_device(*handle);
    start();
    return tl::unexpected(setup.error());
  }
  setup->handle = *handle;
  return install(slot, *setup);
}

}  // namespace osteon
