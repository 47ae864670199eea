#include "osteon/scene/field_cache.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <utility>

#include "../../mesh/shapes.h"
#include "osteon/base/file.h"
#include "osteon/scene/build_case.h"

namespace osteon {
namespace {

namespace fs = std::filesystem;

FieldCache::Field a_field() {
  FieldOptions options;
  options.most_blocks = 64;
  static const auto field = std::make_shared<const DistanceField>(
      std::move(DistanceField::make(test::cube(0.003), options).value()));
  return field;
}

class FieldCacheFile : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("osteon_fields_" + std::to_string(::getpid()));
    fs::remove_all(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  fs::path file() const { return folder_ / "deep" / "fields.bin"; }
  fs::path folder_;
};

TEST(FieldBytes, NoFieldsAreAFileToo) {
  const auto read = read_fields(to_bytes(std::map<std::uint64_t, FieldCache::Field>{}));
  ASSERT_TRUE(read);
  EXPECT_TRUE(read->empty());
  EXPECT_FALSE(read_fields(""));
  EXPECT_FALSE(read_fields("OSTNFLD1"));
}

TEST(FieldBytes, ComeBackAsTheyWere) {
  const auto read = read_fields(to_bytes({{7, a_field()}}));
  ASSERT_TRUE(read);
  ASSERT_EQ(read->size(), 1u);
  EXPECT_EQ(read->at(7)->hash(), a_field()->hash());
  EXPECT_EQ(read->at(7)->at(Vec3(0, 0, 0.0032)).distance,
            a_field()->at(Vec3(0, 0, 0.0032)).distance);
}

TEST(FieldBytes, DamageIsNoticed) {
  const std::string good = to_bytes({{7, a_field()}});
  for (std::size_t size = 0; size < good.size(); size += 1 + size / 3)
    EXPECT_FALSE(read_fields(good.substr(0, size))) << size;
  EXPECT_FALSE(read_fields(good.substr(0, good.size() - 1)));
  EXPECT_FALSE(read_fields(good + "x"));
  for (std::size_t i = 0; i < good.size(); i += 1 + good.size() / 40) {
    std::string bad = good;
    bad[i] = static_cast<char>(bad[i] ^ 0x10);
    EXPECT_FALSE(read_fields(bad)) << i;
  }
}

TEST_F(FieldCacheFile, AMissingOrBrokenFileIsAnEmptyCache) {
  EXPECT_EQ(FieldCache(file()).find(7), nullptr);
  fs::create_directories(file().parent_path());
  ASSERT_TRUE(write_file_atomic(file(), "something else"));
  EXPECT_EQ(FieldCache(file()).find(7), nullptr);
}

TEST_F(FieldCacheFile, KeepsWhatIsInUseAndDropsTheRest) {
  FieldCache first(file());
  first.put(7, a_field());
  first.put(8, a_field());
  ASSERT_TRUE(first.save());
  FieldCache second(file());
  ASSERT_NE(second.find(7), nullptr);
  second.put(9, a_field());
  ASSERT_TRUE(second.save());
  FieldCache third(file());
  EXPECT_NE(third.find(7), nullptr);
  EXPECT_EQ(third.find(8), nullptr);
  EXPECT_NE(third.find(9), nullptr);
}

CaseDef one_bone(TriMesh mesh) {
  CaseDef def;
  def.name = "one";
  BoneDef bone;
  bone.name = "bone";
  bone.mesh = std::move(mesh);
  bone.felt = Felt::kField;
  def.bones.push_back(std::move(bone));
  return def;
}

TEST(FeltAsAField, AnOpenMeshIsAnErrorThatNamesTheBone) {
  TriMesh open = test::cube(0.003);
  open.triangles.pop_back();
  const auto built = build_case(one_bone(open));
  ASSERT_FALSE(built);
  EXPECT_NE(built.error().message().find("bone 'bone'"), std::string::npos);
  EXPECT_NE(built.error().message().find("open"), std::string::npos);
}

TEST(FeltAsAField, TheSameCaseComesFromTheCache) {
  FieldCache cache;
  BuildOptions options;
  options.fields = &cache;
  const auto fresh = build_case(one_bone(test::cube(0.003)), options);
  const auto again = build_case(one_bone(test::cube(0.003)), options);
  ASSERT_TRUE(fresh && again);
  EXPECT_EQ(fresh->hash, again->hash);
  ASSERT_TRUE(fresh->bones[0].field);
  EXPECT_EQ(fresh->bones[0].field, again->bones[0].field);
  CaseDef pieces = one_bone(test::cube(0.003));
  pieces.bones[0].felt = Felt::kPieces;
  const auto other = build_case(std::move(pieces));
  ASSERT_TRUE(other);
  EXPECT_FALSE(other->bones[0].field);
  EXPECT_NE(other->hash, fresh->hash);
}

}  // namespace
}  // namespace osteon
