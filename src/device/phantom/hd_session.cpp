#include "hd_session.h"

#include <algorithm>
#include <cmath>

#include "hd_errors.h"

namespace osteon {
namespace {

constexpr int kErrorsKept = 64;
constexpr double kMetre_mm = 1000;
constexpr int kMostPassesToRest = 100;

// For an arm's last zero to go out.
struct Wait {
  const ServoArm& arm;
  int passes = 0;
};

std::string text_or_empty(const char* text) { return text ? text : ""; }

}  // namespace

HdSession::~HdSession() {
  for (auto& arm : arms_)
    if (arm) remove(*arm);
}

std::size_t HdSession::free_slot() const {
  std::size_t slot = 0;
  while (slot < kMostArms && arms_[slot]) ++slot;
  return slot;
}

hd::ErrorCode HdSession::take_error() const {
  hd::ErrorCode newest = hd::kSuccess;
  for (int i = 0; i < kErrorsKept; ++i) {
    const hd::ErrorCode code = api_.get_error().code;
    if (code == hd::kSuccess) break;
    if (newest == hd::kSuccess && force_off_for(code) != ForceOff::kNone) newest = code;
  }
  return newest;
}

Result<hd::Handle> HdSession::init(const std::string& config_name) {
  (void)take_error();
  // Older set-ups call it "Default PHANToM"; no name means it in all of them.
  const bool the_default = config_name.empty() || config_name == "Default Device";
  const hd::Handle handle = api_.init_device(the_default ? nullptr : config_name.c_str());
  const hd::ErrorCode error = take_error();
  const std::string where = config_name.empty() ? "the default arm" : config_name;
  if (error != hd::kSuccess) {
    const std::string said = text_or_empty(api_.get_error_string(error));
    if (handle != hd::kInvalidHandle) api_.disable_device(handle);
    return fail(describe_hd_error(error), where, "OpenHaptics says: " + said);
  }
  if (handle == hd::kInvalidHandle)
    return fail("OpenHaptics has no arm of this name", where,
                "Name it so in the maker's set-up program");
  api_.make_current_device(handle);
  api_.enable(hd::kMaxForceClamping);
  api_.enable(hd::kSoftwareForceLimit);
  api_.enable(hd::kForceOutput);
  return handle;
}

// Every answer may be missing: older libraries do not know each question.
ArmReport HdSession::report() const {
  const auto number = [this](hd::Enum what) {
    double value = 0;
    api_.get_doublev(what, &value);
    return std::isfinite(value) && value > 0 ? value : 0;
  };
  ArmReport out;
  out.model = text_or_empty(api_.get_string(hd::kModel));
  out.max_force_n = number(hd::kMaxForce);
  out.max_continuous_force_n = number(hd::kMaxContinuousForce);
  out.max_stiffness_n_per_m = number(hd::kMaxStiffness) * kMetre_mm;  // N/mm
  out.max_torque_nm = number(hd::kMaxTorque) / kMetre_mm;
  out.max_continuous_torque_nm = number(hd::kMaxContinuousTorque) / kMetre_mm;
  api_.get_integerv(hd::kOutputDof, &out.output_dof);
  out.rate_hz = number(hd::kUpdateRate);
  std::array<double, 6> box{};
  api_.get_doublev(hd::kUsableWorkspace, box.data());
  const Vec3 lo(box[0], box[1], box[2]);
  const Vec3 hi(box[3], box[4], box[5]);
  if (is_finite(lo) && is_finite(hi) && (lo.array() < hi.array()).all())
    out.workspace_m = {lo / kMetre_mm, hi / kMetre_mm};
  int styles = 0;
  api_.get_integerv(hd::kCalibrationStyle, &styles);
  out.calibration_styles = static_cast<hd::Enum>(styles);
  (void)take_error();
  return out;
}

Result<ServoArm*> HdSession::install(std::size_t slot, const ArmSetup& setup) {
  arms_[slot] = std::make_unique<ServoArm>(api_, setup, now_ns_);
  start();
  if (const hd::ErrorCode error = take_error(); error != hd::kSuccess) {
    stop();
    api_.disable_device(setup.handle);
    arms_[slot].reset();
    start();
    return fail(describe_hd_error(error), "servo loop", "Close other programs that use the arm");
  }
  return arms_[slot].get();
}

void HdSession::remove(ServoArm& arm) {
  const std::lock_guard lock(changing_);
  for (auto& slot : arms_) {
    if (slot.get() != &arm) continue;
    arm.end();
    Wait wait{arm};
    if (running_) api_.schedule_synchronous(wait_for_rest, &wait, hd::kDefaultPriority);
    stop();
    api_.make_current_device(arm.handle());
    api_.disable(hd::kForceOutput);
    api_.disable_device(arm.handle());
    (void)take_error();
    slot.reset();
    start();
    return;
  }
}

// Runs whenever there is an arm.
void HdSession::start() {
  const bool any = std::any_of(arms_.begin(), arms_.end(), [](const auto& arm) { return !!arm; });
  if (running_ || !any) return;
  loop_ = api_.schedule_asynchronous(servo_pass, this, hd::kDefaultPriority);
  api_.start_scheduler();
  running_ = true;
}

void HdSession::stop() {
  if (!running_) return;
  api_.stop_scheduler();
  api_.unschedule(loop_);
  running_ = false;
}

void HdSession::tick_all() {
  for (const auto& arm : arms_)
    if (arm) arm->tick();
}

unsigned HdSession::servo_pass(void* session) {
  static_cast<HdSession*>(session)->tick_all();
  return hd::kCallbackContinue;
}

// Runs in the servo loop beside `servo_pass`, which alone may open a frame: one a pass is all that
// the library bears.
unsigned HdSession::wait_for_rest(void* wait) {
  Wait& w = *static_cast<Wait*>(wait);
  const bool done = w.arm.at_rest() || ++w.passes >= kMostPassesToRest;
  return done ? hd::kCallbackDone : hd::kCallbackContinue;
}

}  // namespace osteon
