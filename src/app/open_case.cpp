#include "open_case.h"

#include <filesystem>
#include <system_error>
#include <utility>

#include "osteon/base/file.h"
#include "osteon/base/hash.h"
#include "osteon/scene/case_io.h"
#include "osteon/scene/piece_cache.h"
#include "piece_work.h"
#include "xdg.h"

namespace osteon {
namespace {

constexpr std::string_view kBuiltin = "builtin:";

std::filesystem::path cached_pieces_file(const std::string& spec) {
  Hasher hasher;
  hasher.add(std::string_view(std::filesystem::absolute(spec).string()));
  return cache_dir() / ("pieces-" + std::to_string(hasher.value()) + ".bin");
}

// Beside the case where that is a folder that has them or can be written.
std::filesystem::path pieces_file(const std::string& spec) {
  if (spec.rfind(kBuiltin, 0) == 0)
    return cache_dir() / ("pieces-" + spec.substr(kBuiltin.size()) + ".bin");
  const std::filesystem::path beside = std::filesystem::path(spec) / "pieces.bin";
  const std::filesystem::path cached = cached_pieces_file(spec);
  std::error_code ec;
  return !std::filesystem::exists(beside, ec) && std::filesystem::exists(cached, ec) ? cached
                                                                                     : beside;
}

Result<CaseDef> grow_builtin(const std::string& name, const std::function<void(double)>& progress) {
  if (name != "wrist")
    return fail("there is no built-in case '" + name + "'", "case", "Use builtin:wrist");
  const auto data = find_data_dir();
  if (!data) return tl::unexpected(data.error());
  GenerateOptions options;
  options.progress = progress;
  auto anatomy = generate_anatomy(*data / "assets/anatomy" / (name + ".toml"), options);
  if (!anatomy) return tl::unexpected(anatomy.error());
  return case_from(std::move(*anatomy));
}

}  // namespace

CaseDef case_from(GeneratedAnatomy anatomy) {
  CaseDef def;
  def.name = std::move(anatomy.name);
  def.side = std::move(anatomy.side);
  for (GeneratedBone& grown : anatomy.bones) {
    BoneDef bone;
    bone.name = std::move(grown.name);
    bone.fma_id = grown.fma_id;
    bone.X_WB = grown.X_WB;
    bone.mesh = std::move(grown.mesh);
    bone.density_kg_per_m3 = grown.density_kg_per_m3;
    def.bones.push_back(std::move(bone));
  }
  for (GeneratedLandmark& landmark : anatomy.landmarks)
    def.landmarks.push_back({std::move(landmark.name), landmark.p_W});
  return def;
}

Result<CaseDef> open_case_def(const std::string& spec,
                              const std::function<void(double)>& progress) {
  if (spec.rfind(kBuiltin, 0) == 0) return grow_builtin(spec.substr(kBuiltin.size()), progress);
  return load_case(spec);
}

Result<std::shared_ptr<const Case>> open_case(const std::string& spec,
                                              const OpenProgress& progress) {
  const auto say = [&](const char* what, double share) {
    if (progress) progress(what, share);
  };
  constexpr double kOpened = 0.2;
  constexpr double kCut = 0.7;
  say("Opening the bones", 0);
  auto def = open_case_def(spec, [&](double share) { say("Growing the bones", kOpened * share); });
  if (!def) return tl::unexpected(def.error());
  PieceCache cache(pieces_file(spec));
  find_pieces(*def, cache, [&](double share) {
    say("Cutting the bones into pieces (once)", kOpened + kCut * share);
  });
  BuildOptions options;
  options.pieces = &cache;
  options.progress = [&](std::size_t i, std::size_t count) {
    const double share = static_cast<double>(i) / static_cast<double>(count);
    say("Building the bones", kOpened + kCut + (1 - kOpened - kCut) * share);
  };
  auto built = build_case(std::move(*def), options);
  if (!built) return tl::unexpected(built.error());
  // A case in a folder that cannot be written has its pieces in the user's cache; without that too
  // they are made anew each time.
  if (!cache.save()) (void)cache.save_as(cached_pieces_file(spec));
  return std::make_shared<const Case>(std::move(*built));
}

}  // namespace osteon
