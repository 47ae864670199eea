#include "exercises/result_files.h"

#include <cstdlib>

#include "cases/xdg.h"

namespace osteon {

std::string results_place() {
  const char* place = std::getenv("OSTEON_RESULTS");
  return place && *place ? std::string(place) : (data_home_dir() / "results.sqlite").string();
}
std::filesystem::path waiting_folder() { return data_home_dir() / "waiting"; }
std::filesystem::path names_file() { return data_home_dir() / "learners.json"; }

// A seat that several people use names them.
std::string learner_here() {
  const char* given = std::getenv("OSTEON_LEARNER");
  return given && is_learner_id(given) ? given : "local";
}

Result<ResultStore> open_results() {
  auto store = ResultStore::open(results_place());
  if (!store) return store;
  if (const auto taken = take_waiting(*store, waiting_folder()); !taken)
    return tl::unexpected(taken.error());
  return store;
}

}  // namespace osteon
