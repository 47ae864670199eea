#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/base/types.h"
#include "osteon/render/scope_camera.h"
#include "osteon/scene/build_case.h"
#include "osteon/scene/case.h"

namespace osteon {

/// A view through a scope that a student meets in every joint of a kind.
struct StandardView {
  std::string name, title, scope;
  double flexion_deg = 0;
  /// What is wrong with the patient in this view, "acl_tear=midsubstance"; empty: nothing more than
  /// the case says.
  std::string finding;
  ScopePose pose;
  std::vector<std::string> shows;  ///< parts of the case that have to be in the picture

  /// Views of one setting are of the same patient in the same pose.
  bool same_setting(const StandardView& other) const {
    return flexion_deg == other.flexion_deg && finding == other.finding;
  }
};

/// Reads a table of views: a header, then a line each, lengths in mm. Strict; the error names the
/// line.
Result<std::vector<StandardView>> parse_standard_views(std::string_view text,
                                                       const std::string& where);

/// Those that Osteon ships for the joint of this case: a knee has a femur, a wrist a radius. Fails
/// on a case with neither.
Result<std::vector<StandardView>> standard_views(const CaseDef& def);

/// The case as it is seen, its knee bent and with that finding where they are given and it is not
/// so already: what is felt of it does not matter, and takes longest to make.
Result<Case> open_scoped_case(const std::string& spec, std::optional<double> flexion_deg,
                              const std::string& finding = {});

}  // namespace osteon
