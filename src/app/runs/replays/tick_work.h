#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "osteon/base/percentiles.h"

namespace osteon {

/// Work of each tick of a recording that is replayed several times: the fastest counts, which
/// leaves out most of what other programs and interrupts took.
class TickWork {
 public:
  /// Before each run.
  void begin_run();
  /// In a run: the next tick of a hand took so long.
  void see(std::size_t hand, std::int64_t ns);
  std::size_t runs() const { return runs_; }
  std::size_t hands() const { return hands_.size(); }
  /// Of the ticks that the longest run had.
  Percentiles of(std::size_t hand) const;

 private:
  struct Hand {
    std::vector<std::uint32_t> least_ns;
    std::size_t at = 0;  // of this run
  };
  std::vector<Hand> hands_;
  std::size_t runs_ = 0;
};

/// One line a hand.
std::string to_text(const TickWork& work, const std::vector<std::string>& hand_names);

}  // namespace osteon
