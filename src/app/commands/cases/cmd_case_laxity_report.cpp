#include "commands/cases/cmd_case_laxity_report.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <utility>

#include "commands/support/text_table.h"

namespace osteon {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kDegrees = 180 / std::numbers::pi;

Json ligaments_json(const KneeLaxity& found) {
  Json out = Json::array();
  for (const LigamentPull& pull : found.ligaments)
    out.push_back({{"name", pull.name},
                   {"tension_n", pull.tension_n},
                   {"unloaded_n", pull.unloaded_n},
                   {"strain", pull.strain}});
  return out;
}

Json report_json(const LaxityReport& report) {
  const LaxityTestRow& test = report.test;
  const KneeLaxity& found = report.found;
  Json out;
  out["test"] = test.name;
  out["flexion_deg"] = test.flexion_deg;
  if (test.anterior_n != 0) out["load_n"] = test.anterior_n;
  if (test.varus_nm != 0) out["load_nm"] = std::abs(test.varus_nm);
  if (test.internal_nm != 0) out["internal_load_nm"] = test.internal_nm;
  out["anterior_mm"] = 1000 * found.anterior_m;
  out["medial_anterior_mm"] = 1000 * found.medial_anterior_m;
  out["lateral_anterior_mm"] = 1000 * found.lateral_anterior_m;
  out["internal_rotation_deg"] = kDegrees * found.internal_rad;
  out["varus_deg"] = kDegrees * found.varus_rad;
  out["whole_anterior_mm"] = 1000 * report.whole_anterior_m;
  out["side_difference_mm"] = 1000 * (found.anterior_m - report.whole_anterior_m);
  out["contact_n"] = found.contact_n;
  out["ligaments"] = ligaments_json(found);
  out["converged"] = found.converged;
  out["rounds"] = found.rounds;
  out["unbalanced_n"] = found.unbalanced_n;
  return out;
}

std::string load_text(const LaxityTestRow& test) {
  std::string text;
  const auto add = [&](double value, const char* what) {
    if (value != 0) text += (text.empty() ? "" : ", ") + fixed(std::abs(value), 0) + what;
  };
  add(test.anterior_n, test.anterior_n < 0 ? " N back" : " N forwards");
  add(test.varus_nm, test.varus_nm < 0 ? " Nm valgus" : " Nm varus");
  add(test.internal_nm, test.internal_nm < 0 ? " Nm outwards" : " Nm inwards");
  return text;
}

std::string pulls_text(const LaxityReport& report) {
  TextTable table({"ligament", "tension N", "without load N", "strain %"});
  for (const LigamentPull& pull : report.found.ligaments)
    table.add({pull.name, fixed(pull.tension_n, 1), fixed(pull.unloaded_n, 1),
               fixed(100 * pull.strain, 1)});
  return table.text();
}

std::pair<double, double> range_of(const std::vector<LineLength>& lengths) {
  const auto [low, high] = std::minmax_element(
      lengths.begin(), lengths.end(),
      [](const LineLength& a, const LineLength& b) { return a.length_m < b.length_m; });
  return {low->length_m, high->length_m};
}

}  // namespace

std::string laxity_json(const std::string& case_name, const std::string& side,
                        const std::vector<LaxityReport>& reports) {
  Json out;
  out["case"] = case_name;
  out["side"] = side;
  if (reports.size() == 1) {
    out.update(report_json(reports[0]));
  } else {
    out["tests"] = Json::array();
    for (const LaxityReport& report : reports) out["tests"].push_back(report_json(report));
  }
  return out.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string laxity_text(const std::vector<LaxityReport>& reports) {
  TextTable table({"test", "bent deg", "load", "forwards mm", "if intact mm", "inwards deg",
                   "varus deg", "contact N", "at rest"});
  for (const LaxityReport& report : reports)
    table.add({report.test.name, fixed(report.test.flexion_deg, 0), load_text(report.test),
               fixed(1000 * report.found.anterior_m, 1), fixed(1000 * report.whole_anterior_m, 1),
               fixed(kDegrees * report.found.internal_rad, 1),
               fixed(kDegrees * report.found.varus_rad, 1), fixed(report.found.contact_n, 0),
               report.found.converged ? "yes" : "no"});
  std::string text = table.text();
  if (reports.size() == 1) text += "\n" + pulls_text(reports[0]);
  return text;
}

std::string beside_json(const LaxityTestRow& test, const std::vector<LaxityBeside>& knees) {
  Json out;
  out["flexion_deg"] = test.flexion_deg;
  out["load_n"] = test.anterior_n;
  out["knees"] = Json::array();
  for (const LaxityBeside& row : knees)
    out["knees"].push_back({{"knee", row.knee},
                            {"whole_mm", 1000 * row.whole_m},
                            {"without_acl_mm", 1000 * row.without_acl_m}});
  return out.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string beside_text(const LaxityTestRow& test, const std::vector<LaxityBeside>& knees) {
  TextTable table({"knee", "whole mm", "without ACL mm"});
  for (const LaxityBeside& row : knees)
    table.add({row.knee, fixed(1000 * row.whole_m, 1), fixed(1000 * row.without_acl_m, 1)});
  return "bent " + fixed(test.flexion_deg, 0) + " degrees, " + load_text(test) + "\n" +
         table.text();
}

std::string isometry_json(const std::vector<LineLength>& lengths) {
  const auto [low, high] = range_of(lengths);
  Json out;
  out["lengths"] = Json::array();
  for (const LineLength& at : lengths)
    out["lengths"].push_back({{"flexion_deg", at.flexion_deg},
                              {"length_mm", 1000 * at.length_m},
                              {"change_mm", 1000 * (at.length_m - lengths[0].length_m)}});
  out["shortest_mm"] = 1000 * low;
  out["longest_mm"] = 1000 * high;
  out["excursion_mm"] = 1000 * (high - low);
  return out.dump(2) + "\n";
}

std::string isometry_text(const std::vector<LineLength>& lengths) {
  TextTable table({"bent deg", "length mm", "change mm"});
  for (const LineLength& at : lengths)
    table.add({fixed(at.flexion_deg, 0), fixed(1000 * at.length_m, 2),
               fixed(1000 * (at.length_m - lengths[0].length_m), 2)});
  const auto [low, high] = range_of(lengths);
  return table.text() + "changes by " + fixed(1000 * (high - low), 2) + " mm in total\n";
}

}  // namespace osteon
