#include "window/jobs/felt_job.h"

#include <new>
#include <utility>

namespace osteon {

FeltJob::FeltJob(std::shared_ptr<const Case> the_case, PreparedCase prepared)
    : case_(std::move(the_case)), prepared_(std::move(prepared)), thread_([this] { run(); }) {}

FeltJob::~FeltJob() {
  stopped_.store(true);
  thread_.join();
}

void FeltJob::run() {
  try {
    prepare_felt(*case_, prepared_, [this](double share) {
      fraction_.store(share, std::memory_order_relaxed);
      return !stopped_.load(std::memory_order_relaxed);
    });
  } catch (const std::bad_alloc&) {
    failed_ = true;
  }
  done_.store(true, std::memory_order_release);
  done_.notify_all();
}

}  // namespace osteon
