#include <epoxy/gl.h>

#include <utility>

#include "osteon/device/drivers.h"
#include "window/window_app.h"

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

std::string WindowApp::no_checkup_because() const {
  if (job_) return "Something is being opened.";
  if (live_ && live_->recording())
    return "Stop the recording first: the check-up needs the device for itself.";
  return {};
}

void WindowApp::begin_checkup(bool push) {
  if (checkup_ || !no_checkup_because().empty()) return;
  CheckupOrder order;
  order.graphics = gl_finding(gl_string(GL_VERSION), gl_string(GL_RENDERER));
  order.push = push;
  if (live_ && live_->choice().info.peak_force_n > 0) {
    // A real device is held by the run; of an emulated one another can be had.
    if (live_->by_real_device())
      order.device = live_->lend_device();
    else
      order.driver = driver_of(live_->choice());
    order.info = live_->choice().info;
  }
  checkup_report_ = {};
  checkup_ = std::make_unique<SideJob<CheckupOutcome>>(check_up(std::move(order), drivers()));
}

void WindowApp::poll_checkup() {
  if (checkup_ && checkup_->done()) end_checkup();
}

// Cancels one that runs. A lent device goes back to its run.
void WindowApp::end_checkup() {
  if (!checkup_) return;
  checkup_->cancel();
  checkup_->wait();
  Result<CheckupOutcome> outcome = checkup_->take();
  checkup_.reset();
  if (!outcome) return note(ToastKind::kError, outcome.error().message());
  checkup_report_ = std::move(outcome->report);
  std::unique_ptr<HapticDevice> device = std::move(outcome->order->device);
  if (!device || !live_) return;
  const Result<void> resumed = live_->take_back(std::move(device));
  if (!resumed) note(ToastKind::kError, resumed.error().message());
}

void WindowApp::apply_checkup(const UiRequests& requests) {
  if (requests.copy) ImGui::SetClipboardText(requests.copy->c_str());
  if (checkup_ && (requests.cancel_checkup || requests.force_off)) checkup_->cancel();
  if (requests.install_udev) install_udev();
  if (requests.toggle_checkup) {
    checkup_open_ = !checkup_open_;
    if (checkup_open_ && !checkup_ && checkup_report_.findings.empty()) begin_checkup(false);
  }
  if (requests.begin_checkup) begin_checkup(false);
  if (requests.begin_push_test) begin_checkup(true);
}

void WindowApp::install_udev() {
  const Finding done = install_udev_rule(kUdevFolder);
  const bool good = done.level == FindingLevel::kGood;
  note(good ? ToastKind::kInfo : ToastKind::kError,
       done.todo.empty() ? done.text : done.text + ". " + done.todo);
  checkup_report_.udev = udev_rule();
}

CheckupModel WindowApp::checkup_model() const {
  CheckupModel model;
  model.open = checkup_open_;
  model.running = checkup_ != nullptr;
  if (checkup_) {
    const LoadProgress now = checkup_->progress();
    model.doing = now.what.empty() ? "Beginning" : now.what;
    model.fraction = now.fraction;
  }
  model.findings = checkup_report_.findings;
  model.verdict = checkup_report_.verdict;
  model.udev = checkup_report_.udev;
  model.not_now = no_checkup_because();
  if (live_ && live_->choice().info.peak_force_n > 0) model.device = live_->choice().info.name;
  return model;
}

}  // namespace osteon
