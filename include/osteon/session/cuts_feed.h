#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "osteon/base/bounded_queue.h"
#include "osteon/physics/heat_pulse.h"

namespace osteon {

class PieceShape;

/// What a picture must know of a carved bone: the cuts of one block as they are now, or that the
/// bone is whole again (`clear`), after which its blocks follow; the shape of a piece that was cut
/// off (`piece`), of which a snapshot tells where it is; or what warmed and cooled the bones
/// (`heat`, and nothing else).
struct CutsPatch {
  static constexpr std::size_t kNodes = 512;  ///< of a block
  std::uint32_t bone = 0, block = 0;
  bool clear = false;
  std::array<std::int16_t, kNodes> cut{};   ///< um, see CarvedField::cuts
  std::shared_ptr<const PieceShape> piece;  ///< null: it is about a block or a bone
  std::optional<HeatPulse> heat;
};

/// From physics to one thread that draws. Of a block that changed often the reader gets the newest
/// state alone; while it reads nothing, what it has to learn waits with physics in places made
/// beforehand. Nobody waits for the other, and nothing is allocated after the making but by what
/// was cut off.
class CutsFeed {
 public:
  /// `joint`: of the case, where it is filled with water.
  explicit CutsFeed(const CarvingSetup& setup, std::optional<FluidJoint> joint = {});

  // Of physics.
  /// Notes what the last step has changed; `all`: every bone may be another. Sends as much as there
  /// is room for, in every eighth step.
  void note(const Carving& carving, bool all);
  /// What that step did to temperatures; after `note`.
  void note_heat(const Carving& carving, const BoneSnapshot& bones, const Command& command,
                 double step_s);
  /// Everything anew: the state was replaced. While all rest.
  void note_all(const Carving& carving);

  // Of who draws.
  /// The next change; false: there is none yet.
  bool take(CutsPatch& patch) { return queue_.pop(patch); }

 private:
  struct Bone {
    bool carved = false, clear = false;
    std::vector<std::uint8_t> waits;    ///< of each block
    std::vector<std::uint32_t> blocks;  ///< that wait; capacity for all that may hold cuts
  };
  void add(std::uint32_t bone, std::uint32_t block);
  void add_all(const Carving& carving);
  void send(const Carving& carving);
  bool send_bone(const Carving& carving, std::uint32_t bone);
  bool send_pieces();

  std::vector<Bone> bones_;
  std::vector<std::shared_ptr<const PieceShape>> pieces_;  ///< that wait
  std::uint32_t notes_ = 0;
  HeatPulses heat_;
  CutsPatch patch_;
  BoundedQueue<CutsPatch> queue_;
};

}  // namespace osteon
