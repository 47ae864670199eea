#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace osteon {

/// What instruments have taken from a sound part that is felt: of a solid its volume, of a ligament
/// the share of its strands; the other one is 0.
struct SoftLoss {
  std::uint32_t soft = 0;  ///< in Case::softs
  double mm3 = 0, percent = 0;
};
inline constexpr std::size_t kMaxSoftLosses = 16;

/// The felt part but skin that a hand's instrument presses hardest; 0 N: none.
struct SoftTouch {
  std::uint32_t soft = 0;
  double force_n = 0;
};

/// A hand's blade that cuts skin which is there for no portal: how far it is beside the middle of
/// that patch, across the limb, and how far it has been beyond the fat, which ends at bone or
/// tendon.
struct SkinBlade {
  bool in = false;
  double aside_m = 0, past_m = 0;
};
/// Such skin: how much of it is open, all cuts together.
struct SkinOpening {
  double open_m = 0;
  std::array<SkinBlade, 4> blades{};  ///< of each hand
};

/// What physics tells of soft parts that are felt, for those who judge.
struct SoftTold {
  double cleared_percent = -1;  ///< of stumps of torn ligaments, all together; -1: there are none
  std::uint32_t loss_count = 0;
  std::array<SoftLoss, kMaxSoftLosses> losses{};  ///< of what has lost something; no stumps
  std::array<SoftTouch, 4> touches{};             ///< of each hand
  SkinOpening skin{};
};

}  // namespace osteon
