#include "window/jobs/checkup_job.h"

#include <utility>

namespace osteon {

CheckupJob::CheckupJob(CheckupOrder order, std::span<const Driver> table)
    : order_(std::move(order)), table_(table), thread_([this] { run(); }) {}

CheckupJob::~CheckupJob() {
  end();
  if (order_.device) order_.device->close();
}

void CheckupJob::end() {
  cancel();
  if (thread_.joinable()) thread_.join();
}

CheckupJob::Progress CheckupJob::progress() const {
  const std::scoped_lock lock(mutex_);
  return progress_;
}

void CheckupJob::run() {
  const auto tell = [this](const char* what, double fraction) {
    const std::scoped_lock lock(mutex_);
    progress_ = {what, fraction};
  };
  const auto cancelled = [this] { return cancelled_.load(std::memory_order_relaxed); };
  report_ = run_checkup(order_, table_, tell, cancelled);
  done_.store(true, std::memory_order_release);
  done_.notify_all();
}

}  // namespace osteon
