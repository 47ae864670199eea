#include "anatomy/soft/portal_places.h"

namespace osteon {
namespace {

TEST(PortalPlaces, LieInTheSoftSpotsOfABentKnee) {
  checks::expect_in_soft_spots(1, 80);
  checks::expect_in_soft_spots(6, 120);
}

/// Taken along by the tibia alone they would not: it turns inwards under the patella, and the
/// tendon's upper end stays where it is.
TEST(PortalPlaces, AreNotThoseThatTheTibiaAloneTakesAlong) {
  const GeneratedAnatomy straight = checks::bent_knee(2, 0), bent = checks::bent_knee(2, 80);
  const auto in_tibia = [](const GeneratedAnatomy& knee, const char* name) {
    return Vec3(checks::bone_named(knee, "tibia").X_WB.inverse() * checks::landmark_of(knee, name));
  };
  for (const char* name : {"portal_al", "portal_am"})
    EXPECT_LT(in_tibia(bent, name).y(), in_tibia(straight, name).y() - 0.007) << name;
}

}  // namespace
}  // namespace osteon
