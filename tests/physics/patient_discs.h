#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <set>
#include <sstream>
#include <string>
#include <string_view>

#include "osteon/anatomy/variation.h"
#include "osteon/base/file.h"
#include "osteon/mesh/measure.h"
#include "osteon/physics/disc_setup.h"
#include "osteon/scene/build_case.h"
#include "physics/disc_fixtures.h"

namespace osteon::testing {

/// The text of the built-in wrist with no soft parts but the disc and the cartilage that it lies
/// on: soon grown.
inline std::string wrist_with_its_disc_alone(const std::string& text) {
  const std::set<std::string> kept = {"sigmoid_notch", "ulnar_head_cartilage", "lunate_fossa",
                                      "tfcc_disc"};
  std::string out, entry;
  bool keeps = true;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("[[")) {
      if (keeps) out += entry;
      entry.clear();
      keeps = true;
    }
    if (entry.starts_with("[[soft]]") && line.starts_with("name = "))
      keeps = kept.contains(line.substr(8, line.size() - 9));
    if (!line.starts_with("on = ")) entry += line + '\n';  // where a landmark lies does not matter
  }
  return keeps ? out + entry : out;
}

/// Forearm and disc of a patient as drawn by `seed`; `tear`: Palmer's class, or empty.
inline std::shared_ptr<const Case> patient_with_disc(std::uint64_t seed, const std::string& tear) {
  const std::filesystem::path assets = std::string(OSTEON_SOURCE_DIR) + "/assets/anatomy";
  const auto text = read_file(assets / "wrist.toml", 1 << 22);
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() /
      ("osteon_patient_disc_" + std::to_string(::getpid()) + ".toml");
  if (!text || !write_file_atomic(file, wrist_with_its_disc_alone(*text))) return nullptr;
  VariationRequest request;
  request.seed = seed;
  request.findings_table = assets / "wrist_findings.toml";
  if (!tear.empty()) request.findings.push_back({"tfcc_tear", tear});
  GenerateOptions coarse;
  coarse.cell_m = 0.0012;
  auto grown = generate_varied(file, assets / "wrist_variation.toml", request, coarse);
  std::filesystem::remove(file);
  EXPECT_TRUE(grown) << (grown ? "" : grown.error().message());
  if (!grown) return nullptr;
  CaseDef def;
  def.name = "a forearm";
  for (GeneratedBone& bone : grown->anatomy.bones) {
    if (bone.name != "radius" && bone.name != "ulna") continue;
    BoneDef one;
    one.name = bone.name;
    one.X_WB = bone.X_WB;
    one.mesh = std::move(bone.mesh);
    one.felt = Felt::kHull;
    def.bones.push_back(std::move(one));
  }
  for (GeneratedSoft& soft : grown->anatomy.softs) {
    SoftDef one;
    one.name = soft.name;
    one.tissue = soft.tissue;
    one.kind = soft.kind;
    one.bones = soft.bones;
    one.mesh_W = std::move(soft.mesh_W);
    def.softs.push_back(std::move(one));
  }
  auto built = build_case(std::move(def));
  EXPECT_TRUE(built) << (built ? "" : built.error().message());
  return built ? std::make_shared<const Case>(std::move(*built)) : nullptr;
}

/// It can be felt: one solid where it is whole or torn in its middle, two where it is torn off a
/// bone, the larger of them most of it.
inline void expect_felt_disc(std::uint64_t seed, const std::string& tear) {
  SCOPED_TRACE("seed " + std::to_string(seed) + " " + (tear.empty() ? "whole" : tear));
  const auto the_case = patient_with_disc(seed, tear);
  ASSERT_TRUE(the_case);
  const auto made = make_disc_solids(*the_case, {"tfcc_disc", 370e3, 950e3}, kDiscTable_n_per_m);
  ASSERT_TRUE(made) << made.error().message();
  const bool off = tear == "1B" || tear == "1D";
  ASSERT_EQ(made->size(), off ? 2u : 1u);
  if (!off) return;
  EXPECT_GT(volume(*made->front().surface_B), 4 * volume(*made->back().surface_B));
}

}  // namespace osteon::testing
