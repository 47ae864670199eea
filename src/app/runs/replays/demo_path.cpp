#include "runs/replays/demo_path.h"

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "cases/felt_choice.h"
#include "osteon/base/file.h"
#include "osteon/scene/survey.h"

namespace osteon {
namespace fs = std::filesystem;
namespace {

constexpr const char* kBuiltin = "builtin:";

// "builtin:wrist" -> assets/paths/wrist_survey.csv, else the first wrist*.csv there.
fs::path shipped_path(const std::string& case_source) {
  const auto choice = parse_felt_choice(case_source);
  if (!choice || !choice->source.starts_with(kBuiltin)) return {};
  const auto data = find_data_dir();
  if (!data) return {};
  const std::string stem = choice->source.substr(std::string(kBuiltin).size());
  const fs::path folder = *data / "assets" / "paths";
  std::error_code ec;
  const fs::path survey = folder / (stem + "_survey.csv");
  if (fs::is_regular_file(survey, ec)) return survey;
  std::vector<fs::path> found;
  for (const auto& entry : fs::directory_iterator(folder, ec))
    if (entry.path().extension() == ".csv" && entry.path().filename().string().starts_with(stem))
      found.push_back(entry.path());
  return found.empty() ? fs::path() : *std::min_element(found.begin(), found.end());
}

}  // namespace

ProbePath demo_path(const Case& the_case, const std::string& case_source) {
  if (const fs::path file = shipped_path(case_source); !file.empty())
    if (auto path = load_path(file); path && !path->samples.empty()) return std::move(*path);
  return make_survey(the_case, make_wrist_probe(), SurveyOptions{}).path;
}

}  // namespace osteon
