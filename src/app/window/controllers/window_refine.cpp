// A case that was opened at once: its light and what is felt of it come later.
#include <utility>

#include "osteon/base/clock.h"
#include "window/window_app.h"

namespace osteon {

void WindowApp::begin_refining(const Loaded& loaded) {
  lighting_.reset();
  refining_.reset();
  finer_source_ = loaded.finer_source;
  if (!loaded.lit) lighting_ = std::make_unique<SideJob<PreparedCase>>(light_case(case_));
  if (finer_source_.empty()) return;
  refining_ = std::make_unique<SideJob<FinerCase>>(refine_case(finer_source_));
  note(ToastKind::kInfo,
       "You can touch the bones now. What you feel are their hulls, until the bones have been cut "
       "into pieces: once, a minute or two.");
}

// The case as it was asked for: for what is saved or opened again.
const std::string& WindowApp::wanted_source() const {
  return finer_source_.empty() ? case_source_ : finer_source_;
}

void WindowApp::poll_refining() {
  if (lighting_ && lighting_->done()) {
    Result<PreparedCase> lit = lighting_->take();
    lighting_.reset();
    if (!lit) return note(ToastKind::kWarning, "Light between the bones: " + lit.error().message());
    renderer_->set_surfaces(*lit);
    edit_drawn_ = kEditNotDrawn;
    prepared_ = std::move(*lit);
  }
  if (!refining_ || !refining_->done() || !may_exchange()) return;
  Result<FinerCase> finer = refining_->take();
  refining_.reset();
  if (finer) return exchange(std::move(*finer));
  note(ToastKind::kWarning, "Some bones are still felt as their hulls. " + finer.error().message());
}

// A piece lies within its bone's hull: who touches no hull touches no piece, and feels nothing of
// the exchange.
bool WindowApp::may_exchange() const {
  if (!ready() || replay_ || edit_ || checkup_ || bend_) return false;
  return !live_ || (!live_->recording() && live_->touches_nothing());
}

void WindowApp::exchange(FinerCase finer) {
  if (live_) {
    const auto exchanged = live_->exchange_case(finer.the_case, finer.source, finer.demo);
    if (!exchanged) return note(ToastKind::kError, exchanged.error().message());
  }
  case_ = std::move(finer.the_case);
  case_source_ = std::move(finer.source);
  demo_ = std::move(finer.demo);
  finer_source_.clear();
  renderer_->set_pieces(*case_);
  marks_.clear();
  marks_told_ = 0;
  pieces_after_s_ = 1e-9 * static_cast<double>(steady_now_ns() - created_ns_);
  note(ToastKind::kInfo, "The bones are cut into pieces: what you feel now follows their surface.");
}

double WindowApp::share_refined() const { return refining_ ? refining_->progress().fraction : 1.0; }

}  // namespace osteon
