#pragma once

#include <imgui.h>

namespace osteon {

/// Colours of the window. Text on panels has at least 4.5:1.
namespace color {
inline constexpr ImU32 kGround = IM_COL32(0x15, 0x18, 0x1c, 0xff);
inline constexpr ImU32 kPanel = IM_COL32(0x1c, 0x20, 0x25, 0xff);
inline constexpr ImU32 kField = IM_COL32(0x28, 0x2d, 0x34, 0xff);
inline constexpr ImU32 kFieldHover = IM_COL32(0x33, 0x3a, 0x43, 0xff);
inline constexpr ImU32 kLine = IM_COL32(0x30, 0x36, 0x3e, 0xff);
inline constexpr ImU32 kText = IM_COL32(0xe8, 0xea, 0xed, 0xff);
inline constexpr ImU32 kTextQuiet = IM_COL32(0x9d, 0xa7, 0xb2, 0xff);
inline constexpr ImU32 kAccent = IM_COL32(0x4f, 0xb8, 0xd8, 0xff);
inline constexpr ImU32 kAccentDim = IM_COL32(0x2b, 0x5f, 0x72, 0xff);
inline constexpr ImU32 kAmber = IM_COL32(0xf2, 0xb1, 0x3f, 0xff);
inline constexpr ImU32 kRed = IM_COL32(0xf2, 0x5f, 0x5a, 0xff);
}  // namespace color

/// The three sizes of the one typeface, and a heavier cut of the middle one.
struct UiFonts {
  ImFont* small = nullptr;
  ImFont* body = nullptr;
  ImFont* strong = nullptr;
  ImFont* large = nullptr;
};

/// Inter where the system has it, else the built-in font; digits are all equally wide. Fills the
/// context's font atlas, for which the backend must make a new texture afterwards.
UiFonts load_fonts(float scale);

/// Colours, roundings and the 8-pixel spacing of the current context.
void apply_theme(float scale);

}  // namespace osteon
