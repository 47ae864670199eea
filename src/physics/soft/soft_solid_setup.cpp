#include "osteon/physics/soft_solid_setup.h"

#include <algorithm>
#include <cmath>

#include "osteon/base/hash.h"
#include "osteon/mesh/measure.h"
#include "osteon/mesh/tri_mesh.h"
#include "osteon/physics/soft_setup.h"
#include "osteon/scene/soft_solid.h"
#include "soft/rim_outline.h"
#include "soft/solid_fields.h"

namespace osteon {
namespace {

constexpr const char* kMenisci = "menisci";
constexpr const char* kMeniscusKind = "meniscus";
constexpr const char* kSolidsWhere = "--soft";
constexpr double kRim_m = 0.003;  // of the outer edge, what is held
constexpr double kUnder = -0.3;
// The outer 10 to 30 % have vessels (Arnoczky and Warren 1982, Am J Sports Med 10:90), of a width
// of about 10 mm.
constexpr double kVessels_m = 0.0033;

Result<std::vector<std::uint32_t>> menisci_asked(const Case& the_case,
                                                 std::span<const std::string> names) {
  std::vector<std::uint32_t> out;
  std::string there;
  for (const std::string& name : names)
    for (std::size_t i = 0; i < the_case.softs.size(); ++i) {
      const SoftPart& part = the_case.softs[i];
      const auto place = static_cast<std::uint32_t>(i);
      const bool meant = part.kind == kMeniscusKind && (name == kMenisci || name == part.name);
      if (meant && std::find(out.begin(), out.end(), place) == out.end()) out.push_back(place);
    }
  if (out.empty())
    return fail("the case has no meniscus that can be felt", kSolidsWhere,
                "Give a case with a knee, such as builtin:knee");
  if (out.size() > kMaxSolids)
    return fail("more than " + std::to_string(kMaxSolids) + " menisci", kSolidsWhere, "Give fewer");
  return out;
}

std::vector<Vec3> in_bone(const Case& the_case, const SoftPart& part, BoneId bone) {
  const Pose X_BW = the_case.bone(bone).X_WB.inverse();
  std::vector<Vec3> out;
  for (const Vec3& p : part.mesh_W.vertices) out.push_back(X_BW * p);
  return out;
}

Vec3 vertices_middle(const TriMesh& mesh) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& p : mesh.vertices) sum += p;
  return sum / static_cast<double>(std::max<std::size_t>(mesh.vertices.size(), 1));
}

// As the coronary ligament and the roots hold a meniscus.
bool is_held(const RimOutline& outline, const Vec3& p) {
  return outline.inside(p) < kRim_m && outline.height(p) < 0;
}

PressedSolidDef solid_def(const TriMesh& mesh, const RimOutline& outline,
                          std::shared_ptr<const DistanceField> field, double stiffness_n_per_m) {
  PressedSolidDef def;
  for (const Vec3& p : mesh.vertices) def.box.include(p);
  def.up = outline.up();
  def.stiffness_n_per_m = stiffness_n_per_m;
  def.held = [&outline](const Vec3& p) { return is_held(outline, p); };
  def.rests = [field, &outline](const Vec3& p) {
    return field->at(p).gradient.normalized().dot(outline.up()) < kUnder;
  };
  def.field = std::move(field);
  return def;
}

Result<SoftSolid> solid_of(const Case& the_case, std::uint32_t soft, double stiffness_n_per_m,
                           FieldCache* known) {
  const SoftPart& part = the_case.softs[soft];
  SoftSolid out;
  out.name = part.name;
  out.soft = soft;
  if (part.bones.size() != 1)
    return fail("the meniscus '" + part.name + "' does not belong to one bone", kSolidsWhere,
                "It must move with the bone that it lies on");
  out.bone = part.bones.front();
  TriMesh mesh_B = part.mesh_W;
  mesh_B.vertices = in_bone(the_case, part, out.bone);
  const std::string what = "the meniscus '" + part.name + "'";
  if (auto made = make_solid_fields(mesh_B, what, known, out); !made)
    return tl::unexpected(made.error());
  const RimOutline outline(mesh_B.vertices, vertices_middle(the_case.bone(out.bone).mesh));
  auto body = PressedSolid::make(solid_def(mesh_B, outline, out.field, stiffness_n_per_m));
  if (!body) {
    body.error().where = what;
    return tl::unexpected(body.error());
  }
  out.body = std::make_shared<const PressedSolid>(std::move(*body));
  out.hangs = [outline](const Vec3& p_B) { return is_held(outline, p_B); };
  out.bleeds = [outline](const Vec3& p_B) { return outline.inside(p_B) < kVessels_m; };
  return out;
}

}  // namespace

void tell_hash(SoftSetup& setup, std::string_view does) {
  Hasher h;
  h.add(setup.hash);
  h.add(does);
  setup.hash = h.value();
}

bool names_solids(const Case& the_case, const std::string& name) {
  const auto is_it = [&](const SoftPart& part) {
    return part.kind == kMeniscusKind && part.name == name;
  };
  return name == kMenisci || std::any_of(the_case.softs.begin(), the_case.softs.end(), is_it);
}

std::uint64_t hash_of(std::span<const SoftSolid> solids) {
  Hasher h;
  for (const SoftSolid& solid : solids) {
    h.add(std::string_view(solid.name));
    h.add(solid.soft);
    h.add(solid.bone.index);
    h.add(solid.field->hash());
    h.add(solid.body->hash());
  }
  return h.value();
}

void add_blades(SoftSetup& setup, std::vector<std::uint32_t> blades, double cutting_n) {
  if (blades.empty() || setup.bands.empty()) return;
  setup.blades = std::move(blades);
  setup.cutting_n = cutting_n;
  Hasher h;
  h.add(setup.hash);
  for (const std::uint32_t blade : setup.blades) h.add(blade);
  h.add(setup.cutting_n);
  setup.hash = h.value();
}

void add_friction(SoftSetup& setup, const SoftFriction& friction) {
  std::vector<double> ratios = {friction.band.resting, friction.band.sliding,
                                friction.solid.resting, friction.solid.sliding};
  if (!setup.skins.empty())
    ratios.insert(ratios.end(), {friction.skin.resting, friction.skin.sliding});
  if (std::all_of(std::begin(ratios), std::end(ratios), [](double ratio) { return ratio == 0; }))
    return;
  setup.friction = friction;
  Hasher h;
  h.add(setup.hash);
  for (const double ratio : ratios) h.add(ratio);
  setup.hash = h.value();
}

void add_cutters(SoftSetup& setup, std::vector<std::optional<SolidCutter>> cutters,
                 double cutting_n) {
  const auto cuts = [](const std::optional<SolidCutter>& cutter) { return cutter.has_value(); };
  if (setup.solids.empty() || std::none_of(cutters.begin(), cutters.end(), cuts)) return;
  setup.cutters = std::move(cutters);
  setup.solid_cutting_n = cutting_n;
  Hasher h;
  h.add(setup.hash);
  h.add(cutting_n);
  for (const auto& cutter : setup.cutters) {
    h.add(cutter.has_value());
    if (!cutter) continue;
    h.add(static_cast<std::uint8_t>(cutter->way));
    h.add(std::string_view(cutter->cutter.name));
    h.add(cutter->cutter.size_m);
    h.add(cutter->works);
    if (cutter->way == SolidCutter::Way::kSlice) h.add(cutter->drawn_share);
    if (cutter->way != SolidCutter::Way::kClear) continue;
    for (const Vec3& v : {cutter->from_T, cutter->to_T, cutter->face_T}) h.add(v);
    h.add(cutter->speed_m_per_s);
  }
  for (const SoftSolid& solid : setup.solids) h.add(solid.uncut->hash());
  setup.hash = h.value();
}

void add_pieces(SoftSetup& setup, std::shared_ptr<const PiecesSetup> pieces) {
  if (setup.cutters.empty() || !pieces) return;
  setup.pieces = std::move(pieces);
  tell_hash(setup, "pieces");
}

void let_pieces_meet_softs(SoftSetup& setup) {
  if (!setup.pieces) return;
  setup.pieces_meet_softs = true;
  tell_hash(setup, "pieces meet soft parts");
}

void let_pieces_be_stopped(SoftSetup& setup) {
  if (setup.bands.empty() && setup.solids.empty()) return;
  setup.pieces_are_stopped = true;
  tell_hash(setup, "pieces are stopped");
}

void let_thin_parts_stop_pieces(SoftSetup& setup) {
  if (!setup.pieces_are_stopped) return;
  setup.thin_ones_stop = true;
  tell_hash(setup, "thin parts stop pieces");
}

void let_suction_heed_thin_parts(SoftSetup& setup) {
  if (!setup.thin_ones_stop) return;
  setup.suction_heeds_thin = true;
  tell_hash(setup, "suction heeds thin parts");
}

void let_presses_be_bounded(SoftSetup& setup) {
  if (setup.solids.empty()) return;
  setup.presses_are_bounded = true;
  tell_hash(setup, "presses are bounded");
}

void let_covered_parts_wait(SoftSetup& setup) {
  if (setup.solids.empty()) return;
  setup.covered_parts_wait = true;
  tell_hash(setup, "covered parts wait");
}

void let_clearing_go_by_strides(SoftSetup& setup) {
  const auto clears = [](const std::optional<SolidCutter>& with) {
    return with && with->way == SolidCutter::Way::kClear;
  };
  if (setup.solids.empty() || std::none_of(setup.cutters.begin(), setup.cutters.end(), clears))
    return;
  setup.clears_by_strides = true;
  tell_hash(setup, "clears by strides");
}

void let_hooks_tear_and_punches_bite(SoftSetup& setup) {
  const auto bites = [](const std::optional<SolidCutter>& cutter) {
    return cutter && cutter->way == SolidCutter::Way::kBite;
  };
  setup.hooks_tear = setup.bridges_tear;
  setup.punches_bite =
      setup.by_strands && std::any_of(setup.biters.begin(), setup.biters.end(), bites);
  if (setup.hooks_tear) tell_hash(setup, "hooks tear");
  if (setup.punches_bite) tell_hash(setup, "punches bite");
}

void let_clearers_part_bands(SoftSetup& setup) {
  if (!setup.by_strands) return;
  Hasher h;
  for (const std::optional<SolidCutter>& with : setup.biters) {
    if (!with || with->way != SolidCutter::Way::kClear) continue;
    setup.clearers_part = true;
    h.add(with->speed_m_per_s);
  }
  if (!setup.clearers_part) return;
  h.add(setup.hash);
  setup.hash = h.value();
  tell_hash(setup, "what clears parts bands");
}

void let_bands_part_by_strands(SoftSetup& setup) {
  if (setup.bands.empty()) return;
  setup.by_strands = true;
  tell_hash(setup, "bands part by strands");
}

void let_bridges_tear(SoftSetup& setup) {
  if (!setup.pieces || setup.grippers.empty()) return;
  setup.bridges_tear = true;
  tell_hash(setup, "bridges tear");
}

void add_grippers(SoftSetup& setup, std::vector<std::optional<SoftGripper>> grippers) {
  const auto holds = [](const std::optional<SoftGripper>& jaws) { return jaws.has_value(); };
  if (std::none_of(grippers.begin(), grippers.end(), holds)) return;
  setup.grippers = std::move(grippers);
  Hasher h;
  h.add(setup.hash);
  for (const auto& jaws : setup.grippers) {
    h.add(jaws.has_value());
    if (!jaws) continue;
    h.add(jaws->holds_n);
    h.add(jaws->jaws);
    for (const Plane& plane : jaws->mouth_T) {
      h.add(plane.n);
      h.add(plane.d);
    }
    if (!(jaws->bore_m > 0)) continue;
    h.add(jaws->bore_m);
    h.add(jaws->bore_T);
  }
  setup.hash = h.value();
}

void add_solids(SoftSetup& setup, std::vector<SoftSolid> solids) {
  setup.solids = std::move(solids);
  Hasher h;
  h.add(setup.hash);
  h.add(hash_of(setup.solids));
  setup.hash = h.value();
}

Result<std::vector<SoftSolid>> make_soft_solids(const Case& the_case,
                                                std::span<const std::string> names,
                                                double stiffness_n_per_m, FieldCache* known) {
  const auto asked = menisci_asked(the_case, names);
  if (!asked) return tl::unexpected(asked.error());
  if (!(stiffness_n_per_m > 0 && std::isfinite(stiffness_n_per_m)))
    return fail("a meniscus has no stiffness", kSolidsWhere, "Correct the tissue table");
  std::vector<SoftSolid> out;
  for (const std::uint32_t soft : *asked) {
    auto solid = solid_of(the_case, soft, stiffness_n_per_m, known);
    if (!solid) return tl::unexpected(solid.error());
    out.push_back(std::move(*solid));
  }
  return out;
}

}  // namespace osteon
