#pragma once

#include <array>
#include <memory>
#include <vector>

#include "osteon/scene/soft_pushes.h"

namespace osteon {

/// What pressed soft parts, and which were cut or in two, in a repeated recording, 60 times a
/// second, kept where it changed.
class PushHistory {
 public:
  static constexpr double kPictureHz = 60;
  /// As things stand after `time_s`; in the order of time.
  void add(const SoftPushes& pushes, double time_s);
  /// The last that was kept until then; before the first: nothing presses.
  SoftPushes at(double time_s) const;
  std::size_t kept() const { return kept_.size(); }

 private:
  struct Kept {
    double time_s = 0;
    std::vector<SoftPushes::One> all;
    std::vector<StringBend> bends;
    std::vector<BandBreak> breaks;
    std::vector<BandNotch> notches;
    std::vector<SoftLoad> loads;
    std::array<std::shared_ptr<const CarveState>, kMaxSolids> cuts;
    std::vector<SkinDent> dents;
    std::vector<std::shared_ptr<const PieceShape>> pieces;
    std::array<std::shared_ptr<const SkinCuts>, kMaxSkins> skin_cuts;
    std::vector<SkinLipPull> lips;
  };
  std::vector<Kept> kept_;
  double due_s_ = 0;  ///< of the next that is looked at
};

}  // namespace osteon
