#pragma once

#include <atomic>
#include <memory>
#include <thread>
#include <utility>

#include "osteon/render/prepare.h"
#include "osteon/scene/case.h"

namespace osteon {

/// Works out how far what is felt is from what is seen (prepare_felt) on a thread of its own, so
/// that the window stays alive.
class FeltJob {
 public:
  FeltJob(std::shared_ptr<const Case> the_case, PreparedCase prepared);
  /// Stops it and waits for the thread.
  ~FeltJob();
  FeltJob(const FeltJob&) = delete;
  FeltJob& operator=(const FeltJob&) = delete;

  double fraction() const { return fraction_.load(std::memory_order_relaxed); }
  bool done() const { return done_.load(std::memory_order_acquire); }
  /// Returns when it is done.
  void wait() const { done_.wait(false, std::memory_order_acquire); }
  /// True when memory ran out: what was taken has heights for some bones alone.
  bool failed() const { return failed_; }
  /// Once, after `done`.
  PreparedCase take() { return std::move(prepared_); }

 private:
  void run();

  std::shared_ptr<const Case> case_;
  PreparedCase prepared_;
  std::atomic<double> fraction_{0};
  bool failed_ = false;
  std::atomic<bool> stopped_{false};
  std::atomic<bool> done_{false};
  std::thread thread_;
};

}  // namespace osteon
