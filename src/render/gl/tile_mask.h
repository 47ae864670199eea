#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "osteon/render/camera.h"

namespace osteon {

/// Which squares of a picture have changed. Pixels count from the lower left corner.
class TileMask {
 public:
  static constexpr int kTile_px = 16;

  TileMask() = default;
  TileMask(int width, int height);

  void mark_all();
  /// Every tile that comes within `radius_px` of the segment. Ends that are not finite mark all.
  void mark(const Eigen::Vector2d& a_px, const Eigen::Vector2d& b_px, double radius_px);

  /// Marks what the other, of the same size, has marked.
  void add(const TileMask& other);
  /// Drops what the other, of the same size, has not marked.
  void keep(const TileMask& other);

  /// Whether a marked tile comes within `radius_px` of the point; true when that is not finite.
  bool reaches(const Eigen::Vector2d& p_px, double radius_px) const;
  bool empty() const;
  /// Tiles that are marked, as share of all.
  double share() const;
  /// The marked tiles as few rectangles that do not overlap, within the picture.
  std::vector<Viewport> rectangles() const;
  /// Smallest rectangle that holds all marked tiles.
  Viewport bounds() const;

  bool operator==(const TileMask&) const = default;

 private:
  bool at(int column, int row) const { return marked_[index(column, row)] != 0; }
  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  }
  Viewport pixels(int column, int row, int columns, int rows) const;

  int width_ = 0, height_ = 0, columns_ = 0, rows_ = 0;
  std::vector<std::uint8_t> marked_;
};

}  // namespace osteon
