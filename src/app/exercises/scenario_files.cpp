#include "exercises/scenario_files.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "exercises/result_files.h"
#include "exercises/seat_files.h"
#include "osteon/base/file.h"
#include "osteon/base/random.h"
#include "osteon/procedure/attempt.h"
#include "osteon/record/recording_note.h"

namespace osteon {
namespace {

namespace fs = std::filesystem;

Result<fs::path> asset_folder(const char* name) {
  const auto data = find_data_dir();
  if (!data) return tl::unexpected(data.error());
  return *data / "assets" / name;
}

// Side and finding of a drawn patient: a function of the seed and of nothing else.
std::string drawn_words(const Scenario& scenario, std::uint64_t seed) {
  Random random(seed * 6364136223846793005u + 1442695040888963407u);
  const double side = random.uniform(), ill = random.uniform(), which = random.uniform();
  const auto pick = [](const std::vector<std::string>& from, double share) {
    return from[std::min(from.size() - 1,
                         static_cast<std::size_t>(share * static_cast<double>(from.size())))];
  };
  std::string words;
  if (!scenario.sides.empty()) words += ":" + pick(scenario.sides, side);
  if (!scenario.findings.empty() && ill < 0.5) words += ":" + pick(scenario.findings, which);
  for (const std::string& word : scenario.always) words += ":" + word;
  // In turn: as many patients one after the other have them all.
  if (!scenario.one_of.empty()) words += ":" + scenario.one_of[seed % scenario.one_of.size()];
  return words;
}

// A report that is no JSON is refused by who reads it next.
std::string with_recording(const std::string& report_json, const fs::path& recording) {
  auto report = nlohmann::ordered_json::parse(report_json, nullptr, false);
  if (recording.empty() || !report.is_object()) return report_json;
  std::error_code ec;
  const fs::path whole = fs::absolute(recording, ec);
  report["recording"] = (ec ? recording : whole).string();
  return report.dump(2);
}

}  // namespace

Result<std::vector<Scenario>> shipped_scenarios() {
  const auto folder = asset_folder("scenarios");
  if (!folder) return tl::unexpected(folder.error());
  std::vector<fs::path> files;
  std::error_code ec;
  for (const auto& entry : fs::directory_iterator(*folder, ec))
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  if (ec) return fail("cannot be read (" + ec.message() + ")", folder->string());
  std::sort(files.begin(), files.end());
  std::vector<Scenario> scenarios;
  for (const fs::path& file : files) {
    auto scenario = load_scenario(file);
    if (!scenario) return tl::unexpected(scenario.error());
    scenarios.push_back(std::move(*scenario));
  }
  return scenarios;
}

Result<Scenario> open_scenario(const std::string& spec) {
  std::error_code ec;
  if (fs::is_regular_file(spec, ec)) return load_scenario(spec);
  const auto all = all_exercises();
  if (!all) return tl::unexpected(all.error());
  std::string names;
  for (const Scenario& scenario : all->scenarios) {
    if (scenario.name == spec) return scenario;
    names += (names.empty() ? "" : ", ") + scenario.name;
  }
  for (const Error& fault : all->faults) names += "\nleft out: " + fault.message();
  return fail("there is no scenario '" + spec + "' and no file of that name", "scenario",
              "Use one of: " + names);
}

Result<std::optional<Standard>> shipped_standard(const std::string& scenario) {
  const auto folder = asset_folder("standards");
  if (!folder) return tl::unexpected(folder.error());
  const fs::path file = *folder / (scenario + ".toml");
  std::error_code ec;
  if (!fs::exists(file, ec)) return std::optional<Standard>{};
  auto standard = load_standard(file);
  if (!standard) return tl::unexpected(standard.error());
  return std::optional<Standard>(std::move(*standard));
}

std::string case_spec_of(const Scenario& scenario, const std::string& case_spec,
                         std::optional<std::uint64_t> seed) {
  std::string spec = case_spec;
  if (spec.empty()) spec = "builtin:" + scenario.anatomy;
  // What every patient of the exercise has stands behind a seed alone.
  if (!(scenario.always.empty() && scenario.one_of.empty()) && !seed) seed = 0;
  if (case_spec.empty() && seed) spec += ":" + std::to_string(*seed) + drawn_words(scenario, *seed);
  if (spec.find('#') != std::string::npos) return spec;
  std::string felt = scenario.felt == "pieces" ? "" : scenario.felt;
  for (const std::string& bone : scenario.fields)
    felt += (felt.empty() ? "" : ",") + bone + "=field";
  if (!felt.empty()) spec += "#" + felt;
  return spec;
}

CarveSettings carve_settings(const Scenario& scenario) {
  CarveSettings carve;
  carve.cortex_m = scenario.cortex_mm / 1000;
  carve.irrigation_ml_per_min = scenario.irrigation_ml_per_min;
  return carve;
}

Result<void> note_attempt(const fs::path& recording, const Scenario& scenario,
                          const std::optional<Standard>& standard, const std::string& by,
                          const std::string& report_json) {
  if (!scenario.source_text.empty())
    if (auto ok = write_note(recording, "scenario", scenario.source_text); !ok) return ok;
  if (standard)
    if (auto ok = write_note(recording, "standard", to_toml(*standard)); !ok) return ok;
  if (auto ok = write_note(recording, "surgeon", by); !ok) return ok;
  return write_note(recording, "report", report_json);
}

Result<std::optional<Error>> keep_report(const std::string& report_json, const std::string& learner,
                                         const fs::path& recording) {
  const auto row = row_from_report(with_recording(report_json, recording), learner);
  if (!row) return tl::unexpected(row.error());
  const auto kept = keep_attempt(*row, results_place(), waiting_folder());
  if (!kept) return tl::unexpected(kept.error());
  return kept->in_store ? std::optional<Error>{} : kept->why_waiting;
}

}  // namespace osteon
