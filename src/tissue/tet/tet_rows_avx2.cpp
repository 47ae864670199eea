#include "tet/tet_row_lanes.h"

namespace osteon::tets {

const TetWork kTetWorkAvx2 = kTetWork<hex::Register<32>::Lanes>;

}  // namespace osteon::tets
