// Discs of drawn patients whose ulna is much shorter or longer than the built-in one; of every tear
// of twenty patients: every_patients_disc.cpp.
#include "physics/patient_discs.h"

namespace osteon {
namespace {

TEST(PatientsDisc, OfAShortUlnaIsFeltWhole) { testing::expect_felt_disc(11, ""); }
TEST(PatientsDisc, OfAShortUlnaIsFeltTornOffTheRadius) { testing::expect_felt_disc(3, "1D"); }
TEST(PatientsDisc, OfAVeryShortUlnaIsFeltTornOffTheUlna) { testing::expect_felt_disc(4, "1B"); }
TEST(PatientsDisc, OfALongUlnaIsFeltTornInItsMiddle) { testing::expect_felt_disc(18, "1A"); }

}  // namespace
}  // namespace osteon
