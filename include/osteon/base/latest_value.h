#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <type_traits>

namespace osteon {

/// Lock-free triple buffer: one writer publishes whole values, one reader takes the newest.
/// Neither side ever waits; a value that is not read in time is replaced.
template <class T>
class LatestValue {
 public:
  explicit LatestValue(const T& initial = T{}) { slots_.fill(Slot{initial}); }
  LatestValue(const LatestValue&) = delete;
  LatestValue& operator=(const LatestValue&) = delete;

  /// Writer's side.
  void publish(const T& value) {
    slots_[write_].value = value;
    write_ = shared_.exchange(write_ | kFresh, std::memory_order_acq_rel) & kIndex;
  }

  /// Reader's side: the newest value; stays valid until the next call. `fresh` says whether it is
  /// newer than that of the last call.
  const T& read(bool* fresh = nullptr) {
    const bool is_fresh = (shared_.load(std::memory_order_relaxed) & kFresh) != 0;
    if (is_fresh) read_ = shared_.exchange(read_, std::memory_order_acq_rel) & kIndex;
    if (fresh) *fresh = is_fresh;
    return slots_[read_].value;
  }

 private:
  static constexpr std::uint32_t kFresh = 4;
  static constexpr std::uint32_t kIndex = 3;
  struct alignas(64) Slot {
    T value;
  };
  std::array<Slot, 3> slots_;
  alignas(64) std::uint32_t write_ = 0;
  alignas(64) std::uint32_t read_ = 1;
  alignas(64) std::atomic<std::uint32_t> shared_{2};
};

}  // namespace osteon
