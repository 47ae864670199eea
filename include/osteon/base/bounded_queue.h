#pragma once

#include <atomic>
#include <cstddef>
#include <vector>

namespace osteon {

/// Lock-free queue of fixed capacity for one producer and one consumer. Allocates in its
/// constructor only. `push` returns false when full; the caller says what that means.
template <class T>
class BoundedQueue {
 public:
  explicit BoundedQueue(std::size_t capacity) : slots_(capacity + 1) {}
  BoundedQueue(const BoundedQueue&) = delete;
  BoundedQueue& operator=(const BoundedQueue&) = delete;

  bool push(const T& value) {
    const std::size_t tail = tail_.load(std::memory_order_relaxed);
    const std::size_t next = advance(tail);
    if (next == head_.load(std::memory_order_acquire)) return false;
    slots_[tail] = value;
    tail_.store(next, std::memory_order_release);
    return true;
  }

  bool pop(T& value) {
    const std::size_t head = head_.load(std::memory_order_relaxed);
    if (head == tail_.load(std::memory_order_acquire)) return false;
    value = slots_[head];
    head_.store(advance(head), std::memory_order_release);
    return true;
  }

  /// The consumer's next value where it lies, null when there is none: a large one need not be
  /// copied. It stays until `drop`.
  const T* front() const {
    const std::size_t head = head_.load(std::memory_order_relaxed);
    return head == tail_.load(std::memory_order_acquire) ? nullptr : &slots_[head];
  }
  /// Takes what `front` has shown out of the queue.
  void drop() {
    head_.store(advance(head_.load(std::memory_order_relaxed)), std::memory_order_release);
  }

 private:
  std::size_t advance(std::size_t i) const { return i + 1 == slots_.size() ? 0 : i + 1; }

  std::vector<T> slots_;
  alignas(64) std::atomic<std::size_t> head_{0};
  alignas(64) std::atomic<std::size_t> tail_{0};
};

}  // namespace osteon
