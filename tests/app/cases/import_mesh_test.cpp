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
