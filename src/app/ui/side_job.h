#pragma once

#include <atomic>
#include <functional>
#include <mutex>
#include <new>
#include <string>
#include <thread>
#include <utility>

#include "osteon/base/clock.h"
#include "osteon/image/progress.h"
#include "ui/load_progress.h"

namespace osteon {

/// Work on a thread of its own that tells where it is and can be stopped, so that the window stays
/// alive. The work's progress may be called with a null `what`: it then tells nothing new and only
/// asks whether to go on, without a lock.
template <class T>
class SideJob {
 public:
  using Work = std::function<Result<T>(const Progress&)>;

  explicit SideJob(Work work)
      : start_ns_(steady_now_ns()),
        result_(fail("not done yet")),
        thread_([this, todo = std::move(work)] { run(todo); }) {}
  /// Cancels and waits for the thread.
  ~SideJob() {
    cancel();
    thread_.join();
  }
  SideJob(const SideJob&) = delete;
  SideJob& operator=(const SideJob&) = delete;

  bool done() const { return done_.load(std::memory_order_acquire); }
  /// Returns when it is done.
  void wait() const { done_.wait(false, std::memory_order_acquire); }
  void cancel() { cancelled_.store(true); }
  bool cancelled() const { return cancelled_.load(); }
  LoadProgress progress() const {
    const std::scoped_lock lock(mutex_);
    LoadProgress progress = progress_;
    const double elapsed_s = static_cast<double>(steady_now_ns() - start_ns_) * 1e-9;
    progress.seconds_left = seconds_left(elapsed_s, progress.fraction);
    return progress;
  }
  /// Once, after `done`.
  Result<T> take() { return std::move(result_); }

 private:
  void run(const Work& work) {
    try {
      result_ = work([this](const char* what, double share) {
        if (what) tell(what, share);
        return !cancelled_.load(std::memory_order_relaxed);
      });
    } catch (const std::bad_alloc&) {
      result_ = fail("there is not enough memory", {}, "Close other programs and try again");
    }
    done_.store(true, std::memory_order_release);
    done_.notify_all();
  }
  void tell(const char* what, double share) {
    const std::scoped_lock lock(mutex_);
    progress_.what = what;
    progress_.fraction = share;
  }

  mutable std::mutex mutex_;
  LoadProgress progress_;
  std::int64_t start_ns_ = 0;
  std::atomic<bool> cancelled_{false};
  std::atomic<bool> done_{false};
  Result<T> result_;
  std::thread thread_;
};

}  // namespace osteon
