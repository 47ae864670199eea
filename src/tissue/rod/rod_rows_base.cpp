#include "rod/rod_pairs.h"
#include "rod/rod_row_lanes.h"

namespace osteon::rods {

using LanesBase = hex::Register<16>::Lanes;

const RodWork kRodWorkBase = {assemble_rows<LanesBase>, factor_pairs, solve_pairs,
                              go_on_rows<LanesBase>, largest_way<LanesBase>};

}  // namespace osteon::rods
