#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/base/types.h"

namespace osteon {

/// Pages of text, tables and curves in portrait A4; a line that does not fit begins a new page.
/// Latin letters; others come out as '?'.
class PdfPages {
 public:
  PdfPages();
  ~PdfPages();
  PdfPages(PdfPages&&) noexcept;

  void heading(const std::string& text);
  void line(const std::string& text);
  /// Cells at even distances; longer ones are cut.
  void row(const std::vector<std::string>& cells, bool bold = false);
  /// A curve over x with its axes' ends written beside it, `height_mm` high. Marks are vertical
  /// lines at their x.
  struct Curve {
    std::string title, x_unit, y_unit;
    std::vector<double> x, y;
    std::vector<double> marks;
    std::vector<double> beside_x, beside_y;  ///< another curve to compare with, drawn in orange
    bool from_zero = true;                   ///< y begins at 0; else at the least value
    bool equal_scales = false;               ///< x and y in one scale: a way seen from above
  };
  void curve(const Curve& curve, double height_mm);
  /// A picture, 8-bit RGB, top row first, in its own shape; nothing where the bytes do not fit it.
  void picture(const std::string& title, const std::vector<std::uint8_t>& rgb, int width,
               int height, double wide_mm);
  /// A bar to each value, from the least number on, with its interval over it.
  struct Bar {
    std::string label;
    double value = 0, lo = 0, hi = 0;
  };
  struct Bars {
    std::string title;
    std::vector<Bar> bars;
    double line = 0;  ///< where a line crosses them all
  };
  void bars(const Bars& bars);
  /// In one step, see write_file_atomic.
  Result<void> save(const std::filesystem::path& file);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace osteon
