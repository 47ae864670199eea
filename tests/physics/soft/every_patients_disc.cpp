// The discs of twenty drawn patients, whole and with each tear.
#include "physics/patient_discs.h"

namespace osteon {
namespace {

TEST(EveryPatientsDisc, IsFeltWholeAndWithEachTear) {
  for (std::uint64_t seed = 0; seed < 20; ++seed)
    for (const char* tear : {"", "1A", "1B", "1D"}) testing::expect_felt_disc(seed, tear);
}

}  // namespace
}  // namespace osteon
