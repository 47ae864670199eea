// NIfTI-1 files in one piece: https://nifti.nimh.nih.gov/pub/dist/src/niftilib/nifti1.h
#include <cmath>
#include <cstring>
#include <map>

#include "files/file_start.h"
#include "files/raw_values.h"
#include "files/volume_files.h"
#include "osteon/base/file.h"

namespace osteon {
namespace {

constexpr std::size_t kHeaderBytes = 348;

/// The header's fields by their offsets in bytes.
class Header {
 public:
  Header(std::string_view bytes, bool swap) : bytes_(bytes), swap_(swap) {}
  int word(std::size_t at) const { return read<std::int16_t>(at); }
  int whole(std::size_t at) const { return read<std::int32_t>(at); }
  double real(std::size_t at) const { return static_cast<double>(read<float>(at)); }
  bool big_endian() const { return swap_; }

 private:
  template <class T>
  T read(std::size_t at) const {
    char ordered[sizeof(T)];
    for (std::size_t n = 0; n < sizeof(T); ++n)
      ordered[n] = bytes_[at + (swap_ ? sizeof(T) - 1 - n : n)];
    T value;
    std::memcpy(&value, ordered, sizeof(T));
    return value;
  }
  std::string_view bytes_;
  bool swap_;
};

const std::map<int, ValueType>& nifti_types() {
  static const std::map<int, ValueType> table = {
      {2, ValueType::uint8},    {4, ValueType::int16},    {8, ValueType::int32},
      {16, ValueType::float32}, {64, ValueType::float64}, {256, ValueType::int8},
      {512, ValueType::uint16}, {768, ValueType::uint32}};
  return table;
}

/// Metres in the file's unit of length: metres, millimetres (also when it does not say) or
/// micrometres.
double unit_of(std::string_view bytes) {
  switch (bytes[123] & 7) {
    case 1:
      return 1;
    case 3:
      return 1e-6;
    default:
      return 1e-3;
  }
}

/// Steps along the axes and the first voxel, in RAS and the file's unit.
struct Affine {
  Mat3 steps;
  Vec3 origin;
};

Affine affine_of(const Header& h) {
  Affine a{Mat3::Zero(), Vec3::Zero()};
  if (h.word(254) > 0) {  // sform: rows of the affine
    for (int row = 0; row < 3; ++row) {
      const auto at = static_cast<std::size_t>(280 + 16 * row);
      for (int c = 0; c < 3; ++c) a.steps(row, c) = h.real(at + 4 * static_cast<std::size_t>(c));
      a.origin[row] = h.real(at + 12);
    }
    return a;
  }
  const Vec3 spacing(h.real(80), h.real(84), h.real(88));
  Mat3 R = Mat3::Identity();
  if (h.word(252) > 0) {  // qform: a quaternion and a handedness
    const double b = h.real(256), c = h.real(260), d = h.real(264);
    const double rest = 1 - b * b - c * c - d * d;
    R = Quat(std::sqrt(std::max(0.0, rest)), b, c, d).normalized().toRotationMatrix();
    if (h.real(76) < 0) R.col(2) = -R.col(2);
    a.origin = Vec3(h.real(268), h.real(272), h.real(276));
  }
  a.steps = R * spacing.asDiagonal();
  return a;
}

struct NiftiHead {
  GridFrame frame;
  bool flip_k = false;
  RawLayout layout;
  double offset = 0;  ///< of the voxels, bytes
};

Result<GridFrame> frame_of(const Header& header, std::string_view bytes, bool& flip_k,
                           const std::string& where) {
  const int dimensions = header.word(40);
  if (dimensions < 3 || (dimensions > 3 && header.word(48) > 1))
    return fail("is not three-dimensional", where, "Export one volume");
  GridFrame frame;
  for (std::size_t a = 0; a < 3; ++a) frame.size[a] = header.word(42 + 2 * a);
  if (auto sane = check_size(frame, where); !sane) return tl::unexpected(sane.error());
  const Affine affine = affine_of(header);
  const Mat3 to_lps = Vec3(-1, -1, 1).asDiagonal();
  const double unit = unit_of(bytes);
  if (auto set = set_axes(to_lps * affine.steps * unit, frame, flip_k, where); !set)
    return tl::unexpected(set.error());
  frame.origin_P = to_lps * affine.origin * unit;
  return frame;
}

Result<NiftiHead> parse_nifti_head(std::string_view bytes, const std::string& where) {
  if (bytes.size() < kHeaderBytes + 4)
    return fail("is truncated: its header is incomplete", where, "Copy or export it again");
  const bool little = Header(bytes, false).whole(0) == 348;
  const Header header(bytes, !little);
  if (header.whole(0) != 348 || bytes.substr(344, 3) != "n+1")
    return fail("is not a single-file NIfTI-1", where, "Export it as .nii or .nii.gz");
  const auto type = nifti_types().find(header.word(70));
  if (type == nifti_types().end())
    return fail(
        "has voxels of type " + std::to_string(header.word(70)) + ", which is not supported", where,
        "Export it as 16-bit numbers");
  NiftiHead head;
  const auto frame = frame_of(header, bytes, head.flip_k, where);
  if (!frame) return tl::unexpected(frame.error());
  head.frame = *frame;
  head.offset = header.real(108);
  head.layout.type = type->second;
  head.layout.big_endian = header.big_endian();
  const double slope = header.real(112), intercept = header.real(116);
  if (std::isfinite(slope) && std::isfinite(intercept) && slope != 0) {
    head.layout.slope = slope;
    head.layout.intercept = intercept;
  }
  return head;
}

bool is_gzip(std::string_view bytes) { return bytes.substr(0, 2) == "\x1f\x8b"; }

}  // namespace

Result<Volume> parse_nifti(std::string_view bytes, const std::string& where) {
  std::string unpacked;
  if (is_gzip(bytes)) {
    auto out = gunzip(bytes, kVolumeLimitBytes, where);
    if (!out) return tl::unexpected(out.error());
    unpacked = std::move(*out);
    bytes = unpacked;
  }
  const auto head = parse_nifti_head(bytes, where);
  if (!head) return tl::unexpected(head.error());
  if (!(head->offset >= 0) || head->offset > static_cast<double>(bytes.size()))
    return fail("is truncated: its voxels begin after its end", where, "Copy or export it again");
  const std::string_view voxels = bytes.substr(static_cast<std::size_t>(head->offset));
  auto volume = unpack_values(head->frame, voxels, head->layout, where);
  if (volume && head->flip_k) turn_k(*volume);
  return volume;
}

Result<VolumeHead> head_of_nifti(const std::filesystem::path& file) {
  const auto start = read_start(file, 2);
  if (!start) return tl::unexpected(start.error());
  auto head = parse_nifti_head(UnpackedFile(file).read(kHeaderBytes + 4), file.string());
  if (!head) return tl::unexpected(head.error());
  if (head->flip_k) turn_frame_k(head->frame);
  const auto voxels = static_cast<double>(head->frame.count() * size_of(head->layout.type));
  return VolumeHead{head->frame, reading_bytes(head->frame, size_of_file(file),
                                               is_gzip(*start) ? head->offset + voxels : 0)};
}

Result<Volume> read_nifti(const std::filesystem::path& file) {
  const auto bytes = read_file(file, kVolumeLimitBytes);
  if (!bytes) return tl::unexpected(bytes.error());
  return parse_nifti(*bytes, file.string());
}

}  // namespace osteon
