// A piece of skin from a file: its errors, and what is done to it.
#include "osteon/tissue/skin_scene.h"

#include <gtest/gtest.h>

#include "tissue/sheet/sheet_checks.h"

namespace osteon {
namespace {

const std::string kSheet = "[sheet]\nsize_mm = [50, 40]\nedge_mm = 2\n";

std::string refusal(const std::string& text) {
  const auto scene = parse_skin_scene(text, "x.toml");
  if (!scene) return scene.error().message();
  const auto result = run_skin(*scene);
  return result ? "" : result.error().message();
}

TEST(SkinScene, NamesTheKeyThatIsWrong) {
  const auto says = [](const std::string& text, const std::string& part) {
    EXPECT_NE(refusal(text).find(part), std::string::npos) << text << "\n" << refusal(text);
  };
  says("", "'sheet' is missing");
  says("[sheet]\n", "'sheet.size_mm' must be two numbers");
  says("[sheet]\nsize_mm = [50, nan]\n", "'sheet.size_mm'");
  says("[sheet]\nsize_mm = [0, 40]\n", "side of the sheet");
  says("[sheet]\nsize_mm = [50, 40]\nedge_mm = 0\n", "'sheet.edge_mm'");
  says(kSheet + "[material]\nyoung_kpa = -1\n", "'material.young_kpa'");
  says(kSheet + "[material]\npoisson = 0.5\n", "'material.poisson'");
  says(kSheet + "[material]\ntension_n_per_m = 900\n", "'material.tension_n_per_m'");
  says(kSheet + "[material]\nyoung = 3\n", "'material.young' is not a known key");
  says(kSheet + "[[cut]]\npoints_mm = [[0, 0]]\n", "'cut[0].points_mm'");
  says(kSheet + "[[cut]]\npoints_mm = [[0, 0], [1]]\n", "'cut[0].points_mm'");
  says(kSheet + "[[cut]]\npoints_mm = [[0, 0], [9, 0]]\ndepth_mm = 0\n", "'cut[0].depth_mm'");
  says(kSheet + "[[press]]\nat_mm = [0, 0]\n", "'press[0].force_n'");
  says(kSheet + "[[press]]\nat_mm = [24, 0]\nforce_n = 1\n", "press[0] is not on the sheet");
  says(kSheet + "[[pierce]]\nat_mm = [0, 90]\ndepth_mm = 9\n", "pierce[0] is not on the sheet");
  says(kSheet + "[[pierce]]\nat_mm = [0, 0]\n", "'pierce[0].depth_mm'");
  says(kSheet + "[place]\ncase = \"x\"\n", "'place.at'");
  says(kSheet + "[place]\ncase = \"x\"\nat = \"y\"\nnear_mm = [0, 0, 0]\n", "'place.at'");
  says(kSheet + "[place]\nat = \"y\"\n", "'place.case'");
  says("[sheet", "x.toml, line 1");
}

TEST(SkinScene, CutsPressesAndPierces) {
  const auto scene =
      parse_skin_scene(kSheet +
                           "[[cut]]\npoints_mm = [[-10, 0], [0, 2], [10, 0]]\ndepth_mm = 5\n"
                           "[[press]]\nat_mm = [0, 12]\nforce_n = 2\n"
                           "[[pierce]]\nat_mm = [0, -12]\nradius_mm = 2.5\ndepth_mm = 25\n"
                           "[[pierce]]\nat_mm = [0, 2]\nradius_mm = 2.5\ndepth_mm = 25\n"
                           "[[pierce]]\nat_mm = [12, 12]\nradius_mm = 2.5\ndepth_mm = 2\n",
                       "x.toml");
  ASSERT_TRUE(scene) << scene.error().message();
  const auto result = run_skin(*scene);
  ASSERT_TRUE(result) << result.error().message();
  ASSERT_EQ(result->cuts.size(), 1u);
  EXPECT_NEAR(result->cuts[0].stroke_m, 2 * std::hypot(0.01, 0.002), 1e-12);
  EXPECT_NEAR(result->cuts[0].opened_m, result->cuts[0].stroke_m, 0.001);
  EXPECT_LT(result->cuts[0].off_m, 0.0004);
  EXPECT_GT(result->widest_m, 0.0008);
  EXPECT_GT(result->groove_m3, 0.3 * 0.005 * result->opening_m2);
  EXPECT_GT(result->presses[0].dent_m, 0.002);
  // Skin that is whole is broken at the table's force; an incision lets the trocar in.
  EXPECT_TRUE(result->pierces[0].pierced);
  EXPECT_NEAR(result->pierces[0].peak_n, 25, 0.3);
  EXPECT_LT(result->pierces[0].deepest_n, 4);
  EXPECT_GT(result->pierces[0].pull_n, 0.1);
  EXPECT_LT(result->pierces[1].peak_n, 2.5);
  EXPECT_FALSE(result->pierces[2].pierced);
  EXPECT_EQ(result->surface.triangles.size(), result->triangles + result->groove_triangles);
  EXPECT_GT(result->groove_triangles, 0u);
  const std::string vtk = skin_vtk(*result);
  EXPECT_NE(vtk.find("SCALARS part int"), std::string::npos);
}

TEST(SkinScene, TheSameSceneGivesTheSameBits) {
  const auto scene = parse_skin_scene(
      kSheet + "[[cut]]\npoints_mm = [[-10, 1], [10, 3]]\n[[press]]\nat_mm = [0, 9]\nforce_n = 3\n",
      "x.toml");
  EXPECT_EQ(skin_vtk(*run_skin(*scene)), skin_vtk(*run_skin(*scene)));
}

}  // namespace
}  // namespace osteon
