// Counts what the haptic tick takes from the heap: nothing.
#include <gtest/gtest.h>

#include <cstdlib>
#include <new>

#include "session_fixtures.h"

#if defined(__GNUC__) && !defined(__clang__)
// g++ sees a library's delete beside the replaced new once either is inlined.
#pragma GCC diagnostic ignored "-Wmismatched-new-delete"
#endif

namespace {
thread_local std::uint64_t allocations = 0;

void* count_and_allocate(std::size_t size, std::size_t alignment) {
  ++allocations;
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
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }

namespace osteon {
namespace {

TEST(NoAllocation, TheCounterCounts) {
  const std::uint64_t before = allocations;
  { const std::vector<int> some(100); }
  EXPECT_EQ(allocations, before + 1);
}

TEST(NoAllocation, InAHapticTickAndItsRecord) {
  Session session(testing::two_box_case(), testing::moving_bones());
  for (std::uint64_t n = 1; n <= 3000; ++n) {
    const ToolInput input = testing::hand_at(n);
    const Command command = testing::command_at(n);
    const std::uint64_t before = allocations;
    const ToolState& tool = session.haptic_tick(input, session.bones(), command);
    ASSERT_EQ(allocations, before) << n;
    (void)session.physics_step(tool, command);
  }
}

TEST(NoAllocation, InAReportWithinItsReservedTime) {
  const auto the_case = testing::two_box_case();
  Session session(the_case, {});
  ReportBuilder builder(*the_case);
  for (std::uint64_t n = 1; n <= 3000; ++n) {
    const ToolState& tool = session.haptic_tick(testing::hand_at(n), session.bones());
    const std::uint64_t before = allocations;
    builder.add(tool);
    ASSERT_EQ(allocations, before) << n;
  }
}

}  // namespace
}  // namespace osteon
