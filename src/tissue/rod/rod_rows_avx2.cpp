#include "rod/rod_pairs.h"
#include "rod/rod_row_lanes.h"

namespace osteon::rods {

using LanesAvx2 = hex::Register<32>::Lanes;

const RodWork kRodWorkAvx2 = {assemble_rows<LanesAvx2>, factor_pairs, solve_pairs,
                              go_on_rows<LanesAvx2>, largest_way<LanesAvx2>};

}  // namespace osteon::rods
