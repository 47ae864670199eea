#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "osteon/carve/carved_field.h"

namespace osteon {

/// A piece of bone that cuts have parted from the rest.
struct LoosePiece {
  /// A connected part of a block's bone.
  struct Part {
    std::uint32_t block = 0;
    std::uint8_t label = 0;
  };
  double volume_m3 = 0;                ///< by nodes
  Vec3 middle_B = Vec3::Zero();        ///< of its nodes
  std::array<int, 3> first{}, last{};  ///< nodes of the grid that hold it
  std::vector<Part> parts;             ///< by rising block
};

/// Finds what hangs on nothing: nodes with bone are connected along the grid's axes. Of what was
/// connected before any cut the largest part stays the bone; all others are loose. What was not
/// connected to it before (a second shell of the mesh) is looked at by itself.
///
/// Where nodes are told that the bone hangs on (hang()), what holds one of them stays, and all else
/// is loose: how large it is does not matter.
///
/// A block without cuts whose bone is one part counts as one; of the others each part is known. A
/// search looks at the nodes of blocks that changed since the last one alone.
class LoosePieces {
 public:
  /// A node that the bone hangs on.
  struct Held {
    std::uint32_t block = 0;
    std::uint16_t node = 0;
  };
  /// Looks at the whole bone once: some 50 ns a node of the blocks near its surface.
  explicit LoosePieces(const CarvedField& field);

  /// Nodes of the uncut bone for which `holds` is true hang on something.
  void hang(const CarvedField& field, const std::function<bool(const Vec3& p_B)>& holds);
  const std::vector<Held>& held() const { return held_; }  ///< none: hang() was not called

  /// Pieces by the place of their first block. Allocates nothing where there are none.
  const std::vector<LoosePiece>& find(const CarvedField& field);

  /// Cuts away a piece that the last search found. The distance to what is left is written anew as
  /// far as `reach_m` around it: who comes there feels the piece no more. False: there is no room
  /// for so many blocks, or the piece is larger than 2^24 nodes; nothing was done.
  bool take_away(CarvedField& field, const LoosePiece& piece, double reach_m) const;

  /// Heights over the surface of a piece that the last search found, by itself, um: of the nodes
  /// from `first` to `last` of the grid, x fastest; air and bone that is not of it are positive.
  /// Empty for a piece that is larger than 2^24 nodes.
  std::vector<std::int16_t> heights_of(const CarvedField& field, const LoosePiece& piece,
                                       const std::array<int, 3>& first,
                                       const std::array<int, 3>& last, int stride) const;

 private:
  /// Connected parts of one block's bone, labels from 1; 0: no bone.
  struct Labels {
    std::array<std::uint8_t, BlockGrid::kNodes> of{};
    std::array<std::uint16_t, 256> nodes{};  ///< of each label
    std::uint8_t count = 0;
  };
  struct Local;
  template <class IsBone>
  static void flood(const IsBone& is_bone, Labels& out);

  void label_whole(const CarvedField& field, std::uint32_t block);
  void note_touching(const CarvedField& field);
  void keep_whole();
  void label_carved(const CarvedField& field);
  const Labels* labels(std::uint32_t block) const;
  std::uint8_t whole_label(const CarvedField& field, std::uint32_t block, std::size_t node) const;
  std::uint8_t label_at(const CarvedField& field, std::uint32_t block, std::size_t node) const;
  std::size_t parts_of(std::uint32_t block) const;
  std::uint32_t nodes_of(std::uint32_t block, std::uint8_t label) const;
  void connect(const CarvedField& field);
  void connect_side(const CarvedField& field, std::uint32_t block, std::uint32_t beyond, int axis);
  std::uint32_t root(std::uint32_t part);
  void unite(std::uint32_t a, std::uint32_t b);
  bool weigh(const CarvedField& field);
  void find_hanging(const CarvedField& field);
  bool is_loose(std::uint32_t root) const;
  void collect(const CarvedField& field);
  void add_part(const CarvedField& field, std::uint32_t block, std::uint8_t label,
                LoosePiece& piece) const;

  static constexpr std::uint32_t kNone = 0xffffffffu;
  std::vector<std::uint32_t> whole_nodes_;  ///< of each block's uncut bone
  std::vector<std::uint32_t> many_;  ///< of each block: its uncut bone's place in many_labels_
  std::vector<Labels> many_labels_;
  std::vector<std::uint8_t> touches_;  ///< bits 0 to 2: uncut, it goes on beyond x+, y+, z+
  std::vector<Held> held_;
  bool hangs_ = false;  ///< hang() was called

  std::vector<std::uint32_t> whole_first_, whole_root_;  ///< parts of the uncut bone

  std::vector<std::uint32_t> slot_;  ///< of each block: its place in carved_
  std::vector<Labels> carved_;
  std::uint64_t since_ = 0, epoch_ = 0;
  bool looked_ = false;

  std::vector<std::uint32_t> first_;     ///< of each block: its first part
  std::vector<std::uint32_t> parent_;    ///< of each part (union by the lower number)
  std::vector<std::uint64_t> weight_;    ///< of each root: nodes
  std::vector<std::uint32_t> home_;      ///< of each root: root of the uncut bone it was part of
  std::vector<std::uint32_t> heaviest_;  ///< of each root of the uncut bone: a root
  std::vector<std::uint8_t> hanging_;    ///< of each root, where held_ counts
  std::vector<LoosePiece> pieces_;
};

}  // namespace osteon
