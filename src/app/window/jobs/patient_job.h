#pragma once

#include <atomic>
#include <filesystem>
#include <thread>

#include "cases/make_patient.h"

namespace osteon {

/// Grows and saves a patient on a thread of its own, so that the window goes on drawing.
class PatientJob {
 public:
  PatientJob(PatientOrder order, std::filesystem::path out);
  /// Stops it and waits for the thread.
  ~PatientJob();
  PatientJob(const PatientJob&) = delete;
  PatientJob& operator=(const PatientJob&) = delete;

  double fraction() const { return fraction_.load(std::memory_order_relaxed); }
  bool done() const { return done_.load(std::memory_order_acquire); }
  /// Returns when it is done.
  void wait() const { done_.wait(false, std::memory_order_acquire); }
  /// Leaves nothing of what was not whole yet.
  void stop() { stopped_.store(true, std::memory_order_relaxed); }
  /// After `done`: whether it was stopped before it was whole.
  bool was_stopped() const { return was_stopped_; }
  /// After `done`.
  const Result<MadePatient>& result() const { return result_; }
  const std::filesystem::path& folder() const { return out_; }

 private:
  struct Stopped {};
  void run(const PatientOrder& order);

  std::filesystem::path out_;
  bool was_stopped_ = false;
  std::atomic<double> fraction_{0};
  std::atomic<bool> stopped_{false};
  std::atomic<bool> done_{false};
  Result<MadePatient> result_;
  std::thread thread_;
};

}  // namespace osteon
