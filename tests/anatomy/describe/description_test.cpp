#include "describe/description.h"

#include <gtest/gtest.h>

namespace osteon {
namespace {

const std::string kHead = "name = \"test\"\nside = \"left\"\n";
const std::string kBall = "{ shape = \"ellipsoid\", center_mm = [0, 0, 0], radii_mm = [5, 4, 3] }";

std::string bone(const std::string& name, const std::string& add, const std::string& more = "") {
  return "[[bone]]\nname = \"" + name + "\"\nfma_id = 7\nposition_mm = [1, 2, 3]\nadd = [" + add +
         "]\n" + more + "\n";
}

/// Message of a description that must not be read; it must name the file and hold all the words.
void expect_refused(const std::string& text, const std::vector<std::string>& words) {
  const auto r = parse_description(text, "wrist.toml");
  ASSERT_FALSE(r) << text;
  const std::string message = r.error().message();
  EXPECT_NE(message.find("wrist.toml"), std::string::npos) << message;
  for (const std::string& word : words)
    EXPECT_NE(message.find(word), std::string::npos) << word << " in: " << message;
}

TEST(Description, EmptyAndBrokenFilesAreRefused) {
  expect_refused("", {"'name'", "missing"});
  expect_refused("name = [", {"line 1"});
  expect_refused("name = \"x\"\nside = \"left\"\nside = \"left\"", {"line 3"});
  expect_refused(kHead, {"'bone'", "missing"});
  expect_refused(kHead + "bone = []", {"'bone'"});
  expect_refused(kHead + "bone = 3", {"'bone'"});
  expect_refused(kHead + "bone = [1, 2]", {"'bone'"});
}

TEST(Description, SideIsLeftOrRight) {
  expect_refused("name = \"x\"\nside = \"up\"\n" + bone("a", kBall), {"'side'"});
}

TEST(Description, UnknownKeysAreRefusedWhereTheyStand) {
  expect_refused(kHead + "colour = 1\n" + bone("a", kBall), {"'colour'"});
  expect_refused(kHead + bone("a", kBall, "weight = 3"), {"bone 'a'", "'weight'"});
  expect_refused(kHead + bone("a",
                              "{ shape = \"ellipsoid\", center_mm = [0, 0, 0], radii_mm = "
                              "[5, 4, 3], radius_mm = 2 }"),
                 {"bone 'a'", "add 1", "'radius_mm'"});
  expect_refused(kHead + bone("a", kBall) +
                     "[[landmark]]\nname = \"l\"\nposition_mm = [0, 0, 0]\nbones = \"a\"\n",
                 {"landmark 'l'", "'bones'"});
}

std::string two_bones_and_layer() {
  const std::string layer =
      "tissue = \"articular_cartilage\"\nkind = \"cartilage\"\nbone = \"b\"\n"
      "thickness_mm = 1\ntaper_mm = 1\nadd = [" +
      kBall + "]\n";
  return kHead + bone("a", kBall) + bone("b", kBall) + "[[soft]]\nname = \"plateau\"\n" + layer;
}

std::string joint(const std::string& lines) {
  return two_bones_and_layer() +
         "[[joint]]\nname = \"bend\"\nfixed = \"a\"\nmoves = [\"b\"]\nstep_deg = 10\n"
         "medial_center_mm = [0, 5, 0]\nlateral_center_mm = [0, -5, 0]\n" +
         lines;
}

TEST(Description, JointsMustNameWhatIsThereAndHaveOneRowAStep) {
  const std::string plateaus = "medial_plateau = \"plateau\"\nlateral_plateau = \"plateau\"\n";
  const std::string rows = "inward_deg = [0, 1, 2]\nmedial_back_mm = [0, 1, 2]\n";
  const auto good = parse_description(joint(plateaus + rows), "knee.toml");
  ASSERT_TRUE(good) << good.error().message();
  EXPECT_EQ(good->joints.at(0).back.at(2), 0.002);
  expect_refused(joint("medial_plateau = \"b\"\nlateral_plateau = \"plateau\"\n" + rows),
                 {"joint 'bend'", "'medial_plateau'"});
  expect_refused(joint(plateaus + "inward_deg = [0, 1]\nmedial_back_mm = [0, 1]\n"),
                 {"'inward_deg'", "three numbers"});
  expect_refused(joint(plateaus + "inward_deg = [1, 1, 2]\nmedial_back_mm = [0, 1, 2]\n"),
                 {"'inward_deg'", "begin with 0"});
  expect_refused(joint(plateaus + "inward_deg = [0, 1, 2]\nmedial_back_mm = [0, 1, 2, 3]\n"),
                 {"'medial_back_mm'", "as many"});
  expect_refused(joint(plateaus + rows + "glides = \"c\"\n"), {"'glides'", "'c'"});
  expect_refused(
      joint(plateaus + rows) + joint("").substr(two_bones_and_layer().size()) + plateaus + rows,
      {"two joints"});
}

TEST(Description, MissingKeysAreNamed) {
  expect_refused(kHead + "[[bone]]\nname = \"a\"\n", {"bone 'a'", "'position_mm'"});
  expect_refused(kHead + "[[bone]]\nfma_id = 3\n", {"line 3", "'name'"});
  expect_refused(kHead + "[[bone]]\nname = \"a\"\nfma_id = 3\nposition_mm = [0, 0, 0]\n",
                 {"bone 'a'", "'add'"});
  expect_refused(kHead + bone("a", "{ shape = \"ellipsoid\", center_mm = [0, 0, 0] }"),
                 {"'radii_mm'"});
  expect_refused(kHead + bone("a", kBall, "clear = [{ gap_mm = 1 }]"), {"clear 1", "'bone'"});
}

TEST(Description, NumbersOutOfRangeAreRefused) {
  for (const char* radii : {"[0, 4, 3]", "[-5, 4, 3]", "[nan, 4, 3]", "[inf, 4, 3]", "[5, 4]",
                            "[5, 4, 3, 2]", "5", "[\"5\", 4, 3]", "[]", "[[5], [4], [3]]"})
    expect_refused(kHead + bone("a", "{ shape = \"ellipsoid\", center_mm = [0, 0, 0], radii_mm = " +
                                         std::string(radii) + " }"),
                   {"bone 'a'", "add 1", "'radii_mm'"});
  expect_refused(kHead + bone("a", kBall, "blend_mm = -1"), {"'blend_mm'"});
  expect_refused(kHead + bone("a", kBall, "density_kg_per_m3 = 0"), {"'density_kg_per_m3'"});
  expect_refused(kHead + "[[bone]]\nname = \"a\"\nfma_id = 1.5\n", {"'fma_id'"});
  expect_refused(kHead + "[[bone]]\nname = \"\"\n", {"'name'"});
}

TEST(Description, ShapesAreChecked) {
  expect_refused(kHead + bone("a", "{ shape = \"banana\" }"), {"'shape'", "banana"});
  expect_refused(kHead + bone("a",
                              "{ shape = \"half_space\", point_mm = [0, 0, 0], "
                              "normal = [0, 0, 1] }"),
                 {"'shape'", "cut"});
  expect_refused(kHead + bone("a", kBall,
                              "cut = [{ shape = \"half_space\", point_mm = [0, 0, 0], "
                              "normal = [0, 0, 0] }]"),
                 {"cut 1", "'normal'"});
  expect_refused(kHead + bone("a",
                              "{ shape = \"box\", center_mm = [0, 0, 0], half_mm = [1, 2, 3], "
                              "round_mm = 1.5 }"),
                 {"'round_mm'"});
}

TEST(Description, TubesAreChecked) {
  const auto tube = [](const std::string& points, const std::string& radii) {
    return kHead +
           bone("a", "{ shape = \"tube\", points_mm = " + points + ", radii_mm = " + radii + " }");
  };
  expect_refused(tube("[]", "[]"), {"'points_mm'"});
  expect_refused(tube("[[0, 0, 0]]", "[1]"), {"'points_mm'"});
  expect_refused(tube("[[0, 0, 0], [1, 0]]", "[1, 1]"), {"'points_mm'"});
  expect_refused(tube("[[0, 0, 0], [0, 0, 0]]", "[1, 1]"), {"'points_mm'", "twice"});
  expect_refused(tube("[[0, 0, 0], [9, 0, 0]]", "[1, 1, 1]"), {"'radii_mm'"});
  expect_refused(tube("[[0, 0, 0], [9, 0, 0], [18, 0, 0], [27, 0, 0]]", "[50, 0.1, 0.1, 50]"),
                 {"'radii_mm'", "zero"});
}

std::string read_twice(const std::string& second, const std::string& cut = "") {
  return kHead + bone("a", "{ name = \"x\", " + kBall.substr(2) + ", " + second, cut);
}

TEST(Description, APartMayBeLikeOneFurtherUp) {
  const auto r = parse_description(
      kHead +
          bone("a",
               "{ name = \"x\", shape = \"box\", center_mm = [1, 2, 3], half_mm = [5, 4, 3], "
               "round_mm = 1, rotation_deg = [10, 20, 30], blend_mm = 2 }, { name = \"y\", like "
               "= \"x\", mirror = true, shift_mm = [1, 0.5, 0] }, { like = \"y\", blend_mm = 4 }"),
      "f");
  ASSERT_TRUE(r) << r.error().message();
  const std::vector<Part>& parts = r->bones[0].solid.parts;
  ASSERT_EQ(parts.size(), 3u);
  EXPECT_EQ(parts[1].name, "y");
  EXPECT_DOUBLE_EQ(parts[1].blend, 0.002);
  EXPECT_DOUBLE_EQ(parts[2].blend, 0.004);
  const auto& copied = std::get<RoundedBox>(parts[1].primitive);
  EXPECT_NEAR(copied.R_local.determinant(), 1, 1e-12);
  const Vec3 p(0.004, 0.007, -0.002), seen(0.003, -0.0065, -0.002);
  EXPECT_NEAR(distance(parts[1].primitive, p), distance(parts[0].primitive, seen), 1e-15);
  EXPECT_DOUBLE_EQ(distance(parts[2].primitive, p), distance(parts[1].primitive, p));
}

TEST(Description, PartsThatAreLikeOthersAreChecked) {
  expect_refused(read_twice("{ like = \"y\" }"), {"add 2", "'like'", "'y'"});
  expect_refused(read_twice("{ name = \"y\", like = \"y\" }"), {"add 2", "'like'", "'y'"});
  expect_refused(read_twice("{ like = \"x\", radii_mm = [1, 2, 3] }"), {"add 2", "'radii_mm'"});
  expect_refused(read_twice("{ like = \"x\", mirror = 1 }"), {"add 2", "'mirror'"});
  expect_refused(read_twice(kBall, "cut = [{ like = \"x\" }]"), {"cut 1", "'like'"});
}

TEST(Description, ATiltIsATurnAboutYAlone) {
  const auto r = parse_description(
      kHead + bone("a", kBall.substr(0, kBall.size() - 2) + ", tilt_deg = 25 }, " +
                            kBall.substr(0, kBall.size() - 2) + ", rotation_deg = [0, 25, 0] }"),
      "f");
  ASSERT_TRUE(r) << r.error().message();
  const std::vector<Part>& parts = r->bones[0].solid.parts;
  EXPECT_EQ(std::get<Ellipsoid>(parts[0].primitive).R_local,
            std::get<Ellipsoid>(parts[1].primitive).R_local);
  expect_refused(kHead + bone("a", kBall.substr(0, kBall.size() - 2) +
                                       ", tilt_deg = 1, rotation_deg = [0, 1, 0] }"),
                 {"add 1", "'tilt_deg'"});
}

TEST(Description, OneRadiusIsThatOfABallOrOfAWholeTube) {
  const auto r = parse_description(
      kHead +
          bone("a",
               "{ shape = \"ellipsoid\", center_mm = [0, 0, 0], radii_mm = [5] }, "
               "{ shape = \"tube\", points_mm = [[0, 0, 0], [10, 0, 0], [40, 0, 0]], radii_mm = "
               "[3] }"),
      "f");
  ASSERT_TRUE(r) << r.error().message();
  const std::vector<Part>& parts = r->bones[0].solid.parts;
  EXPECT_EQ(std::get<Ellipsoid>(parts[0].primitive).radii, Vec3::Constant(0.005));
  const Tube& tube = std::get<Tube>(parts[1].primitive);
  ASSERT_EQ(tube.radii.size(), tube.points.size());
  for (const double radius : tube.radii) EXPECT_DOUBLE_EQ(radius, 0.003);
}

TEST(Description, NamesAreUniqueAndClearancesNameOtherBones) {
  expect_refused(kHead + bone("a", kBall) + bone("a", kBall), {"'name'", "'a'"});
  expect_refused(kHead + bone("a", kBall, "clear = [{ bone = \"b\", gap_mm = 1 }]"),
                 {"bone 'a'", "clear 1", "'b'"});
  expect_refused(kHead + bone("a", kBall, "clear = [{ bone = \"a\", gap_mm = 1 }]"), {"another"});
  expect_refused(
      kHead + bone("a", kBall, "clear = [{ bone = \"b\", gap_mm = -1 }]") + bone("b", kBall),
      {"'gap_mm'"});
  const std::string landmark = "[[landmark]]\nname = \"l\"\nposition_mm = [0, 0, 0]\n";
  expect_refused(kHead + bone("a", kBall) + landmark + landmark, {"'l'", "two landmarks"});
  expect_refused(kHead + bone("a", kBall) + landmark + "along = \"t\"\n",
                 {"'l'", "'along'", "'t'"});
}

TEST(Description, ReadsInMetresWithDefaults) {
  const auto r = parse_description(
      kHead +
          bone("a",
               kBall + ", { shape = \"tube\", points_mm = [[0, 0, 0], [9, 0, 0]], radii_mm = "
                       "[2, 1], blend_mm = 4 }",
               "blend_mm = 2\nclear = [{ bone = \"b\", gap_mm = 1.5 }]") +
          bone("b", kBall, "density_kg_per_m3 = 1200") +
          "[[landmark]]\nname = \"l\"\nposition_mm = [10, 0, -20]\n",
      "f");
  ASSERT_TRUE(r) << r.error().message();
  EXPECT_EQ(r->side, "left");
  ASSERT_EQ(r->bones.size(), 2u);
  const BoneDescription& a = r->bones[0];
  EXPECT_EQ(a.fma_id, 7);
  EXPECT_EQ(a.density_kg_per_m3, 1900);
  EXPECT_EQ(r->bones[1].density_kg_per_m3, 1200);
  EXPECT_LT((a.p_WB - Vec3(0.001, 0.002, 0.003)).norm(), 1e-12);
  ASSERT_EQ(a.solid.parts.size(), 2u);
  EXPECT_DOUBLE_EQ(a.solid.parts[0].blend, 0.002);
  EXPECT_DOUBLE_EQ(a.solid.parts[1].blend, 0.004);
  EXPECT_LT((std::get<Ellipsoid>(a.solid.parts[0].primitive).radii - Vec3(5, 4, 3) * 0.001).norm(),
            1e-12);
  ASSERT_EQ(a.clearances.size(), 1u);
  EXPECT_EQ(a.clearances[0].other_bone, 1u);
  EXPECT_DOUBLE_EQ(a.clearances[0].gap, 0.0015);
  EXPECT_LT((r->landmarks[0].p_W - Vec3(0.01, 0, -0.02)).norm(), 1e-12);
}

const std::string kTwoBones = kHead + bone("a", kBall) + bone("b", kBall);

std::string soft(const std::string& kind, const std::string& lines) {
  return kTwoBones + "[[soft]]\nname = \"s\"\ntissue = \"ligament\"\nkind = \"" + kind + "\"\n" +
         lines;
}

TEST(Description, SoftPartsAreChecked) {
  expect_refused(soft("jelly", ""), {"soft part 's'", "'kind'", "jelly"});
  expect_refused(soft("cartilage", ""), {"soft part 's'", "'bone'"});
  const std::string layer = "thickness_mm = 1\ntaper_mm = 1\n";
  expect_refused(soft("cartilage", layer + "bone = \"c\"\n"), {"'bone'", "'c'"});
  expect_refused(soft("cartilage", layer + "bone = \"a\"\n"), {"'add'", "'facing'"});
  expect_refused(soft("cartilage", layer + "bone = \"a\"\nfacing = [\"a\"]\nreach_mm = 2\n"),
                 {"'facing'", "other"});
  expect_refused(soft("cartilage", layer + "bone = \"a\"\nfacing = [\"b\"]\n"), {"'reach_mm'"});
  const std::string band = "width_mm = 4\nthickness_mm = 1\nflat = [0, 0, 1]\n";
  expect_refused(soft("ligament", band), {"'path'"});
  const std::string from = "{ bone = \"a\", at_mm = [0, 0, 0] }";
  expect_refused(soft("ligament", band + "path = [" + from + "]"), {"'path'", "two"});
  expect_refused(soft("ligament", band + "path = [" + from + ", " + from + "]"),
                 {"path 2", "'at_mm'"});
  expect_refused(
      soft("ligament", band + "path = [" + from + ", { bone = \"b\", at_mm = [9, 0, 0], " +
                           "thickness_mm = 5 }]"),
      {"path 2", "'thickness_mm'"});
  expect_refused(soft("disc", ""), {"'add'"});
  expect_refused(soft("skin", ""), {"'offset_mm'"});
  expect_refused(soft("disc",
                      "add = [{ shape = \"ellipsoid\", center_mm = [0, 0, 0], radii_mm = "
                      "[5, 4, 3] }]\n"),
                 {"add 1", "'bone'"});
  const std::string ball = "center_mm = [0, 0, 0], radii_mm = [5, 4, 3] }]\n";
  expect_refused(
      soft("disc", "add = [{ bone = \"a\", to_bone = \"b\", shape = \"ellipsoid\", " + ball),
      {"add 1", "'to_bone'", "tube"});
  expect_refused(
      soft("disc", "add = [{ bone = \"a\", to_bone = \"c\", shape = \"ellipsoid\", " + ball),
      {"add 1", "'to_bone'", "'c'"});
}

TEST(Description, SoftPartsNamesAreUnlikeAllOthers) {
  const std::string disc =
      "add = [{ bone = \"a\", shape = \"ellipsoid\", center_mm = [0, 0, 0], "
      "radii_mm = [5, 4, 3] }]\n";
  ASSERT_TRUE(parse_description(soft("disc", disc), "wrist.toml"));
  expect_refused(
      soft("disc", disc) + "[[soft]]\nname = \"a\"\ntissue = \"fat\"\nkind = \"fat\"\n" + disc,
      {"'name'", "bone"});
  expect_refused(
      soft("disc", disc) + "[[soft]]\nname = \"s\"\ntissue = \"fat\"\nkind = \"fat\"\n" + disc,
      {"'name'", "two soft parts"});
  expect_refused(
      soft("disc", disc) + "[[landmark]]\nname = \"l\"\nposition_mm = [0, 0, 0]\non = \"moon\"\n",
      {"landmark 'l'", "moon"});
}

}  // namespace
}  // namespace osteon
