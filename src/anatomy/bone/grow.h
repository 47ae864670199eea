#pragma once

#include <cstddef>
#include <functional>
#include <string>

#include "describe/description.h"
#include "osteon/anatomy/generate.h"

namespace osteon {

/// Grows one bone, at rest. It need not be one of the description's own: a changed copy will do.
Result<GeneratedBone> grow_bone(const AnatomyDescription& anatomy, const BoneDescription& bone,
                                const GenerateOptions& options, const std::string& file);

/// Grows every bone of a description that is in memory, where its findings move it, and places its
/// landmarks; `file` names it in errors. Bones are not parted yet (split_bones.h), and soft parts
/// not grown (soft_grow.h).
Result<GeneratedAnatomy> grow_bones(const AnatomyDescription& anatomy,
                                    const GenerateOptions& options, const std::string& file);

/// Runs the tasks as the options say, else one after the other.
void run_tasks(const GenerateOptions& options, std::size_t count,
               const std::function<void(std::size_t)>& task,
               const std::function<void(double)>& progress = {});

}  // namespace osteon
