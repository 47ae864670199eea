#include "cases/all_cores.h"

#include <algorithm>
#include <atomic>
#include <thread>
#include <vector>

namespace osteon {
namespace {

// Workers that take the next task until none is left, or until they are told to stop.
class Workers {
 public:
  Workers(std::size_t count, const std::function<void(std::size_t)>& task)
      : count_(count), task_(task) {}
  ~Workers() {
    next_ = count_;
    for (std::thread& thread : threads_) thread.join();
  }
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  void start(std::size_t threads) {
    for (std::size_t i = 0; i < threads; ++i)
      threads_.emplace_back([this] {
        while (work_once()) {
        }
      });
  }
  bool work_once() {
    const std::size_t i = next_.fetch_add(1);
    if (i >= count_) return false;
    task_(i);
    ++done_;
    return true;
  }
  void wait() {
    for (std::thread& thread : threads_) thread.join();
    threads_.clear();
  }
  double share() const { return static_cast<double>(done_) / static_cast<double>(count_); }

 private:
  std::size_t count_;
  const std::function<void(std::size_t)>& task_;
  std::atomic<std::size_t> next_{0};
  std::atomic<std::size_t> done_{0};
  std::vector<std::thread> threads_;
};

}  // namespace

void run_on_all_cores(std::size_t count, const std::function<void(std::size_t)>& task,
                      const std::function<void(double)>& progress) {
  if (count == 0) return;
  Workers workers(count, task);
  const std::size_t cores = std::max(1u, std::thread::hardware_concurrency());
  workers.start(std::min(cores, count) - 1);
  do {
    progress(workers.share());
  } while (workers.work_once());
  workers.wait();
}

}  // namespace osteon
