#include "window/panels/picture_words.h"

#include "ui/label_places.h"
#include "ui/ui_widgets.h"

namespace osteon {
namespace {

constexpr float kWidestNote = 180;  // units
constexpr float kDot = 4;           // of a note, units

/// What of the picture no card covers, from left to right.
struct Free {
  float from = 0, to = 0;
  bool holds(const UiRect& r) const { return r.x >= from && r.right() <= to; }
};

Free free_of_cards(const PanelContext& c) {
  const UiRect& picture = c.layout.picture;
  if (!c.model.panels_open) return {picture.x, picture.right()};
  return {c.layout.left.right(), c.layout.right.x};
}

void drop_what_is_covered(const PanelContext& c, std::vector<PictureWords>& words) {
  const Free free = free_of_cards(c);
  for (PictureWords& each : words)
    if (!free.holds(each.at)) each.text.clear();
}

// Moves them apart, and away from `taken`.
void spread(std::vector<PictureWords>& words, std::vector<UiRect> taken, float gap) {
  std::vector<UiRect> wanted;
  for (const PictureWords& each : words) wanted.push_back(each.at);
  const std::vector<UiRect> places = spread_labels(wanted, gap, std::move(taken));
  for (std::size_t i = 0; i < words.size(); ++i) words[i].at = places[i];
}

}  // namespace

std::vector<PictureWords> note_words(const PanelContext& c) {
  const ui::WithFont small(c.fonts.small);
  std::vector<PictureWords> words;
  for (const NoteRow& row : c.model.notes.rows) {
    if (!row.drawn) continue;
    const std::string text = ui::shortened(row.text, c.px(kWidestNote));
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    UiRect at{row.x + c.px(12), row.y - size.y / 2 - c.px(3), size.x + c.px(12), size.y + c.px(6)};
    if (at.right() > free_of_cards(c).to) at.x = row.x - c.px(12) - at.w;
    words.push_back({text, at});
  }
  spread(words, {}, c.px(2));
  drop_what_is_covered(c, words);
  return words;
}

PictureWords tip_words(const PanelContext& c) {
  const ui::WithFont small(c.fonts.small);
  const TipModel& tip = c.model.hands.tip;
  const std::string text = ui::number(tip.distance_mm, 1) + " mm";
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  return {text, {tip.x1 + c.px(8), tip.y1 + c.px(4), size.x, size.y}};
}

std::vector<PictureWords> name_words(const PanelContext& c) {
  std::vector<UiRect> taken;
  for (const PictureWords& note : note_words(c)) taken.push_back(note.at);
  for (const NoteRow& row : c.model.notes.rows)
    if (row.drawn)
      taken.push_back({row.x - c.px(kDot), row.y - c.px(kDot), c.px(2 * kDot), c.px(2 * kDot)});
  if (c.model.hands.tip.drawn) taken.push_back(tip_words(c).at);
  const ui::WithFont small(c.fonts.small);
  std::vector<PictureWords> words;
  for (const NameTag& tag : c.model.hands.names) {
    const bool known = tag.bone.index < c.model.bone_labels.size();
    const std::string text = known ? c.model.bone_labels[tag.bone.index] : std::string();
    const ImVec2 ink = ImGui::CalcTextSize(text.c_str());
    const ImVec2 size{ink.x + c.px(8), ink.y + c.px(2)};
    words.push_back({text, {tag.x - size.x / 2, tag.y - size.y / 2, size.x, size.y}});
  }
  spread(words, std::move(taken), c.px(2));
  drop_what_is_covered(c, words);
  return words;
}

}  // namespace osteon
