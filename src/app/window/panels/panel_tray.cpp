#include <algorithm>
#include <array>
#include <cctype>
#include <string>

#include "ui/ui_widgets.h"
#include "window/panels/panels.h"

namespace osteon {
namespace {

bool contains(const std::string& text, const char* part) {
  const auto same = [](char a, char b) {
    return std::tolower(static_cast<unsigned char>(a)) ==
           std::tolower(static_cast<unsigned char>(b));
  };
  const std::string wanted = part;
  return std::search(text.begin(), text.end(), wanted.begin(), wanted.end(), same) != text.end();
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

void draw_item(const PanelContext& c, const TrayItem& item) {
  ImGui::PushID(static_cast<int>(item.place));
  const bool held = item.place == c.model.hands.tray.held;
  const ImVec2 at = ImGui::GetCursorPos();
  if (ImGui::Selectable("##take", held, 0, {0, c.px(64)})) c.requests.hands.take = item.place;
  ImGui::SetCursorPos(at);
  draw_picture(c, item);
  ImGui::SameLine(0, c.px(12));
  ImGui::BeginGroup();
  const std::string title = item.size.empty() ? item.title : item.title + ", " + item.size;
  ImGui::Dummy({0, c.px(6)});
  ImGui::TextUnformatted(title.c_str());
  ui::text(color::kTextQuiet, held ? "in your hand" : item.does.c_str());
  ImGui::EndGroup();
  ImGui::SetCursorPos({at.x, at.y + c.px(68)});
  ImGui::PopID();
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
  constexpr std::size_t kLongest = 64;
  std::array<char, kLongest> search{};
  c.model.hands.tray.search.copy(search.data(), kLongest - 1);
  ImGui::SetNextItemWidth(w - c.px(112));
  if (ImGui::InputTextWithHint("##search", "Search", search.data(), kLongest))
    c.requests.hands.search = search.data();
  ImGui::SameLine();
  if (ImGui::Button("Close  (T)")) c.requests.hands.toggle_tray = true;
  ImGui::BeginChild("items");
  for (const TrayItem& item : c.model.hands.tray.items)
    if (contains(item.title, search.data()) || contains(item.does, search.data()))
      draw_item(c, item);
  ImGui::EndChild();
  ImGui::End();
  ImGui::PopStyleColor();
}

}  // namespace osteon
