#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <sstream>
#include <string>
#include <vector>

#include "ui/ui_widgets.h"
#include "window/panels/panels.h"

namespace osteon {
namespace {

// Letters and digits, small; all else parts words.
std::string plain(const std::string& text) {
  std::string out;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    out += std::isalnum(byte) != 0 || c == '.' ? static_cast<char>(std::tolower(byte)) : ' ';
  }
  return out;
}

// Every word that is searched for is a part of the name or of what it does: "scalpel 11" finds
// "Scalpel, no. 11 blade".
bool is_found(const TrayItem& item, const std::string& search) {
  const std::string text = plain(item.title + " " + item.size + " " + item.does);
  std::istringstream words(plain(search));
  for (std::string word; words >> word;)
    if (text.find(word) == std::string::npos) return false;
  return true;
}

void draw_picture(const PanelContext& c, const TrayItem& item) {
  const TrayModel& tray = c.model.hands.tray;
  const ImVec2 size{c.px(64), c.px(64)};
  if (tray.sheet == 0 || item.picture < 0) return ImGui::Dummy(size);
  const float w = 1.0f / static_cast<float>(tray.sheet_columns);
  const float h = 1.0f / static_cast<float>(tray.sheet_rows);
  const auto column = static_cast<float>(item.picture % tray.sheet_columns);
  const auto row = static_cast<float>(item.picture / tray.sheet_columns);
  ImGui::Image(reinterpret_cast<ImTextureID>(tray.sheet), size, {column * w, row * h},
               {(column + 1) * w, (row + 1) * h});
}

// An instrument with all its sizes; the one that a click takes comes first.
using TrayRow = std::vector<const TrayItem*>;

std::vector<TrayRow> rows_of(const TrayModel& tray) {
  std::vector<TrayRow> rows;
  for (const TrayItem& item : tray.items) {
    if (!is_found(item, tray.search)) continue;
    const auto row = std::find_if(rows.begin(), rows.end(), [&](const TrayRow& other) {
      return other.front()->title == item.title;
    });
    if (row == rows.end())
      rows.push_back({&item});
    else
      row->push_back(&item);
  }
  return rows;
}

constexpr int kSizesInALine = 6;

// "4.5": the unit stands in the first button's tooltip and in the row's name.
void draw_sizes(const PanelContext& c, TrayRow row) {
  if (row.size() < 2) return;
  std::sort(row.begin(), row.end(),
            [](const TrayItem* a, const TrayItem* b) { return a->place < b->place; });
  for (std::size_t i = 0; i < row.size(); ++i) {
    if (i % kSizesInALine != 0) ImGui::SameLine(0, c.px(3));
    ImGui::PushID(static_cast<int>(row[i]->place));
    const std::string number = row[i]->size.substr(0, row[i]->size.find(' '));
    const bool held = row[i]->place == c.model.hands.tray.held;
    if (held) ImGui::PushStyleColor(ImGuiCol_Button, color::kAccent);
    if (ImGui::Button(number.c_str(), {c.px(34), c.px(20)})) c.requests.hands.take = row[i]->place;
    if (held) ImGui::PopStyleColor();
    ui::tooltip((row[i]->title + ", " + row[i]->size).c_str());
    ImGui::PopID();
  }
}

float height_of(const PanelContext& c, const TrayRow& row) {
  if (row.size() < 2) return c.px(64);
  const auto lines = static_cast<float>((row.size() + kSizesInALine - 1) / kSizesInALine);
  return c.px(46) + lines * (c.px(20) + ImGui::GetStyle().ItemSpacing.y);
}

void draw_row(const PanelContext& c, const TrayRow& row) {
  const std::uint32_t in_hand = c.model.hands.tray.held;
  const auto held = std::find_if(
      row.begin(), row.end(), [in_hand](const TrayItem* item) { return item->place == in_hand; });
  const TrayItem& item = held == row.end() ? *row.front() : **held;
  ImGui::PushID(static_cast<int>(row.front()->place));
  const ImVec2 at = ImGui::GetCursorPos();
  const float height = height_of(c, row);
  if (ImGui::Selectable("##take", held != row.end(), ImGuiSelectableFlags_AllowItemOverlap,
                        {0, height}))
    c.requests.hands.take = item.place;
  ImGui::SetItemAllowOverlap();  // the buttons of sizes lie on it
  ImGui::SetCursorPos(at);
  draw_picture(c, item);
  ImGui::SameLine(0, c.px(12));
  ImGui::BeginGroup();
  const std::string title = item.size.empty() ? item.title : item.title + ", " + item.size;
  ImGui::Dummy({0, c.px(row.size() < 2 ? 6 : 0)});
  ImGui::TextUnformatted(title.c_str());
  ui::text(color::kTextQuiet, held != row.end() ? "in your hand" : item.does.c_str());
  draw_sizes(c, row);
  ImGui::EndGroup();
  ImGui::SetCursorPos({at.x, at.y + height + c.px(4)});
  ImGui::PopID();
}

// Of an exercise, what it has the hand use comes first.
void draw_rows(const PanelContext& c, const std::vector<TrayRow>& rows) {
  const bool any_used =
      std::any_of(rows.begin(), rows.end(), [](const TrayRow& row) { return row.front()->used; });
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const bool used = rows[i].front()->used;
    if (any_used && (i == 0 || used != rows[i - 1].front()->used))
      ui::text(color::kTextQuiet, used ? "For this hand in the exercise" : "All others");
    draw_row(c, rows[i]);
  }
}

}  // namespace

void draw_tray(const PanelContext& c) {
  const UiRect& r = c.layout.picture;
  const float w = std::min(c.px(340), r.w - c.px(16));
  const float h = std::min(c.px(440), r.h - c.px(16));
  ImGui::SetNextWindowPos({r.x + r.w / 2, r.y + r.h / 2}, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::SetNextWindowSize({w, h});
  ImGui::PushStyleColor(ImGuiCol_WindowBg, color::kPanel);
  ImGui::Begin(
      "##tray", nullptr,
      ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings);
  const std::vector<TrayRow> rows = rows_of(c.model.hands.tray);
  constexpr std::size_t kLongest = 64;
  std::array<char, kLongest> search{};
  c.model.hands.tray.search.copy(search.data(), kLongest - 1);
  ImGui::SetNextItemWidth(w - c.px(112));
  // At once: a letter that is meant for it would else be another function's key.
  if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
  if (ImGui::InputTextWithHint("##search", "Search", search.data(), kLongest))
    c.requests.hands.search = search.data();
  const bool typing = ImGui::IsItemActive() || ImGui::IsItemDeactivated();
  const bool entered = typing && ImGui::IsKeyPressed(GLFW_KEY_ENTER, false);
  if (entered && rows.empty()) ImGui::SetKeyboardFocusHere(-1);  // to search for something else
  ImGui::SameLine();
  if (ImGui::Button("Close  (Esc)")) c.requests.hands.toggle_tray = true;
  if (entered && !rows.empty()) c.requests.hands.take = rows.front().front()->place;
  ImGui::BeginChild("items");
  if (rows.empty()) ui::text(color::kTextQuiet, "Nothing in the tray is called that");
  draw_rows(c, rows);
  ImGui::EndChild();
  ImGui::End();
  ImGui::PopStyleColor();
}

}  // namespace osteon
