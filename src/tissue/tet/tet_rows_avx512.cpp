#include "tet/tet_row_lanes.h"

namespace osteon::tets {

const TetWork kTetWorkAvx512 = kTetWork<hex::Register<64>::Lanes>;

}  // namespace osteon::tets
