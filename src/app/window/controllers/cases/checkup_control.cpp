#include "window/controllers/cases/checkup_control.h"

#include <epoxy/gl.h>

#include <utility>

#include "osteon/device/drivers.h"

namespace osteon {
namespace {

std::string gl_string(GLenum name) {
  const auto* text = reinterpret_cast<const char*>(glGetString(name));
  return text ? text : "unknown";
}

const Driver* driver_of(const DeviceChoice& choice) {
  for (const Driver& driver : drivers())
    if (choice.driver == driver.name) return &driver;
  return nullptr;
}

}  // namespace

std::string CheckupControl::not_now_because() const {
  if (cases_.loading()) return "Wait until the case is open.";
  if (live_.recording())
    return "Stop the recording first: the check-up needs exclusive use of the device.";
  return {};
}

void CheckupControl::open() {
  open_ = true;
  begin(false);
}

void CheckupControl::begin(bool push) {
  if (job_ || !not_now_because().empty()) return;
  CheckupOrder order;
  order.graphics = gl_finding(gl_string(GL_VERSION), gl_string(GL_RENDERER));
  order.push = push;
  if (live_.run() && live_.run()->choice().info.peak_force_n > 0) {
    // A real device is held by the run; of an emulated one another can be had.
    if (live_.run()->by_real_device())
      order.device = live_.run()->lend_device();
    else
      order.driver = driver_of(live_.run()->choice());
    order.info = live_.run()->choice().info;
  }
  report_ = {};
  job_ = std::make_unique<SideJob<CheckupOutcome>>(check_up(std::move(order), drivers()));
}

void CheckupControl::poll() {
  if (job_ && job_->done()) end();
}

void CheckupControl::end() {
  if (!job_) return;
  job_->cancel();
  job_->wait();
  Result<CheckupOutcome> outcome = job_->take();
  job_.reset();
  if (!outcome) return host_.note(ToastKind::kError, outcome.error().message());
  report_ = std::move(outcome->report);
  std::unique_ptr<HapticDevice> device = std::move(outcome->order->device);
  if (!device || !live_.run()) return;
  const Result<void> resumed = live_.run()->take_back(std::move(device));
  if (!resumed) host_.note(ToastKind::kError, resumed.error().message());
}

void CheckupControl::apply(const UiRequests& requests) {
  if (requests.copy) ImGui::SetClipboardText(requests.copy->c_str());
  if (job_ && (requests.cancel_checkup || requests.force_off)) job_->cancel();
  if (requests.install_udev) install_udev();
  if (requests.toggle_checkup) {
    open_ = !open_;
    if (open_ && !job_ && report_.findings.empty()) begin(false);
  }
  if (requests.begin_checkup) begin(false);
  if (requests.begin_push_test) begin(true);
}

void CheckupControl::install_udev() {
  const Finding done = install_udev_rule(kUdevFolder);
  const bool good = done.level == FindingLevel::kGood;
  host_.note(good ? ToastKind::kInfo : ToastKind::kError,
             done.todo.empty() ? done.text : done.text + ". " + done.todo);
  report_.udev = udev_rule();
}

CheckupModel CheckupControl::model() const {
  CheckupModel model;
  model.open = open_;
  model.running = job_ != nullptr;
  if (job_) {
    const LoadProgress now = job_->progress();
    model.doing = now.what.empty() ? "Beginning" : now.what;
    model.fraction = now.fraction;
  }
  model.findings = report_.findings;
  model.verdict = report_.verdict;
  model.udev = report_.udev;
  model.not_now = not_now_because();
  if (live_.run() && live_.run()->choice().info.peak_force_n > 0)
    model.device = live_.run()->choice().info.name;
  return model;
}

}  // namespace osteon
