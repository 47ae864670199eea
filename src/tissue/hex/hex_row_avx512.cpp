#include "hex/hex_row.h"

namespace osteon::hex {

void row_forces_avx512(const RowConstants& constants, const Row& row) {
  work_on_row<Register<64>::Lanes>(constants, row);
}

}  // namespace osteon::hex
