#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <utility>
#include <vector>

#include "cases/felt_choice.h"
#include "cases/open_case.h"
#include "osteon/record/recording.h"
#include "osteon/render/anatomical_view.h"
#include "osteon/scene/build_case.h"
#include "osteon/session/session.h"
#include "runs/hands/tray.h"
#include "runs/pictures/xray_cuts.h"
#include "runs/pictures/xray_shot.h"

namespace osteon {
namespace {

bool is_recording(const std::string& source) {
  return std::filesystem::path(source).extension() == ".osr";
}

/// The case as it is seen: what is felt of it does not matter, and takes longest to make.
Result<Case> open_seen_case(const std::string& spec) {
  auto def = open_case_def(spec);
  if (!def) return tl::unexpected(def.error());
  for (BoneDef& bone : def->bones) bone.felt = Felt::kHull;
  return build_case(std::move(*def));
}

Result<XrayScene> scene_of(const Case& the_case, const BoneSnapshot& bones,
                           const CaseBodyOptions& options) {
  const auto tissues = load_default_tissues();
  if (!tissues) return tl::unexpected(tissues.error());
  const auto body = CaseBody::create(the_case, *tissues, options);
  if (!body) return tl::unexpected(body.error());
  const AnatomicalFrame frame = anatomical_frame(the_case);
  XrayScene scene;
  scene.body = body->posed(bones);
  scene.patient = {frame.distal_W, frame.dorsal_W, frame.radial_W};
  const Camera all = preset_camera(ViewPreset::kAp, the_case, 1);
  scene.isocenter_W = close_up_camera(all, the_case, BoneId{}, 1).target_W;
  return scene;
}

Result<std::size_t> ticks_until(const Recording& recording, const SessionSettings& settings,
                                std::optional<double> at_s, const std::string& file) {
  const double end_s = static_cast<double>(recording.ticks.size()) * settings.haptic.tick_s;
  if (recording.ticks.empty()) return fail("holds no ticks", file);
  if (!at_s) return recording.ticks.size();
  if (!(*at_s >= 0 && *at_s <= end_s + 1e-9))
    return fail("has no data at " + std::to_string(*at_s) + " s", file,
                "Choose a time between 0 and " + std::to_string(end_s) + " s");
  const double ticks = std::round(*at_s / settings.haptic.tick_s);
  return std::clamp<std::size_t>(static_cast<std::size_t>(ticks), 1, recording.ticks.size());
}

/// An instrument of steel, and the hand that holds it.
Result<void> add_held(const Tool& held, const Pose& X_WT, XrayScene& scene) {
  auto mesh = xray_surface(held.mesh, "the instrument");
  if (!mesh) return tl::unexpected(mesh.error());
  scene.body.layers.insert(scene.body.layers.begin(),
                           XrayLayer{"instrument", kSteel, {{*mesh, X_WT}}});
  scene.hands_W.push_back(X_WT * hand_on(held));
  return {};
}

Result<XrayScene> scene_of_recording(const XraySceneOrder& order) {
  if (order.flexion_deg)
    return fail("is shown as it was recorded and cannot be bent", order.source,
                "Leave out --flexion, or name a case");
  auto recording = load_recording(order.source);
  if (!recording) return tl::unexpected(recording.error());
  const auto settings = parse_settings(recording->header.settings_json);
  if (!settings) return tl::unexpected(settings.error());
  const auto ticks = ticks_until(*recording, *settings, order.at_s, order.source);
  if (!ticks) return tl::unexpected(ticks.error());
  const auto the_case = open_case(recording->header.case_source);
  if (!the_case) return tl::unexpected(the_case.error());
  const auto tray = tray_of(recording->header);
  if (!tray) return tl::unexpected(tray.error());
  BoneSnapshot bones_then;
  std::vector<ToolState> tools;  // of each hand
  CutScene cut;
  ReplayOptions how;
  how.to_s = static_cast<double>(*ticks) * settings->haptic.tick_s;
  how.at_end = [&](const Session& session) { cut = cut_scene(session); };
  how.tray = *tray;
  auto carving = carving_for(**the_case, *settings);
  if (!carving) return tl::unexpected(carving.error());
  how.carving = std::move(*carving);
  auto softs = softs_for(**the_case, *settings);
  if (!softs) return tl::unexpected(softs.error());
  how.softs = std::move(*softs);
  how.on_tick = [&](std::size_t hand, const ToolState& tool, const BoneSnapshot& bones,
                    std::span<const Event>) {
    if (tool.tick > *ticks) return;
    if (hand >= tools.size()) tools.resize(hand + 1);
    tools[hand] = tool;
    bones_then = bones;
  };
  const auto replayed = replay(*recording, *the_case, how);
  if (!replayed) return tl::unexpected(replayed.error());
  auto scene = scene_of(**the_case, bones_then, order.body);
  if (!scene) return scene;
  auto cuts = XrayCuts::create(order.body);
  if (!cuts) return tl::unexpected(cuts.error());
  cuts->add_to(scene->body, cut, bones_then);
  if (order.body.bones_hu) return scene;
  scene->without_tools = scene->body;
  for (const ToolState& held : tools) {
    const Tool tool = held.instrument < tray->size() ? *(*tray)[held.instrument]
                                                     : make_wrist_probe(settings->probe_radius_m);
    if (auto ok = add_held(tool, held.X_WP, *scene); !ok) return tl::unexpected(ok.error());
  }
  return scene;
}

Result<XrayScene> scene_of_case(const XraySceneOrder& order) {
  if (order.at_s)
    return fail("is a case, which has no times", order.source,
                "Leave out --at, or name a recording (.osr)");
  auto spec = Result<std::string>(order.source);
  if (order.flexion_deg) spec = bent_spec(*spec, "flexion", *order.flexion_deg);
  if (!spec) return tl::unexpected(spec.error());
  const auto the_case = open_seen_case(*spec);
  if (!the_case) return tl::unexpected(the_case.error());
  return scene_of(*the_case, rest_snapshot(*the_case), order.body);
}

}  // namespace

Vec3 hand_on(const Tool& tool) {
  constexpr double kFromEnd_m = 0.05;
  double end_m = 0;
  for (const Vec3& v : tool.mesh.vertices) end_m = std::max(end_m, v.z());
  return std::max(end_m - kFromEnd_m, 0.5 * end_m) * Vec3::UnitZ();
}

Result<XrayScene> open_xray_scene(const XraySceneOrder& order) {
  return is_recording(order.source) ? scene_of_recording(order) : scene_of_case(order);
}

}  // namespace osteon
