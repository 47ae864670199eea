#include "runs/pictures/xray_cuts.h"

#include <algorithm>
#include <iterator>
#include <string>
#include <utility>

#include "osteon/carve/piece_below.h"
#include "osteon/image/tissue.h"
#include "osteon/physics/carving.h"
#include "osteon/session/session.h"

namespace osteon {
namespace {

using Shared = std::shared_ptr<const TriMesh>;

Shared surface_of(const PieceShape* shape) {
  if (!shape) return nullptr;
  auto mesh = shape->surface();
  return mesh ? std::make_shared<const TriMesh>(std::move(*mesh)) : nullptr;
}

Result<void> take(const TissueTable& tissues, const std::string& name, XrayMaterial& material) {
  const Tissue* found = tissues.find(name);
  if (!found) return fail("has no tissue '" + name + "'", "the tissue table");
  material = material_of_hu(found->hu.value);
  return {};
}

void add(const Shared& mesh, const Pose& X_WB, XrayLayer& layer) {
  if (mesh) layer.surfaces.push_back({mesh, X_WB});
}

}  // namespace

CutScene cut_scene(const Session& session) {
  CutScene out;
  const Carving* carving = session.carving();
  if (!carving) return out;
  for (std::uint32_t b = 0; b < session.the_case().bones.size(); ++b)
    if (const CarvedField* field = carving->field(b); field && field->block_count() > 0)
      out.bones.emplace_back(b, *field);
  for (const FallenPiece& piece : carving->pieces()) out.pieces.push_back(piece.shape);
  return out;
}

Result<XrayCuts> XrayCuts::create(const CaseBodyOptions& options) {
  XrayCuts cuts;
  cuts.cortical_m_ = options.cortical_m;
  cuts.phantom_ = options.bones_hu.has_value();
  cuts.away_ = material_of_hu(0);
  if (cuts.phantom_) {
    cuts.away_.density_g_per_cm3 = 0;
    cuts.cancellous_ = cuts.cortical_ = material_of_hu(*options.bones_hu);
    return cuts;
  }
  const auto tissues = load_default_tissues();
  if (!tissues) return tl::unexpected(tissues.error());
  const std::pair<const char*, XrayMaterial*> wanted[] = {
      {"cancellous_bone", &cuts.cancellous_},
      {"cortical_bone", &cuts.cortical_},
      {"articular_cartilage", &cuts.cartilage_}};
  for (const auto& [name, material] : wanted)
    if (auto ok = take(*tissues, name, *material); !ok) return tl::unexpected(ok.error());
  return cuts;
}

const XrayCuts::Piece* XrayCuts::piece(const CutScene& cut, const LooseBone& lying) {
  if (const auto known = pieces_.find(lying.shape); known != pieces_.end()) return &known->second;
  const auto shape = std::find_if(cut.pieces.begin(), cut.pieces.end(),
                                  [&](const auto& s) { return s->hash() == lying.shape; });
  const auto home = std::find_if(cut.bones.begin(), cut.bones.end(),
                                 [&](const auto& b) { return b.first == lying.bone; });
  if (shape == cut.pieces.end() || home == cut.bones.end()) return nullptr;
  const UncutField& bone = home->second.bone();
  Piece made;
  if (!phantom_) made.cancellous = surface_of(piece_below(**shape, bone, cortical_m_).get());
  const bool covered = bone.bare() != nullptr;
  made.bone = surface_of(covered ? piece_below(**shape, bone, 0).get() : shape->get());
  if (covered && !phantom_) made.whole = surface_of(shape->get());
  return &pieces_.emplace(lying.shape, std::move(made)).first->second;
}

void XrayCuts::add_to(XrayBody& body, const CutScene& cut, const BoneSnapshot& bones) {
  std::vector<XrayLayer> layers{{"cancellous bone of pieces", cancellous_, {}},
                                {"cortical bone of pieces", cortical_, {}},
                                {"cartilage of pieces", cartilage_, {}},
                                {"cut away", away_, {}}};
  for (std::uint32_t n = 0; n < std::min<std::size_t>(bones.loose.count, kMaxLoose); ++n) {
    const LooseBone& lying = bones.loose.bones[n];
    const Piece* const of = piece(cut, lying);
    if (!of) continue;
    add(of->cancellous, lying.X_WB, layers[0]);
    add(of->bone, lying.X_WB, layers[1]);
    add(of->whole, lying.X_WB, layers[2]);
  }
  for (const auto& [bone, field] : cut.bones) {
    auto surface = std::make_shared<const TriMesh>(cut_surface(field));
    if (bone < bones.count && !surface->triangles.empty())
      add(surface, bones.bones[bone].X_WB, layers[3]);
  }
  std::erase_if(layers, [](const XrayLayer& layer) { return layer.surfaces.empty(); });
  body.layers.insert(body.layers.begin(), std::make_move_iterator(layers.begin()),
                     std::make_move_iterator(layers.end()));
}

}  // namespace osteon
