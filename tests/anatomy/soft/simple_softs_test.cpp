#include <gtest/gtest.h>

#include <cstdlib>

#include "anatomy/anatomy_assets.h"
#include "anatomy/soft/soft_checks.h"
#include "osteon/anatomy/variation.h"

namespace osteon {
namespace {

GeneratedAnatomy patient(const std::string& name, std::uint64_t seed) {
  VariationRequest request;
  if (seed > 0) request.seed = seed;
  auto r = generate_varied(kAnatomyAssets / (name + ".toml"),
                           kAnatomyAssets / (name + "_variation.toml"), request);
  if (!r) throw std::runtime_error(r.error().message());
  return std::move(r->anatomy);
}

/// One piece each, without holes or handles. Seed 0 is the built-in one; with OSTEON_LONG more
/// seeds follow, each of which takes seconds.
void expect_simple(const std::string& name, std::uint64_t seeds_long,
                   const std::vector<std::string>& kinds) {
  const std::uint64_t seeds = std::getenv("OSTEON_LONG") ? seeds_long : 1;
  for (std::uint64_t seed = 0; seed <= seeds; ++seed)
    for (const GeneratedSoft& soft : patient(name, seed).softs) {
      if (std::find(kinds.begin(), kinds.end(), soft.kind) == kinds.end()) continue;
      EXPECT_EQ(checks::euler_number(soft.mesh_W), 2) << soft.name << " of seed " << seed;
    }
}

TEST(SimpleSofts, BandsOfTheWristAreStraps) { expect_simple("wrist", 4, {"ligament"}); }
TEST(SimpleSofts, BandsAndMenisciOfTheKneeHaveNoHoles) {
  expect_simple("knee", 12, {"ligament", "tendon", "meniscus"});
}

}  // namespace
}  // namespace osteon
