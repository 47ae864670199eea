#pragma once

#include <memory>
#include <string>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/scene/build_case.h"

namespace osteon {

/// One bone of a case, and in which unit a file that takes its mesh's place is written.
struct CaseBone {
  BoneDef bone;
  std::shared_ptr<const CoveredSurface> covered;  ///< with its cartilage; null: not asked, or none
  std::string unit;                               ///< of the case's mesh files: "m", "cm" or "mm"
  double metres_per_unit = 1;                     ///< the same
};

/// The bone that `CASE#BONE` names. A built-in case is in metres, as it would be saved. Fails with
/// the names of the case's bones where it has none of that name.
Result<CaseBone> load_case_bone(const std::string& spec, bool with_cartilage = false);

/// Three numbers with commas between, "1.5,-2,30", as a point in millimetres; `option` names it in
/// errors. m.
Result<Vec3> point_from_mm(const std::string& text, const std::string& option);

}  // namespace osteon
