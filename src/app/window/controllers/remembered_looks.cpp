#include "window/controllers/remembered_looks.h"

#include <algorithm>
#include <utility>

#include "cases/felt_choice.h"

namespace osteon {
namespace {

// Before the names of soft parts, which may be those of bones.
const std::string kSoftLook = "soft:";

}  // namespace

void recall_looks(const AppSettings& settings, const std::string& source, const Case& the_case,
                  ViewState& view) {
  const auto looks = settings.looks.find(source_without_choice(source));
  if (looks == settings.looks.end()) return;
  const auto recall = [&](const std::string& name, BoneAppearance& shown) {
    const auto look = looks->second.find(name);
    if (look == looks->second.end()) return;
    shown.color = look->second.color;
    shown.opacity = look->second.opacity;
    shown.visible = look->second.visible;
  };
  for (std::size_t k = 0; k < the_case.bones.size(); ++k)
    recall(the_case.bones[k].name, view.bones[k]);
  for (std::size_t k = 0; k < the_case.softs.size(); ++k)
    recall(kSoftLook + the_case.softs[k].name, view.softs[k]);
}

void remember_looks(AppSettings& settings, const std::string& source, const Case& the_case,
                    const ViewState& view) {
  if (view.bones.size() != the_case.bones.size()) return;
  const ViewState usual = default_view(the_case);
  std::map<std::string, BoneLook> changed;
  const auto keep = [&](const std::string& name, const BoneAppearance& look,
                        const BoneAppearance& plain) {
    if (!(look == plain)) changed[name] = {look.color, look.opacity, look.visible};
  };
  for (std::size_t k = 0; k < the_case.bones.size(); ++k)
    keep(the_case.bones[k].name, view.bones[k], usual.bones[k]);
  for (std::size_t k = 0; k < std::min(the_case.softs.size(), view.softs.size()); ++k)
    keep(kSoftLook + the_case.softs[k].name, view.softs[k], usual.softs[k]);
  if (changed.empty())
    settings.looks.erase(source_without_choice(source));
  else
    settings.looks[source_without_choice(source)] = std::move(changed);
}

void recall_light(const AppSettings& settings, ViewState& view) {
  view.show_hulls = settings.show_hulls;
  view.show_felt = settings.show_felt;
  view.show_force = settings.show_force;
  view.show_hand_ghost = settings.show_hand_ghost;
  view.light_azimuth_rad = settings.light_azimuth_rad;
  view.light_elevation_rad = settings.light_elevation_rad;
  view.light_brightness = static_cast<float>(settings.light_brightness);
  view.ambient_occlusion = static_cast<float>(settings.ambient_occlusion);
}

void remember_light(AppSettings& settings, const ViewState& view) {
  settings.show_hulls = view.show_hulls;
  settings.show_felt = view.show_felt;
  settings.show_force = view.show_force;
  settings.show_hand_ghost = view.show_hand_ghost;
  settings.light_azimuth_rad = view.light_azimuth_rad;
  settings.light_elevation_rad = view.light_elevation_rad;
  settings.light_brightness = static_cast<double>(view.light_brightness);
  settings.ambient_occlusion = static_cast<double>(view.ambient_occlusion);
}

}  // namespace osteon
