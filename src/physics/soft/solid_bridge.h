#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "osteon/carve/carved_field.h"
#include "osteon/carve/loose_pieces.h"

namespace osteon {

/// The narrowest section of what cuts have left of a solid, between a place and what it hangs on.
struct SolidBridge {
  double area_m2 = 0;
  std::vector<Vec3> middles_B;  ///< of the pairs of nodes that it parts
  Vec3 middle_B = Vec3::Zero();
};

/// Looks for it: the least number of neighbouring nodes that must be parted (the least cut of their
/// graph, by Dinic), each pair a square of the grid. So a section that lies along the
/// grid has its true area, one aslant up to 1.7 times as much. Nodes of a cube of two on a side
/// that hang together count as one, or it would take too long.
class BridgeSearch {
 public:
  explicit BridgeSearch(const CarvedField& field);

  /// Goes on with the graph of what is left, by so many layers of nodes: what of it is done a
  /// search need not do. True: it is whole. Nothing that is found depends on it.
  bool prepare(const CarvedField& field, std::size_t layers);
  std::size_t layers() const { return static_cast<std::size_t>(n_[2]); }
  /// Another field may have the same step.
  void forget() { of_step_ = kNoStep; }

  /// `hangs`: its nodes that are held. `around_m`: what is so near to the place goes with it. None:
  /// all sections are wider than `most_m2`, nothing of the solid is there, or it hangs on nothing.
  std::optional<SolidBridge> narrowest(const CarvedField& field, const LoosePieces& hangs,
                                       const Vec3& p_B, double around_m, double most_m2);

 private:
  static constexpr std::uint64_t kNoStep = ~std::uint64_t{0};
  enum class Stage : std::uint8_t { kLeft, kLabel, kCount, kMeet, kLink, kBack, kReady };
  struct Link {
    std::int32_t to = 0;
    std::int32_t room = 0;  ///< pairs of nodes
  };
  /// Of the nodes along x, those that lay inside before anything was cut.
  struct Row {
    int from = 0, to = 0;
  };
  std::size_t at(int x, int y, int z) const;
  Row& row_at(int y, int z) { return rows_[static_cast<std::size_t>(z * n_[1] + y)]; }
  const Row& row_at(int y, int z) const { return rows_[static_cast<std::size_t>(z * n_[1] + y)]; }
  void take_left(const CarvedField& field);
  void label(int z);
  template <class Visit>
  void each_pair(int z, const Visit& visit) const;
  void begin_links();
  void link(std::size_t part);
  void link_back(std::size_t part);
  void go_to(Stage stage);
  bool find_levels();
  bool push_more();
  SolidBridge bridge() const;

  BlockGrid grid_;
  std::array<int, 3> n_{};
  std::vector<Row> rows_;
  std::vector<std::uint8_t> inside_, left_;  ///< of each node
  // The graph of what is left, and how far it is made.
  std::uint64_t of_step_ = kNoStep;
  Stage stage_ = Stage::kLeft;
  std::size_t at_ = 0;
  std::int32_t parts_ = 0;
  std::vector<std::int32_t> part_;         ///< of each node; -1: none
  std::vector<std::int32_t> begin_, met_;  ///< of each part, the parts that it meets
  std::vector<std::int32_t> first_;        ///< of each part's links; one more at the end
  std::vector<Link> links_;
  std::vector<std::int32_t> back_;  ///< of each link the one the other way
  // A search.
  std::vector<std::uint8_t> source_, sink_;  ///< of each part
  std::vector<std::int32_t> room_;           ///< of each link: pairs that are not used yet
  std::vector<std::int32_t> level_;          ///< of each part; -1: it was not reached
  std::vector<std::int32_t> next_;           ///< of each part: link that is looked at next
  std::vector<std::int32_t> queue_, way_;
  std::int32_t flow_ = 0;
};

}  // namespace osteon
