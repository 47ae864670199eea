#include "files/raw_values.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "files/volume_files.h"

namespace osteon {
namespace {

template <class T>
T value_at(const char* bytes, bool swap) {
  char ordered[sizeof(T)];
  std::memcpy(ordered, bytes, sizeof(T));
  if (swap) std::reverse(ordered, ordered + sizeof(T));
  T value;
  std::memcpy(&value, ordered, sizeof(T));
  return value;
}

std::int16_t to_hu(double value) {
  if (std::isnan(value)) return -1024;
  return static_cast<std::int16_t>(std::lround(std::clamp(value, -32768.0, 32767.0)));
}

template <class T>
void unpack(std::string_view bytes, const RawLayout& layout, std::vector<std::int16_t>& out) {
  const bool swap = layout.big_endian != (std::endian::native == std::endian::big);
  for (std::size_t n = 0; n < out.size(); ++n) {
    const auto stored = static_cast<double>(value_at<T>(bytes.data() + n * sizeof(T), swap));
    out[n] = to_hu(stored * layout.slope + layout.intercept);
  }
}

}  // namespace

std::size_t size_of(ValueType type) {
  switch (type) {
    case ValueType::int8:
    case ValueType::uint8:
      return 1;
    case ValueType::int16:
    case ValueType::uint16:
      return 2;
    case ValueType::float64:
      return 8;
    default:
      return 4;
  }
}

Result<void> check_size(const GridFrame& frame, const std::string& where) {
  double voxels = 1;
  for (const int n : frame.size) {
    if (n < 1 || n > 65535) return fail("has an impossible size", where, "Export it again");
    voxels *= n;
  }
  if (voxels > kMostVoxels)
    return fail("has more than 1200 million voxels", where, "Crop it to the joint first");
  return {};
}

Result<Volume> unpack_values(const GridFrame& frame, std::string_view bytes,
                             const RawLayout& layout, const std::string& where) {
  if (auto sane = check_size(frame, where); !sane) return tl::unexpected(sane.error());
  const std::size_t needed = frame.count() * size_of(layout.type);
  if (bytes.size() < needed)
    return fail("is truncated: it holds " + std::to_string(bytes.size()) + " bytes of voxels, " +
                    std::to_string(needed) + " are needed",
                where, "Copy or export it again");
  Volume volume{frame, std::vector<std::int16_t>(frame.count())};
  switch (layout.type) {
    case ValueType::int8:
      unpack<std::int8_t>(bytes, layout, volume.values);
      break;
    case ValueType::uint8:
      unpack<std::uint8_t>(bytes, layout, volume.values);
      break;
    case ValueType::int16:
      unpack<std::int16_t>(bytes, layout, volume.values);
      break;
    case ValueType::uint16:
      unpack<std::uint16_t>(bytes, layout, volume.values);
      break;
    case ValueType::int32:
      unpack<std::int32_t>(bytes, layout, volume.values);
      break;
    case ValueType::uint32:
      unpack<std::uint32_t>(bytes, layout, volume.values);
      break;
    case ValueType::float32:
      unpack<float>(bytes, layout, volume.values);
      break;
    case ValueType::float64:
      unpack<double>(bytes, layout, volume.values);
      break;
  }
  return volume;
}

Result<void> set_axes(const Mat3& steps_P, GridFrame& frame, bool& flip_k,
                      const std::string& where) {
  const Vec3 lengths = steps_P.colwise().norm();
  if (!is_finite(lengths) || lengths.minCoeff() < 1e-7 || lengths.maxCoeff() > 1)
    return fail("has no usable voxel spacing", where, "Correct its spacing");
  Mat3 axes = steps_P * lengths.cwiseInverse().asDiagonal();
  const Mat3 angles = axes.transpose() * axes - Mat3::Identity();
  if (angles.cwiseAbs().maxCoeff() > 5e-3)
    return fail("has axes that are not at right angles", where, "Resample it to an upright grid");
  flip_k = axes.determinant() < 0;
  const Vec3 i = axes.col(0).normalized();
  const Vec3 k = i.cross(axes.col(1)).normalized();
  axes << i, k.cross(i), k;
  frame.axes_P = axes;
  frame.spacing_m = lengths;
  return {};
}

void turn_frame_k(GridFrame& frame) {
  // The axis already points the new way, so the last slice lies against it.
  frame.origin_P -= (frame.size[2] - 1) * frame.spacing_m.z() * frame.axes_P.col(2);
}

void turn_k(Volume& volume) {
  GridFrame& frame = volume.frame;
  const std::size_t slice = frame.index(0, 0, 1);
  for (int a = 0, b = frame.size[2] - 1; a < b; ++a, --b)
    std::swap_ranges(
        volume.values.begin() + static_cast<std::ptrdiff_t>(frame.index(0, 0, a)),
        volume.values.begin() + static_cast<std::ptrdiff_t>(frame.index(0, 0, a) + slice),
        volume.values.begin() + static_cast<std::ptrdiff_t>(frame.index(0, 0, b)));
  turn_frame_k(frame);
}

double reading_bytes(const GridFrame& frame, double file_bytes, double unpacked_bytes) {
  const double volume = static_cast<double>(frame.count()) * sizeof(std::int16_t);
  return file_bytes + std::max(3 * unpacked_bytes, 2 * unpacked_bytes + volume);
}

}  // namespace osteon
