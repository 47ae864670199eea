#include "tet/tet_rows.h"

namespace osteon::tets {

#if defined(__x86_64__)
const TetWork& best_tet_work() {
  if (__builtin_cpu_supports("avx512f")) return kTetWorkAvx512;
  if (__builtin_cpu_supports("avx2")) return kTetWorkAvx2;
  return kTetWorkBase;
}
#else
const TetWork& best_tet_work() { return kTetWorkBase; }
#endif

}  // namespace osteon::tets
