#include "surface/ball_rooms.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "osteon/mesh/measure.h"

namespace osteon {
namespace {

constexpr double kMostNodes = 64e6;
constexpr double kCellsInRadius = 4;
constexpr std::uint8_t kFree = 255;  // not numbered yet

}  // namespace

BallRooms::BallRooms(const MeshDistance& surface, double radius_m) : radius_(radius_m) {
  const Aabb tight = bounds(surface.mesh());
  const double volume = tight.grown(2 * radius_m).extent().prod();
  cell_ = std::max(radius_m / kCellsInRadius, std::cbrt(volume / kMostNodes));
  radius_ = std::max(radius_m, kCellsInRadius * cell_);
  const Aabb box = tight.grown(radius_ + 2 * cell_);
  lo_ = box.lo;
  std::int64_t longest = 1;
  std::size_t count = 1;
  for (std::size_t k = 0; k < 3; ++k) {
    size_[k] = 2 + static_cast<std::int64_t>(box.extent()[static_cast<Eigen::Index>(k)] / cell_);
    longest = std::max(longest, size_[k]);
    count *= static_cast<std::size_t>(size_[k]);
  }
  room_.assign(count, kNone);
  std::int64_t side = 1;
  while (side < longest) side *= 2;
  mark_free(surface, {0, 0, 0}, side);
  number_rooms();
}

bool BallRooms::holds(const Node& node) const {
  for (std::size_t k = 0; k < 3; ++k)
    if (node[k] < 0 || node[k] >= size_[k]) return false;
  return true;
}

void BallRooms::fill_block(const Node& first, std::int64_t side) {
  Node end{};
  for (std::size_t k = 0; k < 3; ++k) end[k] = std::min(first[k] + side, size_[k]);
  for (std::int64_t z = first[2]; z < end[2]; ++z)
    for (std::int64_t y = first[1]; y < end[1]; ++y) {
      const auto at = room_.begin() + static_cast<std::ptrdiff_t>(index({first[0], y, z}));
      std::fill(at, at + (end[0] - first[0]), kFree);
    }
}

// Heights change by no more than the way, so that most blocks are settled by their middle alone.
void BallRooms::mark_free(const MeshDistance& surface, const Node& first, std::int64_t side) {
  if (!holds(first)) return;
  const double half = 0.5 * static_cast<double>(side - 1);
  const Vec3 middle =
      lo_ + cell_ * (Vec3(static_cast<double>(first[0]), static_cast<double>(first[1]),
                          static_cast<double>(first[2])) +
                     Vec3::Constant(half));
  const double room = surface.closest(middle).signed_distance - radius_;
  const double reach = std::sqrt(3.0) * half * cell_;
  if (room >= reach) return fill_block(first, side);
  if (room < -reach || side == 1) return;
  const std::int64_t step = side / 2;
  for (int k = 0; k < 8; ++k)
    mark_free(surface,
              {first[0] + (k & 1 ? step : 0), first[1] + (k & 2 ? step : 0),
               first[2] + (k & 4 ? step : 0)},
              step);
}

void BallRooms::number_rooms() {
  flood({0, 0, 0}, kOutside);  // the lattice reaches far enough beyond the mesh
  for (std::int64_t z = 0; z < size_[2]; ++z)
    for (std::int64_t y = 0; y < size_[1]; ++y)
      for (std::int64_t x = 0; x < size_[0]; ++x) {
        if (room_[index({x, y, z})] != kFree) continue;
        const std::size_t number = kOutside + ++hollows_;
        flood({x, y, z}, static_cast<std::uint8_t>(std::min<std::size_t>(number, kMostRooms)));
      }
}

void BallRooms::flood(const Node& start, std::uint8_t room) {
  std::vector<Node> open{start};
  room_[index(start)] = room;
  while (!open.empty()) {
    const Node at = open.back();
    open.pop_back();
    for (std::size_t k = 0; k < 3; ++k)
      for (const std::int64_t step : {-1, 1}) {
        Node next = at;
        next[k] += step;
        if (!holds(next) || room_[index(next)] != kFree) continue;
        room_[index(next)] = room;
        open.push_back(next);
      }
  }
}

BallRooms::Node BallRooms::cell_of(const Vec3& p) const {
  Node node{};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto axis = static_cast<Eigen::Index>(k);
    const auto at = static_cast<std::int64_t>(std::floor((p[axis] - lo_[axis]) / cell_));
    node[k] = std::clamp<std::int64_t>(at, 0, size_[k] - 2);
  }
  return node;
}

double BallRooms::to_outside(const Node& node, double most_m) const {
  const auto reach = static_cast<std::int64_t>(most_m / cell_);
  const auto from = [&](std::size_t k) { return std::max<std::int64_t>(-reach, -node[k]); };
  const auto to = [&](std::size_t k) {
    return std::min<std::int64_t>(reach, size_[k] - 1 - node[k]);
  };
  std::int64_t least = reach * reach + 1;
  for (std::int64_t z = from(2); z <= to(2); ++z)
    for (std::int64_t y = from(1); y <= to(1); ++y) {
      const std::size_t row = index({node[0], node[1] + y, node[2] + z});
      for (std::int64_t x = from(0); x <= to(0); ++x) {
        const std::int64_t squared = x * x + y * y + z * z;
        if (squared < least && room_[row + static_cast<std::size_t>(x)] == kOutside)
          least = squared;
      }
    }
  if (least > reach * reach) return std::numeric_limits<double>::infinity();
  return cell_ * std::sqrt(static_cast<double>(least));
}

}  // namespace osteon
