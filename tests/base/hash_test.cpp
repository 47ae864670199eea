#include "osteon/base/hash.h"

#include <gtest/gtest.h>

#include <cmath>

namespace osteon {
namespace {

std::uint64_t hash_of(std::string_view bytes) {
  Hasher h;
  h.bytes(bytes.data(), bytes.size());
  return h.value();
}

// Test vectors published with the FNV-1a reference code.
TEST(Hasher, AgreesWithPublishedVectors) {
  EXPECT_EQ(hash_of(""), 0xcbf29ce484222325ull);
  EXPECT_EQ(hash_of("a"), 0xaf63dc4c8601ec8cull);
  EXPECT_EQ(hash_of("foobar"), 0x85944171f73967e8ull);
}

TEST(Hasher, TellsTextBoundariesApart) {
  Hasher a, b;
  a.add(std::string_view("ab"));
  a.add(std::string_view("c"));
  b.add(std::string_view("a"));
  b.add(std::string_view("bc"));
  EXPECT_NE(a.value(), b.value());
}

TEST(Hasher, SeesTheLastBitOfAPose) {
  Pose X;
  X.p = Vec3(1, 2, 3);
  Hasher a, b;
  a.add(X);
  X.p.z() = std::nextafter(3.0, 4.0);
  b.add(X);
  EXPECT_NE(a.value(), b.value());
}

}  // namespace
}  // namespace osteon
