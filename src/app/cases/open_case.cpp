#include "cases/open_case.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>
#include <sstream>
#include <system_error>
#include <utility>

#include "cases/all_cores.h"
#include "cases/beside_case.h"
#include "cases/cache_room.h"
#include "cases/colour_softs.h"
#include "cases/crop_case.h"
#include "cases/felt_choice.h"
#include "cases/make_patient.h"
#include "cases/piece_work.h"
#include "cases/pose_case.h"
#include "cases/xdg.h"
#include "osteon/base/file.h"
#include "osteon/base/hash.h"
#include "osteon/scene/bone_cover.h"
#include "osteon/scene/case_io.h"
#include "osteon/scene/field_cache.h"
#include "osteon/scene/piece_cache.h"

namespace osteon {
namespace {

constexpr std::string_view kBuiltin = "builtin:";

// A cache of a case in the user's own folder. `kind`: "pieces" or "fields".
std::filesystem::path users_cache(const std::string& spec, const std::string& kind) {
  if (spec.rfind(kBuiltin, 0) == 0)
    return cache_dir() / (kind + "-" + spec.substr(kBuiltin.size()) + ".bin");
  Hasher hasher;
  hasher.add(std::string_view(std::filesystem::absolute(spec).string()));
  return cache_dir() / (kind + "-" + std::to_string(hasher.value()) + ".bin");
}

// Beside the case where that is a folder that has one or can be written.
std::filesystem::path cache_file(const std::string& spec, const std::string& kind) {
  const std::filesystem::path users = users_cache(spec, kind);
  if (spec.rfind(kBuiltin, 0) == 0) return users;
  const std::filesystem::path beside = std::filesystem::path(spec) / (kind + ".bin");
  std::error_code ec;
  return !std::filesystem::exists(beside, ec) && std::filesystem::exists(users, ec) ? users
                                                                                    : beside;
}

// A case in a folder that cannot be written has its caches in the user's own; without that too what
// they hold is made anew each time.
template <class Cache>
void keep(Cache& cache, const std::string& spec, const std::string& kind) {
  const std::filesystem::path users = users_cache(spec, kind);
  if (!cache.save()) (void)cache.save_as(users);
  note_use(users);
}

/// "left" or "geissler=2" of "wrist:7:left:geissler=2".
Result<void> read_patient_word(const std::string& word, const std::string& name,
                               PatientOrder& order) {
  const std::size_t equals = word.find('=');
  if (word == "left" || word == "right")
    order.side = word;
  else if (equals != std::string::npos)
    order.findings.push_back({word.substr(0, equals), word.substr(equals + 1)});
  else
    return fail("'" + word + "' is not a side or a finding", "builtin:" + name,
                "Write left, right or FINDING=GRADE, such as builtin:wrist:7:left:geissler=2");
  return {};
}

/// "wrist:7": the patient that seed 7 draws; "wrist:7:left:geissler=2": with that side and finding.
Result<CaseDef> grow_drawn(const std::string& name, std::size_t colon,
                           const std::function<void(double)>& progress, CaseParts parts) {
  PatientOrder order;
  order.anatomy = name.substr(0, colon);
  std::istringstream words(name.substr(colon + 1));
  std::string digits;
  std::getline(words, digits, ':');
  for (std::string word; std::getline(words, word, ':');)
    if (auto ok = read_patient_word(word, name, order); !ok) return tl::unexpected(ok.error());
  std::uint64_t seed = 0;
  const char* const last = digits.data() + digits.size();
  const auto [end, ec] = std::from_chars(digits.data(), last, seed);
  if (ec != std::errc() || end != last || digits.empty())
    return fail("'" + digits + "' is not a seed", "builtin:" + name,
                "Write a whole number, such as builtin:wrist:7");
  order.seed = seed;
  auto grown = grow_patient(order, progress, parts == CaseParts::kAll);
  if (!grown) return tl::unexpected(grown.error());
  CaseDef def = case_from(std::move(grown->anatomy));
  def.recipe = recipe_of(order);
  return def;
}

Result<CaseDef> grow_builtin(const std::string& name, const std::function<void(double)>& progress,
                             CaseParts parts) {
  if (const std::size_t colon = name.find(':'); colon != std::string::npos)
    return grow_drawn(name, colon, progress, parts);
  const auto files = builtin_anatomy(name);
  if (!files) return tl::unexpected(files.error());
  GenerateOptions options;
  options.progress = progress;
  options.run = run_on_all_cores;
  options.soft_parts = parts != CaseParts::kFelt;
  auto anatomy = generate_anatomy(files->description, options);
  if (!anatomy) return tl::unexpected(anatomy.error());
  CaseDef def = case_from(std::move(*anatomy));
  def.recipe = CaseRecipe{name, {}, {}, {}, {}};
  return def;
}

/// The case in a folder. One who wrote "knee" where no such folder is means the built-in knee.
Result<CaseDef> load_folder(const std::string& source) {
  const std::filesystem::path name = std::filesystem::path(source).filename();
  const std::string plain = name.string().substr(0, name.string().find(':'));
  std::error_code ec;
  if ((plain == "wrist" || plain == "knee") && !std::filesystem::exists(source, ec))
    return fail("there is no such folder", source,
                "For the built-in " + plain + " write builtin:" + name.string());
  return load_case(source);
}

bool feels_cartilage(const FeltChoice& choice) {
  return std::any_of(choice.of_bone.begin(), choice.of_bone.end(),
                     [](const auto& bone) { return bone.second == Felt::kCovered; });
}

bool feels_cartilage(const CaseDef& def) {
  return std::any_of(def.bones.begin(), def.bones.end(),
                     [](const BoneDef& bone) { return bone.felt == Felt::kCovered; });
}

/// The case as saved, or grown, with its joints bent as chosen.
Result<CaseDef> open_bent(const FeltChoice& choice, const std::function<void(double)>& progress,
                          CaseParts parts) {
  const std::string& source = choice.source;
  const bool builtin = source.rfind(kBuiltin, 0) == 0;
  // What is about to be bent need not have its soft parts yet.
  const CaseParts first = choice.bent.empty() ? parts : CaseParts::kFelt;
  auto def =
      builtin ? grow_builtin(source.substr(kBuiltin.size()), progress, first) : load_folder(source);
  if (def && feels_cartilage(*def) && parts == CaseParts::kFelt) parts = CaseParts::kAll;
  for (const auto& [joint, degrees] : choice.bent) {
    if (!def) return def;
    def = bend_case(std::move(*def), joint, degrees, parts != CaseParts::kFelt, progress);
  }
  return def;
}

struct Caches {
  explicit Caches(const std::string& source)
      : pieces(cache_file(source, "pieces")), fields(cache_file(source, "fields")) {}
  PieceCache pieces;
  FieldCache fields;
};

Result<std::shared_ptr<const Case>> build(CaseDef def, Caches& caches,
                                          const std::function<void(double)>& progress) {
  BuildOptions options;
  options.pieces = &caches.pieces;
  options.fields = &caches.fields;
  options.progress = [&](std::size_t i, std::size_t count) {
    progress(static_cast<double>(i) / static_cast<double>(count));
  };
  auto built = build_case(std::move(def), options);
  if (!built) return tl::unexpected(built.error());
  return std::make_shared<const Case>(std::move(*built));
}

/// Bones that the caches do not know are felt as hulls; says so in the choice.
bool feel_hulls_of_unknown(CaseDef& def, Caches& caches, FeltChoice& choice) {
  std::vector<std::string> unknown;
  for (BoneDef& bone : def.bones) {
    if (is_known(bone, caches.pieces, caches.fields)) continue;
    bone.felt = Felt::kHull;
    unknown.push_back(bone.name);
  }
  if (unknown.size() == def.bones.size())
    choice.of_bone = {{std::string(), Felt::kHull}};
  else
    for (const std::string& bone : unknown) choice.of_bone[bone] = Felt::kHull;
  return !unknown.empty();
}

}  // namespace

Result<AnatomyFiles> builtin_anatomy(const std::string& name) {
  constexpr std::array<std::string_view, 8> kNames{"wrist",       "knee",          "fast_box",
                                                   "fast_maze",   "fast_meniscus", "fast_ring",
                                                   "fast_suture", "graft_bench"};
  if (std::find(kNames.begin(), kNames.end(), name) == kNames.end())
    return fail("there is no built-in anatomy '" + name + "'", "anatomy",
                "Use wrist, knee, fast_box, fast_maze, fast_meniscus, fast_ring, fast_suture or "
                "graft_bench");
  const auto data = find_data_dir();
  if (!data) return tl::unexpected(data.error());
  const auto folder = *data / "assets/anatomy";
  return AnatomyFiles{folder / (name + ".toml"), folder / (name + "_variation.toml"),
                      folder / (name + "_findings.toml")};
}

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
  for (GeneratedSoft& grown : anatomy.softs) {
    SoftDef soft;
    soft.name = std::move(grown.name);
    soft.fma_id = grown.fma_id;
    soft.tissue = std::move(grown.tissue);
    soft.kind = std::move(grown.kind);
    soft.mesh_W = std::move(grown.mesh_W);
    soft.thickness_m = grown.thickness_m;
    soft.bones = std::move(grown.bones);
    for (GeneratedAttachment& a : grown.attachments)
      soft.attachments.push_back({std::move(a.name), std::move(a.bone), a.p_W});
    def.softs.push_back(std::move(soft));
  }
  for (GeneratedLandmark& landmark : anatomy.landmarks)
    def.landmarks.push_back(
        {std::move(landmark.name), landmark.p_W, landmark.inwards_W, std::move(landmark.bone)});
  for (GeneratedFinding& finding : anatomy.findings)
    def.findings.push_back(
        {std::move(finding.name), std::move(finding.grade), std::move(finding.meaning)});
  for (GeneratedJoint& grown : anatomy.joints) {
    JointDef joint{std::move(grown.name), std::move(grown.fixed), grown.at_deg, {}};
    for (GeneratedJoint::Moved& moved : grown.bones)
      joint.bones.push_back({std::move(moved.bone), std::move(moved.X_FB)});
    def.joints.push_back(std::move(joint));
  }
  return def;
}

Result<CaseDef> open_case_def(const std::string& spec, const std::function<void(double)>& progress,
                              CaseParts parts) {
  const auto choice = parse_felt_choice(spec);
  if (!choice) return tl::unexpected(choice.error());
  if (feels_cartilage(*choice) && parts == CaseParts::kFelt) parts = CaseParts::kAll;
  auto def = open_bent(*choice, progress, parts);
  if (!def) return def;
  colour_softs(*def);
  if (auto laid = lay_beside(choice->beside, *def); !laid) return tl::unexpected(laid.error());
  if (auto applied = apply(*choice, *def); !applied) return tl::unexpected(applied.error());
  if (choice->near_mm > 0)
    if (auto cut = crop_knee(*def, choice->near_mm / 1000); !cut)
      return tl::unexpected(cut.error());
  return def;
}

Result<std::shared_ptr<const Case>> open_case(const std::string& spec, const OpenProgress& progress,
                                              CaseParts parts) {
  const auto say = [&](const char* what, double share) {
    if (progress) progress(what, share);
  };
  constexpr double kOpened = 0.2;
  constexpr double kCut = 0.7;
  say("Opening the bones", 0);
  auto def = open_case_def(
      spec, [&](double share) { say("Generating the bones", kOpened * share); }, parts);
  if (!def) return tl::unexpected(def.error());
  if (parts == CaseParts::kSeen)
    for (BoneDef& bone : def->bones) bone.felt = Felt::kHull;
  cover_bones(*def);
  const std::string source = source_without_choice(spec);
  Caches caches(source);
  if (const auto choice = parse_felt_choice(spec); choice && choice->near_mm > 0)
    prepare_cropped(*def, caches.pieces, caches.fields);
  find_what_is_felt(*def, caches.pieces, caches.fields, [&](double share) {
    say("Cutting the bones into pieces (once)", kOpened + kCut * share);
  });
  auto built = build(std::move(*def), caches, [&](double share) {
    say("Building the bones", kOpened + kCut + (1 - kOpened - kCut) * share);
  });
  if (!built) return tl::unexpected(built.error());
  keep(caches.fields, source, "fields");
  keep(caches.pieces, source, "pieces");
  keep_cache_room(cache_dir(), users_cache(source, "fields"));
  return built;
}

Result<OpenedAtOnce> open_case_at_once(const std::string& spec, const OpenProgress& progress) {
  constexpr double kOpened = 0.8;
  const auto say = [&](const char* what, double share) {
    if (progress) progress(what, share);
  };
  say("Opening the bones", 0);
  auto choice = parse_felt_choice(spec);
  if (!choice) return tl::unexpected(choice.error());
  auto def =
      open_case_def(spec, [&](double share) { say("Generating the bones", kOpened * share); });
  if (!def) return tl::unexpected(def.error());
  cover_bones(*def);
  Caches caches(choice->source);
  OpenedAtOnce out;
  const bool coarse = feel_hulls_of_unknown(*def, caches, *choice);
  out.spec = coarse ? to_text(*choice) : spec;
  if (coarse) out.finer = spec;
  auto built = build(std::move(*def), caches, [&](double share) {
    say("Building the bones", kOpened + (1 - kOpened) * share);
  });
  if (!built) return tl::unexpected(built.error());
  out.the_case = std::move(*built);
  return out;
}

}  // namespace osteon
