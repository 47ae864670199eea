#include "runs/hands/tray.h"

#include <cstdlib>
#include <filesystem>
#include <sstream>

#include "cases/all_cores.h"
#include "cases/cache_room.h"
#include "cases/xdg.h"
#include "osteon/base/file.h"
#include "osteon/base/hash.h"
#include "osteon/image/tissue.h"
#include "osteon/physics/disc_setup.h"
#include "osteon/physics/soft_setup.h"
#include "osteon/physics/stump_setup.h"
#include "osteon/render/anatomical_view.h"
#include "osteon/scene/field_cache.h"
#include "osteon/scene/instrument.h"
#include "osteon/scene/soft_solid.h"

namespace osteon {
namespace {

constexpr const char* kTodo = "See `osteon instruments`";

Result<Tool> tool_named(std::span<const Instrument> instruments, const std::string& name) {
  const auto colon = name.find(':');
  const Instrument* instrument = find_instrument(instruments, name.substr(0, colon));
  if (!instrument) return fail("there is no such instrument", name, kTodo);
  if (colon == std::string::npos) return make_tool(*instrument, instrument->usual_size);
  const std::string digits = name.substr(colon + 1);
  char* end = nullptr;
  const double size_mm = std::strtod(digits.c_str(), &end);
  const auto size = *end == 0 && !digits.empty() ? find_size(*instrument, size_mm) : std::nullopt;
  if (!size) return fail("the instrument has no such size", name, kTodo);
  return make_tool(*instrument, *size);
}

}  // namespace

Result<Tray> make_tray(std::span<const std::string> names, double probe_radius_m) {
  Tray tray;
  std::vector<Instrument> instruments;
  for (const std::string& name : names) {
    if (name == kWristProbe) {
      tray.push_back(std::make_shared<const Tool>(make_wrist_probe(probe_radius_m)));
      continue;
    }
    if (instruments.empty()) {
      auto loaded = load_instruments();
      if (!loaded) return tl::unexpected(loaded.error());
      instruments = std::move(*loaded);
    }
    auto tool = tool_named(instruments, name);
    if (!tool) return tl::unexpected(tool.error());
    tray.push_back(std::make_shared<const Tool>(std::move(*tool)));
  }
  return tray;
}

Result<Tray> tray_of(const RecordingHeader& header) {
  const auto settings = parse_settings(header.settings_json);
  if (!settings) return tl::unexpected(settings.error());
  return make_tray(settings->tray, settings->probe_radius_m);
}

Result<std::shared_ptr<const CarvingSetup>> carving_for(const Case& the_case,
                                                        const SessionSettings& settings) {
  const RunFieldTasks run = [](std::size_t count, const std::function<void(std::size_t)>& task) {
    run_on_all_cores(count, task, [](double) {});
  };
  return make_carving(the_case, settings.tray, settings.carve, run);
}

Result<std::shared_ptr<const CarvingSetup>> carving_for_run(const Case& the_case,
                                                            std::span<const std::string> tray,
                                                            const CarveSettings& carve) {
  SessionSettings settings;
  settings.tray.assign(tray.begin(), tray.end());
  settings.carve = carve;
  settings.carve.on = can_carve(the_case, tray);
  return carving_for(the_case, settings);
}

namespace {

Result<const Tissue*> tissue_named(const TissueTable& tissues, const std::string& name) {
  if (const Tissue* tissue = tissues.find(name)) return tissue;
  return fail("the tissue table has no '" + name + "'", "assets/materials/tissue.toml");
}

// Places in the tray of what has an edge and does not bite.
Result<std::vector<std::uint32_t>> blades_in(std::span<const std::string> tray) {
  std::vector<std::uint32_t> out;
  if (tray.empty()) return out;
  const auto instruments = load_instruments();
  if (!instruments) return tl::unexpected(instruments.error());
  for (std::size_t i = 0; i < tray.size(); ++i) {
    const Instrument* found = find_instrument(*instruments, tray[i].substr(0, tray[i].find(':')));
    if (found && found->can(InstrumentFunction::kCut) && !found->can(InstrumentFunction::kRemove))
      out.push_back(static_cast<std::uint32_t>(i));
  }
  return out;
}

FrictionRatios ratios_of(const Tissue& tissue) {
  return {tissue.static_friction.value, tissue.dynamic_friction.value};
}

// Of a case with a radius what is felt of a wrist, of others the knee's.
Result<LigamentTable> table_for(const Case& the_case) {
  const auto data = find_data_dir();
  if (!data) return tl::unexpected(data.error());
  if (the_case.find("radius").valid())
    return load_felt_table(*data / "assets/tissue/wrist_ligaments.toml");
  return load_ligament_table(*data / "assets/tissue/knee_ligaments.toml");
}

// What is soft in a session, by the kinds that its names mean.
struct SoftNames {
  std::vector<std::string> ligaments, menisci, skin;
  bool stumps = false, disc = false;
};

SoftNames sorted_names(const Case& the_case, std::span<const std::string> names) {
  SoftNames out;
  for (const std::string& name : names) {
    if (names_skin(name))
      out.skin.push_back(name);
    else if (names_stumps(name))
      out.stumps = true;
    else if (names_disc(the_case, name))
      out.disc = true;
    else if (names_solids(the_case, name))
      out.menisci.push_back(name);
    else
      out.ligaments.push_back(name);
  }
  return out;
}

Result<void> add_ligaments(const Case& the_case, std::span<const std::string> names,
                           const TissueTable& tissues, std::span<const std::string> tray,
                           SoftSetup& setup) {
  if (names.empty()) return {};
  const auto table = table_for(the_case);
  if (!table) return tl::unexpected(table.error());
  const auto ligament = tissue_named(tissues, "ligament");
  if (!ligament) return tl::unexpected(ligament.error());
  auto made = make_soft_setup(the_case, *table, names, (*ligament)->stiffness_n_per_m.value);
  if (!made) return tl::unexpected(made.error());
  setup = std::move(*made);
  auto blades = blades_in(tray);
  if (!blades) return tl::unexpected(blades.error());
  add_blades(setup, std::move(*blades), (*ligament)->cutting_n.value);
  auto biters = make_solid_cutters(tray);
  if (!biters) return tl::unexpected(biters.error());
  setup.biters = std::move(*biters);
  setup.friction.band = ratios_of(**ligament);
  return {};
}

void append_solids(std::vector<SoftSolid>&& from, std::vector<SoftSolid>& out) {
  for (SoftSolid& solid : from) out.push_back(std::move(solid));
}

// Fields of soft parts that were made before, in the user's cache.
std::filesystem::path soft_fields_file(const Case& the_case) {
  Hasher hasher;
  hasher.add(the_case.hash);
  for (const SoftPart& part : the_case.softs) {
    hasher.add(std::string_view(part.name));
    hasher.add(static_cast<std::uint64_t>(part.mesh_W.vertices.size()));
  }
  return cache_dir() / ("fields-soft-" + std::to_string(hasher.value()) + ".bin");
}

// They are made again where they cannot be kept.
void keep_soft_fields(FieldCache& fields, const std::filesystem::path& file) {
  if (!fields.save()) return;
  note_use(file);
  keep_cache_room(cache_dir(), file);
}

// Menisci, the disc of a wrist and what torn ligaments have left: solids of one list.
Result<std::vector<SoftSolid>> solids_named(const Case& the_case, const SoftNames& names,
                                            const TissueTable& tissues, const Tissue& meniscus,
                                            FieldCache& known) {
  std::vector<SoftSolid> out;
  if (!names.menisci.empty()) {
    auto made = make_soft_solids(the_case, names.menisci, meniscus.stiffness_n_per_m.value, &known);
    if (!made) return made;
    append_solids(std::move(*made), out);
  }
  if (names.disc) {
    const auto table = table_for(the_case);
    if (!table) return tl::unexpected(table.error());
    auto made = make_disc_solids(the_case, table->disc, meniscus.stiffness_n_per_m.value, &known);
    if (!made) return made;
    append_solids(std::move(*made), out);
  }
  if (names.stumps) {
    const auto ligament = tissue_named(tissues, "ligament");
    if (!ligament) return tl::unexpected(ligament.error());
    auto made = make_stumps(
        the_case, {(*ligament)->stiffness_n_per_m.value, (*ligament)->cutting_n.value}, &known);
    if (!made) return made;
    append_solids(std::move(*made), out);
  }
  if (out.size() > kMaxSolids)
    return fail("more than " + std::to_string(kMaxSolids) + " menisci, pieces of a disc and stumps",
                "--soft", "Give fewer");
  return out;
}

Result<void> add_solids_named(const Case& the_case, const SoftNames& names,
                              const TissueTable& tissues, std::span<const std::string> tray,
                              SoftSetup& setup) {
  if (names.menisci.empty() && !names.stumps && !names.disc) return {};
  const auto meniscus = tissue_named(tissues, "meniscus");
  if (!meniscus) return tl::unexpected(meniscus.error());
  const std::filesystem::path file = soft_fields_file(the_case);
  FieldCache known(file);
  auto solids = solids_named(the_case, names, tissues, **meniscus, known);
  if (!solids) return tl::unexpected(solids.error());
  keep_soft_fields(known, file);
  add_solids(setup, std::move(*solids));
  auto cutters = make_solid_cutters(tray);
  if (!cutters) return tl::unexpected(cutters.error());
  add_cutters(setup, std::move(*cutters), (*meniscus)->cutting_n.value);
  setup.friction.solid = ratios_of(**meniscus);
  return {};
}

Result<void> add_skin(const Case& the_case, std::span<const std::string> names,
                      const TissueTable& tissues, std::span<const std::string> tray,
                      bool along_bones, SoftSetup& setup) {
  if (names.empty()) return {};
  const auto skin = tissue_named(tissues, "skin");
  if (!skin) return tl::unexpected(skin.error());
  auto made = make_skin_patches(the_case, names, {anatomical_frame(the_case).distal_W, along_bones},
                                {(*skin)->stiffness_n_per_m.value, (*skin)->cutting_n.value});
  if (!made) return tl::unexpected(made.error());
  auto tools = make_skin_tools(tray);
  if (!tools) return tl::unexpected(tools.error());
  add_skins(setup, std::move(*made), std::move(*tools));
  setup.friction.skin = ratios_of(**skin);
  return {};
}

// `along_bones`: so patches of skin lie that are no portal's; false: as they lay once.
Result<SoftSetup> softs_as(const Case& the_case, const SessionSettings& settings,
                           bool along_bones) {
  const auto tissues = load_default_tissues();
  if (!tissues) return tl::unexpected(tissues.error());
  const SoftNames names = sorted_names(the_case, settings.soft);
  SoftSetup setup;
  if (auto done = add_ligaments(the_case, names.ligaments, *tissues, settings.tray, setup); !done)
    return tl::unexpected(done.error());
  if (auto done = add_solids_named(the_case, names, *tissues, settings.tray, setup); !done)
    return tl::unexpected(done.error());
  if (auto done = add_skin(the_case, names.skin, *tissues, settings.tray, along_bones, setup);
      !done)
    return tl::unexpected(done.error());
  auto grippers = make_soft_grippers(settings.tray);
  if (!grippers) return tl::unexpected(grippers.error());
  add_grippers(setup, std::move(*grippers));
  add_friction(setup, SoftFriction(setup.friction));
  // A recording from before a soft part could do something is replayed as then: what came later is
  // added, in the order in which it came, until the hash is the recording's.
  const auto lacks_something = [&] {
    return settings.soft_hash == 0 || settings.soft_hash != setup.hash;
  };
  if (lacks_something()) {
    auto pieces = make_pieces(the_case, settings.tray);
    if (!pieces) return tl::unexpected(pieces.error());
    add_pieces(setup, std::make_shared<const PiecesSetup>(std::move(*pieces)));
  }
  for (auto* let :
       {let_pieces_meet_softs, let_bands_part_by_strands, let_bridges_tear, let_wounds_be_held_open,
        let_pieces_be_stopped, let_hooks_tear_and_punches_bite, let_thin_parts_stop_pieces,
        let_presses_be_bounded, let_clearers_part_bands, let_suction_heed_thin_parts,
        let_covered_parts_wait, let_clearing_go_by_strides})
    if (lacks_something()) let(setup);
  return setup;
}

}  // namespace

Result<std::shared_ptr<const SoftSetup>> softs_for(const Case& the_case,
                                                   const SessionSettings& settings) {
  if (settings.soft.empty()) return std::shared_ptr<const SoftSetup>();
  auto setup = softs_as(the_case, settings, true);
  if (setup && settings.soft_hash != 0 && settings.soft_hash != setup->hash)
    setup = softs_as(the_case, settings, false);
  if (!setup) return tl::unexpected(setup.error());
  if (settings.soft_hash != 0 && settings.soft_hash != setup->hash)
    return fail("the soft parts of the case are not those of the recording", "recording",
                "Replay it with the version of Osteon that made it");
  return std::make_shared<const SoftSetup>(std::move(*setup));
}

std::vector<std::string> softs_named(const std::string& text) {
  std::vector<std::string> names;
  std::istringstream parts(text);
  for (std::string name; std::getline(parts, name, ',');) names.push_back(name);
  return names;
}

Result<void> take_instruments(const RecordingHeader& header, const Case& the_case,
                              ReplayOptions& options) {
  const auto settings = parse_settings(header.settings_json);
  if (!settings) return tl::unexpected(settings.error());
  auto tray = make_tray(settings->tray, settings->probe_radius_m);
  if (!tray) return tl::unexpected(tray.error());
  auto carving = carving_for(the_case, *settings);
  if (!carving) return tl::unexpected(carving.error());
  auto softs = softs_for(the_case, *settings);
  if (!softs) return tl::unexpected(softs.error());
  options.tray = std::move(*tray);
  options.softs = std::move(*softs);
  options.carving = std::move(*carving);
  return {};
}

std::string absolute_case_path(const std::string& case_source) {
  if (case_source.empty() || case_source.rfind("builtin:", 0) == 0) return {};
  std::error_code error;
  const auto path = std::filesystem::absolute(case_source.substr(0, case_source.find('#')), error);
  return error ? std::string() : path.lexically_normal().string();
}

}  // namespace osteon
