#pragma once

#include <optional>
#include <string>
#include <vector>

#include "osteon/base/result.h"

namespace osteon {

/// One exercise as a learning management system launches it: an assignable unit.
struct Cmi5Unit {
  std::string scenario;           ///< its name, as in the launch address
  std::string title, text;        ///< UTF-8
  std::optional<double> mastery;  ///< least scaled score to pass, 0 to 1; none: any
};

struct Cmi5Course {
  std::string id;           ///< an absolute address (IRI) that is the course's alone
  std::string title, text;  ///< UTF-8
  std::string seed;         ///< of the patient of every unit; empty: the one that is described
  std::vector<Cmi5Unit> units;
};

/// The course structure (cmi5.xml) that such a system imports. Each unit is launched in a window of
/// its own as osteon://launch/NAME and is done once it is passed. Fails on a course without a unit,
/// without a title, or whose id is no address. Source: cmi5 first edition (Quartz), 13 and 14.
Result<std::string> cmi5_course_xml(const Cmi5Course& course);

}  // namespace osteon
