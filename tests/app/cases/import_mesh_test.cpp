#include "cases/import_mesh.h"

#include <gtest/gtest.h>

#include "mesh/shapes.h"
#include "osteon/base/file.h"
#include "osteon/mesh/measure.h"
#include "osteon/mesh/mesh_io.h"
#include "osteon/scene/case_io.h"

namespace osteon {
namespace {

namespace fs = std::filesystem;

fs::path folder_of_meshes(const std::string& name) {
  const fs::path dir = test::fresh_folder(name);
  fs::create_directories(dir / "in");
  EXPECT_TRUE(save_stl(test::sphere(0.008, 8, Vec3(0.1, 0.2, 0.3)), dir / "in/lunate.stl", 0.001));
  TriMesh broken = test::sphere(0.02, 8, Vec3(0.1, 0.2, 0.4));
  for (Triangle& t : broken.triangles) test::flip(t);
  broken.triangles.pop_back();
  EXPECT_TRUE(save_stl(broken, dir / "in/1mc.STL", 0.001));
  EXPECT_TRUE(write_file_atomic(dir / "in/notes.txt", "not a mesh"));
  return dir;
}

ImportOptions options_for(const fs::path& dir) {
  ImportOptions options;
  options.source = dir / "in";
  options.metres_per_unit = 0.001;
  options.out = dir / "wrist";
  return options;
}

std::string complaint(const ImportOptions& options) {
  const auto result = import_meshes(options);
  return result ? "" : result.error().message();
}

TEST(ImportMesh, RefusesBadSources) {
  const fs::path dir = folder_of_meshes("import_bad");
  ImportOptions options = options_for(dir);
  options.source = dir / "nothing";
  EXPECT_NE(complaint(options).find("cannot be read"), std::string::npos);
  fs::create_directories(dir / "empty");
  options.source = dir / "empty";
  EXPECT_NE(complaint(options).find("holds no mesh"), std::string::npos);
  options.source = dir / "in/notes.txt";
  EXPECT_NE(complaint(options).find("format"), std::string::npos);
  EXPECT_FALSE(fs::exists(dir / "wrist"));
}

TEST(ImportMesh, RefusesTwoFilesOfOneBone) {
  const fs::path dir = folder_of_meshes("import_twice");
  fs::copy_file(dir / "in/lunate.stl", dir / "in/Lunate.stl");
  EXPECT_NE(complaint(options_for(dir)).find("'lunate'"), std::string::npos);
}

TEST(ImportMesh, RefusesWhatIsNoBone) {
  const fs::path dir = test::fresh_folder("import_no_bone");
  fs::create_directories(dir / "in");
  ImportOptions options = options_for(dir);
  TriMesh one;
  one.vertices = {Vec3(0, 0, 0), Vec3(0.01, 0, 0), Vec3(0, 0.01, 0)};
  one.triangles = {{0, 1, 2}};
  ASSERT_TRUE(save_stl(one, dir / "in/lunate.stl", 0.001));
  options.force = true;
  EXPECT_NE(complaint(options).find("has no volume: it is one triangle"), std::string::npos)
      << complaint(options);
}

TEST(ImportMesh, RefusesAWrongUnitAndSuggestsTheRightOne) {
  const fs::path dir = test::fresh_folder("import_unit");
  fs::create_directories(dir / "in");
  ASSERT_TRUE(save_stl(test::sphere(0.012, 8), dir / "in/capitate.stl", 0.001));  // 24 mm
  ImportOptions options = options_for(dir);
  options.metres_per_unit = 0.01;
  EXPECT_NE(complaint(options).find("is 240 mm long"), std::string::npos) << complaint(options);
  EXPECT_NE(complaint(options).find("--unit mm"), std::string::npos) << complaint(options);
  options.metres_per_unit = 1;
  EXPECT_NE(complaint(options).find("24000 mm"), std::string::npos) << complaint(options);
  EXPECT_FALSE(fs::exists(dir / "wrist"));
  options.metres_per_unit = 0.01;
  options.force = true;
  EXPECT_EQ(complaint(options), "");
}

TEST(ImportMesh, RefusesPartsThatOverlap) {
  const fs::path dir = test::fresh_folder("import_overlap");
  fs::create_directories(dir / "in");
  TriMesh two = test::cube(0.01);
  const TriMesh other = test::cube(0.01, Vec3(0.011, 0.007, 0.003));
  for (const Vec3& v : other.vertices) two.vertices.push_back(v);
  for (const Triangle& t : other.triangles) two.triangles.push_back({t[0] + 8, t[1] + 8, t[2] + 8});
  ASSERT_TRUE(save_stl(two, dir / "in/block.stl", 0.001));
  ImportOptions options = options_for(dir);
  EXPECT_NE(complaint(options).find("pass through each other"), std::string::npos);
  EXPECT_FALSE(fs::exists(dir / "wrist"));
  options.force = true;
  const auto taken = import_meshes(options);
  ASSERT_TRUE(taken) << taken.error().message();
  EXPECT_EQ(taken->bones[0].triangles, 24u);
  EXPECT_GT(taken->bones[0].crossings, 0u);
  const std::vector<std::string> found = check_case(taken->def);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NE(found[0].find("pass through each other"), std::string::npos) << found[0];
}

// Boxes on a common diagonal, on a common face and on a common edge.
TEST(ImportMesh, RefusesBoxesThatMeetInSpecialPlaces) {
  int number = 0;
  for (const Vec3& shift : {Vec3(0.01, 0.01, 0.01), Vec3(0.02, 0, 0), Vec3(0.02, 0.02, 0)}) {
    const fs::path dir = test::fresh_folder("import_boxes_" + std::to_string(++number));
    fs::create_directories(dir / "in");
    const TriMesh two = test::joined(test::cube(0.01), test::cube(0.01, shift));
    ASSERT_TRUE(save_stl(two, dir / "in/block.stl", 0.001));
    const std::string said = complaint(options_for(dir));
    EXPECT_NE(said.find("--force"), std::string::npos) << shift.transpose() << ": " << said;
    EXPECT_FALSE(fs::exists(dir / "wrist"));
  }
}

TEST(ImportMesh, CapsACutShaft) {
  const fs::path dir = test::fresh_folder("import_shaft");
  fs::create_directories(dir / "in");
  TriMesh shaft = test::sphere(0.01, 150);  // 300 around
  for (Vec3& v : shaft.vertices) v.z() *= 8;
  std::erase_if(shaft.triangles, [&](const Triangle& t) {
    return std::max({shaft.vertices[t[0]].z(), shaft.vertices[t[1]].z(),
                     shaft.vertices[t[2]].z()}) > 0.0001;
  });
  ASSERT_TRUE(save_stl(shaft, dir / "in/radius.stl", 0.001));
  const auto result = import_meshes(options_for(dir));
  ASSERT_TRUE(result) << result.error().message();
  EXPECT_EQ(result->bones[0].repair.capped_ends, 1u);
  EXPECT_TRUE(result->bones[0].closed);
  EXPECT_NEAR(volume(result->def.bones[0].mesh), 2 * M_PI / 3 * 0.01 * 0.01 * 0.08, 2e-8);
}

TEST(ImportMesh, NeverTouchesAnExistingFolder) {
  const fs::path dir = folder_of_meshes("import_over");
  fs::create_directories(dir / "wrist");
  ASSERT_TRUE(write_file_atomic(dir / "wrist/thesis.txt", "years of work"));
  EXPECT_NE(complaint(options_for(dir)).find("already exists"), std::string::npos);
  EXPECT_TRUE(fs::exists(dir / "wrist/thesis.txt"));
}

TEST(ImportMesh, AFailedImportLeavesNothing) {
  const fs::path dir = folder_of_meshes("import_fails");
  ASSERT_TRUE(write_file_atomic(dir / "in/zz.stl", "solid broken"));
  EXPECT_FALSE(import_meshes(options_for(dir)));
  EXPECT_EQ(std::distance(fs::directory_iterator(dir), fs::directory_iterator()), 1);
}

TEST(ImportMesh, MendsNamesAndCenters) {
  const fs::path dir = folder_of_meshes("import_good");
  const auto result = import_meshes(options_for(dir));
  ASSERT_TRUE(result) << result.error().message();
  ASSERT_EQ(result->def.bones.size(), 2u);
  EXPECT_EQ(result->def.name, "wrist");
  EXPECT_EQ(result->def.bones[0].name, "metacarpal_1");
  EXPECT_EQ(result->def.bones[0].fma_id, 23899);
  EXPECT_EQ(result->bones[0].repair.filled_holes, 1u);
  EXPECT_TRUE(result->bones[0].closed);
  const auto loaded = load_case(dir / "wrist");
  ASSERT_TRUE(loaded) << loaded.error().message();
  EXPECT_TRUE(check_case(*loaded).empty());
  const BoneDef& lunate = loaded->bones[1];
  EXPECT_LT((lunate.X_WB.p - Vec3(0.1, 0.2, 0.3)).norm(), 1e-7);
  EXPECT_LT(centroid(lunate.mesh).norm(), 1e-7);
  EXPECT_GT(volume(lunate.mesh), 0);
  EXPECT_EQ(std::distance(fs::directory_iterator(dir), fs::directory_iterator()), 2)
      << "the folder in the making must be gone";
}

TEST(ImportMesh, TakesOneFileAndATrailingSlash) {
  const fs::path dir = folder_of_meshes("import_one");
  ImportOptions options = options_for(dir);
  options.source = dir / "in/lunate.stl";
  options.out = dir / "one/";
  const auto result = import_meshes(options);
  ASSERT_TRUE(result) << result.error().message();
  EXPECT_EQ(result->def.name, "one");
  EXPECT_TRUE(load_case(dir / "one"));
}

// Of one hull a bone: what the files hold is the question here, not how it is cut into pieces.
std::uint64_t hash_of(const fs::path& folder) {
  auto def = load_case(folder);
  if (!def) return 0;
  for (BoneDef& bone : def->bones) bone.felt = Felt::kHull;
  const auto built = build_case(*def);
  return built ? built->hash : 0;
}

TEST(ImportMesh, RealWrist) {
  const fs::path source = test::shared_folder() / "anatomy/wrist";
  if (!fs::is_directory(source)) GTEST_SKIP() << "no reference bones in " << source;
  ImportOptions options;
  options.source = source;
  options.out = test::fresh_folder("import_wrist") / "real";
  options.side = "right";
  const auto result = import_meshes(options);
  ASSERT_TRUE(result) << result.error().message();
  EXPECT_EQ(result->bones.size(), 15u);
  auto loaded = load_case(options.out);
  ASSERT_TRUE(loaded) << loaded.error().message();
  EXPECT_TRUE(check_case(*loaded).empty()) << check_case(*loaded).front();
  for (const BoneDef& bone : loaded->bones) EXPECT_NE(bone.fma_id, 0) << bone.name;
  const std::uint64_t hash = hash_of(options.out);
  EXPECT_NE(hash, 0u);
  EXPECT_EQ(hash_of(options.out), hash);
  ASSERT_TRUE(save_case(*loaded, options.out.parent_path() / "again"));
  EXPECT_EQ(hash_of(options.out.parent_path() / "again"), hash);
}

}  // namespace
}  // namespace osteon
