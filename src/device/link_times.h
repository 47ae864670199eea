#pragma once

#include <cstdint>

namespace osteon::link_times {

/// Times of every link to a device whose loop runs on this side, ns.
constexpr std::int64_t kSilence_ns = 10'000'000;    ///< without a sound reading: a fault
constexpr std::int64_t kOrderLife_ns = 20'000'000;  ///< of a force that no other one follows
constexpr std::int64_t kFaultHold_ns = 50'000'000;  ///< a fault stays so long after its cause

}  // namespace osteon::link_times
