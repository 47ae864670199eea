#pragma once

namespace osteon {

/// Longest time by which bones are carried forward from their snapshot with its velocities, s.
/// Beyond it a velocity says nothing about where a bone is. The haptic tick holds every age to it,
/// and the session counts no farther.
inline constexpr double kOldestSnapshot_s = 0.020;

}  // namespace osteon
