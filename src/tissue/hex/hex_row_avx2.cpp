#include "hex/hex_row.h"

namespace osteon::hex {

void row_forces_avx2(const RowConstants& constants, const Row& row) {
  work_on_row<Register<32>::Lanes>(constants, row);
}

}  // namespace osteon::hex
