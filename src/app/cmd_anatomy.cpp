#include <CLI/CLI.hpp>
#include <charconv>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "all_cores.h"
#include "cli_support.h"
#include "commands.h"
#include "open_case.h"
#include "osteon/anatomy/variation.h"
#include "osteon/base/file.h"
#include "osteon/scene/case_io.h"
#include "progress_line.h"
#include "whole_folder.h"

namespace osteon {
namespace {

struct MakeCommand {
  std::string name, out, side;
  std::optional<std::uint64_t> seed;
  std::vector<std::string> set, findings;
};

std::string shown(double v) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", v);
  return text;
}

Result<ParameterValue> read_set(const std::string& text) {
  const auto equals = text.find('=');
  const std::string where = "--set " + text;
  if (equals == std::string::npos || equals == 0)
    return fail("is not NAME=NUMBER", where, "See osteon anatomy list");
  const char* const first = text.data() + equals + 1;
  const char* const last = text.data() + text.size();
  double value = 0;
  const auto read = std::from_chars(first, last, value);
  if (read.ec != std::errc{} || read.ptr != last)
    return fail("is not NAME=NUMBER", where, "See osteon anatomy list");
  return ParameterValue{text.substr(0, equals), value};
}

Result<FindingChoice> read_finding(const std::string& text) {
  const auto equals = text.find('=');
  if (equals == std::string::npos || equals == 0 || equals + 1 == text.size())
    return fail("is not NAME=GRADE", "--finding " + text, "See osteon anatomy list");
  return FindingChoice{text.substr(0, equals), text.substr(equals + 1)};
}

Result<VariationRequest> request_of(const MakeCommand& command, const AnatomyFiles& files) {
  VariationRequest request;
  request.findings_table = files.findings;
  for (const std::string& text : command.findings) {
    auto finding = read_finding(text);
    if (!finding) return tl::unexpected(finding.error());
    request.findings.push_back(std::move(*finding));
  }
  request.seed = command.seed;
  request.side = command.side;
  for (const std::string& text : command.set) {
    auto value = read_set(text);
    if (!value) return tl::unexpected(value.error());
    request.set.push_back(std::move(*value));
  }
  return request;
}

/// As comments of case.toml: the command that makes this case again, and every value used.
std::string provenance(const MakeCommand& command, const VariedAnatomy& varied) {
  std::string text = "# Made by: osteon anatomy make " + command.name;
  if (command.seed) text += " --seed " + std::to_string(*command.seed);
  for (const std::string& set : command.set) text += " --set " + set;
  for (const std::string& finding : command.findings) text += " --finding " + finding;
  if (!command.side.empty()) text += " --side " + command.side;
  text += "\n";
  if (varied.halvings > 0)
    text += "# Bones met: drawn values were moved half the way to their means " +
            std::to_string(varied.halvings) + " times.\n";
  for (const auto& [name, value] : varied.values) text += "# " + name + " = " + shown(value) + "\n";
  return text;
}

Result<void> save_with_note(const CaseDef& def, const std::string& note,
                            const std::filesystem::path& folder) {
  if (auto saved = save_case(def, folder); !saved) return saved;
  const auto file = folder / "case.toml";
  const auto text = read_file(file, 4u << 20);
  if (!text) return tl::unexpected(text.error());
  return write_file_atomic(file, note + *text);
}

Result<VariedAnatomy> grow(const MakeCommand& command) {
  const auto files = builtin_anatomy(command.name);
  if (!files) return tl::unexpected(files.error());
  const auto request = request_of(command, *files);
  if (!request) return tl::unexpected(request.error());
  ProgressLine line;
  GenerateOptions options;
  options.progress = [say = line.callback()](double share) {
    if (!say("Growing the bones", share)) throw std::runtime_error("stopped; nothing was written");
  };
  options.run = run_on_all_cores;
  return generate_varied(files->description, files->table, *request, options);
}

int run_make(const MakeCommand& command) {
  const auto out = plain_folder(command.out);
  if (const auto free = refuse_existing(out); !free) return report_error(free.error());
  auto varied = grow(command);
  if (!varied) return report_error(varied.error());
  const std::string note = provenance(command, *varied);
  const CaseDef def = case_from(std::move(varied->anatomy));
  const auto saved = write_whole_folder(
      out, [&](const std::filesystem::path& part) { return save_with_note(def, note, part); });
  if (!saved) return report_error(saved.error());
  for (const auto& [name, value] : varied->values) std::printf("%s = %g\n", name.c_str(), value);
  if (varied->halvings > 0)
    std::printf("bones met: drawn values were moved half the way to their means %d times\n",
                varied->halvings);
  for (const CaseFinding& finding : def.findings)
    std::printf("finding %s=%s: %s\n", finding.name.c_str(), finding.grade.c_str(),
                finding.meaning.c_str());
  std::printf("%zu bones, %zu soft parts, %s -> %s\n", def.bones.size(), def.softs.size(),
              def.side.c_str(), out.string().c_str());
  return kExitDone;
}

void print_findings(const std::vector<AnatomyFinding>& findings) {
  std::printf("\nfindings, as --finding NAME=GRADE\n");
  for (const AnatomyFinding& finding : findings) {
    std::printf("%s: %s  [%s]\n", finding.name.c_str(), finding.meaning.c_str(),
                finding.source.c_str());
    for (const FindingGrade& grade : finding.grades)
      std::printf("  %-14s %s\n", grade.name.c_str(), grade.meaning.c_str());
  }
}

int run_list(const std::string& name) {
  const auto files = builtin_anatomy(name);
  if (!files) return report_error(files.error());
  const auto parameters = list_variation(files->table);
  if (!parameters) return report_error(parameters.error());
  std::printf("%-26s %7s %6s %6s %6s %9s  %s\n", "parameter", "mean", "sd", "min", "max",
              "built in", "source");
  for (const VariationParameter& p : *parameters)
    std::printf("%-26s %7g %6g %6g %6g %9g  %s\n  %s\n", p.name.c_str(), p.mean, p.sd, p.min, p.max,
                p.built_in, p.source.c_str(), p.meaning.c_str());
  const auto findings = list_findings(files->findings);
  if (!findings) return report_error(findings.error());
  print_findings(*findings);
  return kExitDone;
}

void add_list(CLI::App& anatomy, int& exit_code) {
  CLI::App* list = anatomy.add_subcommand("list", "Say what can be varied, and how far");
  auto name = std::make_shared<std::string>();
  list->add_option("anatomy", *name, "wrist or knee")->required();
  list->callback([name, &exit_code] { exit_code = run_list(*name); });
}

void add_make(CLI::App& anatomy, int& exit_code) {
  CLI::App* make = anatomy.add_subcommand("make", "Make a case of a varied anatomy");
  auto command = std::make_shared<MakeCommand>();
  make->add_option("anatomy", command->name, "wrist or knee")->required();
  make->add_option("--seed", command->seed,
                   "draw every parameter that is not set; none: as built in");
  make->add_option("--set", command->set, "NAME=NUMBER; may be given several times")
      ->take_all()
      ->expected(1);
  make->add_option("--finding", command->findings,
                   "NAME=GRADE, what is wrong with the patient; may be given several times")
      ->take_all()
      ->expected(1);
  make->add_option("--side", command->side, "left or right (default: right)");
  make->add_option("--out", command->out, "the case folder to make")->required();
  make->callback([command, &exit_code] { exit_code = run_make(*command); });
}

}  // namespace

void add_anatomy_commands(CLI::App& app, int& exit_code) {
  CLI::App* anatomy =
      app.add_subcommand("anatomy", "Built-in anatomy that varies from patient to patient");
  anatomy->require_subcommand(1);
  add_list(*anatomy, exit_code);
  add_make(*anatomy, exit_code);
  add_anatomy_compare(*anatomy, exit_code);
}

}  // namespace osteon
