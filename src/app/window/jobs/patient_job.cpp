#include "window/jobs/patient_job.h"

#include <new>
#include <utility>

namespace osteon {

PatientJob::PatientJob(PatientOrder order, std::filesystem::path out)
    : out_(std::move(out)),
      result_(fail("not made yet")),
      thread_([this, wanted = std::move(order)] {
        run(wanted);
        done_.store(true, std::memory_order_release);
        done_.notify_all();
      }) {}

PatientJob::~PatientJob() {
  stop();
  thread_.join();
}

void PatientJob::run(const PatientOrder& order) {
  try {
    result_ = make_patient(order, out_, [this](double share) {
      if (stopped_.load(std::memory_order_relaxed)) throw Stopped{};
      fraction_.store(share, std::memory_order_relaxed);
    });
  } catch (const Stopped&) {
    was_stopped_ = true;
    result_ = fail("stopped; nothing was written");
  } catch (const std::bad_alloc&) {
    result_ = fail("there is not enough memory", {}, "Close other programs and try again");
  }
}

}  // namespace osteon
