#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "osteon/carve/carved_surface.h"
#include "osteon/carve/cut_surface.h"
#include "osteon/physics/carving.h"
#include "osteon/physics/heat_pulse.h"
#include "osteon/render/renderer.h"
#include "osteon/session/cuts_feed.h"
#include "runs/pictures/xray_cuts.h"

namespace osteon {

/// What is left of the bones that a session carves, for who draws them: it takes what the session
/// tells and makes the surface of the blocks anew that have changed. Knows no picture.
class CarvedPicture {
 public:
  /// Null: nothing is carved.
  explicit CarvedPicture(std::shared_ptr<const CarvingSetup> setup);

  void take(const CutsPatch& patch);
  /// Every bone is whole again: before going through its cuts from the begin.
  void make_whole();

  struct Changed {
    BoneId bone;  ///< or, beyond the bones, a layer of cartilage: a soft part of the case
    CubeGrid grid;
    std::vector<SurfaceCube> cubes;
  };
  /// What looks different since it was last asked; for Renderer::set_cubes and its like.
  std::vector<Changed> changes();
  /// A piece that was cut off, for Renderer::set_loose and its like.
  struct Piece {
    std::uint64_t shape = 0;  ///< as LooseBone has it
    std::uint32_t bone = 0;
    SurfaceCube surface;  ///< in Bone before it fell
  };
  /// Those that were told since it was last asked.
  std::vector<Piece> new_pieces();

  /// How many pulses of heat it was given since all was whole.
  std::size_t pulses() const { return pulses_.size(); }
  /// Works out how warm the bones became: as many pulses further as `most` says. Pulses that were
  /// given before anybody asked count too. True when it has come to the last one.
  bool follow_heat(std::size_t most = std::numeric_limits<std::size_t>::max());
  struct Warmed {
    BoneId bone;
    HeatVolume volume;
  };
  /// Of the bones whose temperatures went on since it was last asked; for Renderer::set_heat.
  std::vector<Warmed> warmed();
  /// Copies of the bones that hold cuts.
  CutBones cut_bones() const;
  /// A copy of one; none: it holds no cuts.
  std::optional<CarvedField> cut_bone(std::uint32_t bone) const;
  /// The same with all pieces, for who looks through them.
  CutScene cut_scene() const { return {cut_bones(), shapes_of_pieces()}; }

 private:
  struct Bone {
    CarvedField field;
    CarvedSurface surface;
    bool waits = false;  ///< changed since it was last meshed
  };
  Bone* bone(std::uint32_t index);
  void take_piece(const std::shared_ptr<const PieceShape>& taken);
  std::vector<std::shared_ptr<const PieceShape>> shapes_of_pieces() const;
  void forget_heat();

  std::shared_ptr<const CarvingSetup> setup_;
  std::vector<std::optional<Bone>> bones_;  ///< made when their first cut comes
  std::map<std::uint64_t, std::shared_ptr<const PieceShape>> known_pieces_;  ///< by hash
  std::vector<Piece> new_pieces_;
  std::vector<HeatPulse> pulses_;
  std::size_t followed_ = 0;         ///< of them
  std::optional<HeatOfBones> heat_;  ///< after these
  bool heat_waits_ = false;          ///< it changed since it was last shown
};

}  // namespace osteon
