#pragma once

#include <cstddef>
#include <functional>

namespace osteon {

/// Runs task(0) to task(count - 1) on all cores, each once, taken in their order; returns when all
/// are done. `progress` is told the share done on the calling thread; it may throw to stop: tasks
/// that were begun are then finished and no other is.
void run_on_all_cores(std::size_t count, const std::function<void(std::size_t)>& task,
                      const std::function<void(double)>& progress);

}  // namespace osteon
