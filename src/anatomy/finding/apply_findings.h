#pragma once

#include <vector>

#include "describe/description.h"
#include "finding/finding_table.h"
#include "osteon/anatomy/generate.h"

namespace osteon {

/// Writes the findings that are asked for into a description, before it is varied: their places
/// are those of the description and move with its bones. An unknown finding or grade, and a
/// finding that is asked for twice, is an error that lists what there is; so is a step of the table
/// that names no part of the description.
Result<std::vector<GeneratedFinding>> apply_findings(const FindingTable& table,
                                                     const std::vector<FindingChoice>& choices,
                                                     AnatomyDescription& anatomy);

}  // namespace osteon
