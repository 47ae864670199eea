#include "skin/wound_section.h"

#include <algorithm>
#include <cmath>

namespace osteon {
namespace {

constexpr double kStandsUp = 0.3;    // of its length: what is flatter lies on the skin
constexpr double kBroad_m = 0.0015;  // half of a blade that counts as five discs, not three
constexpr double kNarrow_m = 0.0004;

struct ToolAxis {
  Vec3 middle, way;  // unit
  double half_m = 0, round_m = 0;
};

// The place of the axis on the skin, whose height there is met in a second look.
std::optional<double> place_on(const SkinPatch& patch, const ToolAxis& axis) {
  if (!(std::abs(axis.way.z()) > kStandsUp)) return {};
  double at = -axis.middle.z() / axis.way.z();
  for (int look = 0; look < 2; ++look) {
    const Vec3 p = axis.middle + at * axis.way;
    at = (patch.relief.at(p.head<2>()).height_m - axis.middle.z()) / axis.way.z();
  }
  if (!(std::abs(at) <= axis.half_m + axis.round_m)) return {};
  return std::clamp(at, -axis.half_m, axis.half_m);
}

std::optional<WoundSection> section_of_rod(const SkinPatch& patch, const RoundBox& rod_S) {
  const Vec3 way = rod_S.rod.p1 - rod_S.rod.p0;
  const double length = way.norm();
  if (!(length > 1e-9)) return {};
  const ToolAxis axis{0.5 * (rod_S.rod.p0 + rod_S.rod.p1), way / length, 0.5 * length,
                      rod_S.rod.radius};
  const auto at = place_on(patch, axis);
  if (!at) return {};
  WoundSection out;
  out.along = 0.5 + *at / length;
  out.middle_S = axis.middle + *at * axis.way;
  out.radius_m = rod_S.rod.radius;
  out.discs[out.count++] = {out.middle_S.head<2>(), rod_S.rod.radius, 0};
  return out;
}

std::optional<WoundSection> section_of_box(const SkinPatch& patch, const RoundBox& box_S) {
  Eigen::Index longest = 0;
  box_S.half.maxCoeff(&longest);
  const Eigen::Index one = (longest + 1) % 3, two = (longest + 2) % 3;
  const Eigen::Index broad = box_S.half[one] >= box_S.half[two] ? one : two;
  const Eigen::Index thin = broad == one ? two : one;
  const ToolAxis axis{box_S.X.p, box_S.X.rotate(Vec3::Unit(longest)), box_S.half[longest],
                      box_S.rod.radius};
  const auto at = place_on(patch, axis);
  if (!at) return {};
  WoundSection out;
  out.core = *at * Vec3::Unit(longest);
  out.middle_S = axis.middle + *at * axis.way;
  out.radius_m = box_S.rod.radius;
  const Vec3 across = box_S.X.rotate(Vec3::Unit(broad));
  const SheetPoint row = (across - across.z() / axis.way.z() * axis.way).head<2>();
  const double half_m = box_S.half[broad], thick_m = box_S.half[thin] + box_S.rod.radius;
  const int each_way = half_m > kBroad_m ? 2 : half_m > kNarrow_m ? 1 : 0;
  for (int i = -each_way; i <= each_way; ++i) {
    const double share = each_way > 0 ? double(i) / each_way : 0;
    out.discs[out.count++] = {out.middle_S.head<2>() + share * half_m * row, thick_m, 0};
  }
  return out;
}

}  // namespace

std::optional<WoundSection> wound_section(const SkinPatch& patch, std::span<const RoundBox> parts,
                                          const Pose& X_ST, std::uint32_t hand) {
  std::optional<WoundSection> best;
  double broadest = -1;
  for (std::uint32_t part = 0; part < parts.size(); ++part) {
    const RoundBox part_S = placed(X_ST, parts[part]);
    auto section = part_S.is_box ? section_of_box(patch, part_S) : section_of_rod(patch, part_S);
    if (!section) continue;
    const double broad = (section->discs[section->count - 1].at - section->discs[0].at).norm() +
                         2 * section->discs[0].radius_m;
    if (!(broad > broadest)) continue;
    broadest = broad;
    section->part = part;
    best = section;
  }
  if (!best) return best;
  for (LipDisc& disc : best->discs) disc.hand = hand;
  return best;
}

}  // namespace osteon
