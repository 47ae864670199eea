#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <type_traits>

#include "osteon/base/types.h"

namespace osteon {

/// Streaming 64-bit FNV-1a hash (Fowler, Noll, Vo). Detects divergence and mix-ups, not attacks.
/// Feed values, never whole structs: padding bytes are not part of a state.
class Hasher {
 public:
  void bytes(const void* data, std::size_t size);
  template <class T>
  requires std::is_arithmetic_v<T>
  void add(T value) { bytes(&value, sizeof value); }
  void add(std::string_view text);
  void add(const Vec3& v);
  void add(const Quat& q);
  void add(const Pose& X);
  std::uint64_t value() const { return h_; }

 private:
  std::uint64_t h_ = 0xcbf29ce484222325ull;
};

}  // namespace osteon
