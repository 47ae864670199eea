#include <algorithm>
#include <cstdio>
#include <string>

#include "segment/segment_panels.h"
#include "ui/panel_ground.h"
#include "ui/ui_widgets.h"

namespace osteon {
namespace {

/// A path typed by hand goes there when Enter is pressed; a file is opened.
void draw_path(const SegmentContext& c, const ScanFolder& folder) {
  char text[1024];
  std::snprintf(text, sizeof text, "%s", folder.path.string().c_str());
  const float up = c.px(56);
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - up - c.px(4));
  if (ImGui::InputText("##path", text, sizeof text, ImGuiInputTextFlags_EnterReturnsTrue))
    c.requests.browse = text;
  ui::tooltip("A folder or file; Enter opens it");
  ImGui::SameLine(0, c.px(4));
  if (ImGui::Button("Up", {up, 0})) c.requests.browse = folder.path.parent_path().string();
  ui::tooltip("The parent folder");
}

void draw_entries(const SegmentContext& c, const ScanFolder& folder, float height) {
  ImGui::BeginChild("##entries", {0, height}, true);
  if (!folder.problem.empty())
    ui::text(color::kAmber, ("This folder cannot be read: " + folder.problem).c_str());
  else if (folder.entries.empty())
    ui::text(color::kTextQuiet, "No folders or single-file scans here");
  for (std::size_t n = 0; n < folder.entries.size(); ++n) {
    const ScanFolder::Entry& entry = folder.entries[n];
    ImGui::PushID(static_cast<int>(n));
    const std::string label = entry.name + (entry.is_folder ? "/" : "") + "###entry";
    if (ImGui::Selectable(label.c_str()))
      (entry.is_folder ? c.requests.browse : c.requests.open_scan) = entry.path.string();
    ImGui::PopID();
  }
  if (folder.more) ui::text(color::kTextQuiet, "... and more; type the path above");
  ImGui::EndChild();
}

std::string scan_of(const ScanFolder& folder) {
  if (folder.pictures > 0) return std::to_string(folder.pictures) + " pictures";
  if (folder.dicom_files > 0) return "DICOM";
  return {};
}

void draw_series(const SegmentContext& c, const ScanChooserModel& chooser) {
  char text[128];
  std::snprintf(text, sizeof text, "%s", chooser.series.c_str());
  ImGui::SetNextItemWidth(c.px(200));
  if (ImGui::InputText("Series", text, sizeof text)) c.requests.series = text;
  ui::tooltip("Number or UID of the series, if the folder holds several; otherwise leave it empty");
}

void draw_spacing(const SegmentContext& c, const ScanChooserModel& chooser) {
  std::array<float, 3> mm{};
  for (int a = 0; a < 3; ++a)
    mm[static_cast<std::size_t>(a)] = static_cast<float>(chooser.spacing_mm[a]);
  ImGui::SetNextItemWidth(c.px(200));
  if (ImGui::InputFloat3("mm between pixels and slices", mm.data(), "%.3f"))
    c.requests.spacing_mm =
        Vec3(static_cast<double>(mm[0]), static_cast<double>(mm[1]), static_cast<double>(mm[2]));
  ui::tooltip("PNG and TIFF files do not store the size of a voxel: across, down, between slices");
}

// The desktop's chooser, where there is one: it knows the user's own places.
void draw_desktop_chooser(const SegmentContext& c, const ScanChooserModel& chooser) {
  if (!chooser.desktop_files) return;
  const float w = c.px(104);
  const float all = w + (chooser.desktop_folders ? w + c.px(4) : 0);
  ImGui::SameLine(ImGui::GetContentRegionAvail().x + c.px(16) - all);
  ImGui::BeginDisabled(chooser.desktop_asks);
  if (ImGui::Button("Choose file ...", {w, 0})) c.requests.desktop_file = true;
  ui::tooltip("In the desktop's own window. Slices of one folder make one scan");
  if (chooser.desktop_folders) {
    ImGui::SameLine(0, c.px(4));
    if (ImGui::Button("Folder ...", {w, 0})) c.requests.desktop_folder = true;
    ui::tooltip("A folder, in the desktop's own window");
  }
  ImGui::EndDisabled();
}

void draw_open(const SegmentContext& c, const ScanChooserModel& chooser, float width) {
  const ScanFolder& folder = chooser.folder;
  const std::string scan = scan_of(folder);
  ImGui::BeginDisabled(scan.empty());
  const std::string label =
      (scan.empty() ? "Open a folder of slices" : "Open this folder: " + scan) + "###open";
  if (ui::accent_button(label.c_str(), {width, 0})) c.requests.open_scan = folder.path.string();
  ImGui::EndDisabled();
  ui::tooltip("All DICOM files, or PNG or TIFF slices, of this folder make one scan");
}

}  // namespace

void draw_scan_chooser(const SegmentContext& c) {
  const ScanChooserModel& chooser = *c.model.chooser;
  const float w = std::min(c.px(620), c.model.width), h = std::min(c.px(520), c.model.height);
  ImGui::SetNextWindowPos({c.model.width / 2, c.model.height / 2}, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::SetNextWindowSize({w, h});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {c.px(16), c.px(16)});
  begin_panel("##chooser", kSideCard);
  ImGui::PopStyleVar();
  {
    const ui::WithFont strong(c.fonts.strong);
    ImGui::TextUnformatted("Choose a scan to segment");
  }
  ui::text(color::kTextQuiet, "A folder of DICOM files, or NRRD, NIfTI, MetaImage or InVesalius");
  draw_path(c, chooser.folder);
  const float rest = 4 * ImGui::GetFrameHeightWithSpacing() + c.px(8);
  draw_entries(c, chooser.folder, std::max(c.px(80), ImGui::GetContentRegionAvail().y - rest));
  if (chooser.folder.pictures > 0)
    draw_spacing(c, chooser);
  else
    draw_series(c, chooser);
  draw_desktop_chooser(c, chooser);
  ImGui::Dummy({0, c.px(2)});
  draw_open(c, chooser, ImGui::GetContentRegionAvail().x);
  if (ImGui::Button(c.model.returns ? "Back to the simulator" : "Close",
                    {ImGui::GetContentRegionAvail().x, 0}))
    c.requests.quit_without_saving = true;
  ImGui::End();
}

}  // namespace osteon
