#include "osteon/image/gaussian.h"

#include <algorithm>
#include <cmath>

namespace osteon {
namespace {

std::vector<float> kernel(double sigma_voxels) {
  const int reach = static_cast<int>(std::ceil(3 * sigma_voxels));
  std::vector<double> weights;
  double sum = 0;
  for (int n = -reach; n <= reach; ++n) {
    weights.push_back(std::exp(-0.5 * n * n / (sigma_voxels * sigma_voxels)));
    sum += weights.back();
  }
  std::vector<float> out;
  for (const double w : weights) out.push_back(static_cast<float>(w / sum));
  return out;
}

/// Blurs one line of `n` values that lie `stride` apart.
void blur_line(std::int16_t* line, int n, std::size_t stride, const std::vector<float>& weights,
               std::vector<float>& padded) {
  const int reach = static_cast<int>(weights.size() / 2);
  padded.resize(static_cast<std::size_t>(n + 2 * reach));
  for (int x = -reach; x < n + reach; ++x)
    padded[static_cast<std::size_t>(x + reach)] =
        line[static_cast<std::size_t>(std::clamp(x, 0, n - 1)) * stride];
  for (int x = 0; x < n; ++x) {
    float sum = 0;
    for (std::size_t w = 0; w < weights.size(); ++w)
      sum += weights[w] * padded[static_cast<std::size_t>(x) + w];
    line[static_cast<std::size_t>(x) * stride] = static_cast<std::int16_t>(std::lround(sum));
  }
}

}  // namespace

void blur_gaussian(Volume& volume, double sigma_m) {
  const auto& size = volume.frame.size;
  const std::size_t strides[3] = {
      1, static_cast<std::size_t>(size[0]),
      static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1])};
  std::vector<float> padded;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double sigma_voxels = sigma_m / volume.frame.spacing_m[static_cast<int>(axis)];
    if (!(sigma_voxels > 0.05)) continue;
    const std::vector<float> weights = kernel(sigma_voxels);
    const std::size_t u = axis == 0 ? 1 : 0, v = axis == 2 ? 1 : 2;
    for (int b = 0; b < size[v]; ++b)
      for (int a = 0; a < size[u]; ++a)
        blur_line(volume.values.data() + static_cast<std::size_t>(a) * strides[u] +
                      static_cast<std::size_t>(b) * strides[v],
                  size[axis], strides[axis], weights, padded);
  }
}

}  // namespace osteon
