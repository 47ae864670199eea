#pragma once

#include <string_view>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/base/types.h"

namespace osteon {

/// Columns of a pose table, in this order.
inline constexpr std::string_view kPoseColumns = "x_mm,y_mm,z_mm,qw,qx,qy,qz";

/// Reads a CSV table of poses (millimetres, quaternion of any length but nought, which is brought
/// to unit length). A first line with the column names may be left out; blank lines are skipped.
/// Errors name the line: wrong column, wrong number of columns, not a number, not finite,
/// quaternion of length nought, no pose at all. `where` names the source in errors.
Result<std::vector<Pose>> parse_pose_table(std::string_view text, std::string_view where);

}  // namespace osteon
