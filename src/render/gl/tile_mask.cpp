#include "gl/tile_mask.h"

#include <algorithm>
#include <cmath>

namespace osteon {
namespace {

double distance_to_segment(const Eigen::Vector2d& p, const Eigen::Vector2d& a,
                           const Eigen::Vector2d& b) {
  const Eigen::Vector2d ab = b - a;
  const double length2 = ab.squaredNorm();
  const double s = length2 > 0 ? std::clamp((p - a).dot(ab) / length2, 0.0, 1.0) : 0.0;
  return (p - a - s * ab).norm();
}

}  // namespace

TileMask::TileMask(int width, int height)
    : width_(std::max(width, 0)),
      height_(std::max(height, 0)),
      columns_((width_ + kTile_px - 1) / kTile_px),
      rows_((height_ + kTile_px - 1) / kTile_px),
      marked_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), 0) {}

void TileMask::mark_all() { std::fill(marked_.begin(), marked_.end(), std::uint8_t{1}); }

void TileMask::mark(const Eigen::Vector2d& a_px, const Eigen::Vector2d& b_px, double radius_px) {
  if (!a_px.allFinite() || !b_px.allFinite() || !std::isfinite(radius_px)) return mark_all();
  // A tile's middle is at most this far from any of its points.
  const double reach = radius_px + kTile_px * std::sqrt(0.5);
  const auto tile = [](double px, int count) {
    return static_cast<int>(std::clamp(std::floor(px / kTile_px), -1.0, count + 0.0));
  };
  const int x0 = std::max(0, tile(std::min(a_px.x(), b_px.x()) - reach, columns_));
  const int x1 = std::min(columns_ - 1, tile(std::max(a_px.x(), b_px.x()) + reach, columns_));
  const int y0 = std::max(0, tile(std::min(a_px.y(), b_px.y()) - reach, rows_));
  const int y1 = std::min(rows_ - 1, tile(std::max(a_px.y(), b_px.y()) + reach, rows_));
  for (int y = y0; y <= y1; ++y) {
    for (int x = x0; x <= x1; ++x) {
      const Eigen::Vector2d middle((x + 0.5) * kTile_px, (y + 0.5) * kTile_px);
      if (distance_to_segment(middle, a_px, b_px) <= reach) marked_[index(x, y)] = 1;
    }
  }
}

void TileMask::add(const TileMask& other) {
  for (std::size_t k = 0; k < marked_.size(); ++k) marked_[k] |= other.marked_[k];
}

void TileMask::keep(const TileMask& other) {
  for (std::size_t k = 0; k < marked_.size(); ++k) marked_[k] &= other.marked_[k];
}

bool TileMask::reaches(const Eigen::Vector2d& p_px, double radius_px) const {
  if (!p_px.allFinite() || !std::isfinite(radius_px)) return true;
  const auto tile = [](double px, int count) {
    return static_cast<int>(std::clamp(std::floor(px / kTile_px), -1.0, count + 0.0));
  };
  const int x0 = std::max(0, tile(p_px.x() - radius_px, columns_));
  const int x1 = std::min(columns_ - 1, tile(p_px.x() + radius_px, columns_));
  const int y0 = std::max(0, tile(p_px.y() - radius_px, rows_));
  const int y1 = std::min(rows_ - 1, tile(p_px.y() + radius_px, rows_));
  for (int y = y0; y <= y1; ++y)
    for (int x = x0; x <= x1; ++x)
      if (at(x, y)) return true;
  return false;
}

bool TileMask::empty() const {
  return std::find(marked_.begin(), marked_.end(), 1) == marked_.end();
}

double TileMask::share() const {
  if (marked_.empty()) return 0;
  return static_cast<double>(std::count(marked_.begin(), marked_.end(), 1)) /
         static_cast<double>(marked_.size());
}

Viewport TileMask::pixels(int column, int row, int columns, int rows) const {
  const int x = column * kTile_px, y = row * kTile_px;
  return {x, y, std::min(columns * kTile_px, width_ - x), std::min(rows * kTile_px, height_ - y)};
}

std::vector<Viewport> TileMask::rectangles() const {
  std::vector<Viewport> out;
  std::vector<std::uint8_t> taken(marked_.size(), 0);
  const auto free_at = [&](int x, int y) { return at(x, y) && taken[index(x, y)] == 0; };
  for (int y = 0; y < rows_; ++y) {
    for (int x = 0; x < columns_; ++x) {
      if (!free_at(x, y)) continue;
      int x1 = x;
      while (x1 < columns_ && free_at(x1, y)) ++x1;
      int y1 = y + 1;
      const auto row_free = [&](int row) {
        for (int k = x; k < x1; ++k)
          if (!free_at(k, row)) return false;
        return true;
      };
      while (y1 < rows_ && row_free(y1)) ++y1;
      for (int row = y; row < y1; ++row)
        for (int k = x; k < x1; ++k) taken[index(k, row)] = 1;
      out.push_back(pixels(x, y, x1 - x, y1 - y));
    }
  }
  return out;
}

Viewport TileMask::bounds() const {
  int x0 = width_, y0 = height_, x1 = 0, y1 = 0;
  for (const Viewport& r : rectangles()) {
    x0 = std::min(x0, r.x);
    y0 = std::min(y0, r.y);
    x1 = std::max(x1, r.x + r.width);
    y1 = std::max(y1, r.y + r.height);
  }
  if (x1 <= x0) return {0, 0, 0, 0};
  return {x0, y0, x1 - x0, y1 - y0};
}

}  // namespace osteon
