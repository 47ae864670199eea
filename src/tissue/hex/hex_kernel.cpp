#include "hex/hex_kernel.h"

namespace osteon::hex {

#if defined(__x86_64__)
RowWork best_row_work() {
  if (__builtin_cpu_supports("avx512f")) return row_forces_avx512;
  if (__builtin_cpu_supports("avx2")) return row_forces_avx2;
  return row_forces_base;
}
#else
RowWork best_row_work() { return row_forces_base; }
#endif

}  // namespace osteon::hex
