#pragma once

#include <string>

#include "osteon/base/result.h"
#include "osteon/procedure/scenario.h"
#include "runs/reports/portal_report.h"

namespace osteon {

/// The case with its portals where they were made in the same patient: each lies beside its
/// landmark, along the skin, as it did in the knee in which it was made. Fails for another patient
/// or side, and for a case without these portals. `where`: names the report.
Result<std::string> with_made_portals(const std::string& case_spec, const ReportedPortals& made,
                                      const std::string& where);

/// Leaves out the stages in which portals are made, of a case whose name says where they are.
void leave_out_what_case_has(Scenario& scenario, const std::string& case_spec);

}  // namespace osteon
