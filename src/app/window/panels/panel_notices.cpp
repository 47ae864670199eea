#include <algorithm>
#include <string>

#include "ui/toast_card.h"
#include "ui/ui_widgets.h"
#include "window/panels/panels.h"

namespace osteon {
namespace {

/// Of the picture, what no card covers.
struct Span {
  float from = 0, to = 0;
  float middle() const { return 0.5f * (from + to); }
};

Span between_cards(const PanelContext& c) {
  const UiRect& picture = c.layout.picture;
  if (!c.model.panels_open) return {picture.x, picture.right()};
  return {c.layout.left.right(), c.layout.right.x};
}

void draw_toasts(const PanelContext& c) {
  const Span free = between_cards(c);
  const float wrap = std::min(c.px(400), free.to - free.from - c.px(116));
  float y = c.layout.picture.y + c.px(16);
  // Below the button that begins an edit, where there is no room beside it.
  const float beside = free.from + c.px(150), widest = wrap + c.px(116);
  if (c.model.edit.can_begin && free.middle() - 0.5f * widest < beside) y += c.px(40);
  for (const Toast& toast : c.model.toasts) {
    bool closed = false;
    y = ui::draw_toast_card(toast, {free.middle(), y, wrap, c.px(1), c.fonts.strong}, closed);
    if (closed) c.requests.dismiss_toast = toast.id;
  }
}

void begin_bottom_note(const PanelContext& c, const char* name) {
  // Over the legend where there is one.
  const bool felt = c.model.view.show_felt, heat = c.model.view.show_heat;
  const float above = c.px(16 + (felt ? 92 : 0) + (heat ? 112 : 0));
  ImGui::SetNextWindowPos({between_cards(c).middle(), c.layout.picture.bottom() - above},
                          ImGuiCond_Always, {0.5f, 1});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {c.px(16), c.px(8)});
  ImGui::Begin(name, nullptr, ui::kNoteFlags);
  ImGui::PopStyleVar();
}

/// Items side by side, on a new line where the space between the cards ends.
class NoteRow {
 public:
  explicit NoteRow(const PanelContext& c) : c_(c) {
    const Span span = between_cards(c);
    most_ = span.to - span.from - 2 * c.px(16 + 8);  // padding of the note, and room beside it
  }

  /// Before an item of that width.
  void place(float width) {
    const float gap = c_.px(16);
    const bool fits = used_ > 0 && used_ + gap + width <= most_;
    if (fits) ImGui::SameLine(0, gap);
    used_ = fits ? used_ + gap + width : width;
  }

  /// A key in a small raised box and what it does, as one item.
  void key(const char* name, const char* what) {
    const ui::WithFont small(c_.fonts.small);
    const ImVec2 name_size = ImGui::CalcTextSize(name);
    const ImVec2 pad{c_.px(5), c_.px(2)};
    const float box_w = name_size.x + 2 * pad.x;
    const float box_h = name_size.y + 2 * pad.y;
    const ImVec2 size{box_w + c_.px(6) + ImGui::CalcTextSize(what).x, box_h};
    place(size.x);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImDrawList* draw = ImGui::GetWindowDrawList();
    draw->AddRectFilled(at, {at.x + box_w, at.y + box_h}, color::kFieldHover, c_.px(3));
    draw->AddText({at.x + pad.x, at.y + pad.y}, color::kText, name);
    draw->AddText({at.x + box_w + c_.px(6), at.y + pad.y}, color::kTextQuiet, what);
    ImGui::Dummy(size);
  }

 private:
  const PanelContext& c_;
  float most_ = 0, used_ = 0;
};

void draw_probe_hint(const PanelContext& c) {
  begin_bottom_note(c, "##probe");
  NoteRow row(c);
  row.key("Mouse", "moves the instrument");
  row.key("Wheel", "deeper, nearer");
  row.key("W A S D Q E", "turn");
  for (const HandRow& hand : c.model.hands.rows)
    if (hand.active && !hand.key_does.empty()) row.key("V", hand.key_does.c_str());
  row.key("M", "release");
  ImGui::End();
}

void draw_first_run_hint(const PanelContext& c) {
  begin_bottom_note(c, "##hint");
  NoteRow row(c);
  row.key("Drag", "look around");
  row.key("Wheel", "zoom");
  row.key("M", "take the instrument");
  row.key("F1", "all keys");
  constexpr const char* kGotIt = "Got it";
  row.place(ImGui::CalcTextSize(kGotIt).x + 2 * ImGui::GetStyle().FramePadding.x);
  if (ImGui::SmallButton(kGotIt)) c.requests.dismiss_hint = true;
  ImGui::End();
}

void draw_name_tag(const PanelContext& c, BoneId bone) {
  if (bone.index >= c.model.bone_labels.size()) return;
  ImGui::SetNextWindowPos({c.model.pointer_x + c.px(14), c.model.pointer_y + c.px(10)});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {c.px(8), c.px(4)});
  ImGui::Begin("##tag", nullptr, ui::kNoteFlags | ImGuiWindowFlags_NoInputs);
  ImGui::PopStyleVar();
  ImGui::TextUnformatted(c.model.bone_labels[bone.index].c_str());
  ImGui::End();
}

void draw_replay_verdict(const PanelContext& c) {
  begin_bottom_note(c, "##verdict");
  ui::text(c.model.replay.identical ? color::kTextQuiet : color::kAmber,
           c.model.replay.verdict.c_str());
  ui::tooltip(
      "Simulates the recording again from its inputs and compares the state of every 100th tick "
      "with the recorded one");
  ImGui::End();
}

}  // namespace

void draw_notices(const PanelContext& c) {
  draw_toasts(c);
  if (c.model.phase != UiPhase::kReady || c.model.help_open) return;
  if (c.model.hand.probe_in_hand)
    draw_probe_hint(c);
  else if (c.model.first_run_hint && c.model.views.layout == PictureLayout::kOutside)
    draw_first_run_hint(c);  // in other layouts it would cover a view that these keys do not move
  else if (c.model.replay.on && c.model.panels_open)
    draw_replay_verdict(c);
  if (!c.model.hand.probe_in_hand) draw_name_tag(c, c.model.hovered);
}

}  // namespace osteon
