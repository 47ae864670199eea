#include "hex/hex_row.h"

namespace osteon::hex {

void row_forces_base(const RowConstants& constants, const Row& row) {
  work_on_row<Register<16>::Lanes>(constants, row);
}

}  // namespace osteon::hex
