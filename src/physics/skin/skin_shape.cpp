#include "skin/skin_shape.h"

#include <algorithm>
#include <cmath>

#include "osteon/tissue/skin_place.h"
#include "skin/skin_groove.h"

namespace osteon {
namespace {

// So much less a dent looks as before.
constexpr double kSkinStill_m = 5e-5;
constexpr double kDentAlike_m = 2e-4;  // the same of its radius
constexpr double kPullAlike_n = 0.02;  // and of a lip's pull
// The skin about a patch goes so far under it, both sides together: light comes through a joint.
constexpr double kOverlap_m = 4e-4;
constexpr double kDentRadius_m = 0.002;  // of a dent that is drawn, at least
constexpr double kDeepestDent = 0.95;    // of the fat's thickness

bool looks_pressed_alike(const SkinDent& a, const SkinDent& b) {
  return a.patch == b.patch && (a.p - b.p).norm() < kSkinStill_m &&
         std::abs(a.deep_m - b.deep_m) < kSkinStill_m &&
         std::abs(a.radius_m - b.radius_m) < kDentAlike_m;
}

std::shared_ptr<const SheetYield> yields_of(const SkinPatch& patch,
                                            const std::shared_ptr<const SkinCuts>& cuts) {
  if (!cuts || *cuts == SkinCuts{}) return patch.whole;
  SheetWork work(*patch.sheet, kept_cuts(*patch.sheet, *cuts));
  while (!work.step()) {
  }
  return work.take();
}

bool looks_pulled_alike(const SkinLipPull& a, const SkinLipPull& b) {
  return (a.p - b.p).norm() < kSkinStill_m && a.out.dot(b.out) > 0.999 &&
         std::abs(a.force_n - b.force_n) < kPullAlike_n;
}

// On the ends of the side of a cut that is nearest and looks that way.
void add_pull(const SplitSheet& split, const SkinLipPull& pull, std::vector<SheetPull>& to) {
  const SheetWall* best = nullptr;
  double nearest = 1e300, at = 0;
  for (const SheetWall& wall : split.walls) {
    const SheetPoint a = split.point[wall.from], way = split.point[wall.to] - a;
    if (!(SheetPoint(-way.y(), way.x()).dot(pull.out) > 0)) continue;
    const double t = std::clamp((pull.p - a).dot(way) / way.squaredNorm(), 0.0, 1.0);
    const double far = (pull.p - a - t * way).squaredNorm();
    if (!(far < nearest)) continue;
    nearest = far;
    best = &wall;
    at = t;
  }
  if (!best) return;
  to.push_back({best->from, (1 - at) * pull.force_n * pull.out});
  to.push_back({best->to, at * pull.force_n * pull.out});
}

std::vector<SheetPoint> ways_of(const SheetYield& yields, std::span<const SkinLipPull> pulls) {
  std::vector<SheetPoint> out(yields.ways().begin(), yields.ways().end());
  if (pulls.empty()) return out;
  std::vector<SheetPull> forces;
  for (const SkinLipPull& pull : pulls) add_pull(yields.split(), pull, forces);
  const std::vector<SheetPoint> more = yields.pulled(forces);
  for (std::size_t i = 0; i < out.size(); ++i) out[i] += more[i];
  return out;
}

// The shape of a slight dent, as deep as the tip is.
void add_dent(const SheetYield& yields, const SkinDent& dent, double fat_m,
              std::vector<double>& down) {
  const SheetDisc disc{dent.p, std::max(kDentRadius_m, dent.radius_m)};
  SheetScratch scratch;
  const double per_m = yields.stiffness(disc, scratch);
  const std::vector<double> shape = yields.dent(disc);
  for (std::size_t i = 0; i < down.size(); ++i)
    down[i] = std::min(down[i] + dent.deep_m * per_m * shape[i], kDeepestDent * fat_m);
}

}  // namespace

SkinShape::SkinShape(const Case& the_case, const SoftSetup& setup)
    : setup_(setup), whole_W_(the_case.softs[setup.skins[0].soft].mesh_W), around_W_(whole_W_) {
  for (const SkinPatch& patch : setup_.skins) {
    Patch mine;
    mine.X_WS = the_case.bone(patch.bone).X_WB * patch.X_BS;
    mine.yields = patch.whole;
    around_W_ =
        around(around_W_, mine.X_WS, patch.width_m - kOverlap_m, patch.height_m - kOverlap_m);
    patches_.push_back(std::move(mine));
  }
}

void SkinShape::add(std::size_t s, SoftShapes::Changed& to) const {
  const SkinPatch& patch = setup_.skins[s];
  const Patch& mine = patches_[s];
  const SplitSheet& split = mine.yields->split();
  std::vector<double> down(split.vertex.size(), 0);
  for (const SkinDent& dent : mine.dents)
    add_dent(*mine.yields, dent, patch.sheet->material().fat_m, down);
  const TriMesh sheet = sheet_surface(split, ways_of(*mine.yields, mine.pulls), down);
  const auto place = [&](const Vec3& p) {
    const double height_m = patch.relief.at(p.head<2>()).height_m;
    return Vec3(mine.X_WS * Vec3(p.x(), p.y(), p.z() + height_m));
  };
  to.depth_m.resize(to.mesh_W.vertices.size(), 0.0f);
  const auto add_part = [&](std::span<const Vec3> points, std::span<const Triangle> triangles) {
    const auto first = static_cast<std::uint32_t>(to.mesh_W.vertices.size());
    for (const Vec3& p : points) to.mesh_W.vertices.push_back(place(p));
    for (const Triangle& t : triangles)
      to.mesh_W.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  };
  const auto copies = std::span(sheet.vertices).first(split.vertex.size());
  add_part(copies, split.triangles);
  to.depth_m.resize(to.mesh_W.vertices.size(), 0.0f);
  const SkinGroove groove = skin_groove(split, copies, patch.sheet->material().thickness_m);
  add_part(groove.points, groove.triangles);
  for (const double depth : groove.depth_m) to.depth_m.push_back(static_cast<float>(depth));
}

std::optional<SoftShapes::Changed> SkinShape::change(const SoftPushes& pushes) {
  bool other = false, at_rest = true;
  for (std::size_t s = 0; s < patches_.size(); ++s) {
    Patch& mine = patches_[s];
    std::vector<SkinDent> dents;
    for (std::uint32_t i = 0; i < pushes.skin_count; ++i)
      if (pushes.skin_dents[i].patch == s) dents.push_back(pushes.skin_dents[i]);
    if (!std::equal(dents.begin(), dents.end(), mine.dents.begin(), mine.dents.end(),
                    looks_pressed_alike)) {
      mine.dents = std::move(dents);
      other = true;
    }
    std::vector<SkinLipPull> pulls;
    for (std::uint32_t i = 0; i < pushes.lip_count; ++i)
      if (pushes.lip_pulls[i].patch == s) pulls.push_back(pushes.lip_pulls[i]);
    if (!std::equal(pulls.begin(), pulls.end(), mine.pulls.begin(), mine.pulls.end(),
                    looks_pulled_alike)) {
      mine.pulls = std::move(pulls);
      other = true;
    }
    if (pushes.skin_cuts[s] != mine.cuts) {
      const SkinCuts none;
      const SkinCuts& was = mine.cuts ? *mine.cuts : none;
      const SkinCuts& now = pushes.skin_cuts[s] ? *pushes.skin_cuts[s] : none;
      if (was.cut != now.cut || was.moved != now.moved) {
        mine.yields = yields_of(setup_.skins[s], pushes.skin_cuts[s]);
        other = true;
      }
      mine.cuts = pushes.skin_cuts[s];
    }
    at_rest = at_rest && mine.dents.empty() && mine.yields->split().walls.empty();
  }
  if (!other) return {};
  SoftShapes::Changed out;
  out.soft = setup_.skins[0].soft;
  out.mesh_W = at_rest ? whole_W_ : around_W_;
  for (std::size_t s = 0; !at_rest && s < patches_.size(); ++s) add(s, out);
  return out;
}

}  // namespace osteon
