#include "osteon/physics/carving_setup.h"

#include <algorithm>
#include <string>

#include "osteon/base/file.h"
#include "osteon/base/turn.h"
#include "osteon/physics/carving.h"
#include "osteon/physics/joint_fluid.h"
#include "osteon/physics/pieces_setup.h"
#include "osteon/scene/instrument.h"
#include "osteon/scene/tool_set.h"

namespace osteon {
namespace {

using Way = CarvingTool::Way;

// An awl's three edges are long and steep: with a turn they take so much more than a drill's. Own
// default.
constexpr double kFeedByHand = 10;

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

void shift_back(Cutter& cutter, double back_m) {
  for (CutterPart& part : cutter.parts) {
    for (RoundRod& rod : part.rods) {
      rod.p0.z() += back_m;
      rod.p1.z() += back_m;
    }
    for (TurnedFace& face : part.faces) face.offset += back_m * face.n_z;
    for (Plane& plane : part.planes) plane.d += back_m * plane.n.z();
    part.box.lo.z() += back_m;
    part.box.hi.z() += back_m;
  }
}

// A burr and what scrapes cut with a ball, or with the half of one.
void find_ball(CarvingTool& tool) {
  const CutterPart& part = tool.cutter.parts.front();
  if (part.rods.empty()) return;
  tool.middle_T = part.rods.front().p0;
  tool.one_sided = !part.planes.empty();
}

Result<CarvingTool> tool_of(const RemovalDef& removal, const Instrument& instrument,
                            double size_m) {
  auto cutter = make_cutter(removal.cutter, size_m);
  if (!cutter) return tl::unexpected(cutter.error());
  CarvingTool tool;
  tool.way = removal.way;
  tool.cutter = std::move(*cutter);
  tool.pilot_m = removal.pilot_m;
  tool.grip = removal.grip;
  const bool turned = !tool.cutter.parts.front().faces.empty();
  const bool ball = !tool.cutter.parts.front().rods.empty();
  const bool drills = tool.way == Way::kDrill || tool.way == Way::kTwist;
  const bool burrs = tool.way == Way::kBurr || tool.way == Way::kScrape;
  if ((drills && !turned) || (burrs && !ball))
    return fail("its cutter '" + removal.cutter + "' does not fit the way '" +
                    std::string(to_text(tool.way)) + "'",
                instrument.name);
  if (instrument.power && instrument.power->unit == "rpm")
    tool.most_rev_per_s = instrument.power->most / 60;
  if (instrument.power && instrument.power->unit == "W") tool.most_w = instrument.power->most;
  tool.reams = drills && removal.cutter == "reamer";
  tool.stays = tool.way == Way::kDrill && instrument.can(InstrumentFunction::kGuide);
  tool.length_m = instrument.shaft.to.at(size_m).z();
  if (tool.way == Way::kDrill) shorten(tool.cutter);
  shift_back(tool.cutter, removal.back_plus_m + removal.back_per_size * size_m);
  if (burrs) find_ball(tool);
  tool.soft_only = removal.cutter == "shaver";
  return tool;
}

// The instrument that a name of the tray stands for, if it removes bone.
const Instrument* remover(std::span<const Instrument> instruments, const std::string& tray_name) {
  const Instrument* found = find_instrument(instruments, tray_name.substr(0, tray_name.find(':')));
  return found && found->removal ? found : nullptr;
}

// The aimer that a name of the tray stands for.
std::optional<AimingTool> aimer_of(std::span<const Instrument> instruments,
                                   const std::string& tray_name) {
  const Instrument* found = find_instrument(instruments, tray_name.substr(0, tray_name.find(':')));
  if (!found || !found->aims) return std::nullopt;
  const Vec3 out = found->aims->mouth_m - found->aims->at_m;
  return AimingTool{
      {found->aims->at_m, turn_between(Vec3::UnitZ(), out)}, found->aims->bore_m, out.norm()};
}

Result<double> size_of(const Instrument& instrument, const std::string& tray_name) {
  const auto named = parse_tool_name(tray_name);
  if (!named) return tl::unexpected(named.error());
  const auto size = named->size_mm ? find_size(instrument, *named->size_mm)
                                   : std::optional<std::size_t>(instrument.usual_size);
  if (!size) return fail("the instrument has no such size", tray_name);
  return instrument.sizes_m[*size];
}

Result<void> add_tools(std::span<const std::string> tray, CarvingSetup& setup) {
  const auto instruments = load_instruments();
  if (!instruments) return tl::unexpected(instruments.error());
  for (const std::string& name : tray) {
    setup.tray.emplace_back();
    setup.aimers.push_back(aimer_of(*instruments, name));
    const Instrument* instrument = remover(*instruments, name);
    if (!instrument) continue;
    const auto size_m = size_of(*instrument, name);
    if (!size_m) return tl::unexpected(size_m.error());
    auto tool = tool_of(*instrument->removal, *instrument, *size_m);
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

std::vector<CarvedLayer> layers_on(const Case& the_case, const Bone& bone) {
  std::vector<CarvedLayer> layers;
  if (!bone.covered) return layers;
  const Pose X_BW = bone.X_WB.inverse();
  for (std::uint32_t s = 0; s < the_case.softs.size(); ++s) {
    const SoftPart& soft = the_case.softs[s];
    if (soft.kind != "cartilage" || soft.bones.size() != 1 ||
        &the_case.bones[soft.bones.front().index] != &bone)
      continue;
    CarvedLayer& layer = layers.emplace_back(CarvedLayer{s, {}, bone.X_WB});
    for (const Vec3& v : soft.mesh_W.vertices) layer.box_B.include(X_BW * v);
  }
  return layers;
}

}  // namespace

bool can_carve(const Case& the_case, std::span<const std::string> tray) {
  const bool has_field =
      std::any_of(the_case.bones.begin(), the_case.bones.end(),
                  [](const Bone& bone) { return is_field(bone.felt) && !bone.beside; });
  if (!has_field || tray.empty()) return false;
  const auto instruments = load_instruments();
  return instruments && std::any_of(tray.begin(), tray.end(), [&](const std::string& name) {
           return remover(*instruments, name) != nullptr;
         });
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
  setup->by_hand = setup->table;
  setup->by_hand.usual_feed_m_per_rev *= kFeedByHand;
  setup->by_hand.largest_feed_m_per_rev *= kFeedByHand;
  setup->thrust_scale = settings.thrust_scale;
  setup->guided_n = settings.guided_n;
  setup->irrigation_m3_s = settings.irrigation_ml_per_min * kM3_s_per_ml_min;
  if (auto added = add_tools(tray, *setup); !added) return tl::unexpected(added.error());
  for (const Bone& bone : the_case.bones) {
    setup->bones.emplace_back();
    setup->layers_on.push_back(layers_on(the_case, bone));
    if (!is_field(bone.felt) || bone.beside) continue;
    UncutFieldOptions options;
    options.cell_m = cell_for(bone, settings.cell_m);
    options.run = run;
    options.room_m = setup->air_m + 3 * options.cell_m;
    auto field = bone.covered ? UncutField::make(*bone.covered, options)
                              : UncutField::make(bone.mesh, options);
    if (!field) {
      Error error = field.error();
      error.where = "carving " + bone.name;
      return tl::unexpected(error);
    }
    setup->bones.back() = std::move(*field);
  }
  auto pieces = make_pieces(the_case, tray);
  if (!pieces) return tl::unexpected(pieces.error());
  setup->pieces = std::make_shared<const PiecesSetup>(std::move(*pieces));
  return std::shared_ptr<const CarvingSetup>(std::move(setup));
}

}  // namespace osteon
