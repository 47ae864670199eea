#include <algorithm>
#include <cmath>
#include <utility>

#include "dicom/dicom_slice.h"
#include "dicom/dicom_stack.h"
#include "osteon/image/dicom.h"

namespace osteon {
namespace {

constexpr double kAir = -1024;

Result<std::vector<DicomHeader>> headers_of(const DicomSeries& series) {
  std::vector<DicomHeader> headers;
  for (const auto& file : series.files) {
    auto header = read_dicom_header(file);
    if (!header) return tl::unexpected(header.error());
    headers.push_back(std::move(*header));
  }
  return headers;
}

Result<DicomStack> stack_of(const DicomSeries& series) {
  auto headers = headers_of(series);
  if (!headers) return tl::unexpected(headers.error());
  return stack_slices(std::move(*headers), "series " + std::to_string(series.number));
}

Result<void> read_slice(const DicomHeader& slice, std::int16_t* out) {
  const auto bytes = read_dicom_bytes(slice.file);
  if (!bytes) return tl::unexpected(bytes.error());
  const auto elements = walk_dicom(*bytes, slice.file.string());
  if (!elements) return tl::unexpected(elements.error());
  return decode_dicom_slice(*elements, slice, out);
}

/// Value of a slice between its pixels; air outside.
double sample(const std::int16_t* slice, const GridFrame& frame, double i, double j) {
  const int i0 = static_cast<int>(std::floor(i)), j0 = static_cast<int>(std::floor(j));
  const auto at = [&](int x, int y) {
    if (x < 0 || y < 0 || x >= frame.size[0] || y >= frame.size[1]) return kAir;
    return static_cast<double>(slice[frame.index(x, y, 0)]);
  };
  const double u = i - i0, v = j - j0;
  return (1 - v) * ((1 - u) * at(i0, j0) + u * at(i0 + 1, j0)) +
         v * ((1 - u) * at(i0, j0 + 1) + u * at(i0 + 1, j0 + 1));
}

/// The upright grid that holds every slice of a tilted stack.
GridFrame upright(const DicomStack& stack) {
  GridFrame frame = stack.frame;
  for (std::size_t a = 0; a < 2; ++a) {
    double lo = 0, hi = 0;
    for (const auto& shift : stack.shift_m) {
      lo = std::min(lo, shift[a]);
      hi = std::max(hi, shift[a]);
    }
    const int axis = static_cast<int>(a);
    frame.origin_P += lo * frame.axes_P.col(axis);
    frame.size[a] += static_cast<int>(std::ceil((hi - lo) / frame.spacing_m[axis]));
  }
  return frame;
}

void place_tilted(const DicomStack& stack, const std::vector<std::int16_t>& slice, std::size_t k,
                  Volume& volume) {
  const Vec3 from = stack.frame.axes_P.transpose() * (volume.frame.origin_P - stack.frame.origin_P);
  const double di = (from.x() - stack.shift_m[k][0]) / stack.frame.spacing_m.x();
  const double dj = (from.y() - stack.shift_m[k][1]) / stack.frame.spacing_m.y();
  for (int j = 0; j < volume.frame.size[1]; ++j)
    for (int i = 0; i < volume.frame.size[0]; ++i)
      volume.at(i, j, static_cast<int>(k)) =
          static_cast<std::int16_t>(std::lround(sample(slice.data(), stack.frame, i + di, j + dj)));
}

}  // namespace

Result<GridFrame> dicom_frame(const DicomSeries& series) {
  const auto stack = stack_of(series);
  if (!stack) return tl::unexpected(stack.error());
  return stack->tilted ? upright(*stack) : stack->frame;
}

Result<Volume> read_dicom(const DicomSeries& series, const Progress& progress) {
  const auto stack = stack_of(series);
  if (!stack) return tl::unexpected(stack.error());
  Volume volume;
  volume.frame = stack->tilted ? upright(*stack) : stack->frame;
  volume.values.resize(volume.frame.count());
  std::vector<std::int16_t> slice(stack->frame.index(0, 0, 1));
  const std::size_t count = stack->slices.size();
  for (std::size_t k = 0; k < count; ++k) {
    if (!goes_on(progress, "Reading slices", static_cast<double>(k) / static_cast<double>(count)))
      return stopped();
    std::int16_t* straight = volume.values.data() + k * slice.size();
    auto read = read_slice(stack->slices[k], stack->tilted ? slice.data() : straight);
    if (!read) return tl::unexpected(read.error());
    if (stack->tilted) place_tilted(*stack, slice, k, volume);
  }
  return volume;
}

}  // namespace osteon
