#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "osteon/base/types.h"
#include "osteon/scene/state.h"

// A stored state is a row of words. Each part of a state has one list of its fields, a template
// over the direction: Out appends a word for each, In takes one and checks it.
namespace osteon::stored {

constexpr std::uint64_t kVersion = 38;

// Appends words. One list of fields serves both directions.
struct Out {
  static constexpr bool kReads = false;
  std::string bytes;
  bool ok = true;
  void word(std::uint64_t value) {
    char raw[8];
    for (int i = 0; i < 8; ++i) raw[i] = static_cast<char>((value >> (8 * i)) & 0xff);
    bytes.append(raw, sizeof raw);
  }
};

struct In {
  static constexpr bool kReads = true;
  std::string_view bytes;
  std::size_t at = 0;
  bool ok = true;
  std::uint64_t version = kVersion;
  std::uint64_t word() {
    if (bytes.size() - at < 8) {
      ok = false;
      return 0;
    }
    std::uint64_t value = 0;
    for (int i = 0; i < 8; ++i)
      value |= std::uint64_t{static_cast<unsigned char>(bytes[at + static_cast<std::size_t>(i)])}
               << (8 * i);
    at += 8;
    return value;
  }
};

// Whether the state says what version `first` brought.
template <class A>
bool since([[maybe_unused]] const A& a, std::uint64_t first) {
  if constexpr (A::kReads)
    return a.version >= first;
  else
    return first <= kVersion;
}

template <class A, class T>
void number(A& a, T& value, std::uint64_t most) {
  if constexpr (A::kReads) {
    const std::uint64_t word = a.word();
    a.ok = a.ok && word <= most;
    value = a.ok ? static_cast<T>(word) : T{};
  } else {
    a.word(static_cast<std::uint64_t>(value));
  }
}

template <class A>
void field(A& a, double& value) {
  if constexpr (A::kReads)
    value = std::bit_cast<double>(a.word());
  else
    a.word(std::bit_cast<std::uint64_t>(value));
}
template <class A>
void field(A& a, std::uint64_t& value) {
  number(a, value, ~std::uint64_t{0});
}
template <class A>
void field(A& a, std::uint32_t& value) {
  number(a, value, 0xffffffffu);
}
template <class A>
void field(A& a, std::uint8_t& value) {
  number(a, value, 0xff);
}
template <class A>
void field(A& a, bool& value) {
  number(a, value, 1);
}
template <class A>
void field(A& a, Vec3& v) {
  for (int i = 0; i < 3; ++i) field(a, v[i]);
}
template <class A>
void field(A& a, Pose& X) {
  field(a, X.p);
  for (int i = 0; i < 4; ++i) field(a, X.q.coeffs()[i]);
}
template <class A>
void field(A& a, BoneId& id) {
  field(a, id.index);
}

template <class A, class T>
void first_of(A& a, std::uint32_t& count, T& list) {
  number(a, count, list.size());
  for (std::uint32_t i = 0; i < count; ++i) field(a, list[i]);
}

}  // namespace osteon::stored
