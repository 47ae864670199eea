#pragma once

#include <imgui.h>

#include <cstdint>
#include <string>

#include "ui/ui_theme.h"

namespace osteon::ui {

/// Scope of a font.
class WithFont {
 public:
  explicit WithFont(ImFont* font) { ImGui::PushFont(font); }
  ~WithFont() { ImGui::PopFont(); }
  WithFont(const WithFont&) = delete;
  WithFont& operator=(const WithFont&) = delete;
};

/// Shown when the pointer rests on the item just drawn; wrapped.
void tooltip(const char* text);
void text(ImU32 color, const char* text);
/// In as many lines as the window's width asks for.
void wrapped_text(ImU32 color, const std::string& words);
/// As much of it as fits into `width`, ended by dots where some is left out.
std::string shortened(const std::string& text, float width);
/// The same, drawn; a tooltip tells the whole where some is left out.
void text_within(ImU32 color, const std::string& text, float width);
/// Title of a section that folds; true while open.
bool section(const UiFonts& fonts, const char* title, bool open_at_first = true);
/// One line: quiet label on the left, value with its unit on the right, tooltip on both.
void stat(const char* label, const std::string& value, const char* explanation,
          ImU32 color = color::kText);
/// Button that shows whether its mode is active, by colour and by an outline.
bool toggle_button(const char* label, bool active, ImVec2 size = {0, 0});
/// Button of the one thing to do now.
bool accent_button(const char* label, ImVec2 size = {0, 0});
/// Check box drawn as a switch, label to its left over the card's width.
bool switch_row(const char* label, bool* on, const char* explanation);
/// An eye, open or closed.
bool eye_button(const char* id, bool open, float size);
/// Label above a slider over the card's width; the value with its unit stands at the right.
bool slider(const char* label, double* value, double min, double max, const char* format,
            const char* explanation);
/// Half sphere seen from the viewer, with the light as a dot; drag to move it.
bool light_pad(const char* id, float size, double* azimuth_rad, double* elevation_rad);

/// Colour that stands for a bone in the timeline and the contact list; neighbours differ clearly.
ImU32 bone_color(std::uint32_t bone_index);

std::string number(double value, int decimals);
/// "1:05.2"
std::string clock_time(double seconds, bool tenths = true);

}  // namespace osteon::ui
