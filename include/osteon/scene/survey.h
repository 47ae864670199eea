#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "osteon/scene/case.h"
#include "osteon/scene/path.h"
#include "osteon/scene/tool.h"

namespace osteon {

struct SurveyOptions {
  std::uint64_t seed = 1;
  double press_n = 2.0;  ///< wanted normal force
  double stroke_m = 0.010;
  double speed_m_per_s = 0.02;
  double stiffness_n_per_m = 2000;      ///< of the coupling
  double hand_stiffness_n_per_m = 500;  ///< of the grip: how far past the surface the hand must aim
};

struct Survey {
  ProbePath path;
  std::vector<std::string> visited;      ///< bones, in order
  std::vector<std::string> unreachable;  ///< bones without a free straight approach
};

/// A path that visits every bone that a straight approach reaches: press to `press_n` along the
/// surface's normal, stroke, retreat. A function of (case, tool, options).
Survey make_survey(const Case& the_case, const Tool& tool, const SurveyOptions& options);

}  // namespace osteon
