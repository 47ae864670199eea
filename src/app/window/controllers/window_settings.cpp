#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <string>

#include "cases/felt_choice.h"
#include "cases/xdg.h"
#include "osteon/base/log.h"
#include "window/window_app.h"

namespace osteon {
namespace {

// Before the names of soft parts, which may be those of bones.
const std::string kSoftLook = "soft:";

}  // namespace

void WindowApp::recall_view() {
  view_ = default_view(*case_);
  view_.camera = preset_camera(ViewPreset::kDorsal, *case_, viewport().aspect(), covered_edges());
  recall_looks();
  view_.show_hulls = settings_.show_hulls;
  view_.show_felt = settings_.show_felt || order_.felt;
  view_.show_force = settings_.show_force;
  view_.show_hand_ghost = settings_.show_hand_ghost;
  view_.light_azimuth_rad = settings_.light_azimuth_rad;
  view_.light_elevation_rad = settings_.light_elevation_rad;
  view_.light_brightness = static_cast<float>(settings_.light_brightness);
  view_.ambient_occlusion = static_cast<float>(settings_.ambient_occlusion);
  if (order_.softs)
    for (BoneAppearance& look : view_.softs) look.visible = true;
  if (order_.close_up)
    view_.camera = close_up_camera(view_.camera, *case_, {}, viewport().aspect(), covered_edges());
  control_ = CameraControl(anatomical_frame(*case_).distal_W);
  shown_ = {rest_snapshot(*case_), {}};
  hovered_ = picked_ = hovered_row_ = {};
}

void WindowApp::recall_looks() {
  const auto looks = settings_.looks.find(source_without_choice(case_source_));
  if (looks == settings_.looks.end()) return;
  const auto recall = [&](const std::string& name, BoneAppearance& shown) {
    const auto look = looks->second.find(name);
    if (look == looks->second.end()) return;
    shown.color = look->second.color;
    shown.opacity = look->second.opacity;
    shown.visible = look->second.visible;
  };
  for (std::size_t k = 0; k < case_->bones.size(); ++k)
    recall(case_->bones[k].name, view_.bones[k]);
  for (std::size_t k = 0; k < case_->softs.size(); ++k)
    recall(kSoftLook + case_->softs[k].name, view_.softs[k]);
}

// Only what the user changed, so that better defaults reach the rest.
void WindowApp::remember_looks() {
  if (!case_ || view_.bones.size() != case_->bones.size()) return;
  const ViewState usual = default_view(*case_);
  std::map<std::string, BoneLook> changed;
  const auto keep = [&](const std::string& name, const BoneAppearance& look,
                        const BoneAppearance& plain) {
    if (!(look == plain)) changed[name] = {look.color, look.opacity, look.visible};
  };
  for (std::size_t k = 0; k < case_->bones.size(); ++k)
    keep(case_->bones[k].name, view_.bones[k], usual.bones[k]);
  for (std::size_t k = 0; k < std::min(case_->softs.size(), view_.softs.size()); ++k)
    keep(kSoftLook + case_->softs[k].name, view_.softs[k], usual.softs[k]);
  if (changed.empty())
    settings_.looks.erase(source_without_choice(case_source_));
  else
    settings_.looks[source_without_choice(case_source_)] = std::move(changed);
}

void WindowApp::remember_view() {
  if (!renderer_) return;
  settings_.show_hulls = view_.show_hulls;
  settings_.show_felt = view_.show_felt;
  settings_.show_force = view_.show_force;
  settings_.show_hand_ghost = view_.show_hand_ghost;
  settings_.light_azimuth_rad = view_.light_azimuth_rad;
  settings_.light_elevation_rad = view_.light_elevation_rad;
  settings_.light_brightness = static_cast<double>(view_.light_brightness);
  settings_.ambient_occlusion = static_cast<double>(view_.ambient_occlusion);
}

void WindowApp::remember() {
  if (!glfwGetWindowMonitor(window_->handle()))
    glfwGetWindowSize(window_->handle(), &settings_.window_width, &settings_.window_height);
  remember_view();
  remember_looks();
  remember_feel();
  const Result<void> saved = save_app_settings(settings_, config_dir() / "settings.json");
  if (!saved) log(LogLevel::kWarning, saved.error().message());
}

void WindowApp::remember_feel() {
  if (!live_) return;
  settings_.stiffness_n_per_m = live_->feel().stiffness_n_per_m;
  settings_.friction_scale = live_->feel().friction_scale;
  settings_.bones_held = live_->feel().bones_held;
}

}  // namespace osteon
