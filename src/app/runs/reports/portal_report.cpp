#include "runs/reports/portal_report.h"

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <string_view>

#include "cases/felt_choice.h"
#include "osteon/scene/portal.h"

namespace osteon {
namespace {

constexpr const char* kMakeThem = "Use the report of a run of acl_puncture (--report)";
constexpr const char* kAxes[] = {"in", "up", "middle"};
constexpr double kMostOff_m = 0.05;

nlohmann::ordered_json components(const Vec3& v, double unit, const char* ending) {
  nlohmann::ordered_json json;
  for (int i = 0; i < 3; ++i) json[kAxes[i] + std::string(ending)] = unit * v[i];
  return json;
}

std::optional<Vec3> components_in(const nlohmann::json& json, double unit, const char* ending) {
  if (!json.is_object()) return std::nullopt;
  Vec3 out;
  for (int i = 0; i < 3; ++i) {
    const auto value = json.find(kAxes[i] + std::string(ending));
    if (value == json.end() || !value->is_number()) return std::nullopt;
    out[i] = value->get<double>() / unit;
  }
  return out.allFinite() ? std::optional(out) : std::nullopt;
}

std::optional<MadePortalFound> portal_in(const nlohmann::json& json) {
  if (!json.is_object() || !json.contains("off") || !json.contains("shaft")) return std::nullopt;
  const auto off = components_in(json["off"], 1e3, "_mm");
  const auto shaft = components_in(json["shaft"], 1, "");
  if (!off || !shaft || off->norm() > kMostOff_m) return std::nullopt;
  // Into the body, or it is no way through the skin.
  if (std::abs(shaft->norm() - 1) > 1e-3 || shaft->x() <= 0) return std::nullopt;
  MadePortalFound out;
  out.off_F = *off;
  out.shaft_F = shaft->normalized();
  return out;
}

}  // namespace

nlohmann::ordered_json made_portals_json(std::span<const MadePortalFound> found,
                                         const Case& the_case, const std::string& case_spec) {
  nlohmann::ordered_json json;
  json["patient"] = patient_of(case_spec);
  for (const MadePortalFound& portal : found) {
    auto& entry = json[the_case.landmarks[portal.landmark].name];
    entry["off"] = components(portal.off_F, 1e3, "_mm");
    entry["shaft"] = components(portal.shaft_F, 1, "");
    entry["pierced"] = portal.pierced;
    entry["seen"] = portal.seen;
    entry["from_needle_mm"] = nullptr;
    if (portal.from_needle_m) entry["from_needle_mm"] = 1e3 * *portal.from_needle_m;
  }
  return json;
}

namespace {

// One that was made lies beside its landmark.
Portal as_made(Portal portal, std::span<const MadePortalFound> found, const Case& the_case) {
  for (const MadePortalFound& made : found) {
    const auto frame = portal_frame(the_case, made.landmark);
    if (made.landmark != portal.landmark || !frame) continue;
    const auto in_world = [&](const Vec3& v) {
      return Vec3(v.x() * frame->in_W + v.y() * frame->up_W + v.z() * frame->middle_W);
    };
    portal.p_W = frame->p_W + in_world(made.off_F);
    portal.nhat_W = in_world(made.shaft_F);
  }
  return portal;
}

}  // namespace

nlohmann::ordered_json portals_json(const Case& the_case, std::span<const MadePortalFound> found) {
  auto json = nlohmann::ordered_json::object();
  for (const Portal& of_case : find_portals(the_case)) {
    const Portal portal = as_made(of_case, found, the_case);
    const Vec3 mm = 1e3 * portal.p_W;
    json[portal.name] = {{"p_mm", {mm.x(), mm.y(), mm.z()}},
                         {"inwards", {portal.nhat_W.x(), portal.nhat_W.y(), portal.nhat_W.z()}}};
  }
  return json;
}

void add_portals(std::span<const MadePortalFound> found, const Case& the_case,
                 const std::string& case_spec, nlohmann::ordered_json& report) {
  if (!found.empty()) report["portals"] = made_portals_json(found, the_case, case_spec);
  if (report.contains("acl") && report["acl"].is_object())
    if (auto portals = portals_json(the_case, found); !portals.empty())
      report["acl"]["portals"] = std::move(portals);
}

std::string portals_text(std::span<const MadePortalFound> found, const Case& the_case) {
  std::string text;
  char line[160];
  for (const MadePortalFound& portal : found) {
    std::snprintf(line, sizeof line, "%s: made %.1f mm up, %.1f mm towards the middle\n",
                  the_case.landmarks[portal.landmark].name.c_str(), 1e3 * portal.off_F.y(),
                  1e3 * portal.off_F.z());
    text += line;
  }
  return text;
}

Result<ReportedPortals> read_portals(const std::string& json_text, const std::string& where) {
  const auto json = nlohmann::json::parse(json_text, nullptr, false);
  if (json.is_discarded() || !json.is_object()) return fail("is not a JSON object", where);
  const auto portals = json.find("portals");
  if (portals == json.end() || !portals->is_object())
    return fail("has no portals that were made", where, kMakeThem);
  const auto patient = portals->find("patient");
  if (patient == portals->end() || !patient->is_string())
    return fail("does not say whose portals they are", where, kMakeThem);
  ReportedPortals out{patient->get<std::string>(), {}};
  for (const char* name : {"portal_al", "portal_am"}) {
    const auto entry = portals->find(name);
    const auto portal = entry == portals->end() ? std::nullopt : portal_in(*entry);
    if (!portal)
      return fail("does not say where " + std::string(name) + " was made", where, kMakeThem);
    out.portals.emplace(name, *portal);
  }
  return out;
}

// Words of a built-in patient that name what is wrong with him have an equals sign.
std::string patient_of(const std::string& case_spec) {
  const std::string source = source_without_choice(case_spec);
  if (!source.starts_with("builtin:")) return source;
  std::string out;
  std::istringstream words(source);
  for (std::string word; std::getline(words, word, ':');)
    if (word.find('=') == std::string::npos) out += (out.empty() ? "" : ":") + word;
  return out;
}

}  // namespace osteon
