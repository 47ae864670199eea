#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace osteon {

enum class ToastKind { kInfo, kWarning, kError };

/// A message that appears beside the picture and goes by itself; errors stay until dismissed.
struct Toast {
  std::uint64_t id = 0;
  ToastKind kind = ToastKind::kInfo;
  std::string text;
  double born_s = 0;
};

/// The few messages on show. The same text is not shown twice; at most kMaxToasts stay.
class Toasts {
 public:
  static constexpr std::size_t kMaxToasts = 3;
  void add(ToastKind kind, std::string text, double now_s);
  void dismiss(std::uint64_t id);
  /// Drops what has been read.
  void age(double now_s);
  std::span<const Toast> shown() const { return shown_; }

 private:
  std::vector<Toast> shown_;
  std::uint64_t next_id_ = 1;
};

}  // namespace osteon
