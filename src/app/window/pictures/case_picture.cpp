#include "window/pictures/case_picture.h"

#include <charconv>
#include <chrono>
#include <cstdio>
#include <memory>
#include <string_view>
#include <system_error>
#include <utility>

#include "cases/felt_choice.h"
#include "cases/open_case.h"
#include "osteon/base/file.h"
#include "osteon/base/hash.h"

namespace osteon {
namespace fs = std::filesystem;
namespace {

constexpr int kMostSide_px = 1024;
constexpr std::string_view kKind = "P6 ";

struct PictureStopped {};

Result<std::shared_ptr<const Case>> open_to_draw(const std::string& spec,
                                                 const Progress& progress) {
  try {
    return open_case(
        spec,
        [&progress](const char* what, double share) {
          if (!progress(what, share)) throw PictureStopped{};
        },
        CaseParts::kSeen);
  } catch (const PictureStopped&) {
    return fail("the picture was stopped", spec);
  }
}

// Binary PPM: "P6 WIDTH HEIGHT 255", one byte of space, then the pixels.
std::optional<int> number_after(std::string_view& text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end == text.data() + text.size()) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()) + 1);
  return value;
}

std::optional<Image> parse_ppm(std::string_view text) {
  if (!text.starts_with(kKind)) return std::nullopt;
  text.remove_prefix(kKind.size());
  const auto width = number_after(text), height = number_after(text), most = number_after(text);
  if (!width || !height || most != 255 || *width < 1 || *height < 1 || *width > kMostSide_px ||
      *height > kMostSide_px)
    return std::nullopt;
  if (text.size() != 3u * static_cast<std::size_t>(*width) * static_cast<std::size_t>(*height))
    return std::nullopt;
  return Image{*width, *height, {text.begin(), text.end()}};
}

}  // namespace

Result<Image> draw_case_picture(const std::string& spec, int width, int height,
                                const Progress& progress) {
  const auto data_dir = find_data_dir();
  if (!data_dir) return tl::unexpected(data_dir.error());
  const auto the_case = open_to_draw(spec, progress);
  if (!the_case) return tl::unexpected(the_case.error());
  const auto context = OffscreenContext::create();
  if (!context) return tl::unexpected(context.error());
  auto renderer = Renderer::create(**the_case, Tool{}, *data_dir);
  if (!renderer) return tl::unexpected(renderer.error());
  ViewState view = default_view(**the_case);
  view.camera = close_up_camera(view.camera, **the_case, BoneId{},
                                static_cast<double>(width) / static_cast<double>(height));
  view.camera.distance_m *= 1.5;  // with something about the joint, by which it is known
  view.quality = RenderQuality::kFine;
  view.show_proxy = view.show_force = view.show_hand_ghost = false;
  RenderSnapshot snapshot;
  snapshot.bones = rest_snapshot(**the_case);
  Image image = renderer->draw_image(snapshot, view, width, height);
  if (image.rgb.empty())
    return fail("the graphics driver has no memory for the picture", renderer->device_name());
  return image;
}

fs::path CasePictureStore::file_of(const std::string& spec) const {
  Hasher hash;
  hash.add(std::string_view(spec));
  hash.add(std::string_view(OSTEON_VERSION));  // a built-in case changes with the program
  std::error_code ec;
  const auto written = fs::last_write_time(source_without_choice(spec) + "/case.toml", ec);
  if (!ec) hash.add(static_cast<std::int64_t>(written.time_since_epoch().count()));
  char name[32];
  std::snprintf(name, sizeof name, "%016llx.ppm", static_cast<unsigned long long>(hash.value()));
  return folder_ / name;
}

std::optional<Image> CasePictureStore::find(const std::string& spec) const {
  const auto text = read_file(file_of(spec));
  if (!text) return std::nullopt;
  return parse_ppm(*text);
}

void CasePictureStore::keep(const std::string& spec, const Image& image) const {
  std::error_code ec;
  fs::create_directories(folder_, ec);
  std::string text = std::string(kKind) + std::to_string(image.width) + " " +
                     std::to_string(image.height) + " 255\n";
  text.append(image.rgb.begin(), image.rgb.end());
  (void)write_file_atomic(file_of(spec), text);
}

}  // namespace osteon
