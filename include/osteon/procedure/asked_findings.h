#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/procedure/scenario.h"
#include "osteon/scene/case.h"

namespace osteon {

/// What somebody says is wrong with a patient: finding and grade. A finding that is left out is not
/// stated at all; one that is not there is stated as kNoFinding.
using StatedFindings = std::map<std::string, std::string>;
inline constexpr const char* kNoFinding = "none";
/// The grade of what was made well: "old_tunnel=sound".
inline constexpr const char* kSoundGrade = "sound";
/// Metric of an attempt whose scenario asks: the share of what is asked that was stated as it is.
inline constexpr const char* kFindingsRight = "findings_right_percent";

/// One thing that a scenario asked, with what was stated and what is so.
struct GradedFinding {
  std::string name, title;
  std::string stated;  ///< empty: nothing
  std::string truth;
  bool right() const { return stated == truth; }
};
/// What was stated beside what the case has, in the order in which it is asked.
std::vector<GradedFinding> grade_findings(const std::vector<AskedFinding>& asks,
                                          const Case& the_case, const StatedFindings& stated);
double share_right_percent(const std::vector<GradedFinding>& graded);
/// What is so, of all that is asked.
StatedFindings true_findings(const std::vector<AskedFinding>& asks, const Case& the_case);

/// A JSON object of grades, {"geissler": "3", "tfcc_tear": "none"}. Fails on anything else, and on
/// a finding or a grade that the scenario does not ask for. `where`: for the message.
Result<StatedFindings> parse_findings(std::string_view json, const std::vector<AskedFinding>& asks,
                                      const std::string& where);
std::string to_json(const StatedFindings& stated);

}  // namespace osteon
