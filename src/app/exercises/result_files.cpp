#include "exercises/result_files.h"

#include <cstdlib>
#include <nlohmann/json.hpp>

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

Result<std::filesystem::path> recording_named(const std::string& file_or_id) {
  std::error_code ec;
  if (!is_uuid(file_or_id) || std::filesystem::exists(file_or_id, ec))
    return std::filesystem::path(file_or_id);
  const auto store = open_results();
  if (!store) return tl::unexpected(store.error());
  const auto row = store->find(file_or_id);
  if (!row) return tl::unexpected(row.error());
  if (!*row)
    return fail("there is no attempt '" + file_or_id + "'", without_password(results_place()),
                "See: osteon results list");
  const auto report = nlohmann::json::parse((*row)->report_json, nullptr, false);
  const auto file = report.is_object() ? report.find("recording") : report.end();
  if (file == report.end() || !file->is_string())
    return fail("the attempt was not recorded", file_or_id, "Record attempts: osteon run --record");
  const std::filesystem::path recording(file->get<std::string>());
  if (!std::filesystem::exists(recording, ec))
    return fail("the attempt's recording is gone", recording.string(),
                "Attempts of other seats have theirs on the seat where they were made");
  return recording;
}

Result<ResultStore> open_results() {
  auto store = ResultStore::open(results_place());
  if (!store) return store;
  if (const auto taken = take_waiting(*store, waiting_folder()); !taken)
    return tl::unexpected(taken.error());
  return store;
}

}  // namespace osteon
