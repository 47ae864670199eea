#pragma once

#include <array>
#include <optional>
#include <vector>

#include "runs/reports/acl_report.h"

namespace osteon {

/// Holes that femur and tibia had before an attempt, the one that holds most first; World.
using OldHoles = std::array<std::vector<DrilledLine>, 2>;

/// The report on a knee that had tunnels already: what was drilled now beside them. A bone that was
/// not drilled keeps its old tunnel, and a graft would go through that. `channels_m`: widths of the
/// narrower holes that go on from new sockets to the far side, 0: none.
Result<AclReport> report_beside_old(const CaseDef& undrilled, const OldHoles& old,
                                    const AclDrilling& drilled,
                                    const std::array<double, 2>& channels_m,
                                    const std::optional<GraftChoices>& choices);

}  // namespace osteon
