#include "cases/make_patient.h"

#include <charconv>
#include <cstdio>
#include <utility>

#include "cases/all_cores.h"
#include "cases/open_case.h"
#include "cases/pose_case.h"
#include "cases/whole_folder.h"
#include "osteon/base/file.h"
#include "osteon/scene/case_io.h"

namespace osteon {
namespace {

std::string short_number(double v) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", v);
  return text;
}

std::string exact_number(double v) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, v);
  return std::string(text, end.ptr);
}

/// As comments of case.toml.
std::string provenance(const PatientOrder& order, const VariedAnatomy& varied) {
  std::string text = "# Made by: " + command_of(order) + "\n";
  if (varied.halvings > 0)
    text += "# Bones overlapped: drawn values were moved half way to their means " +
            std::to_string(varied.halvings) + " times.\n";
  for (const auto& [name, value] : varied.values)
    text += "# " + name + " = " + short_number(value) + "\n";
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

}  // namespace

Result<PatientChoices> patient_choices(const std::string& anatomy) {
  const auto files = builtin_anatomy(anatomy);
  if (!files) return tl::unexpected(files.error());
  auto parameters = list_variation(files->table);
  if (!parameters) return tl::unexpected(parameters.error());
  auto findings = list_findings(files->findings);
  if (!findings) return tl::unexpected(findings.error());
  return PatientChoices{std::move(*parameters), std::move(*findings)};
}

std::string command_of(const PatientOrder& order) {
  std::string text = "osteon anatomy make " + order.anatomy;
  if (order.seed) text += " --seed " + std::to_string(*order.seed);
  for (const auto& [name, value] : order.set) text += " --set " + name + "=" + exact_number(value);
  for (const FindingChoice& f : order.findings) text += " --finding " + f.finding + "=" + f.grade;
  if (!order.side.empty()) text += " --side " + order.side;
  return text;
}

Result<VariedAnatomy> grow_patient(const PatientOrder& order,
                                   const std::function<void(double)>& progress, bool soft_parts) {
  const auto files = builtin_anatomy(order.anatomy);
  if (!files) return tl::unexpected(files.error());
  VariationRequest request;
  request.findings_table = files->findings;
  request.findings = order.findings;
  request.seed = order.seed;
  request.side = order.side;
  request.set = order.set;
  GenerateOptions options;
  options.progress = progress;
  options.run = run_on_all_cores;
  options.soft_parts = soft_parts;
  return generate_varied(files->description, files->table, request, options);
}

Result<MadePatient> make_patient(const PatientOrder& order, const std::filesystem::path& out,
                                 const std::function<void(double)>& progress) {
  if (const auto free = refuse_existing(out); !free) return tl::unexpected(free.error());
  auto varied = grow_patient(order, progress);
  if (!varied) return tl::unexpected(varied.error());
  const std::string note = provenance(order, *varied);
  CaseDef def = case_from(std::move(varied->anatomy));
  def.recipe = recipe_of(order);
  const auto saved = write_whole_folder(
      out, [&](const std::filesystem::path& part) { return save_with_note(def, note, part); });
  if (!saved) return tl::unexpected(saved.error());
  return MadePatient{std::move(varied->values), varied->halvings, def.findings,
                     def.bones.size(),          def.softs.size(), def.side};
}

}  // namespace osteon
