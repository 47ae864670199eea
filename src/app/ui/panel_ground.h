#pragma once

#include <imgui.h>

namespace osteon {

inline constexpr ImGuiWindowFlags kCardPanel =
    ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize |
    ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_AlwaysAutoResize |
    ImGuiWindowFlags_NoBringToFrontOnFocus;
inline constexpr ImGuiWindowFlags kBarPanel =
    ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
    ImGuiWindowFlags_NoBringToFrontOnFocus;

/// ImGui::Begin for the large panels that lie under everything else. Their ground is opaque and of
/// one colour, so it is cleared, not blended: a processor that draws spends most of a panel's time
/// on mixing the ground's pixels with what they hide.
void begin_panel(const char* name, ImGuiWindowFlags flags);

}  // namespace osteon
