#include "runs/reports/exam_report.h"

#include <cstdio>
#include <nlohmann/json.hpp>

namespace osteon {
namespace {

constexpr const char* kKneeNames[] = {"found", "grafted"};
constexpr const char* kTestNames[] = {"lachman", "pivot"};

nlohmann::ordered_json found_json(const KneeTestFound& found, const KneeExam& exam, KneeTest test) {
  nlohmann::ordered_json json;
  json["flexion_deg"] = found.flexion_deg;
  if (test == KneeTest::kLachman) {
    json["force_n"] = found.share * exam.front_n;
  } else {
    json["valgus_nm"] = found.share * exam.valgus_nm;
    json["internal_nm"] = found.share * exam.internal_nm;
  }
  json["anterior_mm"] = 1e3 * found.front_m;
  json["whole_anterior_mm"] = 1e3 * found.other_front_m;
  json["side_difference_mm"] = 1e3 * found.side_difference_m();
  return json;
}

}  // namespace

nlohmann::ordered_json to_json(const KneeExam& exam) {
  nlohmann::ordered_json json;
  for (std::size_t k = 0; k < exam.found.size(); ++k)
    for (std::size_t i = 0; i < kKneeTests; ++i) {
      auto& entry = json[kKneeNames[k]][kTestNames[i]];
      entry = nullptr;
      if (const auto& found = exam.found[k][i])
        entry = found_json(*found, exam, static_cast<KneeTest>(i));
    }
  return json;
}

std::string to_text(const KneeExam& exam) {
  constexpr const char* kKnees[] = {"as it was found", "with the graft"};
  constexpr const char* kTests[] = {"Lachman", "pivot shift"};
  std::string text;
  char line[160];
  for (std::size_t k = 0; k < exam.found.size(); ++k)
    for (std::size_t i = 0; i < kKneeTests; ++i) {
      const auto& found = exam.found[k][i];
      const std::string what = std::string(kTests[i]) + " by hand, " + kKnees[k];
      if (!found) {
        std::snprintf(line, sizeof line, "%-44s not done\n", what.c_str());
      } else {
        std::snprintf(line, sizeof line, "%-44s %6.1f mm at %.0f degrees, %.1f more than intact\n",
                      what.c_str(), 1e3 * found->front_m, found->flexion_deg,
                      1e3 * found->side_difference_m());
      }
      text += line;
    }
  return text;
}

}  // namespace osteon
