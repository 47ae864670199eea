#include "rod/rod_rows.h"

namespace osteon::rods {

#if defined(__x86_64__)
const RodWork& best_rod_work() {
  if (__builtin_cpu_supports("avx512f")) return kRodWorkAvx512;
  if (__builtin_cpu_supports("avx2")) return kRodWorkAvx2;
  return kRodWorkBase;
}
#else
const RodWork& best_rod_work() { return kRodWorkBase; }
#endif

}  // namespace osteon::rods
