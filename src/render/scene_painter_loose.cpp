// Pieces of bone that were cut off and lie loose.
#include <algorithm>

#include "scene_painter.h"
#include "surface/loose_surface.h"

namespace osteon {
namespace {

constexpr std::size_t kMostShapes = 256;  // more are not kept: pieces of runs long past

// Of what it was part of.
const BoneAppearance& loose_look(const ViewState& view, const LooseBone& piece) {
  if (piece.soft == kNoSoftPart) return appearance(view, piece.bone);
  static const BoneAppearance plain;
  return piece.soft < view.softs.size() ? view.softs[piece.soft] : plain;
}

}  // namespace

void ScenePainter::set_loose(std::uint64_t shape, std::size_t bone, const SurfaceCube& surface) {
  std::map<std::uint64_t, LooseModel>& all = shared_->loose;
  if (all.size() >= kMostShapes) all.clear();
  LooseModel model;
  model.mesh = GpuMesh(loose_shaded(surface, bone));
  Aabb box;
  for (const Vec3& v : surface.vertices) box.include(v);
  if (!box.empty()) model.around = capsule_around(box);
  all.insert_or_assign(shape, std::move(model));
  shared_->changes.within(bone, {});  // drawn over what is kept
}

const GpuMesh* ScenePainter::loose_surface(std::uint64_t shape) const {
  const auto found = shared_->loose.find(shape);
  return found == shared_->loose.end() ? nullptr : &found->second.mesh;
}

std::vector<std::pair<const ScenePainter::LooseModel*, const LooseBone*>> ScenePainter::loose_of(
    const RenderSnapshot& snapshot, const ViewState& view) const {
  std::vector<std::pair<const LooseModel*, const LooseBone*>> out;
  if (!view.show_loose) return out;
  const LooseBones& loose = snapshot.bones.loose;
  for (std::size_t i = 0; i < std::min<std::size_t>(loose.count, kMaxLoose); ++i) {
    const LooseBone& piece = loose.bones[i];
    const auto found = shared_->loose.find(piece.shape);
    if (found == shared_->loose.end() || !is_finite(piece.X_WB)) continue;
    if (loose_look(view, piece).visible) out.emplace_back(&found->second, &piece);
  }
  return out;
}

std::vector<ScenePainter::Capsule> ScenePainter::loose_capsules(const RenderSnapshot& snapshot,
                                                                const ViewState& view) const {
  std::vector<Capsule> out;
  for (const auto& [model, piece] : loose_of(snapshot, view))
    out.push_back(
        {piece->X_WB * model->around.a, piece->X_WB * model->around.b, model->around.radius_m});
  return out;
}

void ScenePainter::paint_loose(const RenderSnapshot& snapshot, const ViewState& view,
                               const Frame& frame) const {
  for (const auto& [model, piece] : loose_of(snapshot, view)) {
    const std::array<float, 3>& rgb = loose_look(view, *piece).color;
    shared_->bone.use();
    shared_->bone.set("u_view_from_model", to_matrix(frame.X_CW * piece->X_WB));
    shared_->bone.set("u_color", Eigen::Vector4f(rgb[0], rgb[1], rgb[2], 1.0f));
    model->mesh.draw();
  }
}

}  // namespace osteon
