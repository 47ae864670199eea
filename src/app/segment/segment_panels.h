#pragma once

#include "segment/segment_model.h"
#include "segment/segment_requests.h"
#include "ui/scene_input.h"
#include "ui/ui_theme.h"

namespace osteon {

/// A card that fills one side of the window.
inline constexpr ImGuiWindowFlags kSideCard =
    ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize |
    ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus;

/// What the parts below share.
struct SegmentContext {
  const SegmentModel& model;
  const UiFonts& fonts;
  const SegmentLayout& layout;
  SegmentRequests& requests;
  float px(float units) const { return units * model.scale; }
};

/// Draws the whole interface of one frame with the current ImGui context and returns what the user
/// asked for. Needs no window.
SegmentRequests draw_segment_ui(const SegmentModel& model, const UiFonts& fonts);

void draw_segment_top(const SegmentContext& c);
void draw_tool_card(const SegmentContext& c);
void draw_bone_card(const SegmentContext& c);
void draw_slice_panes(const SegmentContext& c);
void draw_solid_pane(const SegmentContext& c);
void draw_segment_notes(const SegmentContext& c);  // toasts, the job under way
void draw_close_question(const SegmentContext& c);
void draw_segment_help(const SegmentContext& c);
void draw_segment_loading(const SegmentContext& c);
void draw_scan_chooser(const SegmentContext& c);
void read_segment_keys(const SegmentContext& c);

}  // namespace osteon
