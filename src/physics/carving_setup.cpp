#include "osteon/physics/carving_setup.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "osteon/base/file.h"
#include "osteon/physics/carving.h"
#include "osteon/scene/instrument.h"
#include "osteon/scene/tool_set.h"

namespace osteon {
namespace {

using Way = CarvingTool::Way;

// What an instrument cuts with.
struct Kind {
  std::string_view instrument, cutter;
  Way way;
  double pilot_m = 0;  // of a cannula
};
constexpr std::array kKinds{
    Kind{"drill", "drill", Way::kDrill},
    Kind{"cannulated_drill", "reamer", Way::kDrill, 0.0024},
    Kind{"reamer", "reamer", Way::kDrill, 0.003},
    Kind{"microdrill", "burr", Way::kBurr},
    Kind{"kerrison_punch", "kerrison", Way::kBite},
};

const Kind* kind_of(std::string_view tray_name) {
  const std::string_view name = tray_name.substr(0, tray_name.find(':'));
  const auto found = std::find_if(kKinds.begin(), kKinds.end(),
                                  [&](const Kind& kind) { return kind.instrument == name; });
  return found == kKinds.end() ? nullptr : &*found;
}

// Long enough that every place of the hole has once been as deep in the cutter as the wall is far,
// and no longer: a front no higher than 0.6 diameters, and a diameter of full width behind it.
void shorten(Cutter& cutter) {
  CutterPart& part = cutter.parts.front();
  constexpr double kMore_m = 0.0005;
  const double length = 0.6 * cutter.size_m + cutter.size_m + kMore_m;
  for (TurnedFace& face : part.faces)
    if (face.n_rho == 0 && face.n_z > 0) face.offset = length;
  part.box.hi.z() = length;
}

Result<CarvingTool> tool_of(const Kind& kind, const std::string& tray_name,
                            std::span<const Instrument> instruments) {
  const auto named = parse_tool_name(tray_name);
  if (!named) return tl::unexpected(named.error());
  const Instrument* instrument = find_instrument(instruments, named->name);
  if (!instrument) return fail("there is no such instrument", tray_name);
  const auto size = named->size_mm ? find_size(*instrument, *named->size_mm)
                                   : std::optional<std::size_t>(instrument->usual_size);
  if (!size) return fail("the instrument has no such size", tray_name);
  auto cutter = make_cutter(kind.cutter, instrument->sizes_m[*size]);
  if (!cutter) return tl::unexpected(cutter.error());
  CarvingTool tool{kind.way, std::move(*cutter), 0, kind.pilot_m};
  if (instrument->power && instrument->power->unit == "rpm")
    tool.most_rev_per_s = instrument->power->most / 60;
  if (kind.way == Way::kDrill) shorten(tool.cutter);
  return tool;
}

Result<void> add_tools(std::span<const std::string> tray, CarvingSetup& setup) {
  const auto instruments = load_instruments();
  if (!instruments) return tl::unexpected(instruments.error());
  for (const std::string& name : tray) {
    setup.tray.emplace_back();
    const Kind* kind = kind_of(name);
    if (!kind) continue;
    auto tool = tool_of(*kind, name, *instruments);
    if (!tool) return tl::unexpected(tool.error());
    constexpr double kRoom_m = 0.001;
    setup.air_m = std::max(setup.air_m, 0.5 * tool->cutter.size_m + kRoom_m);
    setup.tray.back() = std::move(*tool);
  }
  return {};
}

double cell_for(const Bone& bone, double cell_m) {
  constexpr double kLong_m = 0.2;
  Aabb box;
  for (const Vec3& v : bone.mesh.vertices) box.include(v);
  return box.extent().maxCoeff() > kLong_m ? 2 * cell_m : cell_m;
}

}  // namespace

bool removes_bone(const std::string& tray_name) { return kind_of(tray_name) != nullptr; }

bool can_carve(const Case& the_case, std::span<const std::string> tray) {
  return std::any_of(tray.begin(), tray.end(), removes_bone) &&
         std::any_of(the_case.bones.begin(), the_case.bones.end(),
                     [](const Bone& bone) { return bone.felt == Felt::kField; });
}

Result<std::shared_ptr<const CarvingSetup>> make_carving(const Case& the_case,
                                                         std::span<const std::string> tray,
                                                         const CarveSettings& settings,
                                                         const RunFieldTasks& run) {
  if (!settings.on) return std::shared_ptr<const CarvingSetup>();
  auto setup = std::make_shared<CarvingSetup>();
  auto layers = bone_layers(settings.cortex_m, settings.marrow_m);
  if (!layers) return tl::unexpected(layers.error());
  const auto data = find_data_dir();
  if (!data) return tl::unexpected(data.error());
  auto table = load_drill_table(*data / "assets/materials/drilling.toml");
  if (!table) return tl::unexpected(table.error());
  setup->layers = std::move(*layers);
  setup->table = std::move(*table);
  setup->thrust_scale = settings.thrust_scale;
  if (auto added = add_tools(tray, *setup); !added) return tl::unexpected(added.error());
  for (const Bone& bone : the_case.bones) {
    setup->bones.emplace_back();
    if (bone.felt != Felt::kField) continue;
    UncutFieldOptions options;
    options.cell_m = cell_for(bone, settings.cell_m);
    options.run = run;
    options.room_m = setup->air_m + 3 * options.cell_m;
    auto field = UncutField::make(bone.mesh, options);
    if (!field) {
      Error error = field.error();
      error.where = "carving " + bone.name;
      return tl::unexpected(error);
    }
    setup->bones.back() = std::move(*field);
  }
  return std::shared_ptr<const CarvingSetup>(std::move(setup));
}

}  // namespace osteon
