#include "osteon/physics/soft_setup.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "osteon/base/hash.h"
#include "osteon/mesh/measure.h"
#include "osteon/scene/state.h"

namespace osteon {
namespace {

constexpr const char* kAllLigaments = "ligaments";
constexpr const char* kWhere = "--soft";
constexpr double kShortest_m = 0.003, kLongest_m = 0.3;
constexpr double kThinnest_m = 0.0003, kThickest_m = 0.02;
constexpr double kBends_deg = 120, kStep_deg = 10;  // as the laxity of a knee has it

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

const LigamentRow* row_of(const LigamentTable& table, const std::string& name) {
  for (const LigamentRow& row : table.ligaments)
    if (row.name == name && !row.part.empty()) return &row;
  return nullptr;
}

std::optional<std::uint32_t> part_of(const Case& the_case, const LigamentRow& row) {
  for (std::size_t i = 0; i < the_case.softs.size(); ++i)
    if (the_case.softs[i].name == row.part) return static_cast<std::uint32_t>(i);
  return std::nullopt;
}

std::vector<std::string> names_there(const Case& the_case, const LigamentTable& table) {
  std::vector<std::string> names;
  for (const LigamentRow& row : table.ligaments)
    if (!row.part.empty() && part_of(the_case, row)) names.push_back(row.name);
  return names;
}

Result<std::vector<const LigamentRow*>> rows_asked(const Case& the_case, const LigamentTable& table,
                                                   std::span<const std::string> names) {
  const std::vector<std::string> there = names_there(the_case, table);
  const std::string advice =
      there.empty() ? "Give a case with a knee or a wrist, such as builtin:knee"
                    : "Choose from " + listed(there) + ", " + kAllLigaments + " or menisci";
  // All: as many of them as are felt at once, in the order of the table.
  const std::vector<std::string> all(
      there.begin(),
      there.begin() + static_cast<std::ptrdiff_t>(std::min(there.size(), kMaxBands)));
  std::vector<std::string> wanted;
  for (const std::string& name : names) {
    const std::vector<std::string> more =
        name == kAllLigaments ? all : std::vector<std::string>{name};
    for (const std::string& one : more)
      if (std::find(wanted.begin(), wanted.end(), one) == wanted.end()) wanted.push_back(one);
  }
  if (wanted.empty()) return fail("the case has no ligament that can be felt", kWhere, advice);
  if (wanted.size() > kMaxBands)
    return fail("more than " + std::to_string(kMaxBands) + " ligaments", kWhere, "Give fewer");
  std::vector<const LigamentRow*> rows;
  for (const std::string& name : wanted) {
    if (std::find(there.begin(), there.end(), name) == there.end())
      return fail("the case has no ligament '" + name + "' that can be felt", kWhere, advice);
    rows.push_back(row_of(table, name));
  }
  return rows;
}

// Of the part's surface, halfway of its bends, what lies farthest beside the straight way: where a
// band that lies over a bone leaves it.
Vec3 farthest_bend(const SoftPart& part, const Vec3& from_W, const Vec3& to_W) {
  constexpr int kSlices = 16;
  const Vec3 way = to_W - from_W;
  std::array<Vec3, kSlices> sums{};
  std::array<int, kSlices> counts{};
  for (Vec3& sum : sums) sum.setZero();
  for (const Vec3& p : part.mesh_W.vertices) {
    const double share = (p - from_W).dot(way) / way.squaredNorm();
    if (!(share >= 0 && share < 1)) continue;
    const auto slice = static_cast<std::size_t>(share * kSlices);
    sums[slice] += p;
    ++counts[slice];
  }
  Vec3 best = to_W;
  double most = 0;
  for (std::size_t i = 0; i < kSlices; ++i) {
    if (counts[i] == 0) continue;
    const Vec3 middle = sums[i] / counts[i];
    const double aside = (middle - from_W).cross(way.normalized()).norm();
    if (aside > most) {
      most = aside;
      best = middle;
    }
  }
  return best;
}

bool moves_with(BoneId bone, const CaseJoint& joint) {
  return std::any_of(joint.bones.begin(), joint.bones.end(),
                     [&](const CaseJoint::Moved& moved) { return moved.bone == bone; });
}

// The joint that bends this band: one that moves just one of its bones.
const CaseJoint* joint_of(const Case& the_case, const SoftBand& band) {
  for (const CaseJoint& joint : the_case.joints)
    if (!joint.bones.empty() && moves_with(band.from, joint) != moves_with(band.to, joint))
      return &joint;
  return nullptr;
}

double length_in(const SoftBand& band, const BoneSnapshot& bones) {
  return (bones.bones[band.from.index].X_WB * band.from_B -
          bones.bones[band.to.index].X_WB * band.to_B)
             .norm() +
         band.over_m;
}

double length_at(const Case& the_case, const SoftBand& band, const CaseJoint* joint, double deg) {
  return length_in(band, joint ? bent_snapshot(the_case, *joint, deg) : rest_snapshot(the_case));
}

// Slack, so that the fibres have their strain where the table says, and no more than the most on
// the way.
BandFibres fibres_of(const Case& the_case, const SoftBand& band, const LigamentBundle& bundle,
                     std::optional<double> found_strain, double toe_strain) {
  const CaseJoint* joint = joint_of(the_case, band);
  BandFibres out;
  out.stiffness_n = bundle.stiffness_n;
  out.toe_strain = toe_strain;
  out.slack_m = length_at(the_case, band, joint, bundle.taut_deg) /
                (1 + found_strain.value_or(bundle.strain));
  for (double deg = 0; joint && deg <= std::min(kBends_deg, joint->max_deg()); deg += kStep_deg)
    out.slack_m =
        std::max(out.slack_m, length_at(the_case, band, joint, deg) / (1 + bundle.most_strain));
  return out;
}

struct FoundOf {
  double left = 1;
  std::optional<double> strain;
};

// Of several findings the worst counts.
FoundOf found_of(const Case& the_case, const LigamentTable& table, const std::string& ligament) {
  FoundOf out;
  for (const CaseFinding& finding : the_case.findings)
    for (const TornRow& row : table.torn) {
      if (row.finding != finding.name || row.ligament != ligament ||
          !(row.grade.empty() || row.grade == finding.grade))
        continue;
      out.left = std::min(out.left, row.left);
      if (row.strain) out.strain = std::min(out.strain.value_or(*row.strain), *row.strain);
    }
  return out;
}

Result<void> lay_ends(const Case& the_case, const SoftPart& part, const LigamentRow& row,
                      SoftBand& band) {
  const bool over = row.over_tibia || !row.over_bone.empty();
  const Attachment* ends[2] = {};
  for (const Attachment& end : part.attachments)
    if (!ends[0])
      ends[0] = &end;
    else if (!ends[1] && end.bone != ends[0]->bone)
      ends[1] = &end;
  if (!ends[1])
    return fail("the ligament '" + part.name + "' does not run from one bone to another", kWhere,
                "It needs footprints on two bones");
  if (row.over_tibia && the_case.bone(ends[0]->bone).name == "tibia") std::swap(ends[0], ends[1]);
  band.from = ends[0]->bone;
  band.to = ends[1]->bone;
  if (!row.over_bone.empty())
    if (const BoneId bend = the_case.find(row.over_bone); bend.valid()) band.to = bend;
  const Vec3 from_W = ends[0]->p_W, to_W = ends[1]->p_W;
  const Vec3 leaves_W = over ? farthest_bend(part, from_W, to_W) : to_W;
  band.over_m = (to_W - leaves_W).norm();
  band.from_B = the_case.bone(band.from).X_WB.inverse() * from_W;
  band.to_B = the_case.bone(band.to).X_WB.inverse() * leaves_W;
  const Vec3 way_W = leaves_W - from_W;
  band.section_B = the_case.bone(band.from).X_WB.inverse().rotate(way_W).unitOrthogonal();
  const double free_m = (leaves_W - from_W).norm();
  if (!(free_m >= kShortest_m && free_m <= kLongest_m))
    return fail("the ligament '" + part.name + "' is " + std::to_string(1e3 * free_m) + " mm long",
                kWhere, "Footprints must be 3 to 300 mm apart");
  return {};
}

// As thick as its volume, were it round.
Result<double> radius_of(const SoftPart& part, double length_m) {
  const double radius = std::sqrt(volume(part.mesh_W) / (std::numbers::pi * length_m));
  if (radius >= kThinnest_m && radius <= kThickest_m) return radius;
  return fail("the surface of '" + part.name + "' does not enclose a ligament's volume", kWhere,
              "It must be closed, its triangles facing outwards");
}

Result<SoftBand> band_of(const Case& the_case, const LigamentTable& table, const LigamentRow& row,
                         double surface_n_per_m) {
  SoftBand band;
  band.soft = *part_of(the_case, row);
  const SoftPart& part = the_case.softs[band.soft];
  band.name = part.name;
  if (auto laid = lay_ends(the_case, part, row, band); !laid) return tl::unexpected(laid.error());
  const FoundOf found = found_of(the_case, table, row.name);
  band.left = found.left;
  const double length_m = length_in(band, rest_snapshot(the_case));
  auto radius = radius_of(part, length_m);
  if (!radius && band.left > 0) return tl::unexpected(radius.error());
  band.radius_m = radius.value_or(kThinnest_m);
  band.surface_n_per_m = surface_n_per_m;
  band.failure_n = row.failure_n;
  for (const LigamentBundle& bundle : row.bundles)
    band.fibres.push_back(fibres_of(the_case, band, bundle, found.strain, table.toe_strain));
  return band;
}

}  // namespace

std::uint64_t hash_of(std::span<const SoftBand> bands) {
  Hasher h;
  for (const SoftBand& band : bands) {
    h.add(std::string_view(band.name));
    h.add(band.soft);
    h.add(band.from.index);
    h.add(band.to.index);
    h.add(band.from_B);
    h.add(band.to_B);
    for (const double x :
         {band.over_m, band.radius_m, band.surface_n_per_m, band.failure_n, band.left})
      h.add(x);
    for (const BandFibres& fibres : band.fibres)
      for (const double x : {fibres.slack_m, fibres.stiffness_n, fibres.toe_strain}) h.add(x);
  }
  return h.value();
}

Result<SoftSetup> make_soft_setup(const Case& the_case, const LigamentTable& table,
                                  std::span<const std::string> names, double surface_n_per_m) {
  const auto rows = rows_asked(the_case, table, names);
  if (!rows) return tl::unexpected(rows.error());
  if (!(surface_n_per_m > 0 && std::isfinite(surface_n_per_m)))
    return fail("a ligament's surface has no stiffness", kWhere, "Correct the tissue table");
  SoftSetup setup;
  for (const LigamentRow* row : *rows) {
    auto band = band_of(the_case, table, *row, surface_n_per_m);
    if (!band) return tl::unexpected(band.error());
    setup.bands.push_back(std::move(*band));
  }
  setup.hash = hash_of(setup.bands);
  return setup;
}

}  // namespace osteon
