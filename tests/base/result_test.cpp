#include "osteon/base/result.h"

#include <gtest/gtest.h>

namespace osteon {
namespace {

TEST(Error, MessageOfAnEmptyErrorIsEmpty) { EXPECT_EQ(Error{}.message(), ""); }

TEST(Error, MessageSaysWhereWhatAndWhatToDo) {
  const Error e{"the mesh has no triangles", "bone.stl", "Export it again"};
  EXPECT_EQ(e.message(), "bone.stl: the mesh has no triangles. Export it again.");
}

TEST(Result, CarriesAValueOrAnError) {
  const Result<int> good = 3;
  const Result<int> bad = fail("no", "here");
  ASSERT_TRUE(good);
  EXPECT_EQ(*good, 3);
  ASSERT_FALSE(bad);
  EXPECT_EQ(bad.error().where, "here");
}

}  // namespace
}  // namespace osteon
