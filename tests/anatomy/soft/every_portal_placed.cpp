#include "anatomy/soft/portal_places.h"

namespace osteon {
namespace {

TEST(EveryPortal, LiesInTheSoftSpotAtAnyFlexion) {
  for (std::uint64_t seed = 0; seed < 12; ++seed)
    for (const double flexion_deg : {0.0, 70.0, 80.0, 90.0, 120.0, 130.0})
      checks::expect_in_soft_spots(seed, flexion_deg);
}

}  // namespace
}  // namespace osteon
