#include "osteon/base/hash.h"

namespace osteon {

void Hasher::bytes(const void* data, std::size_t size) {
  const auto* p = static_cast<const unsigned char*>(data);
  for (std::size_t i = 0; i < size; ++i) h_ = (h_ ^ p[i]) * 0x100000001b3ull;
}

void Hasher::add(std::string_view text) {
  add(static_cast<std::uint64_t>(text.size()));
  bytes(text.data(), text.size());
}

void Hasher::add(const Vec3& v) {
  for (int i = 0; i < 3; ++i) add(v[i]);
}

void Hasher::add(const Quat& q) {
  add(q.w());
  add(q.x());
  add(q.y());
  add(q.z());
}

void Hasher::add(const Pose& X) {
  add(X.p);
  add(X.q);
}

}  // namespace osteon
