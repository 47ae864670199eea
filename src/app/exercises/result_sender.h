#pragma once

#include <filesystem>

namespace osteon {

/// Where the last sending in the background wrote what came of it.
std::filesystem::path sending_log();

/// Begins `osteon results send` as a program of its own where the environment names a learning
/// record store (OSTEON_LRS, with OSTEON_LRS_USER, OSTEON_LRS_PASSWORD, OSTEON_LRS_CERTIFICATES),
/// and does not wait for it: neither its time nor its failure is the caller's. What is not sent
/// stays kept, and goes with the next one. False: no store is named, or nothing could be begun.
bool send_results_in_background();

}  // namespace osteon
