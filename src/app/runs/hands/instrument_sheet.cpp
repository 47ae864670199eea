#include "runs/hands/instrument_sheet.h"

#include <algorithm>
#include <cmath>

#include "osteon/base/file.h"
#include "osteon/mesh/measure.h"

namespace osteon {
namespace {

constexpr double kCell_m = 0.1;
constexpr double kTip_m = 0.022;  // of the working end, shown large beside the whole

// The triangles that lie within a distance of the tip.
TriMesh tip_of(const TriMesh& mesh) {
  TriMesh tip;
  tip.vertices = mesh.vertices;
  for (const Triangle& t : mesh.triangles)
    if (std::all_of(t.begin(), t.end(),
                    [&](std::uint32_t v) { return mesh.vertices[v].z() < kTip_m; }))
      tip.triangles.push_back(t);
  return tip;
}

// Turned a little about its own axis, scaled so that it fills `width` by `height`, and put at a
// middle of the sheet, which lies in the x-z plane.
void put(const TriMesh& mesh, const Vec3& middle, double width, double height, TriMesh& sheet) {
  const Quat turn(Eigen::AngleAxisd(0.9, Vec3::UnitZ()));
  TriMesh turned = mesh;
  Aabb box;
  for (Vec3& p : turned.vertices) p = turn * p;
  for (const Triangle& t : turned.triangles)
    for (const std::uint32_t v : t) box.include(turned.vertices[v]);
  if (box.empty()) return;
  const Vec3 size = box.extent().cwiseMax(Vec3::Constant(1e-6));
  const double scale = std::min(width / size.x(), height / size.z());
  const auto first = static_cast<std::uint32_t>(sheet.vertices.size());
  for (const Vec3& p : turned.vertices)
    sheet.vertices.push_back(middle + scale * (p - box.center()));
  for (const Triangle& t : turned.triangles)
    sheet.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
}

Case sheet_case(const std::vector<SheetItem>& items, int columns) {
  Case out;
  out.name = "instruments";
  for (std::size_t i = 0; i < items.size(); ++i) {
    const auto column = static_cast<double>(i % static_cast<std::size_t>(columns));
    const auto row = static_cast<double>(i / static_cast<std::size_t>(columns));
    const Vec3 middle(kCell_m * column, 0, -kCell_m * row);
    const TriMesh& mesh = items[i].mesh;
    Bone bone;
    bone.name = items[i].name;
    put(mesh, middle - Vec3(0.022, 0, 0), 0.038, 0.086, bone.mesh);
    put(tip_of(mesh), middle + Vec3(0.022, 0, 0), 0.036, 0.07, bone.mesh);
    out.bones.push_back(std::move(bone));
  }
  return out;
}

// `aspect`: width of the picture over its height.
ViewState sheet_view(const Case& the_case, std::size_t count, int columns, double aspect) {
  ViewState view = default_view(the_case);
  const auto rows = static_cast<double>((count + static_cast<std::size_t>(columns) - 1) /
                                        static_cast<std::size_t>(columns));
  view.camera.target_W = Vec3(kCell_m * (columns - 1) / 2, 0, -kCell_m * (rows - 1) / 2);
  view.camera.q_WC = look_rotation(-Vec3::UnitY(), Vec3::UnitZ());
  view.camera.orthographic = true;
  const double shown_rows = std::max(rows, columns / aspect);
  view.camera.distance_m =
      0.5 * kCell_m * shown_rows / std::tan(0.5 * view.camera.vertical_fov_rad);
  view.bones.assign(count, BoneAppearance{{0.72f, 0.75f, 0.79f}, 1, true, false});
  view.show_proxy = view.show_force = view.show_hand_ghost = false;
  view.ambient_occlusion = 0.6f;
  view.quality = RenderQuality::kFine;
  return view;
}

}  // namespace

std::vector<SheetItem> sheet_items(const std::vector<Instrument>& instruments) {
  std::vector<SheetItem> items;
  for (const Instrument& instrument : instruments)
    items.push_back({instrument.name, instrument_mesh(instrument, instrument.usual_size, 1.0)});
  return items;
}

Result<Image> instrument_sheet(const std::vector<SheetItem>& items, int columns, int width,
                               int height) {
  if (items.empty() || items.size() > kMaxBones)
    return fail("a sheet holds 1 to " + std::to_string(kMaxBones) + " instruments", "the sheet",
                "Name the instruments to draw");
  const auto data_dir = find_data_dir();
  if (!data_dir) return tl::unexpected(data_dir.error());
  const auto context = OffscreenContext::create();
  if (!context) return tl::unexpected(context.error());
  const Case the_case = sheet_case(items, columns);
  auto renderer = Renderer::create(the_case, Tool{}, *data_dir);
  if (!renderer) return tl::unexpected(renderer.error());
  RenderSnapshot snapshot;
  snapshot.bones = rest_snapshot(the_case);
  const ViewState view =
      sheet_view(the_case, items.size(), columns, static_cast<double>(width) / height);
  Image image = renderer->draw_image(snapshot, view, width, height);
  if (image.rgb.empty())
    return fail("the graphics driver has no memory for the picture", renderer->device_name(),
                "Choose a smaller --size");
  return image;
}

}  // namespace osteon
