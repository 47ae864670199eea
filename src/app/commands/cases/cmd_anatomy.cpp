#include <charconv>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>
#include "commands/support/parser.h"

#include "cases/make_patient.h"
#include "cases/open_case.h"
#include "cases/whole_folder.h"
#include "commands/support/cli_support.h"
#include "commands/support/commands.h"
#include "commands/support/progress_line.h"
#include "osteon/anatomy/shape_numbers.h"

namespace osteon {
namespace {

struct MakeCommand {
  std::string name, out, side;
  std::optional<std::uint64_t> seed;
  std::vector<std::string> set, findings;
};

Result<ParameterValue> read_set(const std::string& text) {
  const auto equals = text.find('=');
  const std::string where = "--set " + text;
  if (equals == std::string::npos || equals == 0)
    return fail("is not NAME=NUMBER", where, "See osteon anatomy list");
  const char* const first = text.data() + equals + 1;
  const char* const last = text.data() + text.size();
  double value = 0;
  const auto read = std::from_chars(first, last, value);
  if (read.ec != std::errc{} || read.ptr != last || !std::isfinite(value))
    return fail("is not NAME=NUMBER", where, "See osteon anatomy list");
  return ParameterValue{text.substr(0, equals), value};
}

Result<FindingChoice> read_finding(const std::string& text) {
  const auto equals = text.find('=');
  if (equals == std::string::npos || equals == 0 || equals + 1 == text.size())
    return fail("is not NAME=GRADE", "--finding " + text, "See osteon anatomy list");
  return FindingChoice{text.substr(0, equals), text.substr(equals + 1)};
}

Result<PatientOrder> order_of(const MakeCommand& command) {
  PatientOrder order;
  order.anatomy = command.name;
  order.seed = command.seed;
  order.side = command.side;
  for (const std::string& text : command.findings) {
    auto finding = read_finding(text);
    if (!finding) return tl::unexpected(finding.error());
    order.findings.push_back(std::move(*finding));
  }
  for (const std::string& text : command.set) {
    auto value = read_set(text);
    if (!value) return tl::unexpected(value.error());
    order.set.push_back(std::move(*value));
  }
  return order;
}

int run_make(const MakeCommand& command) {
  const auto out = plain_folder(command.out);
  const auto order = order_of(command);
  if (!order) return report_error(order.error());
  ProgressLine line;
  const auto made = make_patient(*order, out, [say = line.callback()](double share) {
    if (!say("Generating the bones", share))
      throw std::runtime_error("stopped; nothing was written");
  });
  if (!made) return report_error(made.error());
  for (const auto& [name, value] : made->values) std::printf("%s = %g\n", name.c_str(), value);
  if (made->halvings > 0)
    std::printf(
        "the bones overlapped: the drawn values were moved half way to their means %d times\n",
        made->halvings);
  for (const CaseFinding& finding : made->findings)
    std::printf("finding %s=%s: %s\n", finding.name.c_str(), finding.grade.c_str(),
                finding.meaning.c_str());
  std::printf("%zu bones, %zu soft parts, %s -> %s\n", made->bones, made->soft_parts,
              made->side.c_str(), out.string().c_str());
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

void print_shape_numbers(const std::vector<ShapeNumbers>& counts) {
  std::printf("\nnumbers that shape each bone, %zu at most\n", kMostShapeNumbers);
  for (const ShapeNumbers& c : counts)
    std::printf("%-12s %-9s %3zu\n", c.bone.c_str(), c.section.c_str(), c.numbers);
}

int run_list(const std::string& name) {
  const auto choices = patient_choices(name);
  if (!choices) return report_error(choices.error());
  const auto files = builtin_anatomy(name);
  if (!files) return report_error(files.error());
  const auto counts = shape_numbers(files->description);
  if (!counts) return report_error(counts.error());
  std::printf("%-26s %7s %6s %6s %6s %9s  %s\n", "parameter", "mean", "sd", "min", "max",
              "built in", "source");
  for (const VariationParameter& p : choices->parameters)
    std::printf("%-26s %7g %6g %6g %6g %9g  %s\n  %s\n", p.name.c_str(), p.mean, p.sd, p.min, p.max,
                p.built_in, p.source.c_str(), p.meaning.c_str());
  print_findings(choices->findings);
  print_shape_numbers(*counts);
  return kExitDone;
}

void add_list(cli::App& anatomy, int& exit_code) {
  cli::App* list =
      anatomy.add_subcommand("list", "List the parameters that can be varied, and their bounds");
  auto name = std::make_shared<std::string>();
  list->add_option("anatomy", *name,
                   "wrist, knee, or a practice box: fast_box, fast_maze, fast_suture, "
                   "fast_meniscus, fast_ring, graft_bench")
      ->required();
  list->callback([name, &exit_code] { exit_code = run_list(*name); });
}

void add_make(cli::App& anatomy, int& exit_code) {
  cli::App* make = anatomy.add_subcommand("make", "Make a case of a varied anatomy");
  auto command = std::make_shared<MakeCommand>();
  make->add_option("anatomy", command->name,
                   "wrist, knee, or a practice box: fast_box, fast_maze, fast_suture, "
                   "fast_meniscus, fast_ring, graft_bench")
      ->required();
  make->add_option("--seed", command->seed,
                   "seed to draw every parameter that is not set; default: built-in values");
  make->add_option("--set", command->set, "NAME=NUMBER, a parameter; may be given several times")
      ->take_all()
      ->expected(1);
  make->add_option("--finding", command->findings,
                   "NAME=GRADE, a pathological finding; may be given several times")
      ->take_all()
      ->expected(1);
  make->add_option("--side", command->side, "left or right; default: right");
  make->add_option("--out", command->out, "the case folder to make")->required();
  make->callback([command, &exit_code] { exit_code = run_make(*command); });
}

}  // namespace

void add_anatomy_commands(cli::App& app, int& exit_code) {
  cli::App* anatomy =
      app.add_subcommand("anatomy", "Built-in anatomy that varies from patient to patient");
  anatomy->require_subcommand(1);
  add_list(*anatomy, exit_code);
  add_make(*anatomy, exit_code);
  add_anatomy_compare(*anatomy, exit_code);
}

}  // namespace osteon
