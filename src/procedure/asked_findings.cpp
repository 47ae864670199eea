#include "osteon/procedure/asked_findings.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace osteon {
namespace {

std::string truth_of(const std::string& name, const Case& the_case) {
  for (const CaseFinding& finding : the_case.findings)
    if (finding.name == name) return finding.grade;
  return kNoFinding;
}

std::string listed(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

Result<void> check_stated(const std::string& name, const std::string& grade,
                          const std::vector<AskedFinding>& asks, const std::string& where) {
  std::vector<std::string> names;
  for (const AskedFinding& asked : asks) {
    names.push_back(asked.name);
    if (asked.name != name) continue;
    if (grade == kNoFinding ||
        std::find(asked.grades.begin(), asked.grades.end(), grade) != asked.grades.end())
      return {};
    return fail("'" + grade + "' is not a grade of " + name, where,
                "Use none, " + listed(asked.grades));
  }
  return fail("the exercise does not ask for '" + name + "'", where,
              names.empty() ? "It asks for no findings" : "It asks for: " + listed(names));
}

}  // namespace

std::vector<GradedFinding> grade_findings(const std::vector<AskedFinding>& asks,
                                          const Case& the_case, const StatedFindings& stated) {
  std::vector<GradedFinding> graded;
  for (const AskedFinding& asked : asks) {
    const auto said = stated.find(asked.name);
    graded.push_back({asked.name, asked.title, said == stated.end() ? "" : said->second,
                      truth_of(asked.name, the_case)});
  }
  return graded;
}

double share_right_percent(const std::vector<GradedFinding>& graded) {
  if (graded.empty()) return 0;
  const auto right = std::count_if(graded.begin(), graded.end(),
                                   [](const GradedFinding& one) { return one.right(); });
  return 100.0 * static_cast<double>(right) / static_cast<double>(graded.size());
}

StatedFindings true_findings(const std::vector<AskedFinding>& asks, const Case& the_case) {
  StatedFindings all;
  for (const AskedFinding& asked : asks) all[asked.name] = truth_of(asked.name, the_case);
  return all;
}

Result<StatedFindings> parse_findings(std::string_view text, const std::vector<AskedFinding>& asks,
                                      const std::string& where) {
  const auto json = nlohmann::json::parse(text, nullptr, false);
  if (!json.is_object())
    return fail("is not a JSON object of findings", where, "Write {\"geissler\": \"3\"}");
  StatedFindings stated;
  for (const auto& [name, grade] : json.items()) {
    if (!grade.is_string())
      return fail("the grade of '" + name + "' is not text", where, "Write {\"geissler\": \"3\"}");
    if (auto ok = check_stated(name, grade, asks, where); !ok) return tl::unexpected(ok.error());
    stated[name] = grade;
  }
  return stated;
}

std::string to_json(const StatedFindings& stated) {
  return nlohmann::ordered_json(stated).dump() + "\n";
}

}  // namespace osteon
