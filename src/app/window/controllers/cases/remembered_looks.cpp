#include "window/controllers/cases/remembered_looks.h"

#include <algorithm>
#include <type_traits>
#include <utility>

#include "cases/felt_choice.h"

namespace osteon {
namespace {

// Before the names of soft parts, which may be those of bones.
const std::string kSoftLook = "soft:";

// What is kept of light and marks, beside what is shown: one list for both directions.
template <class Settings, class View, class Copy>
void each_light(Settings& kept, View& shown, Copy copy) {
  copy(kept.show_hulls, shown.show_hulls);
  copy(kept.show_felt, shown.show_felt);
  copy(kept.show_heat, shown.show_heat);
  copy(kept.show_force, shown.show_force);
  copy(kept.show_hand_ghost, shown.show_hand_ghost);
  copy(kept.light_azimuth_rad, shown.light_azimuth_rad);
  copy(kept.light_elevation_rad, shown.light_elevation_rad);
  copy(kept.light_brightness, shown.light_brightness);
  copy(kept.ambient_occlusion, shown.ambient_occlusion);
}

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
  each_light(settings, view, [](const auto& kept, auto& shown) {
    shown = static_cast<std::decay_t<decltype(shown)>>(kept);
  });
}

void remember_light(AppSettings& settings, const ViewState& view) {
  each_light(settings, view, [](auto& kept, const auto& shown) {
    kept = static_cast<std::decay_t<decltype(kept)>>(shown);
  });
}

}  // namespace osteon
