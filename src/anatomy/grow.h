#pragma once

#include <cstddef>
#include <functional>
#include <string>

#include "description.h"
#include "osteon/anatomy/generate.h"

namespace osteon {

/// Grows every bone of a description that is in memory, and places its landmarks; `file` names it
/// in errors. Soft parts are not grown: see soft_grow.h.
Result<GeneratedAnatomy> grow_bones(const AnatomyDescription& anatomy,
                                    const GenerateOptions& options, const std::string& file);

/// Runs the tasks as the options say, else one after the other.
void run_tasks(const GenerateOptions& options, std::size_t count,
               const std::function<void(std::size_t)>& task,
               const std::function<void(double)>& progress = {});

}  // namespace osteon
