#include "commands/shapes/skin_picture.h"

#include <algorithm>

#include "osteon/base/file.h"
#include "osteon/render/renderer.h"

namespace osteon {
namespace {

SoftPart part_of(const TriMesh& mesh, std::size_t from, std::size_t to, std::string name,
                 const std::array<float, 3>& color) {
  SoftPart out;
  out.name = std::move(name);
  out.kind = "fat";  // drawn as it is, not seen through
  out.color_srgb = color;
  out.mesh_W.vertices = mesh.vertices;
  out.mesh_W.triangles.assign(mesh.triangles.begin() + static_cast<std::ptrdiff_t>(from),
                              mesh.triangles.begin() + static_cast<std::ptrdiff_t>(to));
  return out;
}

Camera camera_over(const SkinDrawing& drawing, double aspect) {
  const Vec3 &z = drawing.out_of_skin, &y = drawing.up, x = y.cross(z);
  const bool alone = drawing.around.triangles.empty();
  const double room = alone ? 1.3 : 2.2;  // with a limb around it, some of that
  Camera camera;
  camera.q_WC = look_rotation(0.15 * x - 0.75 * y + z, y);
  Vec3 lo = Vec3::Constant(1e300), hi = -lo;  // along x, y and z
  for (const Vec3& p : drawing.surface.vertices) {
    const Vec3 q(p.dot(x), p.dot(y), p.dot(z));
    lo = lo.cwiseMin(q);
    hi = hi.cwiseMax(q);
  }
  const Vec3 middle = 0.5 * (lo + hi), size = hi - lo;
  camera.target_W = middle.x() * x + middle.y() * y + middle.z() * z;
  camera.distance_m = 1;
  const double half = room * 0.5 * std::max(0.85 * size.y(), size.x() / aspect);
  camera.distance_m = half / camera.half_height_m();
  return camera;
}

}  // namespace

Result<void> draw_skin(const SkinDrawing& drawing, const std::filesystem::path& file) {
  constexpr int kWidth = 1200, kHeight = 800;
  constexpr std::array<float, 3> kSkin{0.86f, 0.66f, 0.56f}, kGroove{0.72f, 0.25f, 0.20f};
  const auto data_dir = find_data_dir();
  if (!data_dir) return tl::unexpected(data_dir.error());
  const auto context = OffscreenContext::create();
  if (!context) return tl::unexpected(context.error());
  const TriMesh& mesh = drawing.surface;
  Case scene;
  scene.softs.push_back(part_of(mesh, 0, drawing.triangles, "skin", kSkin));
  if (drawing.triangles < mesh.triangles.size())
    scene.softs.push_back(
        part_of(mesh, drawing.triangles, mesh.triangles.size(), "groove", kGroove));
  // One part with the skin around it, so that no border shows.
  TriMesh& skin = scene.softs.front().mesh_W;
  const auto more = static_cast<std::uint32_t>(skin.vertices.size());
  skin.vertices.insert(skin.vertices.end(), drawing.around.vertices.begin(),
                       drawing.around.vertices.end());
  for (const Triangle& t : drawing.around.triangles)
    skin.triangles.push_back({t[0] + more, t[1] + more, t[2] + more});
  auto renderer = Renderer::create(scene, Tool{}, *data_dir, prepare_case(scene));
  if (!renderer) return tl::unexpected(renderer.error());
  ViewState view = default_view(scene);
  view.camera = camera_over(drawing, double(kWidth) / kHeight);
  view.quality = RenderQuality::kFine;
  view.show_proxy = view.show_force = view.show_hand_ghost = false;
  for (BoneAppearance& look : view.softs) {
    look.visible = true;
    look.opacity = 1;
  }
  return save_png(renderer->draw_image({}, view, kWidth, kHeight), file);
}

}  // namespace osteon
