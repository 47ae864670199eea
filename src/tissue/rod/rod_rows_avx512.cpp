#include "rod/rod_pairs.h"
#include "rod/rod_row_lanes.h"

namespace osteon::rods {

using LanesAvx512 = hex::Register<64>::Lanes;

const RodWork kRodWorkAvx512 = {assemble_rows<LanesAvx512>, factor_pairs, solve_pairs,
                                go_on_rows<LanesAvx512>, largest_way<LanesAvx512>};

}  // namespace osteon::rods
