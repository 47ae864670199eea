#include "tunnel_wall.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <utility>

namespace osteon::tunnel {
namespace {

/// The stretches of a column in bone, and its corners at the ends where these stand in bone.
struct Column {
  std::array<std::optional<bool>, 2> in_bone;
  std::array<std::uint32_t, 2> corner{};
  std::vector<Side> stretches;  ///< upwards
};

class WallMaker {
 public:
  WallMaker(Patch& patch, const Prism& prism, const Rims& rims)
      : patch_(patch), prism_(prism), rims_(rims), columns_(rims.columns.size()) {}

  bool make(const InBone& in_bone, Wall& wall) {
    if (!find_starts(in_bone)) return false;
    for (std::size_t k = 0; k < columns_.size(); ++k)
      if (!follow_column(k)) return false;
    for (std::size_t k = 0; k < columns_.size(); ++k)
      if (!cross_ends(k)) return false;
    for (std::size_t k = 0; k < columns_.size(); ++k)
      if (!fill_side(k, wall.wall)) return false;
    return fill_end(kStart, wall.ends) && fill_end(kEnd, wall.ends);
  }

 private:
  using Stretches = std::vector<Side>;

  const Vec3& at(std::uint32_t point) const { return patch_.points_A[point]; }
  std::size_t next(std::size_t k) const { return (k + 1) % columns_.size(); }

  /// Says of every column whether its start is in bone: its first meeting with the surface tells,
  /// or its neighbour and the surface's crossings between the two.
  bool find_starts(const InBone& in_bone) {
    std::optional<std::size_t> known;
    for (std::size_t k = 0; k < columns_.size(); ++k) {
      if (rims_.columns[k].empty()) continue;
      columns_[k].in_bone[kStart] = rims_.columns[k].front().leaving;
      if (!known) known = k;
    }
    if (!known) {
      const Vec2& c = prism_.column(0);
      columns_[0].in_bone[kStart] = in_bone(Vec3(c.x(), c.y(), prism_.start));
      known = 0;
    }
    std::size_t k = *known;
    for (std::size_t i = 0; i < columns_.size(); ++i, k = next(k)) {
      const bool flips = rims_.on_ends[kStart][k].size() % 2 == 1;
      const bool there = *columns_[k].in_bone[kStart] != flips;
      auto& found = columns_[next(k)].in_bone[kStart];
      if (found && *found != there) return false;
      found = there;
    }
    return true;
  }

  std::uint32_t add_corner(std::size_t k, double z) {
    const Vec2& c = prism_.columns[k];
    patch_.points_A.emplace_back(c.x(), c.y(), z);
    return static_cast<std::uint32_t>(patch_.points_A.size() - 1);
  }

  bool follow_column(std::size_t k) {
    Column& column = columns_[k];
    bool in = *column.in_bone[kStart];
    std::uint32_t last = 0;
    if (in) last = column.corner[kStart] = add_corner(k, prism_.start);
    for (const ColumnPoint& p : rims_.columns[k]) {
      if (p.leaving != in) return false;
      if (in) column.stretches.push_back({last, p.point});
      in = !in;
      last = p.point;
    }
    column.in_bone[kEnd] = in;
    if (!in) return true;
    column.corner[kEnd] = add_corner(k, prism_.end);
    column.stretches.push_back({last, column.corner[kEnd]});
    return true;
  }

  double along(std::size_t k, std::uint32_t point) const {
    const Vec2& a = prism_.columns[k];
    return (Vec2(at(point).x(), at(point).y()) - a).dot(prism_.columns[next(k)] - a);
  }

  /// The stretches of side k in bone at both ends, from column k to the next.
  bool cross_ends(std::size_t k) {
    for (const End end : {kStart, kEnd}) {
      Stretches stretches;
      bool in = *columns_[k].in_bone[end];
      std::uint32_t last = columns_[k].corner[end];
      auto points = rims_.on_ends[end][k];
      std::sort(points.begin(), points.end(), [&](std::uint32_t a, std::uint32_t b) {
        return std::pair(along(k, a), a) < std::pair(along(k, b), b);
      });
      for (const std::uint32_t p : points) {
        if (in) stretches.push_back({last, p});
        in = !in;
        last = p;
      }
      if (in != *columns_[next(k)].in_bone[end]) return false;
      if (in) stretches.push_back({last, columns_[next(k)].corner[end]});
      ends_[end].push_back(std::move(stretches));
    }
    return true;
  }

  /// Side k is seen from the axis: x runs back from column k + 1, y along the axis.
  bool fill_side(std::size_t k, std::vector<Triangle>& triangles) {
    std::vector<Side> sides = rims_.on_sides[k];
    for (const Side& s : columns_[k].stretches) sides.push_back(s);
    for (const Side& s : columns_[next(k)].stretches) sides.push_back({s.second, s.first});
    for (const Side& s : ends_[kStart][k]) sides.push_back({s.second, s.first});
    for (const Side& s : ends_[kEnd][k]) sides.push_back(s);
    if (sides.empty()) return true;
    const Vec2& a = prism_.columns[k];
    const Vec2 across = (prism_.columns[next(k)] - a).normalized();
    const Vec2 b = prism_.columns[next(k)];
    return fill(sides, triangles, [&](const Vec3& p) {
      const Vec2 flat(p.x(), p.y());
      // The same number for all that stands on a column, so that its points are in line exactly.
      const double s = flat == a ? 0 : flat == b ? (b - a).dot(across) : (flat - a).dot(across);
      return Vec2(-s, p.z() - prism_.start);
    });
  }

  bool fill_end(End end, std::vector<Triangle>& triangles) {
    std::vector<Side> sides = rims_.across_ends[end];
    for (const Stretches& stretches : ends_[end])
      for (const Side& s : stretches) sides.push_back(end == kStart ? s : Side{s.second, s.first});
    if (sides.empty()) return true;
    return fill(sides, triangles, [&](const Vec3& p) {
      return end == kStart ? Vec2(p.x(), p.y()) : Vec2(p.y(), p.x());
    });
  }

  template <class Flatten>
  bool fill(const std::vector<Side>& sides, std::vector<Triangle>& triangles, Flatten flatten) {
    std::vector<FlatPoint> points;
    for (const Side& s : sides) points.push_back({s.first, flatten(at(s.first))});
    return fill_region(std::move(points), sides, triangles);
  }

  Patch& patch_;
  const Prism& prism_;
  const Rims& rims_;
  std::vector<Column> columns_;
  std::array<std::vector<Stretches>, 2> ends_;  ///< of each end and side
};

}  // namespace

bool make_wall(Patch& patch, const Prism& prism, const Rims& rims, const InBone& in_bone,
               Wall& wall) {
  return WallMaker(patch, prism, rims).make(in_bone, wall);
}

}  // namespace osteon::tunnel
