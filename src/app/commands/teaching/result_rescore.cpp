#include <algorithm>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>

#include "cases/all_cores.h"
#include "commands/support/cli_support.h"
#include "commands/support/progress_line.h"
#include "commands/teaching/result_sending.h"
#include "exercises/debrief.h"
#include "osteon/base/file.h"
#include "osteon/base/hash.h"

namespace osteon {
namespace {

namespace fs = std::filesystem;

// Which of the recordings are this process's: those whose number leaves `index` over `count`.
struct Slice {
  std::size_t index = 0, count = 1;
};

struct RescoreCommand {
  std::vector<std::string> from;
  std::string out, scenario, standard, slice;
};

struct RescoreJob {
  fs::path recording, out;
};

std::optional<std::size_t> whole_number(std::string_view text) {
  std::size_t value = 0;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (fault != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::optional<std::size_t> number_in_environment(const char* name) {
  const char* text = std::getenv(name);
  return text ? whole_number(text) : std::nullopt;
}

// "--slice 3/8", else Slurm's job array (sbatch --array=0-7), else all.
Result<Slice> slice_of(const std::string& text) {
  if (text.empty()) {
    const auto id = number_in_environment("SLURM_ARRAY_TASK_ID");
    const auto count = number_in_environment("SLURM_ARRAY_TASK_COUNT");
    if (!id || !count || *count == 0) return Slice{};
    const std::size_t first = number_in_environment("SLURM_ARRAY_TASK_MIN").value_or(0);
    const std::size_t last = number_in_environment("SLURM_ARRAY_TASK_MAX").value_or(*count - 1);
    const std::size_t step = *count > 1 && last > first ? (last - first) / (*count - 1) : 1;
    return Slice{*id < first ? 0 : (*id - first) / std::max<std::size_t>(1, step) % *count, *count};
  }
  const std::size_t bar = text.find('/');
  const auto index = whole_number(std::string_view(text).substr(0, bar));
  const auto count = bar == std::string::npos
                         ? std::nullopt
                         : whole_number(std::string_view(text).substr(bar + 1));
  if (!index || !count || *count == 0 || *index < 1 || *index > *count)
    return fail("'" + text + "' is not a slice", "--slice", "Give it as I/N, with I from 1 to N");
  return Slice{*index - 1, *count};
}

void add_recordings(const fs::path& from, std::vector<fs::path>& files) {
  std::error_code ec;
  if (!fs::is_directory(from, ec)) {
    files.push_back(from);
    return;
  }
  for (const auto& entry : fs::recursive_directory_iterator(from, ec))
    if (entry.path().extension() == ".osr") files.push_back(entry.path());
}

// In an order that every slice sees alike. Two recordings of one name would be one file.
Result<std::vector<RescoreJob>> rescore_jobs(const RescoreCommand& command, const Slice& slice) {
  std::vector<fs::path> files;
  for (const std::string& from : command.from) add_recordings(from, files);
  std::sort(files.begin(), files.end());
  files.erase(std::unique(files.begin(), files.end()), files.end());
  if (files.empty())
    return fail("no recording was found", command.from.front(), "Name .osr files or their folder");
  std::map<std::string, fs::path> names;
  std::vector<RescoreJob> jobs;
  for (std::size_t i = 0; i < files.size(); ++i) {
    const std::string name = files[i].stem().string() + ".json";
    if (const auto [it, added] = names.emplace(name, files[i]); !added)
      return fail("two recordings have the same name",
                  it->second.string() + ", " + files[i].string(),
                  "Rename one, or judge the two folders separately");
    if (i % slice.count == slice.index) jobs.push_back({files[i], fs::path(command.out) / name});
  }
  return jobs;
}

// What the judgement was made of: another standard, scenario or recording is judged anew.
Result<std::string> made_of(const RescoreJob& job, const RescoreCommand& command) {
  std::error_code ec;
  const auto size = fs::file_size(job.recording, ec);
  if (ec) return fail("there is no such recording", job.recording.string(), "");
  std::string text = std::to_string(size) + "|" + command.scenario + "|" + command.standard;
  for (const std::string& file : {command.scenario, command.standard})
    if (fs::is_regular_file(file, ec)) {
      const auto bytes = read_file(file);
      if (!bytes) return tl::unexpected(bytes.error());
      text += "|" + *bytes;
    }
  Hasher hash;
  hash.add(text);
  char digits[20];
  std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(hash.value()));
  return std::string(digits);
}

bool is_judged(const RescoreJob& job, const std::string& made_of) {
  std::error_code ec;
  if (!fs::exists(job.out, ec)) return false;
  const auto text = read_file(job.out);
  if (!text) return false;
  const auto json = nlohmann::json::parse(*text, nullptr, false);
  return json.is_object() && json.value("made_of", "") == made_of;
}

enum class Rescored { kJudged, kThere, kDifferent };

Result<Rescored> rescore_one(const RescoreJob& job, const RescoreCommand& command) {
  const auto mark = made_of(job, command);
  if (!mark) return tl::unexpected(mark.error());
  if (is_judged(job, *mark)) return Rescored::kThere;
  const auto debrief = make_debrief({job.recording, "", command.scenario, command.standard});
  if (!debrief) return tl::unexpected(debrief.error());
  if (!debrief->outcome)
    return fail("the recording holds no exercise", job.recording.string(),
                "Name one with --scenario");
  auto json = nlohmann::ordered_json::parse(report_of(*debrief));
  json["recording"] = job.recording.string();
  json["surgeon"] = debrief->surgeon;
  json["identical"] = debrief->identical;
  json["made_of"] = *mark;
  if (auto ok = write_file_atomic(job.out, json.dump(2) + "\n"); !ok)
    return tl::unexpected(ok.error());
  return debrief->identical ? Rescored::kJudged : Rescored::kDifferent;
}

int rescore_results(const RescoreCommand& command) {
  const auto slice = slice_of(command.slice);
  if (!slice) return report_error(slice.error());
  const auto jobs = rescore_jobs(command, *slice);
  if (!jobs) return report_error(jobs.error());
  std::error_code ec;
  fs::create_directories(command.out, ec);
  if (!fs::is_directory(command.out, ec))
    return report_error({"the folder cannot be made", command.out, "Choose another with --out"});
  std::map<Rescored, std::size_t> count;
  std::size_t failed = 0;
  std::mutex counting;
  ProgressLine line;
  const auto stop = line.stopping();
  run_on_all_cores(
      jobs->size(),
      [&](std::size_t i) {
        const auto done = rescore_one((*jobs)[i], command);
        const std::lock_guard lock(counting);
        if (done) return void(++count[*done]);
        ++failed;
        std::fprintf(stderr, "osteon: %s\n", done.error().message().c_str());
      },
      [&](double share) { stop("Judging", share); });
  std::printf(
      "%zu recordings: %zu judged, %zu already judged, %zu failed, %zu differ when replayed\n",
      jobs->size(), count[Rescored::kJudged] + count[Rescored::kDifferent], count[Rescored::kThere],
      failed, count[Rescored::kDifferent]);
  return failed + count[Rescored::kDifferent] > 0 ? kExitNo : kExitDone;
}

}  // namespace

void add_result_rescore(cli::App& results, int& exit_code) {
  auto options = std::make_shared<RescoreCommand>();
  cli::App* command = results.add_subcommand(
      "rescore",
      "Judge recorded attempts again, on all cores, and write one JSON report each. Recordings\n"
      "that are already judged are skipped, so a stopped run can continue. In a Slurm job array\n"
      "each task takes its share");
  command->add_option("recordings", options->from, "recordings (.osr), or folders of them")
      ->required();
  command->add_option("--out", options->out, "folder for the reports")->required();
  command->add_option("--scenario", options->scenario,
                      "name or file; default: the one stored in each recording");
  command->add_option("--standard", options->standard,
                      "standard to judge against, TOML; default: the one that was used");
  command->add_option("--slice", options->slice, "I/N: only the Ith of N shares");
  command->callback([options, &exit_code] { exit_code = rescore_results(*options); });
}

}  // namespace osteon
