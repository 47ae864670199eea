#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "osteon/mesh/distance.h"

namespace osteon {

/// Where the middle of a ball may be beside a closed, outward mesh: nodes of a lattice at least its
/// radius over the surface, those connected along the lattice under one number.
class BallRooms {
 public:
  static constexpr std::uint8_t kNone = 0;     ///< no room for the ball
  static constexpr std::uint8_t kOutside = 1;  ///< the room around the mesh; hollows count from 2
  static constexpr std::uint8_t kMostRooms = 254;

  BallRooms(const MeshDistance& surface, double radius_m);

  using Node = std::array<std::int64_t, 3>;
  double radius() const { return radius_; }
  double cell() const { return cell_; }
  const Node& size() const { return size_; }
  Vec3 place(const Node& node) const {
    return lo_ + cell_ * Vec3(static_cast<double>(node[0]), static_cast<double>(node[1]),
                              static_cast<double>(node[2]));
  }
  bool holds(const Node& node) const;
  std::uint8_t room(const Node& node) const { return room_[index(node)]; }
  std::size_t index(const Node& node) const {
    return static_cast<std::size_t>((node[2] * size_[1] + node[1]) * size_[0] + node[0]);
  }
  /// Lowest node of the lattice's cell that holds p.
  Node cell_of(const Vec3& p) const;
  /// Rooms besides the one outside; those beyond kMostRooms share that number.
  std::size_t hollows() const { return hollows_; }
  /// From a node to the nearest one of the room outside, m; infinite beyond `most_m`.
  double to_outside(const Node& node, double most_m) const;

 private:
  void mark_free(const MeshDistance& surface, const Node& first, std::int64_t side);
  void fill_block(const Node& first, std::int64_t side);
  void number_rooms();
  void flood(const Node& start, std::uint8_t room);

  double radius_;
  double cell_;
  Vec3 lo_;
  Node size_{};
  std::vector<std::uint8_t> room_;  // of each node
  std::size_t hollows_ = 0;
};

}  // namespace osteon
