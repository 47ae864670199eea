#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "osteon/base/result.h"

namespace osteon {

/// Who the learners' ids stand for: the one place where names are, so that deleting it leaves
/// attempts that nobody can be found by. JSON, {"id": "name"}; a file that is not there is empty.
using LearnerNames = std::map<std::string, std::string>;
Result<LearnerNames> load_names(const std::filesystem::path& file);
Result<void> save_names(const LearnerNames& names, const std::filesystem::path& file);

}  // namespace osteon
