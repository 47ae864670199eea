#include "osteon/scene/build_case.h"

#include <cmath>
#include <memory>
#include <set>
#include <utility>

#include "case/build_joints.h"
#include "case/mesh_hash.h"
#include "case/mesh_indices.h"
#include "case/soft_parts.h"
#include "osteon/mesh/measure.h"
#include "osteon/scene/bone_cover.h"
#include "osteon/scene/bone_pieces.h"
#include "osteon/scene/felt_as.h"
#include "osteon/scene/field_cache.h"
#include "osteon/scene/piece_cache.h"
#include "osteon/scene/wide_field.h"

namespace osteon {
namespace {

bool is_sound(const Material& m) {
  const bool finite = std::isfinite(m.stiffness_n_per_m) && std::isfinite(m.static_friction) &&
                      std::isfinite(m.dynamic_friction);
  return finite && m.stiffness_n_per_m > 0 && m.dynamic_friction >= 0 &&
         m.dynamic_friction <= m.static_friction;
}

Result<void> check_bone(const BoneDef& def) {
  const std::string where = "bone '" + def.name + "'";
  if (def.name.empty()) return fail("a bone has no name", "case", "Give every bone a name");
  if (!is_finite(def.X_WB) || std::abs(def.X_WB.q.norm() - 1) > 1e-6)
    return fail("the pose is not finite with a unit quaternion", where);
  if (!std::isfinite(def.density_kg_per_m3) || def.density_kg_per_m3 <= 0)
    return fail("the density must be above zero", where, "Bone has about 1900 kg/m3");
  if (!is_sound(def.material))
    return fail("the material is out of range", where,
                "Stiffness above zero, friction not negative, dynamic not above static");
  if (!indices_fit(def.mesh))
    return fail("a triangle refers to a vertex that does not exist", where);
  return {};
}

// The mesh encloses a volume when it is closed; else the hull has to do.
double mass_of(const BoneDef& def, const std::vector<Hull>& pieces) {
  double enclosed = topology(def.mesh).closed() ? std::abs(volume(def.mesh)) : 0;
  if (enclosed <= 0)
    for (const Hull& piece : pieces) enclosed += piece.volume;
  return enclosed * def.density_kg_per_m3;
}

// Corners of each piece of a bone, in Bone; none when no hull can be made.
using CornerLists = std::vector<std::vector<Vec3>>;

CornerLists piece_corners(const TriMesh& mesh, PieceCache* cache) {
  const std::uint64_t key = piece_key(mesh);
  if (cache)
    if (const PieceCorners* known = cache->find(key)) return known->pieces;
  auto made = cut_into_pieces(mesh);
  if (!made) return {};
  CornerLists corners = made->pieces;
  if (cache) cache->put(key, std::move(*made));
  return corners;
}

// Hulls are always built from corners alone, so that cached pieces give the same bits.
Result<std::vector<Hull>> build_pieces(const BoneDef& bone, PieceCache* cache) {
  CornerLists corners;
  if (bone.felt != Felt::kHull) corners = piece_corners(bone.mesh, cache);
  if (corners.empty()) corners.push_back(bone.mesh.vertices);
  std::vector<Hull> pieces;
  for (const auto& points : corners) {
    HullOutcome outcome = build_hull(points);
    if (!outcome.hull)
      return fail("no hull can be made: " + std::string(describe(outcome.failure)),
                  "bone '" + bone.name + "'", "Check the mesh");
    pieces.push_back(std::move(*outcome.hull));
  }
  return pieces;
}

Result<FieldCache::Field> build_field(const BoneDef& bone, const FieldOptions& options,
                                      FieldCache* cache) {
  if (!is_field(bone.felt)) return FieldCache::Field();
  const std::uint64_t key = field_key(bone, options);
  if (cache)
    if (auto known = cache->find(key)) return known;
  auto made = make_felt_field(bone, options);
  if (!made) return fail(made.error().what, "bone '" + bone.name + "'", made.error().todo);
  auto field = std::make_shared<const DistanceField>(std::move(*made));
  if (cache) cache->put(key, field);
  return FieldCache::Field(std::move(field));
}

Result<Bone> build_bone(BoneDef def, const BuildOptions& options) {
  auto field = build_field(def, {}, options.fields);
  if (!field) return tl::unexpected(field.error());
  auto wide = build_field(def, wide_field_options(), options.fields);
  if (!wide) return tl::unexpected(wide.error());
  auto pieces = build_pieces(def, options.pieces);
  if (!pieces) return tl::unexpected(pieces.error());
  Bone bone;
  bone.field = std::move(*field);
  bone.wide = std::move(*wide);
  bone.felt = felt_as(def.mesh, def.felt);
  bone.beside = def.beside;
  if (def.felt == Felt::kCovered) bone.covered = std::move(def.covered);
  bone.pieces = std::move(*pieces);
  for (const Hull& piece : bone.pieces) bone.bodies.push_back(make_convex_body(piece));
  bone.mass_kg = mass_of(def, bone.pieces);
  bone.name = std::move(def.name);
  bone.fma_id = def.fma_id;
  bone.X_WB = def.X_WB;
  bone.mesh = std::move(def.mesh);
  bone.material = def.material;
  return bone;
}

void hash_piece(Hasher& hasher, const Hull& piece) {
  add_points(hasher, piece.vertices);
  add_triangles(hasher, piece.triangles);
  hasher.add(static_cast<std::uint64_t>(piece.planes.size()));
  for (const Plane& plane : piece.planes) {
    hasher.add(plane.n);
    hasher.add(plane.d);
  }
}

// `chosen`: as the case says, so that a recording of an open bone still finds its case.
void hash_bone(Hasher& hasher, const Bone& bone, Felt chosen) {
  hasher.add(std::string_view(bone.name));
  hasher.add(bone.fma_id);
  hasher.add(bone.X_WB);
  hasher.add(static_cast<std::uint8_t>(chosen));
  if (bone.beside) hasher.add(std::string_view("beside"));  // a case without keeps its hash
  add_mesh(hasher, bone.mesh);
  hasher.add(static_cast<std::uint64_t>(bone.pieces.size()));
  for (const Hull& piece : bone.pieces) hash_piece(hasher, piece);
  if (bone.field) hasher.add(bone.field->hash());
  hasher.add(bone.mass_kg);
  hasher.add(bone.material.stiffness_n_per_m);
  hasher.add(bone.material.static_friction);
  hasher.add(bone.material.dynamic_friction);
}

// What is felt, and nothing else: a case that was renamed, or has other soft parts to look at,
// replays the same, and a run without a window need not make what only a picture shows.
std::uint64_t hash_of(const Case& the_case, const std::vector<Felt>& chosen) {
  Hasher hasher;
  hasher.add(static_cast<std::uint64_t>(the_case.bones.size()));
  for (std::size_t i = 0; i < chosen.size(); ++i) hash_bone(hasher, the_case.bones[i], chosen[i]);
  for (const CaseJoint& joint : the_case.joints)
    if (joint.begin_deg) hasher.add(*joint.begin_deg);
  return hasher.value();
}

Result<void> check_landmarks(const std::vector<Landmark>& landmarks) {
  for (const Landmark& landmark : landmarks)
    if (!is_finite(landmark.p_W))
      return fail("the position is not finite", "landmark '" + landmark.name + "'");
  return {};
}

}  // namespace

Result<Case> build_case(CaseDef def, const BuildOptions& options) {
  const std::string where = "case '" + def.name + "'";
  if (def.bones.empty()) return fail("it has no bones", where, "Import at least one mesh");
  if (def.bones.size() > kMaxBones)
    return fail("it has " + std::to_string(def.bones.size()) + " bones, more than " +
                    std::to_string(kMaxBones),
                where, "Split it into several cases");
  if (auto sound = check_landmarks(def.landmarks); !sound) return tl::unexpected(sound.error());
  std::set<std::string> names;
  for (const BoneDef& bone : def.bones) {
    if (!names.insert(bone.name).second)
      return fail("two bones have the name '" + bone.name + "'", where, "Rename one of them");
    if (auto sound = check_bone(bone); !sound) return tl::unexpected(sound.error());
  }
  cover_bones(def);
  std::vector<Felt> chosen;
  for (const BoneDef& bone : def.bones) chosen.push_back(bone.felt);
  Case built;
  for (std::size_t i = 0; i < def.bones.size(); ++i) {
    if (options.progress) options.progress(i, def.bones.size());
    auto bone = build_bone(std::move(def.bones[i]), options);
    if (!bone) return tl::unexpected(bone.error());
    built.bones.push_back(std::move(*bone));
  }
  auto softs = build_softs(std::move(def.softs), built.bones);
  if (!softs) return tl::unexpected(softs.error());
  built.softs = std::move(*softs);
  auto joints = build_joints(std::move(def.joints), built.bones);
  if (!joints) return tl::unexpected(joints.error());
  built.joints = std::move(*joints);
  built.name = std::move(def.name);
  built.side = std::move(def.side);
  built.landmarks = std::move(def.landmarks);
  built.findings = std::move(def.findings);
  built.hash = hash_of(built, chosen);
  return built;
}

}  // namespace osteon
