#include "osteon/physics/soft_shape.h"

#include <algorithm>
#include <cmath>

#include "osteon/mesh/append_mesh.h"
#include "osteon/physics/band_strands.h"
#include "skin/skin_shape.h"
#include "soft/band_stumps.h"
#include "soft/bent_band.h"
#include "soft/cut_shape.h"
#include "soft/notched_band.h"

namespace osteon {
namespace {

std::vector<SoftPushes::One> pushes_on(std::size_t solid, const SoftPushes& pushes) {
  std::vector<SoftPushes::One> out;
  for (std::uint32_t i = 0; i < pushes.count; ++i)
    if (pushes.all[i].solid == solid) out.push_back(pushes.all[i]);
  return out;
}

// Beyond that a push looks like another one. Where none was, or none is left, is always seen.
constexpr double kStill_n = 0.005, kStill_m = 1e-4, kStill_turn = 1e-3;

bool looks_still(const SoftPushes::One& a, const SoftPushes::One& b) {
  return std::abs(a.force_n - b.force_n) < kStill_n && (a.p_B - b.p_B).norm() < kStill_m &&
         (a.nhat_B - b.nhat_B).norm() < kStill_turn;
}

// Of a band: what its middle line or its surface does.
constexpr double kStillBent_m = 5e-6, kStillShare = 1e-3;

bool bends_alike(const StringBend& a, const StringBend& b) {
  return std::abs(a.bent_m - b.bent_m) < kStillBent_m &&
         std::abs(a.dent_m - b.dent_m) < kStillBent_m &&
         std::abs(a.share - b.share) < kStillShare && (a.nhat_W - b.nhat_W).norm() < kStill_turn &&
         a.round_m == b.round_m;
}

std::vector<StringBend> bends_of(std::size_t band, const SoftPushes& pushes) {
  std::vector<StringBend> out;
  for (std::uint32_t i = 0; i < pushes.bend_count; ++i)
    if (pushes.bends[i].band == band) out.push_back(pushes.bends[i]);
  return out;
}

std::optional<double> break_of(std::size_t band, const SoftPushes& pushes) {
  for (std::uint32_t i = 0; i < pushes.break_count; ++i)
    if (pushes.breaks[i].band == band) return pushes.breaks[i].share;
  return {};
}

std::optional<BandNotch> notch_of(std::size_t band, const SoftPushes& pushes) {
  for (std::uint32_t i = 0; i < pushes.notch_count; ++i)
    if (pushes.notches[i].band == band) return pushes.notches[i];
  return {};
}

}  // namespace

SoftShapes::SoftShapes(const Case& the_case, std::shared_ptr<const SoftSetup> setup)
    : setup_(std::move(setup)) {
  if (!setup_) return;
  for (const SoftSolid& solid : setup_->solids) {
    Shape shape;
    shape.X_WB = the_case.bone(solid.bone).X_WB;
    shape.mesh_W = the_case.softs[solid.soft].mesh_W;
    if (solid.surface_B) {
      shape.mesh_W = *solid.surface_B;
      for (Vec3& p : shape.mesh_W.vertices) p = shape.X_WB * p;
    }
    shape.whole_W = shape.drawn_W = shape.mesh_W;
    shapes_.push_back(std::move(shape));
    find_patches(shapes_.size() - 1);
  }
  for (const SoftBand& band : setup_->bands) {
    BandShape shape;
    shape.mesh_W = the_case.softs[band.soft].mesh_W;
    const Pose &from = the_case.bone(band.from).X_WB, &to = the_case.bone(band.to).X_WB;
    shape.rest_W = {from * band.from_B, to * band.to_B};
    shape.section = section_of(band, shape.rest_W, from);
    bands_.push_back(std::move(shape));
  }
  if (!setup_->skins.empty()) skin_ = std::make_unique<SkinShape>(the_case, *setup_);
}

SoftShapes::~SoftShapes() = default;
SoftShapes::SoftShapes(SoftShapes&&) noexcept = default;

void SoftShapes::find_patches(std::size_t solid) {
  Shape& shape = shapes_[solid];
  const Pose X_BW = shape.X_WB.inverse();
  shape.patches.clear();
  for (const Vec3& p : shape.mesh_W.vertices)
    shape.patches.push_back(setup_->solids[solid].body->patch_at(X_BW * p));
}

void SoftShapes::cut(std::size_t solid, std::shared_ptr<const CarveState> cuts) {
  Shape& shape = shapes_[solid];
  shape.cuts = std::move(cuts);
  if (shape.cuts && !shape.left) shape.left = std::make_unique<CutShape>(setup_->solids[solid]);
  if (shape.cuts && shape.left->show(*shape.cuts)) {
    shape.mesh_W = shape.left->mesh_B();
    for (Vec3& p : shape.mesh_W.vertices) p = shape.X_WB * p;
    return;
  }
  shape.left = nullptr;
  shape.mesh_W = shape.whole_W;
  find_patches(solid);
}

void SoftShapes::add_bands(const SoftPushes& pushes, std::vector<Changed>& out) {
  for (std::size_t b = 0; b < bands_.size(); ++b) {
    BandShape& shape = bands_[b];
    std::vector<StringBend> now = bends_of(b, pushes);
    const std::optional<double> broken = break_of(b, pushes);
    const std::optional<BandNotch> notch = notch_of(b, pushes);
    if (broken == shape.broken && notch == shape.notch &&
        std::equal(now.begin(), now.end(), shape.shown.begin(), shape.shown.end(), bends_alike))
      continue;
    out.push_back({setup_->bands[b].soft, shape.mesh_W, {}});
    TriMesh& mesh_W = out.back().mesh_W;
    if (broken)
      mesh_W.vertices = stump_points(shape.mesh_W, shape.rest_W, *broken,
                                     stump_gap_m(setup_->bands[b], shape.rest_W));
    else if (notch)
      mesh_W.vertices = bent_points(notched_points(shape.mesh_W.vertices, setup_->bands[b],
                                                   shape.rest_W, shape.section, *notch),
                                    shape.rest_W, now);
    else
      mesh_W.vertices = bent_points(shape.mesh_W.vertices, shape.rest_W, now);
    shape.notch = notch;
    shape.shown = std::move(now);
    shape.broken = broken;
  }
}

std::vector<Vec3> SoftShapes::moved(std::size_t solid,
                                    std::span<const SoftPushes::One> pushes) const {
  const PressedSolid& body = *setup_->solids[solid].body;
  std::vector<SolidPush> here;
  for (const SoftPushes::One& one : pushes)
    here.push_back(body.push_at(one.p_B, one.nhat_B, one.force_n));
  return body.moved(here);
}

// False: it looks as it did.
bool SoftShapes::take(std::size_t solid, const SoftPushes& pushes) {
  Shape& shape = shapes_[solid];
  std::vector<SoftPushes::One> now = pushes_on(solid, pushes);
  const bool is_cut = pushes.cuts[solid] != shape.cuts;
  if (!is_cut &&
      std::equal(now.begin(), now.end(), shape.shown.begin(), shape.shown.end(), looks_still))
    return false;
  if (is_cut) cut(solid, pushes.cuts[solid]);
  const std::vector<Vec3> nodes = moved(solid, now);
  shape.shown = std::move(now);
  shape.drawn_W = shape.mesh_W;
  if (shape.shown.empty()) return true;
  const std::vector<SolidPatch>& patches = shape.left ? shape.left->patches() : shape.patches;
  for (std::size_t v = 0; v < patches.size(); ++v)
    shape.drawn_W.vertices[v] += shape.X_WB.rotate(PressedSolid::moved_at(patches[v], nodes));
  return true;
}

// Stumps of one ligament are one part.
TriMesh SoftShapes::drawn(std::uint32_t soft) const {
  TriMesh out;
  for (std::size_t s = 0; s < shapes_.size(); ++s) {
    if (setup_->solids[s].soft == soft) append_mesh(out, shapes_[s].drawn_W);
  }
  return out;
}

std::vector<SoftShapes::Changed> SoftShapes::changes(const SoftPushes& pushes) {
  std::vector<Changed> out;
  if (skin_)
    if (auto skin = skin_->change(pushes)) out.push_back(std::move(*skin));
  std::vector<std::uint32_t> changed;
  for (std::size_t s = 0; s < shapes_.size(); ++s) {
    const std::uint32_t soft = setup_->solids[s].soft;
    if (take(s, pushes) && std::find(changed.begin(), changed.end(), soft) == changed.end())
      changed.push_back(soft);
  }
  for (const std::uint32_t soft : changed) out.push_back({soft, drawn(soft), {}});
  add_bands(pushes, out);
  return out;
}

}  // namespace osteon
