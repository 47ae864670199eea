#include "segment/slice_picture.h"

#include <algorithm>
#include <cmath>

namespace osteon {
namespace {

constexpr Rgba kBeyond = 0xff0f0c0b;   // outside the scan
constexpr Rgba kPreview = 0xffd8b84f;  // the accent, #4fb8d8
constexpr double kPreviewFill = 0.45;
constexpr double kChosenMore = 0.15;
constexpr double kOutline = 0.95;

Rgba grey(double value) {
  const auto g = static_cast<Rgba>(value);
  return 0xff000000u | g << 16 | g << 8 | g;
}

Rgba mixed(Rgba under, Rgba over, double share) {
  const auto part = static_cast<Rgba>(std::lround(256 * std::clamp(share, 0.0, 1.0)));
  Rgba out = 0xff000000u;
  for (const unsigned shift : {0u, 8u, 16u}) {
    const Rgba a = under >> shift & 0xffu, b = over >> shift & 0xffu;
    out |= (a * (256 - part) + b * part) >> 8 << shift;
  }
  return out;
}

/// For each pixel along one direction of the pane: the voxel it lies in, and the two it lies
/// between.
struct PaneAxis {
  struct At {
    bool inside;
    std::size_t nearest, low, high;  ///< places in memory along this axis
    float share;                     ///< of `high`
  };
  std::vector<At> at;
};

PaneAxis pane_axis(int pixels, double first, double step, int size, std::size_t stride) {
  PaneAxis axis;
  axis.at.reserve(static_cast<std::size_t>(pixels));
  for (int p = 0; p < pixels; ++p) {
    const double v = first + step * p;
    const double nearest = std::floor(v + 0.5);
    PaneAxis::At at{nearest >= 0 && nearest < size, 0, 0, 0, 0};
    if (at.inside) {
      const double clamped = std::clamp(v, 0.0, static_cast<double>(size - 1));
      const auto low = static_cast<std::size_t>(clamped);
      const std::size_t high = std::min(low + 1, static_cast<std::size_t>(size - 1));
      at.nearest = stride * static_cast<std::size_t>(nearest);
      at.low = stride * low;
      at.high = stride * high;
      at.share = static_cast<float>(clamped - static_cast<double>(low));
    }
    axis.at.push_back(at);
  }
  return axis;
}

/// One pane's slice, row by row.
class SlicePainter {
 public:
  SlicePainter(const LabelEdit& edit, const SlicePlane& plane, const SliceWindow& window, int slice,
               const SliceLook& look)
      : edit_(edit), look_(look) {
    const GridFrame& frame = edit.labels().frame;
    const std::array<std::size_t, 3> strides = {1, frame.index(0, 1, 0), frame.index(0, 0, 1)};
    const auto n = static_cast<std::size_t>(plane.normal);
    start_ = strides[n] * static_cast<std::size_t>(std::clamp(slice, 0, frame.size[n] - 1));
    // Pixels are looked at in their middles.
    const Vec3 first = voxel_at(plane, frame, window, 0.5, 0.5, slice);
    const Vec3 next = voxel_at(plane, frame, window, 1.5, 1.5, slice);
    const auto axis = [&](int a, int pixels) {
      const auto u = static_cast<std::size_t>(a);
      return pane_axis(pixels, first[a], next[a] - first[a], frame.size[u], strides[u]);
    };
    columns_ = axis(plane.right, window.width);
    rows_ = axis(plane.down, window.height);
    const double width = std::max(1.0, look.grey.width_hu);
    scale_ = static_cast<float>(255 / width);
    black_ = static_cast<float>(look.grey.level_hu - 0.5 * width);
  }

  void row(std::size_t y, Rgba* out) const {
    const PaneAxis::At& r = rows_.at[y];
    for (std::size_t x = 0; x < columns_.at.size(); ++x) {
      const PaneAxis::At& c = columns_.at[x];
      out[x] = r.inside && c.inside ? pixel(x, y, c, r) : kBeyond;
    }
  }

 private:
  std::uint16_t label(std::size_t x, std::size_t y) const {
    const PaneAxis::At &c = columns_.at[x], &r = rows_.at[y];
    return c.inside && r.inside ? edit_.labels().values[start_ + c.nearest + r.nearest]
                                : std::uint16_t{0};
  }

  float value(const PaneAxis::At& c, const PaneAxis::At& r) const {
    const std::int16_t* v = edit_.volume().values.data() + start_;
    const auto at = [v](std::size_t n) { return static_cast<float>(v[n]); };
    const float top = at(c.low + r.low) + c.share * (at(c.high + r.low) - at(c.low + r.low));
    const float bottom = at(c.low + r.high) + c.share * (at(c.high + r.high) - at(c.low + r.high));
    return top + r.share * (bottom - top);
  }

  /// A pixel next to one of another label.
  bool on_outline(std::size_t x, std::size_t y, std::uint16_t here) const {
    return (x > 0 && label(x - 1, y) != here) || (y > 0 && label(x, y - 1) != here) ||
           (x + 1 < columns_.at.size() && label(x + 1, y) != here) ||
           (y + 1 < rows_.at.size() && label(x, y + 1) != here);
  }

  Rgba pixel(std::size_t x, std::size_t y, const PaneAxis::At& c, const PaneAxis::At& r) const {
    const float shade = std::clamp((value(c, r) - black_) * scale_, 0.0f, 255.0f);
    const Rgba ground = grey(static_cast<double>(shade));
    const std::size_t place = start_ + c.nearest + r.nearest;
    const std::uint16_t here = edit_.labels().values[place];
    if (here == 0)
      return look_.preview && look_.preview->holds(edit_.volume().values[place])
                 ? mixed(ground, kPreview, kPreviewFill)
                 : ground;
    const auto color = look_.colors.find(here);
    if (color == look_.colors.end()) return ground;
    if (on_outline(x, y, here)) return mixed(ground, color->second, kOutline);
    return mixed(ground, color->second, look_.fill + (here == look_.chosen ? kChosenMore : 0));
  }

  const LabelEdit& edit_;
  const SliceLook& look_;
  std::size_t start_ = 0;
  PaneAxis columns_, rows_;
  float scale_ = 1, black_ = 0;
};

}  // namespace

void draw_slice(const LabelEdit& edit, const SlicePlane& plane, const SliceWindow& window,
                int slice, const SliceLook& look, std::vector<Rgba>& pixels) {
  const auto width = static_cast<std::size_t>(std::max(1, window.width));
  const auto height = static_cast<std::size_t>(std::max(1, window.height));
  pixels.resize(width * height);
  const SlicePainter painter(edit, plane, window, slice, look);
  for (std::size_t y = 0; y < height; ++y) painter.row(y, pixels.data() + y * width);
}

}  // namespace osteon
