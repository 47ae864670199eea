#include "knee/knee_fibres.h"

#include <algorithm>

#include "knee/taut_over.h"

namespace osteon {
namespace {

constexpr double kFibresBend_deg = 120;  // to here bending alone never overstretches a fibre
constexpr double kFibresStep_deg = 10;

Vec3 laid_on(const MeshDistance& bone, const Vec3& p) { return bone.closest(p).point; }

Vec3 laid_on_moved(const KneeParts& parts, const Vec3& p) {
  const Vec3 tibia = laid_on(*parts.tibia.surface, p);
  if (!parts.fibula) return tibia;
  const Vec3 fibula = laid_on(*parts.fibula->surface, p);
  return (fibula - p).norm() < (tibia - p).norm() ? fibula : tibia;
}

/// Slack, so that the fibre has its strain where it is said, and no more than the most on the way.
void set_slack(const LigamentBundle& bundle, const PoseTrack& X_FT, JointFibre& fibre) {
  fibre.slack_m = passive_length(fibre, X_FT, bundle.taut_deg) / (1 + bundle.strain);
  for (double bend = 0; bend <= std::min(kFibresBend_deg, X_FT.last()); bend += kFibresStep_deg)
    fibre.slack_m =
        std::max(fibre.slack_m, passive_length(fibre, X_FT, bend) / (1 + bundle.most_strain));
}

}  // namespace

double passive_length(const JointFibre& fibre, const PoseTrack& X_FT, double flexion_deg) {
  return (pose_at(X_FT, flexion_deg) * fibre.to_T - fibre.from_F).norm() + fibre.over_m;
}

std::optional<std::pair<Vec3, Vec3>> ends_of(const CaseDef& def, const KneeParts& parts,
                                             const std::string& name) {
  for (const SoftDef& soft : def.softs) {
    if (soft.name != name) continue;
    std::optional<Vec3> from, to;
    for (const AttachmentDef& end : soft.attachments) {
      if (end.bone == "femur") from = parts.place(parts.femur, end.p_W);
      if (end.bone == "tibia") to = parts.place(parts.tibia, end.p_W);
      if (end.bone == "fibula" && parts.fibula) to = parts.place(*parts.fibula, end.p_W);
    }
    if (from && to) return std::pair(*from, *to);
  }
  return std::nullopt;
}

std::vector<JointFibre> make_fibres(const CaseDef& def, const KneeParts& parts,
                                    const LigamentRow& row, double toe_strain) {
  std::vector<JointFibre> fibres;
  std::pair<Vec3, Vec3> origin{Vec3::Zero(), Vec3::Zero()};
  if (!row.part.empty()) {
    const auto ends = ends_of(def, parts, row.part);
    if (!ends) return fibres;
    origin = *ends;
  }
  for (const LigamentBundle& bundle : row.bundles)
    for (std::size_t i = 0; i < bundle.femur.size(); ++i) {
      JointFibre fibre;
      fibre.from_F = laid_on(*parts.femur.surface, origin.first + parts.scale * bundle.femur[i]);
      fibre.to_T = laid_on_moved(parts, origin.second + parts.scale * bundle.tibia[i]);
      if (row.over_tibia) {
        const TautOver taut = taut_over(parts.tibia.surface->mesh(), fibre.from_F, fibre.to_T,
                                        Vec3(0, fibre.from_F.y() < 0 ? -1 : 1, 0));
        fibre.to_T = taut.first;
        fibre.over_m = taut.rest_m;
      }
      fibre.stiffness_n = bundle.stiffness_n / static_cast<double>(bundle.femur.size());
      fibre.toe_strain = toe_strain;
      set_slack(bundle, parts.X_FT, fibre);
      fibres.push_back(fibre);
    }
  return fibres;
}

}  // namespace osteon
