// A few small soft parts; all of them: every_soft_filled.cpp.
#include <set>

#include "anatomy/soft/filled_checks.h"
#include "bone/grow.h"
#include "osteon/base/file.h"
#include "soft/soft_grow.h"

namespace osteon {
namespace {

TEST(SoftFilled, ALayerOfCartilageADiscAndABand) {
  const auto file = std::filesystem::path(OSTEON_SOURCE_DIR) / "assets/anatomy/wrist.toml";
  auto anatomy = parse_description(read_file(file, 1 << 22).value(), file.string());
  ASSERT_TRUE(anatomy) << anatomy.error().message();
  const std::set<std::string> wanted = {"metacarpal_4_cartilage", "tfcc_disc", "ulnolunate"};
  std::erase_if(anatomy->softs, [&](const auto& soft) { return !wanted.contains(soft.name); });
  anatomy->landmarks.clear();
  for (BoneDescription& bone : anatomy->bones)
    if (bone.name != "metacarpal_4") bone.cell_m = 0.0012;
  auto grown = grow_bones(*anatomy, {}, "wrist");
  ASSERT_TRUE(grown) << grown.error().message();
  ASSERT_TRUE(grow_soft_parts(*anatomy, {}, "wrist", *grown));
  for (const GeneratedSoft& soft : grown->softs) checks::expect_filled(soft);
}

}  // namespace
}  // namespace osteon
