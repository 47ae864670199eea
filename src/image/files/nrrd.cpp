// NRRD files: https://teem.sourceforge.net/nrrd/format.html
#include "files/file_start.h"
#include "files/raw_values.h"
#include "files/text_header.h"
#include "files/volume_files.h"
#include "osteon/base/file.h"

namespace osteon {
namespace {

namespace fs = std::filesystem;

const std::map<std::string, ValueType>& nrrd_types() {
  static const std::map<std::string, ValueType> table = {
      {"signed char", ValueType::int8},    {"int8", ValueType::int8},
      {"int8_t", ValueType::int8},         {"uchar", ValueType::uint8},
      {"unsigned char", ValueType::uint8}, {"uint8", ValueType::uint8},
      {"uint8_t", ValueType::uint8},       {"short", ValueType::int16},
      {"short int", ValueType::int16},     {"signed short", ValueType::int16},
      {"int16", ValueType::int16},         {"int16_t", ValueType::int16},
      {"ushort", ValueType::uint16},       {"unsigned short", ValueType::uint16},
      {"uint16", ValueType::uint16},       {"uint16_t", ValueType::uint16},
      {"int", ValueType::int32},           {"signed int", ValueType::int32},
      {"int32", ValueType::int32},         {"int32_t", ValueType::int32},
      {"uint", ValueType::uint32},         {"unsigned int", ValueType::uint32},
      {"uint32", ValueType::uint32},       {"uint32_t", ValueType::uint32},
      {"float", ValueType::float32},       {"double", ValueType::float64}};
  return table;
}

/// Lines up to the first empty one; `data` is what follows.
Result<TextHeader> read_header(std::string_view bytes, std::string_view& data,
                               const std::string& where) {
  if (bytes.substr(0, 4) != "NRRD") return fail("is not an NRRD file", where, "Export it again");
  TextHeader header;
  for (std::size_t at = 0;;) {
    const std::size_t end = bytes.find('\n', at);
    const std::string line = trimmed(bytes.substr(at, end == bytes.npos ? end : end - at));
    if (end == bytes.npos || line.empty()) {
      data = end == bytes.npos ? std::string_view() : bytes.substr(end + 1);
      return header;
    }
    at = end + 1;
    const std::size_t colon = line.find(':');
    if (line[0] == '#' || colon == std::string::npos) continue;
    // "key:=value" lines are free text.
    if (colon + 1 < line.size() && line[colon + 1] == '=') continue;
    header[lower_case(trimmed(line.substr(0, colon)))] = trimmed(line.substr(colon + 1));
  }
}

/// Steps along the axes in LPS, m.
Result<Mat3> steps_of(TextHeader& header, const std::string& where) {
  Mat3 steps = Mat3::Zero();
  const auto directions = numbers_in(header["space directions"]);
  const auto spacings = numbers_in(header["spacings"]);
  if (directions && directions->size() == 9) {
    for (int n = 0; n < 9; ++n) steps(n % 3, n / 3) = (*directions)[static_cast<std::size_t>(n)];
  } else if (spacings && spacings->size() == 3) {
    for (int n = 0; n < 3; ++n) steps(n, n) = (*spacings)[static_cast<std::size_t>(n)];
  } else {
    return fail("has neither 'space directions' nor 'spacings'", where, "Export it with them");
  }
  return steps;
}

/// Turns the file's space into LPS.
Result<Mat3> space_of(TextHeader& header, const std::string& where) {
  const std::string space = lower_case(header["space"]);
  if (space.empty() || space == "left-posterior-superior" || space == "lps")
    return Mat3(Mat3::Identity());
  if (space == "right-anterior-superior" || space == "ras")
    return Mat3(Vec3(-1, -1, 1).asDiagonal());
  if (space == "left-anterior-superior" || space == "las") return Mat3(Vec3(1, -1, 1).asDiagonal());
  return fail("lies in the space '" + space + "', which is not supported", where,
              "Export it in left-posterior-superior");
}

Result<GridFrame> nrrd_frame(TextHeader& header, bool& flip_k, const std::string& where) {
  GridFrame frame;
  const auto sizes = numbers_in(header["sizes"]);
  if (header["dimension"] != "3" || !sizes || sizes->size() != 3)
    return fail("is not three-dimensional", where, "Export one scalar volume");
  for (std::size_t a = 0; a < 3; ++a) frame.size[a] = whole_number((*sizes)[a]).value_or(0);
  auto steps = steps_of(header, where);
  const auto space = space_of(header, where);
  if (!steps) return tl::unexpected(steps.error());
  if (!space) return tl::unexpected(space.error());
  if (auto set = set_axes(*space * *steps * 0.001, frame, flip_k, where); !set)
    return tl::unexpected(set.error());
  const auto origin = numbers_in(header["space origin"]);
  if (origin && origin->size() == 3)
    frame.origin_P = *space * Vec3((*origin)[0], (*origin)[1], (*origin)[2]) * 0.001;
  return frame;
}

/// Name of the file beside this one that holds the voxels; empty: they are in this one.
std::string nrrd_data_file(TextHeader& header) {
  return header.count("data file") ? header["data file"] : header["datafile"];
}

bool is_nrrd_packed(TextHeader& header) {
  const std::string encoding = lower_case(header["encoding"]);
  return encoding == "gzip" || encoding == "gz";
}

/// The voxels' bytes, unpacked, from this file or the one beside it that it names; `kept` holds
/// them where they are not this file's own.
Result<std::string_view> nrrd_data(TextHeader& header, std::string_view attached,
                                   const fs::path& folder, const std::string& where,
                                   std::string& kept) {
  const std::string name = nrrd_data_file(header);
  if (!name.empty()) {
    if (folder.empty() || fs::path(name).has_parent_path() || name.find('%') != name.npos ||
        name.rfind("LIST", 0) == 0)
      return fail("has its data in '" + name + "', which is not one file in the same folder", where,
                  "Export it as one .nrrd file");
    auto detached = read_file(folder / name, kVolumeLimitBytes);
    if (!detached) return tl::unexpected(detached.error());
    kept = std::move(*detached);
    attached = kept;
  }
  if (lower_case(header["encoding"]) == "raw") return attached;
  if (!is_nrrd_packed(header))
    return fail("has the encoding '" + lower_case(header["encoding"]) + "', which is not supported",
                where, "Export it with raw or gzip encoding");
  auto unpacked = gunzip(attached, kVolumeLimitBytes, where);
  if (!unpacked) return tl::unexpected(unpacked.error());
  kept = std::move(*unpacked);
  return std::string_view(kept);
}

Result<TextVolumeHead> parse_nrrd_head(std::string_view bytes, const std::string& where) {
  TextVolumeHead head;
  auto header = read_header(bytes, head.attached, where);
  if (!header) return tl::unexpected(header.error());
  head.header = std::move(*header);
  const auto type = nrrd_types().find(lower_case(head.header["type"]));
  if (type == nrrd_types().end())
    return fail("has voxels of type '" + head.header["type"] + "', which is not supported", where,
                "Export it as 16-bit numbers");
  head.type = type->second;
  const auto frame = nrrd_frame(head.header, head.flip_k, where);
  if (!frame) return tl::unexpected(frame.error());
  head.frame = *frame;
  if (auto sane = check_size(*frame, where); !sane) return tl::unexpected(sane.error());
  return head;
}

}  // namespace

Result<Volume> parse_nrrd(std::string_view bytes, const fs::path& folder,
                          const std::string& where) {
  auto head = parse_nrrd_head(bytes, where);
  if (!head) return tl::unexpected(head.error());
  std::string kept;
  const auto data = nrrd_data(head->header, head->attached, folder, where, kept);
  if (!data) return tl::unexpected(data.error());
  RawLayout layout;
  layout.type = head->type;
  layout.big_endian = lower_case(head->header["endian"]) == "big";
  auto volume = unpack_values(head->frame, *data, layout, where);
  if (volume && head->flip_k) turn_k(*volume);
  return volume;
}

Result<VolumeHead> head_of_nrrd(const fs::path& file) {
  const auto bytes = read_start(file);
  if (!bytes) return tl::unexpected(bytes.error());
  auto head = parse_nrrd_head(*bytes, file.string());
  if (!head) return tl::unexpected(head.error());
  return volume_head(*head, file, nrrd_data_file(head->header), is_nrrd_packed(head->header));
}

Result<Volume> read_nrrd(const fs::path& file) {
  const auto bytes = read_file(file, kVolumeLimitBytes);
  if (!bytes) return tl::unexpected(bytes.error());
  return parse_nrrd(*bytes, folder_of(file), file.string());
}

}  // namespace osteon
