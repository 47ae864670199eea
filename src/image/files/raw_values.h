#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "osteon/base/result.h"
#include "osteon/image/volume.h"

namespace osteon {

enum class ValueType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };
std::size_t size_of(ValueType type);

/// How voxels are stored in a file.
struct RawLayout {
  ValueType type = ValueType::int16;
  bool big_endian = false;
  double slope = 1, intercept = 0;
};

/// Unpacks the voxels of `frame` from `bytes` into HU; a value that is not finite or beyond 16 bits
/// is cut to them. Fails when there are too few bytes.
Result<Volume> unpack_values(const GridFrame& frame, std::string_view bytes,
                             const RawLayout& layout, const std::string& where);

/// Sets spacing and axes from the steps along i, j and k (columns, m, in Patient). Fails when they
/// are no right-angled grid. A left-handed grid gets its k turned round: `flip_k` then says so, and
/// origin and voxels must follow (see turn_k).
Result<void> set_axes(const Mat3& steps_P, GridFrame& frame, bool& flip_k,
                      const std::string& where);
/// Moves the origin to the last slice, for an order of slices that is turned round.
void turn_frame_k(GridFrame& frame);
/// Turns the order of slices round and moves the origin to the last one.
void turn_k(Volume& volume);

/// Fails unless the sizes are sane.
Result<void> check_size(const GridFrame& frame, const std::string& where);

/// What reading takes at its peak: the file, its voxels unpacked where they are packed (0: they are
/// not), which takes three times as much while the room for them grows, and the volume.
double reading_bytes(const GridFrame& frame, double file_bytes, double unpacked_bytes = 0);

/// Unpacks gzip (or zlib) data; fails when damaged or larger than `limit` unpacked.
Result<std::string> gunzip(std::string_view bytes, std::uint64_t limit, const std::string& where);

}  // namespace osteon
