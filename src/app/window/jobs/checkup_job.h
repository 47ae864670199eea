#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <span>
#include <thread>
#include <utility>

#include "checkup/checkup.h"

namespace osteon {

/// A check-up on a thread of its own, so that the window goes on drawing.
class CheckupJob {
 public:
  CheckupJob(CheckupOrder order, std::span<const Driver> table);
  /// Cancels and waits for the thread; a lent device that nobody took back is closed.
  ~CheckupJob();
  CheckupJob(const CheckupJob&) = delete;
  CheckupJob& operator=(const CheckupJob&) = delete;

  struct Progress {
    const char* what = "Beginning";
    double fraction = 0;
  };
  Progress progress() const;
  bool done() const { return done_.load(std::memory_order_acquire); }
  /// Ends it within some ticks, with the device at zero force: for the panic key too.
  void cancel() { cancelled_.store(true, std::memory_order_relaxed); }
  /// Returns when it is done.
  void wait() const { done_.wait(false, std::memory_order_acquire); }
  /// Cancels and returns when it is done.
  void end();
  /// Once, after `done`.
  CheckupReport take_report() { return std::move(report_); }
  /// The device that was lent, still open; after `done`. Null when none was.
  std::unique_ptr<HapticDevice> take_device() { return std::move(order_.device); }

 private:
  void run();

  CheckupOrder order_;
  std::span<const Driver> table_;
  mutable std::mutex mutex_;
  Progress progress_;
  std::atomic<bool> cancelled_{false};
  std::atomic<bool> done_{false};
  CheckupReport report_;
  std::thread thread_;
};

}  // namespace osteon
