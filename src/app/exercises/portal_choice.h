#pragma once

#include <string>

#include "osteon/base/result.h"
#include "runs/reports/portal_report.h"

namespace osteon {

/// The case with its portals where they were made in the same patient: each lies beside its
/// landmark, along the skin, as it did in the knee in which it was made. Fails for another patient
/// or side, and for a case without these portals. `where`: names the report.
Result<std::string> with_made_portals(const std::string& case_spec, const ReportedPortals& made,
                                      const std::string& where);

}  // namespace osteon
