// The counter behind count_allocations.h: the one replacement of operator new in a program.
#include "count_allocations.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdlib>
#include <new>
#include <vector>

#if defined(__GNUC__) && !defined(__clang__)
// g++ sees a library's delete beside the replaced new once either is inlined.
#pragma GCC diagnostic ignored "-Wmismatched-new-delete"
#endif

namespace {
thread_local std::uint64_t count = 0;

void* count_and_allocate(std::size_t size, std::size_t alignment) {
  ++count;
  // aligned_alloc wants a whole number of alignments.
  const std::size_t whole = (size + alignment - 1) / alignment * alignment;
  void* memory = std::aligned_alloc(alignment, whole ? whole : alignment);
  if (!memory) throw std::bad_alloc();
  return memory;
}
}  // namespace

// The whole program's, for as long as this test program runs; arrays come through these too.
void* operator new(std::size_t size) { return count_and_allocate(size, alignof(std::max_align_t)); }
void* operator new(std::size_t size, std::align_val_t alignment) {
  return count_and_allocate(size, static_cast<std::size_t>(alignment));
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  try {
    return count_and_allocate(size, alignof(std::max_align_t));
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }

namespace osteon {

std::uint64_t testing::allocations() { return count; }

namespace {

using testing::allocations;

TEST(Allocations, TheCounterCounts) {
  const std::uint64_t before = allocations();
  { const std::vector<int> some(100); }
  EXPECT_EQ(allocations(), before + 1);
}

}  // namespace
}  // namespace osteon
