#include "runs/pictures/scope_lens.h"

#include <cmath>
#include <numbers>
#include <utility>

#include "osteon/procedure/scope_watch.h"
#include "osteon/scene/tool_set.h"

namespace osteon {
namespace {

constexpr double kSight_m = 0.030;  // length of the cone that shows what a scope sees
constexpr int kConeSides = 48;

/// Scope files with the lens of an instrument.
constexpr std::pair<const char*, const char*> kLenses[] = {
    {"arthroscope_0", "knee_0"},
    {"arthroscope_30", "knee_30"},
    {"arthroscope_70", "knee_70"},
    {"wrist_arthroscope_2_7", "wrist_30"},
    {"wrist_arthroscope_1_9", "wrist_30_small"}};

Result<std::optional<ScopeDef>> lens_of(const Instrument& instrument) {
  if (!instrument.optics) return std::optional<ScopeDef>();
  for (const auto& [name, lens] : kLenses)
    if (instrument.name == name) {
      auto scope = load_scope(lens);
      if (!scope) return tl::unexpected(scope.error());
      return std::optional<ScopeDef>(*scope);
    }
  ScopeDef scope;
  scope.name = instrument.name;
  scope.angle_rad = instrument.optics->angle_deg * std::numbers::pi / 180;
  scope.field_rad = instrument.optics->field_deg * std::numbers::pi / 180;
  return std::optional<ScopeDef>(scope);
}

}  // namespace

Result<Lenses> lenses_of(const std::vector<std::string>& tray) {
  if (tray.empty()) return Lenses();
  const auto instruments = load_instruments();
  if (!instruments) return tl::unexpected(instruments.error());
  return lenses_of(tray, *instruments);
}

Result<Lenses> lenses_of(const std::vector<std::string>& tray,
                         std::span<const Instrument> instruments) {
  Lenses lenses(tray.size());
  for (std::size_t k = 0; k < tray.size(); ++k) {
    const auto name = parse_tool_name(tray[k]);
    const Instrument* instrument = name ? find_instrument(instruments, name->name) : nullptr;
    if (!instrument) continue;
    auto lens = lens_of(*instrument);
    if (!lens) return tl::unexpected(lens.error());
    lenses[k] = std::move(*lens);
  }
  return lenses;
}

const ScopeDef* lens_of_tool(const Lenses& lenses, const ToolState& tool) {
  const bool one = tool.instrument < lenses.size() && lenses[tool.instrument].has_value();
  return one && is_finite(tool.X_WP) ? &*lenses[tool.instrument] : nullptr;
}

std::optional<std::size_t> first_looking(const Lenses& lenses, std::span<const ToolState> tools) {
  for (std::size_t h = 0; h < tools.size(); ++h)
    if (lens_of_tool(lenses, tools[h])) return h;
  return std::nullopt;
}

ScopePose scope_pose(const Pose& X_WT) {
  ScopePose pose;
  pose.at_W = X_WT.p;
  pose.toward_W = X_WT * Vec3(0, 0, -0.01);
  pose.up_W = X_WT.rotate(Vec3::UnitY());
  return pose;
}

TriMesh sight_cone(const Pose& X_WT, const ScopeDef& scope) {
  const ScopeView view = view_through({scope.angle_rad, 0.5 * field_in_water_rad(scope)}, X_WT);
  const Vec3 right_W = view.along_W.cross(view.up_W);
  const double radius = kSight_m * std::tan(0.5 * field_in_water_rad(scope));
  TriMesh cone;
  for (int k = 0; k < kConeSides; ++k) {
    const double turn = 2 * std::numbers::pi * k / kConeSides;
    cone.vertices.push_back(view.eye_W + kSight_m * view.along_W +
                            radius * (std::cos(turn) * right_W + std::sin(turn) * view.up_W));
  }
  cone.vertices.push_back(view.eye_W);
  cone.vertices.push_back(view.eye_W + kSight_m * view.along_W);
  for (std::uint32_t k = 0; k < kConeSides; ++k) {
    const std::uint32_t next = (k + 1) % kConeSides;
    cone.triangles.push_back({k, kConeSides, next});
    cone.triangles.push_back({k, next, kConeSides + 1});
  }
  return cone;
}

}  // namespace osteon
