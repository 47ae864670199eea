#include "ui/toasts.h"

#include <algorithm>

namespace osteon {
namespace {

double lifetime_s(const Toast& toast) {
  switch (toast.kind) {
    case ToastKind::kInfo:
      return 4.0;
    case ToastKind::kWarning:
      return 10.0;
    case ToastKind::kError:
      break;
  }
  return 1e9;
}

}  // namespace

void Toasts::add(ToastKind kind, std::string text, double now_s) {
  for (Toast& toast : shown_) {
    if (toast.text != text) continue;
    toast.born_s = now_s;
    return;
  }
  if (shown_.size() == kMaxToasts) shown_.erase(shown_.begin());
  shown_.push_back({next_id_++, kind, std::move(text), now_s});
}

void Toasts::dismiss(std::uint64_t id) {
  std::erase_if(shown_, [id](const Toast& toast) { return toast.id == id; });
}

void Toasts::age(double now_s) {
  std::erase_if(shown_, [now_s](const Toast& t) { return now_s - t.born_s > lifetime_s(t); });
}

}  // namespace osteon
