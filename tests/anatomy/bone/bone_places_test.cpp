#include "bone/bone_places.h"

#include <gtest/gtest.h>

#include "anatomy/anatomy_assets.h"
#include "describe/description.h"
#include "osteon/anatomy/variation.h"
#include "osteon/base/file.h"
#include "osteon/mesh/distance.h"

namespace osteon {
namespace {

TEST(BonePlaces, WithoutBonesNothingHappens) {
  GeneratedAnatomy grown;
  lay_on_bones({}, grown);
  EXPECT_TRUE(grown.landmarks.empty());
}

// Of patients whose bones grow alone, as exercises open them: each lies on the bone that it is
// described to lie on, though shape and place vary by different laws.
TEST(BonePlaces, LandmarksOfARandomKneeLieOnTheirBonesWithoutSoftPartsToo) {
  const auto text = read_file(kAnatomyAssets / "knee.toml", 1 << 22);
  ASSERT_TRUE(text) << text.error().message();
  const auto description = parse_description(*text, "knee.toml");
  ASSERT_TRUE(description) << description.error().message();
  GenerateOptions options;
  options.cell_m = 0.002;
  options.soft_parts = false;
  for (const std::uint64_t seed : {5U, 6U}) {
    const auto grown =
        generate_varied(kAnatomyAssets / "knee.toml", kAnatomyAssets / "knee_variation.toml",
                        {seed, {}, "right"}, options);
    ASSERT_TRUE(grown) << grown.error().message();
    std::size_t seen = 0;
    for (std::size_t i = 0; i < description->landmarks.size(); ++i) {
      const auto bone = description->landmarks[i].on_bone;
      if (!bone) continue;
      const GeneratedBone& ground = grown->anatomy.bones[*bone];
      const Vec3 p_B = ground.X_WB.inverse() * grown->anatomy.landmarks[i].p_W;
      EXPECT_NEAR(MeshDistance(ground.mesh).closest(p_B).signed_distance, 0, 1e-9)
          << grown->anatomy.landmarks[i].name << ", seed " << seed;
      ++seen;
    }
    EXPECT_GT(seen, 5U);
  }
}

}  // namespace
}  // namespace osteon
