#include "skin/skin_groove.h"

#include <algorithm>
#include <array>
#include <map>

namespace osteon {
namespace {

// The wall begins so far under the lip: it has a colour of its own there.
constexpr double kUnderLip_m = 1e-5;
constexpr double kSkinOfDepth = 0.6;  // of a shallow groove: the skin is no more of its wall
/// A place of a wall's section: share of the way to the groove's middle, and of the fat's height.
struct WallRow {
  double across, down;
};
// Under the skin's own edge: fat that bulges, then the floor.
constexpr std::array<WallRow, 4> kFat{{{0.02, 0.35}, {0.10, 0.70}, {0.32, 0.92}, {0.66, 0.99}}};
constexpr std::size_t kRows = kFat.size() + 3;  // with the lip, the skin's lower edge, the middle
using Column = std::array<std::uint32_t, kRows>;

class GrooveDraft {
 public:
  GrooveDraft(const SplitSheet& split, std::span<const Vec3> surface, double thickness_m)
      : split_(split), surface_(surface), thickness_m_(thickness_m) {
    middle_.assign(split.copies.size(), Vec3::Zero());
    for (std::size_t i = 0; i < split.vertex.size(); ++i)
      middle_[split.vertex[i]] += surface[i] / split.copies[split.vertex[i]];
  }

  void add_wall(const SheetWall& wall) {
    const Column a = column(wall.from, wall.from_base), b = column(wall.to, wall.to_base);
    for (std::size_t r = 0; r + 1 < kRows; ++r) {
      add({b[r], a[r], a[r + 1]});
      add({b[r], a[r + 1], b[r + 1]});
    }
  }
  SkinGroove take() { return std::move(out_); }

 private:
  std::uint32_t point(const Vec3& p, double depth_m) {
    out_.points.push_back(p);
    out_.depth_m.push_back(std::max(depth_m, kUnderLip_m));
    return static_cast<std::uint32_t>(out_.points.size() - 1);
  }
  void add(const Triangle& t) {
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) out_.triangles.push_back(t);
  }

  // One for each lip's vertex, so that neighbouring walls share it. At the groove's end it is a
  // point.
  Column column(std::uint32_t copy, std::uint32_t base) {
    const auto known = columns_.find(copy);
    if (known != columns_.end()) return known->second;
    const Vec3& lip = surface_[copy];
    Column made{};
    made.fill(point(lip - kUnderLip_m * Vec3::UnitZ(), 0));
    const double deep_m = split_.groove_m[base];
    if (split_.copies[base] >= 2 && deep_m > kUnderLip_m) {
      const Vec3 way = middle_[base] - lip;
      const double skin_m = std::min(thickness_m_, kSkinOfDepth * deep_m);
      const auto at = [&](double across, double down_m) {
        return point(lip + across * way - down_m * Vec3::UnitZ(), down_m);
      };
      made[1] = at(0, skin_m);
      for (std::size_t r = 0; r < kFat.size(); ++r)
        made[2 + r] = at(kFat[r].across, skin_m + kFat[r].down * (deep_m - skin_m));
      made.back() = floor_of(base, deep_m);
    }
    return columns_[copy] = made;
  }
  std::uint32_t floor_of(std::uint32_t base, double deep_m) {
    const auto known = floor_.find(base);
    if (known != floor_.end()) return known->second;
    return floor_[base] = point(middle_[base] - deep_m * Vec3::UnitZ(), deep_m);
  }

  const SplitSheet& split_;
  std::span<const Vec3> surface_;
  double thickness_m_;
  std::vector<Vec3> middle_;  // of each vertex of the sheet: between its copies
  std::map<std::uint32_t, Column> columns_;
  std::map<std::uint32_t, std::uint32_t> floor_;
  SkinGroove out_;
};

}  // namespace

SkinGroove skin_groove(const SplitSheet& split, std::span<const Vec3> surface, double thickness_m) {
  GrooveDraft draft(split, surface, thickness_m);
  for (const SheetWall& wall : split.walls) draft.add_wall(wall);
  return draft.take();
}

}  // namespace osteon
