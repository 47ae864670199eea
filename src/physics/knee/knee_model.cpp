#include <algorithm>
#include <cmath>
#include <numbers>

#include "knee/knee_beds.h"
#include "knee/knee_fibres.h"
#include "knee/knee_parts.h"
#include "osteon/mesh/measure.h"
#include "osteon/physics/knee_laxity.h"

namespace osteon {
namespace {

/// Share of a ligament that findings and cuts leave.
double left_of(const CaseDef& def, const LigamentTable& table, const KneeChanges& changes,
               const std::string& ligament) {
  double left = 1;
  for (const CaseFinding& finding : def.findings)
    for (const TornRow& row : table.torn)
      if (!changes.heal && row.finding == finding.name && row.ligament == ligament &&
          (row.grade.empty() || row.grade == finding.grade))
        left = std::min(left, row.left);
  for (const std::string& cut : changes.without)
    if (cut == ligament) left = 0;
  return changes.graft && table.graft.ligament == ligament ? 0 : left;
}

Result<void> check_names(const LigamentTable& table, const KneeChanges& changes) {
  std::string all;
  for (const LigamentRow& row : table.ligaments) all += (all.empty() ? "" : ", ") + row.name;
  for (const std::string& cut : changes.without)
    if (std::none_of(table.ligaments.begin(), table.ligaments.end(),
                     [&](const LigamentRow& row) { return row.name == cut; }))
      return fail("there is no ligament '" + cut + "'", "the ligaments to cut",
                  "Choose from " + all);
  return {};
}

void lay_plateaus(const KneeParts& parts, const LigamentTable& table, KneeModel& knee) {
  const CartilageLaw law{table.cartilage_young_pa, table.cartilage_poisson,
                         parts.femoral_thickness_m};
  std::vector<Vec3> middles;
  for (const TriMesh& layer : parts.plateaus) {
    const std::vector<JointBed> beds = lay_beds(layer, *parts.tibia.surface, law);
    knee.joint.beds.insert(knee.joint.beds.end(), beds.begin(), beds.end());
    middles.push_back(centroid(layer));
  }
  const std::vector<JointBed> spines =
      lay_spine_beds(*parts.tibia.surface, *parts.femur.surface, parts.plateaus, parts.scale, law);
  knee.joint.beds.insert(knee.joint.beds.end(), spines.begin(), spines.end());
  const auto by_y = [](const Vec3& a, const Vec3& b) { return a.y() < b.y(); };
  knee.medial_T = *std::max_element(middles.begin(), middles.end(), by_y);
  knee.lateral_T = *std::min_element(middles.begin(), middles.end(), by_y);
  knee.joint.middle_T = 0.5 * (knee.medial_T + knee.lateral_T);
}

void add_ligaments(const CaseDef& def, const KneeParts& parts, const LigamentTable& table,
                   const KneeChanges& changes, KneeModel& knee) {
  for (const LigamentRow& row : table.ligaments) {
    std::vector<JointFibre> fibres = make_fibres(def, parts, row, table.toe_strain);
    if (fibres.empty()) {
      knee.absent.push_back(row.name);
      continue;
    }
    const double left = left_of(def, table, changes, row.name);
    for (JointFibre& fibre : fibres) {
      fibre.ligament = knee.ligaments.size();
      fibre.stiffness_n *= left;
      knee.joint.fibres.push_back(fibre);
    }
    knee.ligaments.push_back(row.name);
  }
}

/// The graft's fibre while it is pulled, its ends as asked for or at the footprints.
Result<JointFibre> pulled_graft(const CaseDef& def, const KneeParts& parts,
                                const LigamentTable& table, const KneeGraft& graft) {
  const auto ends = ends_of(def, parts, table.graft.ligament);
  if (!ends && !(graft.from_W && graft.to_W))
    return fail("the case has no '" + table.graft.ligament + "', so its footprints are unknown",
                "graft", "Give both ends");
  JointFibre fibre;
  fibre.from_F = graft.from_W ? parts.place(parts.femur, *graft.from_W) : ends->first;
  fibre.to_T = graft.to_W ? parts.place(parts.tibia, *graft.to_W) : ends->second;
  fibre.toe_strain = table.toe_strain;
  fibre.pulled_n = graft.tension_n.value_or(table.graft.tension_n);
  const double apart = (fibre.to_T - fibre.from_F).norm();
  if (!(apart > 0.005 && apart < 0.15))
    return fail("its ends are " + std::to_string(1000 * apart) +
                    " mm apart with the knee straight; they must be 5 to 150",
                "graft", "Give places in mm, World, on femur and tibia");
  return fibre;
}

/// Strain at which a fibre of stiffness k pulls with this force (the law of JointFibre turned
/// round).
double strain_at(double force_n, double k, double toe) {
  return force_n <= k * toe ? std::sqrt(4 * toe * force_n / k) : force_n / k + toe;
}

/// Pulled at its bend until the knee is at rest, then fixed: the same length is held by a spring
/// with what of the tension is kept.
Result<void> fix_graft(const CaseDef& def, const KneeParts& parts, const LigamentTable& table,
                       const KneeGraft& graft, KneeModel& knee) {
  auto fibre = pulled_graft(def, parts, table, graft);
  if (!fibre) return tl::unexpected(fibre.error());
  if (!graft.held) {
    knee.ligaments.emplace_back("graft");
    return {};
  }
  fibre->ligament = knee.ligaments.size();
  HeldJoint pulled = knee.joint;
  pulled.fibres.push_back(*fibre);
  const double bend_deg = graft.flexion_deg.value_or(table.graft.flexion_deg);
  JointPose start = joint_pose(pulled, pose_at(knee.X_FT, bend_deg));
  pulled.surround.about = start;
  const JointLoad load{-knee.seating_n * along_F(start.flexion_rad), 0, 0};
  const auto rest = settle(pulled, load, start);
  if (!rest) return tl::unexpected(rest.error());
  if (!rest->converged)
    return fail("the knee reaches no equilibrium while the graft is pulled", "graft",
                "Check its ends and its tension");
  const double length = rest->fibres.back().length_m;
  const double diameter = graft.diameter_m.value_or(table.graft.diameter_m);
  const double body = table.graft.young_pa * 0.25 * std::numbers::pi * diameter * diameter;
  const double fixation = graft.fixation_n_per_m.value_or(table.graft.fixation_n_per_m);
  fibre->stiffness_n = 1 / (1 / body + 1 / (fixation * length));
  fibre->slack_m = length / (1 + strain_at(table.graft.kept * fibre->pulled_n, fibre->stiffness_n,
                                           fibre->toe_strain)) +
                   graft.slack_m;
  fibre->pulled_n = 0;
  knee.joint.fibres.push_back(*fibre);
  knee.ligaments.emplace_back("graft");
  return {};
}

Result<void> check_held(const CaseDef& def, const LigamentTable& table, const KneeModel& knee) {
  bool held = false;
  for (const JointFibre& fibre : knee.joint.fibres) held = held || fibre.stiffness_n > 0;
  const bool bare =
      std::none_of(table.ligaments.begin(), table.ligaments.end(), [&](const auto& row) {
        return !row.part.empty() &&
               std::find(knee.absent.begin(), knee.absent.end(), row.name) == knee.absent.end();
      });
  if (held && !bare) return {};
  return fail("nothing holds the tibia", "case '" + def.name + "'",
              bare
                  ? "The case has no ligaments as soft parts; make it with osteon anatomy make knee"
                  : "Leave at least one ligament intact, or put in a graft");
}

}  // namespace

Result<KneeModel> make_knee(const CaseDef& def, const LigamentTable& table,
                            const KneeChanges& changes) {
  if (auto ok = check_names(table, changes); !ok) return tl::unexpected(ok.error());
  const auto parts = find_knee_parts(def, table.width_m);
  if (!parts) return tl::unexpected(parts.error());
  KneeModel knee;
  knee.X_FT = parts->X_FT;
  knee.seating_n = table.seating_n;
  knee.joint.surface_F = parts->femoral_surface;
  knee.joint.solids_F = {parts->femur.surface, parts->femoral_cartilage};
  knee.joint.surround = {
      table.surround_n_per_m, table.across_n_per_m, table.surround_nm_per_rad, {}};
  lay_plateaus(*parts, table, knee);
  add_ligaments(def, *parts, table, changes, knee);
  if (changes.graft)
    if (auto ok = fix_graft(def, *parts, table, *changes.graft, knee); !ok)
      return tl::unexpected(ok.error());
  if (auto ok = check_held(def, table, knee); !ok) return tl::unexpected(ok.error());
  return knee;
}

Result<std::vector<LineLength>> line_over_flexion(const CaseDef& def, const Vec3& from_W,
                                                  const Vec3& to_W) {
  const auto parts = find_knee_bones(def);
  if (!parts) return tl::unexpected(parts.error());
  JointFibre line;
  line.from_F = parts->place(parts->femur, from_W);
  line.to_T = parts->place(parts->tibia, to_W);
  std::vector<LineLength> out;
  for (double bend = 0; bend <= std::min(130.0, parts->X_FT.last()); bend += 10)
    out.push_back({bend, passive_length(line, parts->X_FT, bend)});
  return out;
}

}  // namespace osteon
