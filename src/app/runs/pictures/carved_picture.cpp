#include "runs/pictures/carved_picture.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "osteon/carve/grid_nodes.h"
#include "osteon/carve/piece_shape.h"
#include "osteon/mesh/measure.h"

namespace osteon {
namespace {

// Surfaces of a block may fall short of it by a cell.
constexpr double kOverlapCells = 1.5;

using HeightOf = double (CarvedField::*)(std::uint32_t block, std::size_t node) const;

// How deep a point lies under the surface of the whole bone, by the nearest node.
double depth_m(const CarvedField& field, const Vec3& p_B, HeightOf height) {
  const auto near = nearest_node(field.grid(), p_B);
  return near ? std::max(0.0, -(field.*height)(near->block, near->node)) : 0;
}

// How high a point lies over the bone under its cartilage, between the nodes about it.
double over_bone_m(const CarvedField& field, const Vec3& p_B) {
  const auto nodes = nodes_about(field.grid(), p_B);
  if (!nodes) return 0;
  double sum = 0;
  for (const auto& [at, share] : *nodes) sum += share * field.bare_height_m(at.block, at.node);
  return sum;
}

SurfaceCube cube_of(const CarvedField& field, std::uint32_t block, const SurfacePatch* patch) {
  SurfaceCube cube;
  cube.cube = block;
  if (!patch) return cube;
  cube.vertices = patch->vertices;
  cube.normals = patch->normals;
  cube.triangles = patch->triangles;
  for (const Vec3& v : cube.vertices)
    cube.depth_m.push_back(static_cast<float>(depth_m(field, v, &CarvedField::bare_height_m)));
  return cube;
}

// What of a cube's surface is cartilage; the rest stays in `bone`.
SurfaceCube take_cartilage(const CarvedField& field, SurfaceCube& bone) {
  constexpr double kLeast_m = 0.00003;  // thinner than the fields tell
  SurfaceCube out = bone;
  out.triangles.clear();
  std::vector<double> over;
  for (const Vec3& v : bone.vertices) over.push_back(over_bone_m(field, v));
  std::vector<Triangle> left;
  for (const Triangle& t : bone.triangles) {
    const bool cartilage = over[t[0]] + over[t[1]] + over[t[2]] > 3 * kLeast_m;
    (cartilage ? out.triangles : left).push_back(t);
  }
  bone.triangles = std::move(left);
  for (std::size_t v = 0; v < out.vertices.size(); ++v)
    out.depth_m[v] = static_cast<float>(depth_m(field, out.vertices[v], &CarvedField::height_m));
  return out;
}

// The layer that a cube's middle is nearest to.
std::size_t layer_near(const std::vector<CarvedLayer>& layers, const Vec3& middle_B) {
  std::size_t best = 0;
  double least = 1e300;
  for (std::size_t l = 0; l < layers.size(); ++l) {
    const Aabb& box = layers[l].box_B;
    const double away = (box.lo - middle_B).cwiseMax(middle_B - box.hi).cwiseMax(0.0).norm();
    if (away < least) best = l;
    least = std::min(least, away);
  }
  return best;
}

void move_to_part(const Pose& X_WB, SurfaceCube& cube) {
  for (Vec3& v : cube.vertices) v = X_WB * v;
  for (Vec3& n : cube.normals) n = X_WB.rotate(n);
}

}  // namespace

CarvedPicture::CarvedPicture(std::shared_ptr<const CarvingSetup> setup)
    : setup_(std::move(setup)), bones_(setup_ ? setup_->bones.size() : 0) {}

CarvedPicture::Bone* CarvedPicture::bone(std::uint32_t index) {
  if (index >= bones_.size() || !setup_->bones[index]) return nullptr;
  std::optional<Bone>& of = bones_[index];
  if (of) return &*of;
  auto field =
      CarvedField::make(setup_->bones[index], setup_->layers, setup_->most_blocks, setup_->air_m);
  if (!field) return nullptr;
  CarvedSurface surface(*field);
  of.emplace(Bone{std::move(*field), std::move(surface)});
  return &*of;
}

// Its whole surface; what was inside of the bone lies deep.
void CarvedPicture::take_piece(const std::shared_ptr<const PieceShape>& taken) {
  const PieceShape& shape = *taken;
  if (!known_pieces_.emplace(shape.hash(), taken).second) return;
  const Bone* const of = bone(shape.grid().bone);
  const auto mesh = shape.surface();
  if (!of || !mesh) return;
  Piece& piece = new_pieces_.emplace_back();
  piece.shape = shape.hash();
  piece.bone = shape.grid().bone;
  piece.surface.vertices = mesh->vertices;
  piece.surface.triangles = mesh->triangles;
  piece.surface.normals = vertex_normals(*mesh);
  for (const Vec3& v : mesh->vertices)
    piece.surface.depth_m.push_back(
        static_cast<float>(depth_m(of->field, v, &CarvedField::bare_height_m)));
}

std::vector<CarvedPicture::Piece> CarvedPicture::new_pieces() {
  return std::exchange(new_pieces_, {});
}

void CarvedPicture::take(const CutsPatch& patch) {
  if (patch.piece) return take_piece(patch.piece);
  if (patch.heat) {
    pulses_.push_back(*patch.heat);
    return;
  }
  const bool known = patch.bone < bones_.size() && bones_[patch.bone].has_value();
  if (patch.clear && !known) return;  // whole as it is
  Bone* of = bone(patch.bone);
  if (!of) return;
  of->waits = true;
  if (patch.clear)
    (void)of->field.restore({of->field.bone().hash(), of->field.step() + 1, {}});
  else
    (void)of->field.apply(patch.block, patch.cut, of->field.step() + 1);
}

void CarvedPicture::make_whole() {
  CutsPatch patch;
  patch.clear = true;
  for (patch.bone = 0; patch.bone < bones_.size(); ++patch.bone) take(patch);
  pulses_.clear();
  forget_heat();
}

void CarvedPicture::forget_heat() {
  followed_ = 0;
  heat_waits_ = heat_.has_value();
  heat_.reset();
}

bool CarvedPicture::follow_heat(std::size_t most) {
  if (!setup_) return true;
  if (!heat_ && !pulses_.empty()) heat_.emplace(setup_->table.heat, setup_->table.water);
  const HeatOfBones::FieldOf field_of = [&](std::uint32_t index) -> const CarvedField* {
    Bone* const of = bone(index);
    return of ? &of->field : nullptr;
  };
  for (; most > 0 && followed_ < pulses_.size(); --most, ++followed_) {
    heat_->take(pulses_[followed_], field_of);
    heat_waits_ = true;
  }
  return followed_ == pulses_.size();
}

std::vector<CarvedPicture::Warmed> CarvedPicture::warmed() {
  std::vector<Warmed> out;
  if (!heat_waits_) return out;
  heat_waits_ = false;
  for (std::uint32_t b = 0; b < bones_.size(); ++b) {
    const BoneHeat* const of = heat_ ? heat_->bone(b) : nullptr;
    if (of || bones_[b]) out.push_back({BoneId{b}, of ? of->volume() : HeatVolume{}});
  }
  return out;
}

CutBones CarvedPicture::cut_bones() const {
  CutBones out;
  for (std::uint32_t b = 0; b < bones_.size(); ++b)
    if (bones_[b] && bones_[b]->field.block_count() > 0) out.emplace_back(b, bones_[b]->field);
  return out;
}

std::optional<CarvedField> CarvedPicture::cut_bone(std::uint32_t bone) const {
  if (bone >= bones_.size() || !bones_[bone] || bones_[bone]->field.block_count() == 0) return {};
  return bones_[bone]->field;
}

std::vector<std::shared_ptr<const PieceShape>> CarvedPicture::shapes_of_pieces() const {
  std::vector<std::shared_ptr<const PieceShape>> out;
  for (const auto& [hash, shape] : known_pieces_) out.push_back(shape);
  return out;
}

std::vector<CarvedPicture::Changed> CarvedPicture::changes() {
  std::vector<Changed> out;
  for (std::uint32_t b = 0; b < bones_.size(); ++b) {
    std::optional<Bone>& of = bones_[b];
    if (!of || !of->waits) continue;
    of->waits = false;
    const BlockGrid& grid = of->field.grid();
    const CubeGrid cubes{grid.lo, grid.block_m(), grid.blocks, kOverlapCells * grid.cell_m, {}};
    std::vector<Changed> changed{{BoneId{b}, cubes, {}}};
    const std::vector<CarvedLayer> none;
    const auto& layers = b < setup_->layers_on.size() ? setup_->layers_on[b] : none;
    for (const CarvedLayer& layer : layers) {
      Changed& of_layer = changed.emplace_back();
      of_layer.bone = BoneId{static_cast<std::uint32_t>(setup_->bones.size()) + layer.soft};
      of_layer.grid = cubes;
      of_layer.grid.X_GM = layer.X_WB.inverse();
    }
    for (const std::uint32_t block : of->surface.update(of->field)) {
      SurfaceCube cube = cube_of(of->field, block, of->surface.patch(block));
      if (!layers.empty()) {
        SurfaceCube cartilage = take_cartilage(of->field, cube);
        const std::size_t owner = layer_near(layers, grid.middle(grid.place(block)));
        for (std::size_t l = 0; l < layers.size(); ++l)
          changed[1 + l].cubes.push_back(l == owner ? SurfaceCube{}
                                                    : SurfaceCube{block, {}, {}, {}, {}});
        move_to_part(layers[owner].X_WB, cartilage);
        changed[1 + owner].cubes.back() = std::move(cartilage);
      }
      changed.front().cubes.push_back(std::move(cube));
    }
    std::move(changed.begin(), changed.end(), std::back_inserter(out));
  }
  return out;
}

}  // namespace osteon
