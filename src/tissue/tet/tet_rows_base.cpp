#include "tet/tet_row_lanes.h"

namespace osteon::tets {

const TetWork kTetWorkBase = kTetWork<hex::Register<16>::Lanes>;

}  // namespace osteon::tets
