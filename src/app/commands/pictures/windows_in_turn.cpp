#include "commands/pictures/windows_in_turn.h"

#include <cstdio>
#include <utility>

#include "commands/support/cli_support.h"
#include "loops/stop_signal.h"

namespace osteon {
namespace {

void print_stats(const WindowApp& app) {
  const FrameStats& stats = app.frame_stats();
  std::printf("%zu pictures, each: mean %.2f ms, p50 %.2f ms, p99 %.2f ms; processor %.2f ms%s\n",
              stats.count(), stats.mean_ms(), stats.quantile_ms(0.5), stats.quantile_ms(0.99),
              app.processor_ms_per_picture(), app.software_driver() ? " (no graphics card)" : "");
  std::printf("first picture of the bones after %.2f s", app.first_picture_s());
  if (app.pieces_after_s() > 0)
    std::printf(", felt as hulls; cut into pieces after %.2f s", app.pieces_after_s());
  std::printf("\n");
}

void print_stats(const SegmentApp& app) {
  const FrameStats& stats = app.frame_stats();
  std::printf("%zu pictures, each: mean %.2f ms, p50 %.2f ms, p99 %.2f ms\n", stats.count(),
              stats.mean_ms(), stats.quantile_ms(0.5), stats.quantile_ms(0.99));
}

/// Where the user goes after this window.
class Turns {
 public:
  Result<std::optional<WindowTurn>> run(const WindowOrder& order) {
    auto app = WindowApp::create(order);
    if (!app) return tl::unexpected(app.error());
    if (auto ended = (*app)->run(); !ended) return tl::unexpected(ended.error());
    if (order.frames > 0) print_stats(**app);
    if (!(*app)->wants_segmentation()) return std::optional<WindowTurn>();
    before_ = WindowOrder();
    before_.case_spec = (*app)->case_source();
    before_.width = order.width;
    before_.height = order.height;
    before_.interface_scale = order.interface_scale;
    SegmentOrder next;
    next.width = order.width;
    next.height = order.height;
    next.interface_scale = order.interface_scale;
    next.scan.source = (*app)->scan_to_segment();
    next.returns = true;
    return std::optional<WindowTurn>(next);
  }

  Result<std::optional<WindowTurn>> run(const SegmentOrder& order) {
    auto app = SegmentApp::create(order);
    if (!app) return tl::unexpected(app.error());
    if (auto ended = (*app)->run(); !ended) return tl::unexpected(ended.error());
    if (order.frames > 0) print_stats(**app);
    if (!order.returns) before_.case_spec.clear();
    return turn_after_segmentation((*app)->case_to_open(), before_);
  }

 private:
  WindowOrder before_;  ///< of the simulator's window that ended last
};

}  // namespace

std::optional<WindowTurn> turn_after_segmentation(const std::filesystem::path& saved_case,
                                                  const WindowOrder& before) {
  WindowOrder next = before;
  if (!saved_case.empty()) next.case_spec = saved_case.string();
  if (next.case_spec.empty()) return std::nullopt;
  return WindowTurn(std::move(next));
}

int run_windows(WindowTurn turn) {
  const StopSignals signals;
  Turns turns;
  for (;;) {
    auto next = std::visit([&](const auto& order) { return turns.run(order); }, turn);
    if (!next) return report_error(next.error());
    if (stop_signal()) return 128 + stop_signal();
    if (!*next) return kExitDone;
    turn = std::move(**next);
  }
}

}  // namespace osteon
