#include "osteon/physics/reference_knee.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <numbers>
#include <optional>
#include <string_view>

#include "knee/knee_beds.h"
#include "knee/taut_over.h"
#include "osteon/base/file.h"
#include "osteon/mesh/measure.h"
#include "osteon/mesh/mesh_io.h"

namespace osteon {
namespace {

constexpr double kMm = 1e-3;

Vec3 in_our_axes(const Vec3& p) { return {-p.y(), -p.z(), p.x()}; }

struct NameOfFibres {
  std::string_view begins, ligament;
};
constexpr std::array<NameOfFibres, 8> kNames{{{"MCLd", "deep_mcl"},
                                              {"MCLs", "mcl"},
                                              {"MCLp", "posterior_oblique"},
                                              {"ACL", "acl"},
                                              {"PCL", "pcl"},
                                              {"LCL", "lcl"},
                                              {"PFL", "popliteofibular"},
                                              {"pCAP", "posterior_capsule"}}};

std::string_view ligament_of(std::string_view fibre) {
  for (const NameOfFibres& name : kNames)
    if (fibre.substr(0, name.begins.size()) == name.begins) return name.ligament;
  return {};
}

std::vector<std::string_view> split(std::string_view text, char between) {
  std::vector<std::string_view> out;
  for (std::size_t end; (end = text.find(between)) != std::string_view::npos;) {
    out.push_back(text.substr(0, end));
    text.remove_prefix(end + 1);
  }
  out.push_back(text);
  return out;
}

std::optional<double> number_in(std::string_view text) {
  double value = 0;
  const auto [end, ec] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (ec != std::errc() || text.empty()) return std::nullopt;
  return value;
}

struct Row {
  std::string_view ligament;
  JointFibre fibre;
};

/// A row of the table; none where it is of the patella.
Result<std::optional<Row>> read_row(std::string_view line, const std::string& where) {
  const std::vector<std::string_view> cells = split(line, ',');
  if (cells.size() != 11) return fail("a row needs 11 cells", where, "Restore the file");
  const std::string_view ligament = ligament_of(cells[0]);
  if (cells[1] != "femur" || cells[5] != "tibia" || ligament.empty()) return std::optional<Row>();
  std::array<double, 8> x{};
  const std::array<std::size_t, 8> at{2, 3, 4, 6, 7, 8, 9, 10};
  for (std::size_t i = 0; i < x.size(); ++i) {
    const auto value = number_in(cells[at[i]]);
    if (!value) return fail("'" + std::string(cells[at[i]]) + "' is not a number", where);
    x[i] = *value;
  }
  Row row{ligament, {}};
  row.fibre.from_F = kMm * in_our_axes({x[0], x[1], x[2]});
  row.fibre.to_T = kMm * in_our_axes({x[3], x[4], x[5]});
  row.fibre.stiffness_n = x[6];
  row.fibre.slack_m = kMm * x[7];
  return std::optional<Row>(row);
}

Result<TriMesh> load_part(const std::filesystem::path& folder, const std::string& name) {
  auto mesh = load_mesh(folder / "knee_cartilage" / (name + ".stl"), 1);
  if (mesh)
    for (Vec3& v : mesh->vertices) v = in_our_axes(v);
  return mesh;
}

void add_fibre(Row row, const TriMesh& tibia, KneeModel& knee) {
  const auto at = std::find(knee.ligaments.begin(), knee.ligaments.end(), row.ligament);
  row.fibre.ligament = static_cast<std::size_t>(at - knee.ligaments.begin());
  if (at == knee.ligaments.end()) knee.ligaments.emplace_back(row.ligament);
  if (row.ligament == "mcl") {
    const TautOver taut = taut_over(tibia, row.fibre.from_F, row.fibre.to_T, Vec3::UnitY());
    row.fibre.to_T = taut.first;
    row.fibre.over_m = taut.rest_m;
  }
  knee.joint.fibres.push_back(row.fibre);
}

Result<void> add_fibres(const std::filesystem::path& file, const TriMesh& tibia, KneeModel& knee) {
  const auto text = read_file(file);
  if (!text) return tl::unexpected(text.error());
  std::size_t number = 0;
  for (std::string_view line : split(*text, '\n')) {
    ++number;
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    if (number == 1 || line.empty()) continue;
    const auto row = read_row(line, file.string() + ", line " + std::to_string(number));
    if (!row) return tl::unexpected(row.error());
    if (*row) add_fibre(**row, tibia, knee);
  }
  return {};
}

/// Thickens the beds of each plateau by the femur's layer, so that its nearest bed just touches.
void add_femoral_layer(const MeshDistance& femur, const CartilageLaw& law,
                       std::vector<JointBed>& beds) {
  for (const double side : {-1.0, 1.0}) {
    double layer = 1e300;
    for (const JointBed& bed : beds)
      if (bed.base_T.y() * side > 0)
        layer =
            std::min(layer, std::abs(femur.closest(bed.base_T).signed_distance) - bed.thickness_m);
    for (JointBed& bed : beds)
      if (bed.base_T.y() * side > 0) {
        const double stack = bed.thickness_m + std::max(0.0, layer);
        bed.stiffness_n_per_m *= (bed.thickness_m + law.other_m) / stack;
        bed.thickness_m = stack;
      }
  }
}

/// Where the whole knee rests at each bend, each found from the one before.
Result<PoseTrack> resting_path(const HeldJoint& whole, double seating_n) {
  constexpr double kStep_rad = 5 * std::numbers::pi / 180;
  PoseTrack track{0, 5, {}};
  JointPose at = joint_pose(whole, {});
  for (int step = 0; step <= 18; ++step) {
    at.flexion_rad = kStep_rad * step;
    const JointLoad seat{-seating_n * along_F(at.flexion_rad), 0, 0};
    const auto rest = settle(whole, seat, at);
    if (!rest) return tl::unexpected(rest.error());
    at = rest->pose;
    track.poses.push_back(pose_of(whole, at));
  }
  return track;
}

void cut(const std::vector<std::string>& without, KneeModel& knee) {
  for (JointFibre& fibre : knee.joint.fibres)
    for (const std::string& name : without)
      if (knee.ligaments[fibre.ligament] == name) fibre.stiffness_n = 0;
}

}  // namespace

Result<KneeModel> load_reference_knee(const std::filesystem::path& folder,
                                      const LigamentTable& table,
                                      const std::vector<std::string>& without) {
  const auto layer = load_part(folder, "tibia_cartilage");
  if (!layer) return tl::unexpected(layer.error());
  const auto tibia = load_part(folder, "tibia_subchondral");
  if (!tibia) return tl::unexpected(tibia.error());
  auto femur = load_part(folder, "femur_subchondral");
  if (!femur) return tl::unexpected(femur.error());
  KneeModel knee;
  if (auto ok = add_fibres(folder / "knee_ligaments.csv", *tibia, knee); !ok)
    return tl::unexpected(ok.error());
  const CartilageLaw law{table.cartilage_young_pa, table.cartilage_poisson, 0.002};
  knee.joint.beds = lay_beds(*layer, MeshDistance(*tibia), law);
  knee.joint.surface_F = std::make_shared<MeshDistance>(std::move(*femur));
  add_femoral_layer(*knee.joint.surface_F, law, knee.joint.beds);
  knee.joint.middle_T = 0.5 * (bounds(*layer).lo + bounds(*layer).hi);
  knee.medial_T = knee.lateral_T = knee.joint.middle_T;
  knee.medial_T.y() = 0.022;
  knee.lateral_T.y() = -0.022;
  knee.seating_n = table.seating_n;
  const auto path = resting_path(knee.joint, table.seating_n);
  if (!path) return tl::unexpected(path.error());
  knee.X_FT = *path;
  knee.joint.surround = {
      table.surround_n_per_m, table.across_n_per_m, table.surround_nm_per_rad, {}};
  cut(without, knee);
  return knee;
}

}  // namespace osteon
