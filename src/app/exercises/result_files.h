#pragma once

#include <filesystem>
#include <string>

#include "osteon/base/result.h"
#include "osteon/results/store.h"

namespace osteon {

/// Where a user's results are: attempts (OSTEON_RESULTS: a file or
/// "postgresql://USER@HOST/DATABASE", else a file of the user's), attempts that wait for the store,
/// names.
std::string results_place();
std::filesystem::path waiting_folder();
std::filesystem::path names_file();
/// Whose attempts are made in this window: OSTEON_LEARNER where that is an id, else "local".
std::string learner_here();

/// The recording that a user names by its file or by the id of a stored attempt. Fails where the
/// attempt is not there, was not recorded, or its recording is gone.
Result<std::filesystem::path> recording_named(const std::string& file_or_id);

/// The store with every waiting attempt taken in.
Result<ResultStore> open_results();

}  // namespace osteon
