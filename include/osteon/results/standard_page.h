#pragma once

#include <string>
#include <vector>

#include "osteon/procedure/group_standard.h"
#include "osteon/results/names.h"

namespace osteon {

/// One page about a standard that two groups have set, HTML with its picture in it and nothing from
/// elsewhere: each person's score, the mark, whom it judges wrongly, the norms. `experts` and
/// `novices` as they were given to standard_of_groups.
std::string to_html(const GroupStandard& set, const std::vector<std::string>& experts,
                    const std::vector<std::string>& novices, const LearnerNames& names = {});

}  // namespace osteon
