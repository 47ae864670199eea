#include "runs/replays/tick_work.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <limits>

namespace osteon {

void TickWork::begin_run() {
  for (Hand& hand : hands_) hand.at = 0;
  ++runs_;
}

void TickWork::see(std::size_t hand, std::int64_t ns) {
  constexpr std::int64_t kMost = std::numeric_limits<std::uint32_t>::max();
  const auto took = static_cast<std::uint32_t>(std::clamp<std::int64_t>(ns, 0, kMost));
  if (hands_.size() <= hand) hands_.resize(hand + 1);
  Hand& of = hands_[hand];
  if (of.at < of.least_ns.size())
    of.least_ns[of.at] = std::min(of.least_ns[of.at], took);
  else
    of.least_ns.push_back(took);
  ++of.at;
}

Percentiles TickWork::of(std::size_t hand) const {
  Percentiles out;
  for (const std::uint32_t ns : hands_[hand].least_ns) out.add_ns(ns);
  return out;
}

std::string to_text(const TickWork& work, const std::vector<std::string>& hand_names) {
  std::string out = "\nwork of a tick in us, the fastest of " + std::to_string(work.runs()) +
                    " runs of each counts:\n";
  for (std::size_t h = 0; h < work.hands(); ++h) {
    const Percentiles times = work.of(h);
    std::array<char, 160> line{};
    std::snprintf(line.data(), line.size(), "%-14s p50 %.1f, p99 %.1f, p99.9 %.1f, max %.1f\n",
                  h < hand_names.size() ? hand_names[h].c_str() : "tool",
                  times.quantile_ns(0.5) * 1e-3, times.quantile_ns(0.99) * 1e-3,
                  times.quantile_ns(0.999) * 1e-3, times.max_ns() * 1e-3);
    out += line.data();
  }
  return out;
}

}  // namespace osteon
