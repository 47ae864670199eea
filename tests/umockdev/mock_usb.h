#pragma once

#include <linux/usbdevice_fs.h>
#include <sys/ioctl.h>
#include <umockdev.h>

#include <deque>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "emulated/emulated_usb.h"
#include "emulated/joystick_descriptors.h"

namespace osteon::testing {

/// An emulated device behind the kernel's USB interface as umockdev plays it: the real libusb
/// finds it in a made-up /sys and talks to it by usbfs ioctls. umockdev answers on a thread of its
/// own: `locked` is the way to the device.
class MockUsb {
 public:
  /// What makes a frame of 1 ms pass: each poll of the host (so that a busy machine changes
  /// nothing) or the real clock.
  enum class Clock { kByPoll, kReal };
  /// Its speed is the device's own.
  MockUsb(UMockdevTestbed* testbed, std::shared_ptr<EmulatedUsbDevice> device,
          const JoystickDescriptors& descriptors, int number, Clock clock = Clock::kByPoll);
  ~MockUsb();
  MockUsb(const MockUsb&) = delete;
  MockUsb& operator=(const MockUsb&) = delete;

  /// The device appears (without a node it cannot be opened), or goes.
  void plug(bool with_node = true);
  void unplug();

  template <class F>
  auto locked(F f) {
    const std::lock_guard<std::mutex> lock(mutex_);
    pump();
    return f();
  }
  /// Inside `locked`.
  void pass_frames(int count) {
    for (int i = 0; i < count; ++i) frame();
  }
  void set_silent(bool silent) {
    locked([&] { silent_ = silent; });
  }
  void set_stall_in(bool stall) {
    locked([&] { stall_in_ = stall; });
  }
  std::size_t in_flight() {
    return locked([&] { return flying_.size() + done_.size(); });
  }
  /// The last packet that the device took, and the last reading that it had given when that packet
  /// was handed over; us of the monotonic clock, whole frames. Inside `locked`.
  struct Answer {
    std::int64_t given_us = 0;
    std::int64_t taken_us = 0;
  };
  const Answer& last_answer() const { return answer_; }

 private:
  static gboolean on_ioctl(UMockdevIoctlBase*, UMockdevIoctlClient* client, gpointer self);
  bool handle(UMockdevIoctlClient* client);
  void submit(UMockdevIoctlClient* client, UMockdevIoctlData* arg);
  void reap(UMockdevIoctlClient* client, UMockdevIoctlData* arg);
  void discard(UMockdevIoctlClient* client, UMockdevIoctlData* arg);
  void run_control(usbdevfs_urb& urb);
  void pump();
  void frame();
  // A request, and the open file that it came by: each file reaps its own.
  struct Urb {
    UMockdevIoctlData* data = nullptr;
    UMockdevIoctlClient* file = nullptr;
    std::int64_t given_us = 0;  ///< the last reading before it was handed over
  };
  Urb take_flying(bool in);
  void end(const Urb& urb, int status);
  std::string sys_path() const;

  UMockdevTestbed* testbed_;
  UMockdevIoctlBase* handler_;
  std::shared_ptr<EmulatedUsbDevice> device_;
  std::string descriptors_hex_;
  int number_;
  Clock clock_;
  std::mutex mutex_;
  std::deque<Urb> flying_;
  std::deque<Urb> done_;
  std::int64_t start_us_;
  std::int64_t frames_ = 0;
  bool attached_ = false;
  bool gone_ = false;
  bool silent_ = false;
  bool stall_in_ = false;
  std::int64_t given_us_ = 0;  ///< frame of the last reading
  Answer answer_;
};

}  // namespace osteon::testing
