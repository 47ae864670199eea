#pragma once

#include <cstdint>
#include <vector>

#include "osteon/tissue/skin_sheet.h"

namespace osteon {

/// Where a sheet is open: found anew when it was cut, so that looking there allocates nothing.
class SkinSlits {
 public:
  void find(const SkinSheet& sheet, const SheetCuts& cuts);
  struct Here {
    double length_m = 0;  ///< of all that hangs together with it; 0: no slit is so near
    double depth_m = 0;   ///< of the groove there
  };
  /// The slit nearest to `p`, within `reach_m`.
  Here near(const SheetPoint& p, double reach_m) const;

 private:
  struct Edge {
    SheetPoint a, way;
    double depth_m = 0, length_m = 0;
  };
  std::vector<Edge> edges_;
};

}  // namespace osteon
