#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/carve/cut_surface.h"
#include "osteon/carve/piece_shape.h"
#include "osteon/scene/state.h"
#include "osteon/xray/areal_density.h"
#include "osteon/xray/case_body.h"

namespace osteon {

class Session;

/// What instruments have made of a case's bones.
struct CutScene {
  CutBones bones;                                         ///< that hold cuts
  std::vector<std::shared_ptr<const PieceShape>> pieces;  ///< that were cut off
};
/// For when all rest.
CutScene cut_scene(const Session& session);

/// Puts what was cut before what a body has already. What was cut out of bones and their cartilage
/// is water, about phantoms nothing. A piece that was cut off stands before that where it lies, of
/// the tissues that it had in its bone: cortical bone as deep as the body's shell was, cancellous
/// bone below, cartilage outside. Surfaces of pieces are made once.
class XrayCuts {
 public:
  /// Fails where the tissue table lacks a tissue. `options`: as the body was made with.
  static Result<XrayCuts> create(const CaseBodyOptions& options = {});

  /// `bones`: where they are, and where pieces lie; a piece that it does not name is gone.
  void add_to(XrayBody& body, const CutScene& cut, const BoneSnapshot& bones);

 private:
  /// In Bone before it fell; null: it has nothing of that tissue.
  struct Piece {
    std::shared_ptr<const TriMesh> cancellous, bone, whole;
  };
  XrayCuts() = default;
  const Piece* piece(const CutScene& cut, const LooseBone& lying);

  double cortical_m_ = 0;
  bool phantom_ = false;
  XrayMaterial away_, cancellous_, cortical_, cartilage_;
  std::map<std::uint64_t, Piece> pieces_;  ///< by their shape's hash
};

}  // namespace osteon
