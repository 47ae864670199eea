#include "commands/support/frames.h"

#include <cstdio>

#include "osteon/base/file.h"

namespace osteon {
namespace {
constexpr int kWidth = 1280;
constexpr int kHeight = 720;
constexpr double kFramesPerSecond = 30;
}  // namespace

FrameWriter::FrameWriter(OffscreenContext context, Renderer renderer, ViewState view,
                         std::filesystem::path folder)
    : context_(std::move(context)),
      renderer_(std::move(renderer)),
      view_(std::move(view)),
      folder_(std::move(folder)) {}

Result<FrameWriter> FrameWriter::create(const Case& the_case, const std::filesystem::path& folder) {
  std::error_code ec;
  std::filesystem::create_directories(folder, ec);
  if (ec) return fail("cannot be made (" + ec.message() + ")", folder.string());
  auto data = find_data_dir();
  if (!data) return tl::unexpected(data.error());
  auto context = OffscreenContext::create();
  if (!context) return tl::unexpected(context.error());
  auto renderer = Renderer::create(the_case, make_wrist_probe(), *data);
  if (!renderer) return tl::unexpected(renderer.error());
  return FrameWriter(std::move(*context), std::move(*renderer), default_view(the_case), folder);
}

void FrameWriter::add(const ToolState& tool, const BoneSnapshot& bones) {
  if (failure_) return;
  if (tool.time_s < static_cast<double>(written_) / kFramesPerSecond) return;
  ++written_;
  char name[32];
  std::snprintf(name, sizeof name, "frame_%06llu.png", static_cast<unsigned long long>(written_));
  const Image image = renderer_.draw_image({bones, tool}, view_, kWidth, kHeight);
  if (auto ok = save_png(image, folder_ / name); !ok) failure_ = ok.error();
}

}  // namespace osteon
