#pragma once

#include <cstddef>

#include "osteon/base/bounded_queue.h"

namespace osteon {

/// A BoundedQueue that goes round in few places while its consumer keeps up: what it holds is then
/// still in both caches, and of a large queue of large values is not. `few` places come first, and
/// `rest` more when these are full.
///
/// Order: while anything is in the rest, the producer adds there alone; so all that is in the few
/// places is older. It sees that the rest is empty as the consumer does, by `front`, which only
/// reads. The consumer looks at the rest first: if it finds something there, everything older was
/// put into the few places before, and is seen.
template <class T>
class WarmQueue {
 public:
  WarmQueue(std::size_t few, std::size_t rest) : few_(few), rest_(rest) {}

  bool push(const T& value) {
    return (rest_.front() == nullptr && few_.push(value)) || rest_.push(value);
  }
  /// The consumer's next value where it lies, null when there is none. It stays until `drop`.
  const T* front() const {
    const T* const later = rest_.front();
    const T* const first = few_.front();
    return first ? first : later;
  }
  /// Takes what `front` has shown out of the queue.
  void drop() {
    if (few_.front())
      few_.drop();
    else
      rest_.drop();
  }

 private:
  BoundedQueue<T> few_, rest_;
};

}  // namespace osteon
