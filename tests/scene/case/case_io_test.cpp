#include "osteon/scene/case_io.h"

#include <gtest/gtest.h>

#include <cmath>

#include "../../mesh/shapes.h"
#include "osteon/base/file.h"
#include "osteon/base/random.h"
#include "osteon/mesh/mesh_io.h"

namespace osteon {
namespace {

namespace fs = std::filesystem;

std::string with_bone(const std::string& lines) {
  return "format = 1\nname = \"test\"\n[[bones]]\n" + lines;
}

std::string soft_lines(const std::string& lines) {
  return "[[soft]]\nname = \"s\"\ntissue = \"fat\"\n" + lines + "mesh = \"s.stl\"\n";
}

struct BadCase {
  std::string text;
  const char* complaint;
  const char* where;
};

TEST(CaseToml, RefusesBadText) {
  const std::string bone = "name = \"a\"\nmesh = \"a.stl\"\n";
  const BadCase table[] = {
      {"", "'format' is missing", "c:"},
      {"format = 2\nname = \"x\"\n", "'format' must lie", "c:1"},
      {"format = 1\n", "'name' is missing", "c:"},
      {"format = 1\nname = \"x\"\n", "1 to 64 bones", "c:"},
      {"format = 1\nname = 7\n", "'name' must be text", "c:2"},
      {"format = 1\nname = \"\"\n", "'name' must have", "c:2"},
      {"format = 1\nname = \"a\\nb\"\n", "control", "c:2"},
      {"format = 1\nname = \"x\"\ncolour = 1\n", "'colour' is unknown", "c:3"},
      {"format = 1\nname = \"x\"\nside = \"up\"\n", "'side'", "c:3"},
      {"format = 1\nname = \"x\"\nmesh_unit = \"inch\"\n", "'mesh_unit'", "c:3"},
      {"format = 1\nname = \"x\"\nbones = 3\n", "'bones' must be written", "c:3"},
      {"format = 1\nname = \"x\"\nbones = [1]\n", "tables only", "c:3"},
      {"format = 1\nname = \n", "not TOML", "c:"},
      {with_bone("mesh = \"a.stl\"\n"), "'name' is missing", "c:3 (bone 1)"},
      {with_bone("name = \"a\"\n"), "'mesh' is missing", "c:3 (bone 1)"},
      {with_bone("name = \"a\"\nmesh = \"../a.stl\"\n"), "folder", "c:5 (bone 1)"},
      {with_bone("name = \"a\"\nmesh = \"x/../../a.stl\"\n"), "folder", "c:5 (bone 1)"},
      {with_bone("name = \"a\"\nmesh = \"/etc/passwd\"\n"), "folder", "c:5 (bone 1)"},
      {with_bone("name = \"a\"\nmesh = \"..\\\\a.stl\"\n"), "folder", "c:5 (bone 1)"},
      {with_bone("name = \"a\"\nmesh = \"C:a.stl\"\n"), "folder", "c:5 (bone 1)"},
      {with_bone("name = \"a\"\nmesh = \"\"\n"), "folder", "c:5 (bone 1)"},
      {with_bone(bone + "density_kg_per_m3 = nan\n"), "'density_kg_per_m3'", "c:6 (bone 1)"},
      {with_bone(bone + "density_kg_per_m3 = inf\n"), "'density_kg_per_m3'", "c:6 (bone 1)"},
      {with_bone(bone + "density_kg_per_m3 = 0\n"), "'density_kg_per_m3'", "c:6 (bone 1)"},
      {with_bone(bone + "density_kg_per_m3 = \"1900\"\n"), "a number", "c:6 (bone 1)"},
      {with_bone(bone + "fma_id = 1.5\n"), "'fma_id' must be a whole", "c:6 (bone 1)"},
      {with_bone(bone + "fma_id = -1\n"), "'fma_id'", "c:6 (bone 1)"},
      {with_bone(bone + "position_m = [1, 2]\n"), "3 numbers", "c:6 (bone 1)"},
      {with_bone(bone + "position_m = [1, 2, nan]\n"), "'position_m'", "c:6 (bone 1)"},
      {with_bone(bone + "position_m = [1, 2, 101]\n"), "'position_m'", "c:6 (bone 1)"},
      {with_bone(bone + "rotation_wxyz = [1, 0, 0]\n"), "4 numbers", "c:6 (bone 1)"},
      {with_bone(bone + "rotation_wxyz = [0.5, 0, 0, 0]\n"), "length 1", "c:6 (bone 1)"},
      {with_bone(bone + "material = 3\n"), "must be a table", "c:6 (bone 1)"},
      {with_bone(bone + "material = { hardness = 1 }\n"), "'hardness' is unknown", "c:6 (bone 1)"},
      {with_bone(bone + "material = { stiffness_n_per_m = -5 }\n"), "stiffness", "c:6 (bone 1)"},
      {with_bone(bone + "material = { static_friction = 0.1, dynamic_friction = 0.2 }\n"),
       "must not exceed", "c:6 (bone 1)"},
      {with_bone(bone + "[[bones]]\nname = \"b\"\nmesh = \"b.stl\"\nweight = 1\n"),
       "'weight' is unknown", "c:9 (bone 2)"},
      {with_bone(bone + soft_lines("kind = \"jelly\"\n")), "'kind' must be", "c:9 (soft part 1)"},
      {with_bone(bone + soft_lines("kind = \"fat\"\nbones = [\"b\"]\n")), "no bone 'b'",
       "c:10 (soft part 1)"},
      {with_bone(bone + soft_lines("kind = \"fat\"\nbones = [1]\n")), "texts",
       "c:10 (soft part 1)"},
      {with_bone(bone + soft_lines("kind = \"fat\"\nthickness_m = -1\n")), "'thickness_m'",
       "c:10 (soft part 1)"},
      {with_bone(bone + soft_lines("kind = \"fat\"\nattachments = [{ name = \"x\" }]\n")),
       "'bone' is missing", "c:10 (soft part 1, attachment 1)"},
      {with_bone(bone + soft_lines("kind = \"fat\"\ncolour = 1\n")), "'colour' is unknown",
       "c:10 (soft part 1)"},
      {with_bone(bone + "[[landmarks]]\nname = \"l\"\n"), "'position_m' is missing",
       "c:6 (landmark 1)"},
      {with_bone(bone + "[[findings]]\ngrade = \"3\"\n"), "'name' is missing", "c:6 (finding 1)"},
      {with_bone(bone + "[[findings]]\nname = \"f\"\ngrade = 3\n"), "'grade' must be text",
       "c:8 (finding 1)"},
      {with_bone(bone + "[[findings]]\nname = \"f\"\ngrades = 3\n"), "'grades' is unknown",
       "c:8 (finding 1)"},
  };
  for (const BadCase& bad : table) {
    const auto result = parse_case_toml(bad.text, "c");
    ASSERT_FALSE(result) << bad.text;
    EXPECT_NE(result.error().what.find(bad.complaint), std::string::npos)
        << bad.text << "\n-> " << result.error().message();
    EXPECT_EQ(result.error().where.find(bad.where), 0u)
        << bad.text << "\n-> " << result.error().where;
  }
}

TEST(CaseToml, TheLeastCaseTakesItsDefaults) {
  const auto result = parse_case_toml(with_bone("name = \"lunate\"\nmesh = \"m/a.stl\"\n"), "c");
  ASSERT_TRUE(result) << result.error().message();
  const BoneDef& bone = result->def.bones.at(0);
  EXPECT_EQ(bone.fma_id, 23712);
  EXPECT_EQ(bone.density_kg_per_m3, 1900);
  EXPECT_EQ(bone.X_WB.p, Vec3(0, 0, 0));
  EXPECT_EQ(result->mesh_files.at(0), "m/a.stl");
  EXPECT_EQ(result->metres_per_unit, 1);
  EXPECT_EQ(result->def.side, "");
}

TEST(CaseToml, RefusesMoreBonesThanASnapshotHolds) {
  std::string text = "format = 1\nname = \"many\"\n";
  for (std::size_t i = 0; i <= kMaxBones; ++i)
    text += "[[bones]]\nname = \"b" + std::to_string(i) + "\"\nmesh = \"b.stl\"\n";
  EXPECT_FALSE(parse_case_toml(text, "c"));
}

CaseDef sample_case() {
  Random random(21);
  CaseDef def;
  def.name = "A \"quoted\" case \\ with signs äöü";
  def.side = "right";
  for (const char* name : {"Scaphoid (proximal)", "scaphoid (distal)", "lunate"}) {
    BoneDef bone;
    bone.name = name;
    bone.X_WB.p = 0.1 * random.direction();
    bone.X_WB.q = random.rotation();
    bone.mesh = test::sphere(random.uniform(0.005, 0.02), 9, 0.01 * random.direction());
    bone.density_kg_per_m3 = random.uniform(1000, 2000);
    bone.material = {random.uniform(500, 3000), 0.31, 0.17};
    def.bones.push_back(bone);
  }
  SoftDef soft;
  soft.name = "a \"band\"";
  soft.tissue = "ligament";
  soft.kind = "ligament";
  soft.mesh_W = test::sphere(0.004, 9, 0.02 * random.direction());
  soft.thickness_m = 0.0013;
  soft.bones = {"lunate", "Scaphoid (proximal)"};
  soft.attachments = {{"origin", "lunate", 0.1 * random.direction()}};
  def.softs.push_back(soft);
  def.landmarks = {{"lister's tubercle", 0.1 * random.direction()}};
  def.findings = {{"geissler", "3", "the \"probe\" passes"}, {"old", "", ""}};
  JointDef joint{"a \"joint\"", "lunate", 12.5, {}};
  joint.bones = {{"scaphoid (distal)", {0, 7.5, {}}}};
  for (int k = 0; k < 5; ++k) {
    const Vec3 p = 0.1 * random.direction();
    joint.bones[0].X_FB.poses.push_back({p, random.rotation()});
  }
  def.joints = {joint};
  def.recipe = CaseRecipe{
      "knee", 18446744073709551615u, "left", {{"size_percent", 101.25}}, {{"acl_tear", "femoral"}}};
  return def;
}

void expect_same_softs(const CaseDef& a, const CaseDef& b) {
  ASSERT_EQ(a.softs.size(), b.softs.size());
  for (std::size_t i = 0; i < a.softs.size(); ++i) {
    const SoftDef &x = a.softs[i], &y = b.softs[i];
    EXPECT_EQ(x.name, y.name);
    EXPECT_EQ(x.tissue, y.tissue);
    EXPECT_EQ(x.kind, y.kind);
    EXPECT_EQ(x.thickness_m, y.thickness_m);
    EXPECT_EQ(x.bones, y.bones);
    EXPECT_EQ(x.mesh_W.triangles.size(), y.mesh_W.triangles.size());
    ASSERT_EQ(x.attachments.size(), y.attachments.size());
    for (std::size_t k = 0; k < x.attachments.size(); ++k) {
      EXPECT_EQ(x.attachments[k].name, y.attachments[k].name);
      EXPECT_EQ(x.attachments[k].bone, y.attachments[k].bone);
      EXPECT_EQ(x.attachments[k].p_W, y.attachments[k].p_W);
    }
  }
}

void expect_same_joints(const CaseDef& a, const CaseDef& b) {
  ASSERT_EQ(a.joints.size(), b.joints.size());
  for (std::size_t i = 0; i < a.joints.size(); ++i) {
    EXPECT_EQ(a.joints[i].name, b.joints[i].name);
    EXPECT_EQ(a.joints[i].fixed, b.joints[i].fixed);
    EXPECT_EQ(a.joints[i].at_deg, b.joints[i].at_deg);
    ASSERT_EQ(a.joints[i].bones.size(), b.joints[i].bones.size());
    for (std::size_t k = 0; k < a.joints[i].bones.size(); ++k) {
      const PoseTrack &x = a.joints[i].bones[k].X_FB, &y = b.joints[i].bones[k].X_FB;
      EXPECT_EQ(a.joints[i].bones[k].bone, b.joints[i].bones[k].bone);
      EXPECT_EQ(x.step, y.step);
      ASSERT_EQ(x.poses.size(), y.poses.size());
      for (std::size_t r = 0; r < x.poses.size(); ++r) {
        EXPECT_EQ(x.poses[r].p, y.poses[r].p);
        EXPECT_EQ(x.poses[r].q.coeffs(), y.poses[r].q.coeffs());
      }
    }
  }
  ASSERT_TRUE(a.recipe && b.recipe);
  EXPECT_EQ(a.recipe->anatomy, b.recipe->anatomy);
  EXPECT_EQ(a.recipe->seed, b.recipe->seed);
  EXPECT_EQ(a.recipe->side, b.recipe->side);
  EXPECT_EQ(a.recipe->set, b.recipe->set);
  EXPECT_EQ(a.recipe->findings, b.recipe->findings);
}

void expect_same(const CaseDef& a, const CaseDef& b) {
  expect_same_softs(a, b);
  expect_same_joints(a, b);
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.side, b.side);
  ASSERT_EQ(a.bones.size(), b.bones.size());
  for (std::size_t i = 0; i < a.bones.size(); ++i) {
    const BoneDef &x = a.bones[i], &y = b.bones[i];
    EXPECT_EQ(x.name, y.name);
    EXPECT_EQ(x.fma_id, y.fma_id);
    EXPECT_EQ(x.X_WB.p, y.X_WB.p);
    EXPECT_EQ(x.X_WB.q.coeffs(), y.X_WB.q.coeffs());
    EXPECT_TRUE(x.mesh.vertices == y.mesh.vertices) << x.name;
    EXPECT_TRUE(x.mesh.triangles == y.mesh.triangles) << x.name;
    EXPECT_EQ(x.beside, y.beside);
    EXPECT_EQ(x.density_kg_per_m3, y.density_kg_per_m3);
    EXPECT_EQ(x.material.stiffness_n_per_m, y.material.stiffness_n_per_m);
    EXPECT_EQ(x.material.static_friction, y.material.static_friction);
    EXPECT_EQ(x.material.dynamic_friction, y.material.dynamic_friction);
  }
  ASSERT_EQ(a.landmarks.size(), b.landmarks.size());
  for (std::size_t i = 0; i < a.landmarks.size(); ++i) {
    EXPECT_EQ(a.landmarks[i].name, b.landmarks[i].name);
    EXPECT_EQ(a.landmarks[i].p_W, b.landmarks[i].p_W);
  }
  ASSERT_EQ(a.findings.size(), b.findings.size());
  for (std::size_t i = 0; i < a.findings.size(); ++i) {
    EXPECT_EQ(a.findings[i].name, b.findings[i].name);
    EXPECT_EQ(a.findings[i].grade, b.findings[i].grade);
    EXPECT_EQ(a.findings[i].meaning, b.findings[i].meaning);
  }
}

TEST(CaseIo, WhatWasLoadedIsSavedBitByBit) {
  const fs::path dir = test::fresh_folder("case_round");
  CaseDef def = sample_case();
  def.bones.back().beside = true;
  ASSERT_TRUE(save_case(def, dir / "a"));
  const auto once = load_case(dir / "a");
  ASSERT_TRUE(once) << once.error().message();
  ASSERT_TRUE(save_case(*once, dir / "b"));
  const auto twice = load_case(dir / "b");
  ASSERT_TRUE(twice);
  expect_same(*once, *twice);
  EXPECT_TRUE(once->bones.back().beside);
  expect_same_joints(def, *once);
  for (std::size_t i = 0; i < def.bones.size(); ++i) {
    EXPECT_EQ(once->bones[i].mesh.vertices.size(), def.bones[i].mesh.vertices.size());
    EXPECT_EQ(once->bones[i].X_WB.p, def.bones[i].X_WB.p);
  }
  EXPECT_TRUE(*read_file(dir / "a/case.toml") == *read_file(dir / "b/case.toml"));
}

TEST(CaseIo, NeverWritesOverFiles) {
  const fs::path dir = test::fresh_folder("case_over");
  ASSERT_TRUE(write_file_atomic(dir / "thesis.txt", "years of work"));
  const auto saved = save_case(sample_case(), dir);
  ASSERT_FALSE(saved);
  EXPECT_NE(saved.error().what.find("is not empty"), std::string::npos);
  EXPECT_EQ(std::distance(fs::directory_iterator(dir), fs::directory_iterator()), 1);
  EXPECT_FALSE(save_case(sample_case(), dir / "thesis.txt"));
  EXPECT_FALSE(save_case(sample_case(), dir / "thesis.txt" / "case"));
}

TEST(CaseIo, DoesNotWriteWhatCouldNotBeReadAgain) {
  const fs::path dir = test::fresh_folder("case_unreadable");
  CaseDef def = sample_case();
  def.bones[1].density_kg_per_m3 = std::nan("");
  EXPECT_FALSE(save_case(def, dir / "a"));
  EXPECT_FALSE(fs::exists(dir / "a"));
}

TEST(CaseIo, NamesWhatIsMissing) {
  const fs::path dir = test::fresh_folder("case_missing");
  EXPECT_NE(load_case(dir / "no").error().what.find("case folder"), std::string::npos);
  EXPECT_NE(load_case(dir).error().where.find("case.toml"), std::string::npos);
  ASSERT_TRUE(save_case(sample_case(), dir / "a"));
  ASSERT_TRUE(fs::remove(dir / "a/lunate.stl"));
  const auto result = load_case(dir / "a");
  ASSERT_FALSE(result);
  EXPECT_NE(result.error().where.find("lunate.stl"), std::string::npos);
}

TEST(CaseIo, RefusesALinkOutOfTheFolder) {
  const fs::path dir = test::fresh_folder("case_link");
  ASSERT_TRUE(save_case(sample_case(), dir / "a"));
  fs::rename(dir / "a/lunate.stl", dir / "outside.stl");
  fs::create_symlink(dir / "outside.stl", dir / "a/lunate.stl");
  const auto result = load_case(dir / "a");
  ASSERT_FALSE(result);
  EXPECT_NE(result.error().what.find("outside"), std::string::npos);
}

TEST(CaseIo, RefusesABrokenMesh) {
  const fs::path dir = test::fresh_folder("case_broken");
  ASSERT_TRUE(save_case(sample_case(), dir / "a"));
  const std::string bytes = *read_file(dir / "a/lunate.stl");
  ASSERT_TRUE(write_file_atomic(dir / "a/lunate.stl", bytes.substr(0, bytes.size() / 2)));
  EXPECT_FALSE(load_case(dir / "a"));
}

TEST(CaseIo, ReadsMeshesInTheirUnit) {
  const fs::path dir = test::fresh_folder("case_unit");
  ASSERT_TRUE(save_stl(test::cube(0.01), dir / "a.stl", 0.001));
  ASSERT_TRUE(write_file_atomic(dir / "case.toml",
                                "format = 1\nname = \"mm\"\nmesh_unit = \"mm\"\n[[bones]]\nname = "
                                "\"a\"\nmesh = \"a.stl\"\n"));
  const auto result = load_case(dir);
  ASSERT_TRUE(result) << result.error().message();
  EXPECT_NEAR(result->bones[0].mesh.vertices[0].cwiseAbs().maxCoeff(), 0.01, 1e-9);
}

// Every finding of check_case, each on its own.
CaseDef bones_alone() {
  CaseDef def = sample_case();
  def.softs.clear();
  return def;
}

TEST(CheckCase, FindsWhatIsWrong) {
  ASSERT_TRUE(check_case(bones_alone()).empty());
  const auto finding = [](auto spoil) {
    CaseDef def = bones_alone();
    spoil(def);
    const std::vector<std::string> found = check_case(def);
    return found.size() == 1 ? found[0] : std::to_string(found.size()) + " findings";
  };
  const auto has = [](const std::string& text, const char* part) {
    return text.find(part) != std::string::npos;
  };
  EXPECT_TRUE(has(finding([](CaseDef& d) { d.bones.clear(), d.landmarks.clear(); }), "no bones"));
  EXPECT_TRUE(has(finding([](CaseDef& d) { d.side = "up"; }), "side"));
  EXPECT_TRUE(has(finding([](CaseDef& d) { d.bones[1].name = d.bones[0].name; }), "twice"));
  EXPECT_TRUE(has(finding([](CaseDef& d) { d.bones[0].mesh.triangles.pop_back(); }), "open"));
  EXPECT_TRUE(
      has(finding([](CaseDef& d) { d.bones[0].mesh.triangles[0][0] = 1u << 30; }), "not exist"));
  EXPECT_TRUE(has(finding([](CaseDef& d) { test::flip(d.bones[0].mesh.triangles[4]); }), "face"));
  EXPECT_TRUE(has(finding([](CaseDef& d) {
                    for (Triangle& t : d.bones[2].mesh.triangles) test::flip(t);
                  }),
                  "inside out"));
  EXPECT_TRUE(has(finding([](CaseDef& d) {
                    for (Vec3& v : d.bones[2].mesh.vertices) v *= 1000;
                    d.landmarks.clear();
                  }),
                  "unit"));
  EXPECT_TRUE(has(finding([](CaseDef& d) {
                    for (Vec3& v : d.bones[2].mesh.vertices) v *= 0.001;
                  }),
                  "unit"));
  EXPECT_TRUE(
      has(finding([](CaseDef& d) { d.bones[0].material.stiffness_n_per_m = 1e5; }), "stiffness"));
  EXPECT_TRUE(
      has(finding([](CaseDef& d) { d.bones[0].material.static_friction = 1.5; }), "friction"));
  EXPECT_TRUE(
      has(finding([](CaseDef& d) { d.bones[0].material.dynamic_friction = 0.9; }), "dynamic"));
  EXPECT_TRUE(has(finding([](CaseDef& d) { d.bones[0].density_kg_per_m3 = 9000; }), "density"));
  EXPECT_TRUE(has(finding([](CaseDef& d) { d.landmarks[0].p_W = Vec3(5, 0, 0); }), "lies more"));
}

}  // namespace
}  // namespace osteon
