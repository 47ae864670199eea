#include "window/controllers/views/soft_picture.h"

#include "osteon/render/soft_surface.h"

namespace osteon {
namespace {

constexpr double kShapesApart_s = 0.1;

}  // namespace

bool SoftPicture::put(const SoftPushes& pushes, Renderer& renderer) {
  const auto changes = shapes_->changes(pushes);
  for (const SoftShapes::Changed& changed : changes)
    set_soft_surface(renderer, *case_, changed.soft, changed.mesh_W, changed.depth_m);
  const auto pieces = loose_.new_pieces(pushes);
  for (const CarvedPicture::Piece& piece : pieces)
    renderer.set_loose(piece.shape, BoneId{piece.bone}, piece.surface);
  return !changes.empty() || !pieces.empty();
}

void SoftPicture::show(const std::shared_ptr<const Case>& the_case,
                       const std::shared_ptr<const SoftSetup>& setup, const SoftPushes& pushes,
                       double now_s, Renderer& renderer) {
  if (the_case != case_ || setup != setup_) {
    if (shapes_ && the_case == case_) (void)put({}, renderer);
    shapes_.reset();
    case_ = the_case;
    setup_ = setup;
  }
  if (!setup_ || !case_) return;
  if (!shapes_) shapes_.emplace(*case_, setup_);
  const double since_s = now_s - changed_s_;
  if (renderer.software_driver() && since_s >= 0 && since_s < kShapesApart_s) return;
  if (put(pushes, renderer)) changed_s_ = now_s;
}

}  // namespace osteon
