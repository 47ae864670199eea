#include "runs/pictures/loose_softs.h"

#include <algorithm>
#include <utility>

#include "osteon/carve/piece_shape.h"
#include "osteon/mesh/measure.h"

namespace osteon {

// A shape without a surface is given to nobody, and not asked again.
std::vector<CarvedPicture::Piece> LooseSofts::new_pieces(const SoftPushes& pushes) {
  std::vector<CarvedPicture::Piece> out;
  const auto count = std::min<std::size_t>(pushes.piece_count, pushes.pieces.size());
  for (std::size_t i = 0; i < count; ++i) {
    const PieceShape* const shape = pushes.pieces[i].get();
    if (!shape || !given_.insert(shape->hash()).second) continue;
    auto mesh = shape->surface();
    if (!mesh) continue;
    CarvedPicture::Piece& piece = out.emplace_back();
    piece.shape = shape->hash();
    piece.bone = shape->grid().bone;
    piece.surface.normals = vertex_normals(*mesh);
    piece.surface.depth_m.assign(mesh->vertices.size(), 0);
    piece.surface.vertices = std::move(mesh->vertices);
    piece.surface.triangles = std::move(mesh->triangles);
  }
  return out;
}

}  // namespace osteon
