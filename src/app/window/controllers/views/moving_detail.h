#pragma once

#include <array>
#include <cstddef>

namespace osteon {

/// How finely a picture is drawn in which all moves, so that a camera that is dragged stays fluent
/// where a processor draws: see Renderer::set_moving_detail.
class MovingDetail {
 public:
  /// Share of the width and height.
  double share() const { return kShares[step_]; }
  /// The work of a picture in which all was drawn, seconds. One slow picture says nothing (another
  /// program ran), two in a row do.
  void took(double picture_s);

 private:
  static constexpr std::array<double, 6> kShares{1.0, 0.8, 0.65, 0.5, 0.4, 0.33};
  /// Of a picture in which all moves: 40 a second. Finer again only where the finer picture, by the
  /// pixels it has more, would keep that too.
  static constexpr double kLongest_s = 0.025, kShortest_s = 0.014;
  static constexpr int kInARow = 2;
  std::size_t step_ = 0;
  int slow_ = 0, quick_ = 0;
};

}  // namespace osteon
