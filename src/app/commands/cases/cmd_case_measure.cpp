#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "commands/support/parser.h"

#include "cases/case_bone.h"
#include "cases/open_case.h"
#include "commands/cases/carved_case.h"
#include "commands/support/cli_support.h"
#include "commands/support/commands.h"
#include "commands/support/number_check.h"
#include "commands/support/text_table.h"
#include "osteon/carve/measure_holes.h"

namespace osteon {
namespace {

using Json = nlohmann::ordered_json;

struct MeasureCommand {
  std::string spec, before;
  std::vector<std::string> regions;
  std::optional<double> at_s;
  double roundness_mm = 0.05;
  bool json = false;
};

/// A ball that is watched: "name=x,y,z,r" in mm, World.
struct MarkedBall {
  std::string name;
  Vec3 center_W = Vec3::Zero();
  double radius_m = 0;
};

Result<MarkedBall> parse_region(const std::string& text) {
  const std::size_t equals = text.find('='), comma = text.rfind(',');
  const auto wrong = [&] {
    return fail("is not a region: '" + text + "'", "--region",
                "Write it as name=x,y,z,r in mm, World: a ball");
  };
  if (equals == std::string::npos || equals == 0 || comma == std::string::npos || comma < equals)
    return wrong();
  const auto center = point_from_mm(text.substr(equals + 1, comma - equals - 1), "--region");
  if (!center) return tl::unexpected(center.error());
  const auto radius = point_from_mm("0,0," + text.substr(comma + 1), "--region");
  if (!radius || !(radius->z() > 0)) return wrong();
  return MarkedBall{text.substr(0, equals), *center, radius->z()};
}

Json mm_json(const Vec3& p) { return Json::array({1000 * p.x(), 1000 * p.y(), 1000 * p.z()}); }

Json hole_json(const Hole& hole, const BoneDef& bone, const CaseDef& def) {
  const Vec3 entry_W = bone.X_WB * hole.entry, exit_W = bone.X_WB * hole.exit;
  Json out;
  out["bone"] = bone.name;
  out["diameter_mm"] = 1000 * hole.diameter_m;
  out["length_mm"] = 1000 * hole.length_m;
  out["entry_mm"] = mm_json(entry_W);
  out["exit_mm"] = mm_json(exit_W);
  const Vec3 axis = bone.X_WB.rotate(hole.axis);
  out["axis"] = Json::array({axis.x(), axis.y(), axis.z()});
  out["through"] = hole.through;
  out["side_openings"] = hole.side_openings;
  if (hole.thinnest_wall_m) {
    out["thinnest_wall_mm"] = 1000 * *hole.thinnest_wall_m;
    out["thinnest_wall_at_mm"] = mm_json(bone.X_WB * hole.thinnest_at);
  } else {
    out["thinnest_wall_mm"] = nullptr;
  }
  out["breach"] = hole.side_openings > 0 || (hole.thinnest_wall_m && *hole.thinnest_wall_m == 0);
  out["roundness_mm"] = 1000 * hole.roundness_m;
  out["landmarks_mm"] = Json::object();
  for (const Landmark& landmark : def.landmarks)
    out["landmarks_mm"][landmark.name] = {{"entry", 1000 * (landmark.p_W - entry_W).norm()},
                                          {"exit", 1000 * (landmark.p_W - exit_W).norm()}};
  return out;
}

bool is_recording(const std::string& spec) {
  return std::filesystem::path(spec).extension() == ".osr";
}

/// A case, or that of a recording as it was left, with what it was before.
struct Measured {
  CaseDef def;
  std::string before;  ///< empty: not known
};

Result<Measured> measured(const MeasureCommand& command) {
  if (is_recording(command.spec)) {
    auto carved = carved_case(command.spec, {}, command.at_s, CaseParts::kFelt);
    if (!carved) return tl::unexpected(carved.error());
    return Measured{std::move(carved->def), command.before.empty() ? carved->spec : command.before};
  }
  if (command.at_s)
    return fail("is for recordings only", "--at", "Give a recording (.osr) in place of a case");
  auto def = open_case_def(command.spec, {}, CaseParts::kFelt);
  if (!def) return tl::unexpected(def.error());
  return Measured{std::move(*def), command.before};
}

Result<Json> regions_json(const MeasureCommand& command, const Measured& of) {
  Json out = Json::array();
  if (command.regions.empty()) return out;
  const CaseDef& after = of.def;
  if (of.before.empty())
    return fail("needs the case before the bone was removed", "--region",
                "Give it with --before CASE");
  const auto before = open_case_def(of.before, {}, CaseParts::kFelt);
  if (!before) return tl::unexpected(before.error());
  for (const std::string& text : command.regions) {
    const auto region = parse_region(text);
    if (!region) return tl::unexpected(region.error());
    for (const BoneDef& bone : after.bones) {
      const auto was = std::find_if(before->bones.begin(), before->bones.end(),
                                    [&](const BoneDef& b) { return b.name == bone.name; });
      if (was == before->bones.end()) continue;
      const Vec3 center_B = bone.X_WB.inverse() * region->center_W;
      const auto share = share_removed(MeshDistance(was->mesh), MeshDistance(bone.mesh), center_B,
                                       region->radius_m);
      if (share)
        out.push_back({{"region", region->name}, {"bone", bone.name}, {"share_removed", *share}});
    }
  }
  return out;
}

void print_table(const Json& holes, const Json& regions) {
  TextTable table({"bone", "diameter mm", "length mm", "through", "thinnest wall mm", "breach"});
  for (const Json& h : holes)
    table.add({h["bone"], fixed(h["diameter_mm"], 3), fixed(h["length_mm"], 2),
               h["through"] ? "yes" : "no",
               h["thinnest_wall_mm"].is_null() ? "-" : fixed(h["thinnest_wall_mm"], 2),
               h["breach"] ? "yes" : "no"});
  if (holes.empty())
    std::puts("no hole");
  else
    std::fputs(table.text().c_str(), stdout);
  for (const Json& r : regions)
    std::printf(
        "region %s of %s: %.1f %% removed\n", r["region"].get_ref<const std::string&>().c_str(),
        r["bone"].get_ref<const std::string&>().c_str(), 100 * r["share_removed"].get<double>());
}

int run_measure(const MeasureCommand& command) {
  const auto of = measured(command);
  if (!of) return report_error(of.error());
  const CaseDef* def = &of->def;
  const auto regions = regions_json(command, *of);
  if (!regions) return report_error(regions.error());
  HoleOptions how;
  how.roundness_m = command.roundness_mm / 1000;
  Json holes = Json::array();
  for (const BoneDef& bone : def->bones)
    for (const Hole& hole : find_holes(bone.mesh, how))
      holes.push_back(hole_json(hole, bone, *def));
  if (!command.json) {
    print_table(holes, *regions);
    return kExitDone;
  }
  Json out;
  out["case"] = def->name;
  out["holes"] = holes;
  out["regions"] = *regions;
  std::printf("%s\n", out.dump(2).c_str());
  return kExitDone;
}

}  // namespace

void add_case_measure_command(cli::App& app, int& exit_code) {
  auto command = std::make_shared<MeasureCommand>();
  cli::App* measure = app.get_subcommand("case")->add_subcommand(
      "measure", "Measure the holes in a case's bones: axis, diameter, length, walls, landmarks");
  measure
      ->add_option("case", command->spec,
                   "a case folder, builtin:wrist or builtin:knee, or a recording (.osr)")
      ->required();
  measure
      ->add_option("--at", command->at_s, "seconds from a recording's start; default: at its end")
      ->check(refuse_negative);
  measure->add_option("--before", command->before,
                      "the case before the bone was removed, for --region");
  measure->add_option("--region", command->regions,
                      "name=x,y,z,r in mm, World: a ball; prints the share of its bone that was "
                      "removed; may be given several times");
  measure
      ->add_option(
          "--roundness", command->roundness_mm,
          "greatest distance of a wall from its cylinder, mm; increase it for a trembling hand")
      ->check(cli::Range(0.001, 1.0))
      ->capture_default_str();
  measure->add_flag("--json", command->json, "print JSON, lengths in mm, World");
  measure->callback([command, &exit_code] { exit_code = run_measure(*command); });
}

}  // namespace osteon
