#include "osteon/image/distance_map.h"

#include <cmath>

namespace osteon {
namespace {

constexpr float kFar = 1e12f;

/// Lower envelope of parabolas over one line; lengths in units of its spacing.
class LineTransform {
 public:
  explicit LineTransform(int longest) {
    f_.resize(static_cast<std::size_t>(longest));
    at_.resize(f_.size() + 1);
    from_.resize(f_.size() + 2);
  }

  void run(float* line, int n, std::size_t stride, float spacing) {
    const float s2 = spacing * spacing;
    bool any = false;
    for (int x = 0; x < n; ++x) {
      f_[u(x)] = line[u(x) * stride] / s2;
      any = any || line[u(x) * stride] < kFar;
    }
    if (!any) return;
    int last = -1;
    for (int q = 0; q < n; ++q) {
      if (f_[u(q)] * s2 >= kFar) continue;
      float s = -1e30f;
      while (last >= 0) {
        const int p = at_[u(last)];
        s = (f_[u(q)] - f_[u(p)] + static_cast<float>(q * q - p * p)) /
            static_cast<float>(2 * (q - p));
        if (s > from_[u(last)]) break;
        --last;
        s = -1e30f;
      }
      ++last;
      at_[u(last)] = q;
      from_[u(last)] = last == 0 ? -1e30f : s;
    }
    for (int x = 0, e = 0; x < n; ++x) {
      while (e < last && from_[u(e + 1)] < static_cast<float>(x)) ++e;
      const float d = static_cast<float>(x - at_[u(e)]);
      line[u(x) * stride] = (d * d + f_[u(at_[u(e)])]) * s2;
    }
  }

 private:
  static std::size_t u(int n) { return static_cast<std::size_t>(n); }
  std::vector<float> f_, from_;
  std::vector<int> at_;
};

}  // namespace

Grid<float> distance_map(const Mask& mask) {
  const auto& size = mask.frame.size;
  Grid<float> out{mask.frame, std::vector<float>(mask.frame.count())};
  for (std::size_t n = 0; n < out.values.size(); ++n) out.values[n] = mask.values[n] ? kFar : 0;
  const std::size_t strides[3] = {
      1, static_cast<std::size_t>(size[0]),
      static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1])};
  LineTransform transform(std::max({size[0], size[1], size[2]}));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t p = axis == 0 ? 1 : 0, q = axis == 2 ? 1 : 2;
    const auto spacing = static_cast<float>(mask.frame.spacing_m[static_cast<int>(axis)] * 1000);
    for (int b = 0; b < size[q]; ++b)
      for (int a = 0; a < size[p]; ++a)
        transform.run(out.values.data() + static_cast<std::size_t>(a) * strides[p] +
                          static_cast<std::size_t>(b) * strides[q],
                      size[axis], strides[axis], spacing);
  }
  for (float& d : out.values) d = std::sqrt(d) * 0.001f;
  return out;
}

}  // namespace osteon
