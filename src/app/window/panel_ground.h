#pragma once

#include <imgui.h>

namespace osteon {

/// ImGui::Begin for the large panels that lie under everything else. Their ground is opaque and of
/// one colour, so it is cleared, not blended: a processor that draws spends most of a panel's time
/// on mixing the ground's pixels with what they hide.
void begin_panel(const char* name, ImGuiWindowFlags flags);

}  // namespace osteon
