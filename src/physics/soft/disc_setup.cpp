#include "osteon/physics/disc_setup.h"

#include <algorithm>
#include <optional>
#include <span>

#include "osteon/mesh/distance.h"
#include "osteon/mesh/measure.h"
#include "osteon/mesh/tri_mesh.h"
#include "osteon/scene/soft_solid.h"
#include "soft/rim_outline.h"
#include "soft/solid_fields.h"

namespace osteon {
namespace {

constexpr const char* kTfcc = "tfcc";
constexpr const char* kDiscKind = "disc";
constexpr const char* kDiscWhere = "--soft";
constexpr double kBare_m = 0.00035;  // so near a bone no cartilage lies between
constexpr double kLies_m = 0.0004;
// Where it nowhere meets bare bone of the ulna: what is nearest of its outer fifth is held.
constexpr double kNearest_m = 0.0002, kOuter = 0.8, kUlnaFar_m = 0.0015;
constexpr double kDiscUnder = -0.3;
constexpr double kLeastPiece_m3 = 3e-9;
// The outer 10 to 40 % have vessels, but not at the radius (Bednar, Arnoczky and Weiland 1991, J
// Hand Surg 16A:1101), of a width of about 12 mm.
constexpr double kDiscVessels_m = 0.003;

struct DiscPlace {
  std::uint32_t soft = 0;
  BoneId bone;     // with which it goes
  TriMesh mesh_B;  // all of it
  std::vector<MeshDistance> bones_B, cartilage_B;
  Vec3 up = Vec3::UnitZ(), fibres = Vec3::UnitX();
  double ulna_reach_m = kBare_m;  // so near the ulna it is held
  Vec3 outwards = Vec3::Zero();   // of what is held there: at least so far along this
  double from_m = 0;

  bool held(const Vec3& p) const;
};

TriMesh moved_mesh(const TriMesh& mesh, const Pose& X) {
  TriMesh out = mesh;
  for (Vec3& p : out.vertices) p = X * p;
  return out;
}

Vec3 mean_of(const std::vector<Vec3>& points) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& p : points) sum += p;
  return sum / static_cast<double>(std::max<std::size_t>(points.size(), 1));
}

bool is_near(std::span<const MeshDistance> surfaces, const Vec3& p, double reach_m) {
  return std::any_of(surfaces.begin(), surfaces.end(), [&](const MeshDistance& surface) {
    return surface.closest(p).signed_distance < reach_m;
  });
}

bool DiscPlace::held(const Vec3& p) const {
  const std::span<const MeshDistance> all(bones_B);
  return is_near(all.first(1), p, kBare_m) ||
         (outwards.dot(p) >= from_m && is_near(all.subspan(1), p, ulna_reach_m));
}

std::vector<Vec3> on_bone(const DiscPlace& place, std::size_t bone) {
  std::vector<Vec3> out;
  const auto one = std::span(place.bones_B).subspan(bone, 1);
  const double reach_m = bone == 0 ? kBare_m : place.ulna_reach_m;
  for (const Vec3& p : place.mesh_B.vertices)
    if ((bone == 0 || place.outwards.dot(p) >= place.from_m) && is_near(one, p, reach_m))
      out.push_back(p);
  return out;
}

// A patient's disc may end over the cartilage of the ulna.
void reach_for_ulna(DiscPlace& place, const Vec3& radial) {
  place.outwards = (mean_of(place.mesh_B.vertices) - radial).normalized();
  double most_m = -1, least_m = 1;
  for (const Vec3& p : place.mesh_B.vertices)
    most_m = std::max(most_m, place.outwards.dot(p - radial));
  place.from_m = place.outwards.dot(radial) + kOuter * most_m;
  for (const Vec3& p : place.mesh_B.vertices)
    if (place.outwards.dot(p) >= place.from_m)
      least_m = std::min(least_m, place.bones_B.back().closest(p).signed_distance);
  if (least_m < kUlnaFar_m) place.ulna_reach_m = least_m + kNearest_m;
}

// From the middle of what the first bone holds to that of what the second does.
Result<Vec3> way_between(DiscPlace& place, const std::string& what) {
  const std::vector<Vec3> radial = on_bone(place, 0);
  if (!radial.empty() && on_bone(place, 1).empty()) reach_for_ulna(place, mean_of(radial));
  const std::vector<Vec3> ulnar = on_bone(place, 1);
  if (radial.empty() || ulnar.empty())
    return fail(what + " does not reach both of its bones", kDiscWhere,
                "Its surface must lie on each of them");
  return Vec3(mean_of(ulnar) - mean_of(radial));
}

Result<DiscPlace> place_disc(const Case& the_case, std::uint32_t soft, const std::string& what) {
  const SoftPart& part = the_case.softs[soft];
  if (part.bones.size() != 2)
    return fail(what + " does not lie between two bones", kDiscWhere,
                "It must name the bone that it goes with, then the other");
  DiscPlace out;
  out.soft = soft;
  out.bone = part.bones.front();
  const Pose X_BW = the_case.bone(out.bone).X_WB.inverse();
  out.mesh_B = moved_mesh(part.mesh_W, X_BW);
  for (const BoneId bone : part.bones)
    out.bones_B.emplace_back(moved_mesh(the_case.bone(bone).mesh, X_BW * the_case.bone(bone).X_WB));
  for (const SoftPart& layer : the_case.softs)
    if (layer.kind == "cartilage" && layer.bones == std::vector<BoneId>{part.bones.back()})
      out.cartilage_B.emplace_back(moved_mesh(layer.mesh_W, X_BW));
  const RimOutline outline(out.mesh_B.vertices, mean_of(out.bones_B.back().mesh().vertices));
  out.up = outline.up();
  const auto way = way_between(out, what);
  if (!way) return tl::unexpected(way.error());
  const Vec3 flat = *way - way->dot(out.up) * out.up;
  if (!(flat.norm() > 1e-3))
    return fail(what + " is held at one place alone", kDiscWhere,
                "It must reach from one bone to the other");
  out.fibres = flat.normalized();
  return out;
}

// A place of a cell that holds little of the solid lies off it: what counts is the surface there.
Vec3 on_solid(const DistanceField& field, const Vec3& p) {
  const FieldSample at = field.at(p);
  return at.distance > 0 ? Vec3(p - at.distance * at.gradient.normalized()) : p;
}

PressedSolidDef disc_def(std::shared_ptr<const DiscPlace> place, const TriMesh& mesh_B,
                         std::shared_ptr<const DistanceField> field, const DiscRow& row,
                         double stiffness_n_per_m) {
  PressedSolidDef def;
  def.box = bounds(mesh_B);
  def.up = place->up;
  def.stiffness_n_per_m = stiffness_n_per_m;
  def.young_pa = row.young_pa;
  def.tension_pa = row.tension_pa;
  def.fibres = place->fibres;
  def.held = [place, field](const Vec3& p) { return place->held(on_solid(*field, p)); };
  def.rests = [place, field](const Vec3& p) {
    return field->at(p).gradient.normalized().dot(place->up) < kDiscUnder &&
           is_near(place->cartilage_B, on_solid(*field, p), kLies_m);
  };
  def.field = std::move(field);
  return def;
}

Result<SoftSolid> piece_of(const Case& the_case, std::shared_ptr<const DiscPlace> place,
                           const TriMesh& mesh_B, const DiscRow& row, double stiffness_n_per_m,
                           FieldCache* known) {
  SoftSolid out;
  out.name = the_case.softs[place->soft].name;
  out.soft = place->soft;
  out.bone = place->bone;
  const std::string what = "the disc '" + out.name + "'";
  if (auto made = make_solid_fields(mesh_B, what, known, out); !made)
    return tl::unexpected(made.error());
  auto body = PressedSolid::make(disc_def(place, mesh_B, out.field, row, stiffness_n_per_m));
  if (!body) {
    body.error().where = what;
    return tl::unexpected(body.error());
  }
  out.body = std::make_shared<const PressedSolid>(std::move(*body));
  out.hangs = [place](const Vec3& p_B) { return place->held(p_B); };
  const RimOutline outline(place->mesh_B.vertices, mean_of(place->bones_B.back().mesh().vertices));
  out.bleeds = [outline, place](const Vec3& p_B) {
    return outline.inside(p_B) < kDiscVessels_m &&
           !is_near(std::span(place->bones_B).first(1), p_B, kDiscVessels_m);
  };
  return out;
}

std::optional<std::uint32_t> disc_of(const Case& the_case, const std::string& name) {
  for (std::uint32_t i = 0; i < the_case.softs.size(); ++i)
    if (the_case.softs[i].kind == kDiscKind && the_case.softs[i].name == name) return i;
  return {};
}

// Closed, the largest first.
std::vector<TriMesh> pieces_of(const TriMesh& mesh) {
  std::vector<TriMesh> out = connected_parts(mesh);
  std::erase_if(out, [](const TriMesh& one) {
    return !topology(one).closed() || volume(one) < kLeastPiece_m3;
  });
  std::stable_sort(out.begin(), out.end(),
                   [](const TriMesh& a, const TriMesh& b) { return volume(a) > volume(b); });
  if (out.size() > kMaxSolids) out.resize(kMaxSolids);
  return out;
}

}  // namespace

bool names_disc(const Case& the_case, const std::string& name) {
  return name == kTfcc || disc_of(the_case, name).has_value();
}

Result<std::vector<SoftSolid>> make_disc_solids(const Case& the_case, const DiscRow& row,
                                                double stiffness_n_per_m, FieldCache* known) {
  const auto soft = disc_of(the_case, row.part);
  if (!soft)
    return fail("the case has no disc that can be felt", kDiscWhere,
                "Give a case with a wrist, such as builtin:wrist");
  const std::string what = "the disc '" + row.part + "'";
  auto placed = place_disc(the_case, *soft, what);
  if (!placed) return tl::unexpected(placed.error());
  const auto place = std::make_shared<const DiscPlace>(std::move(*placed));
  const std::vector<TriMesh> pieces = pieces_of(place->mesh_B);
  if (pieces.empty())
    return fail(what + " does not enclose a volume", kDiscWhere,
                "Its surface must be closed, its triangles facing outwards");
  std::vector<SoftSolid> out;
  for (const TriMesh& piece : pieces) {
    const auto touches = [&](const Vec3& p) { return place->held(p); };
    if (std::none_of(piece.vertices.begin(), piece.vertices.end(), touches)) continue;
    auto solid = piece_of(the_case, place, piece, row, stiffness_n_per_m, known);
    if (!solid && !out.empty()) continue;  // a shred
    if (!solid) return tl::unexpected(solid.error());
    if (pieces.size() > 1) solid->surface_B = std::make_shared<const TriMesh>(piece);
    if (!out.empty()) solid->name += "_piece_" + std::to_string(out.size() + 1);
    out.push_back(std::move(*solid));
  }
  if (out.empty())
    return fail("no bone holds " + what, kDiscWhere, "Its surface must lie on bare bone");
  return out;
}

}  // namespace osteon
