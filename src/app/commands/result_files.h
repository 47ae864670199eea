#pragma once

#include <filesystem>

#include "osteon/base/result.h"
#include "osteon/results/store.h"

namespace osteon {

/// Where a user's results are: attempts, attempts that wait for the store, names.
std::filesystem::path results_file();
std::filesystem::path waiting_folder();
std::filesystem::path names_file();

/// The store with every waiting attempt taken in.
Result<ResultStore> open_results();

}  // namespace osteon
