// MetaImage files: https://itk.org/Wiki/ITK/MetaIO/Documentation
#include "files/file_start.h"
#include "files/raw_values.h"
#include "files/text_header.h"
#include "files/volume_files.h"
#include "osteon/base/file.h"

namespace osteon {
namespace {

namespace fs = std::filesystem;

const std::map<std::string, ValueType>& types() {
  static const std::map<std::string, ValueType> table = {
      {"met_char", ValueType::int8},     {"met_uchar", ValueType::uint8},
      {"met_short", ValueType::int16},   {"met_ushort", ValueType::uint16},
      {"met_int", ValueType::int32},     {"met_uint", ValueType::uint32},
      {"met_float", ValueType::float32}, {"met_double", ValueType::float64}};
  return table;
}

/// Lines up to the one that says where the data is, which comes last.
TextHeader read_header(std::string_view bytes, std::string_view& data) {
  TextHeader header;
  for (std::size_t at = 0; at < bytes.size();) {
    std::size_t end = bytes.find('\n', at);
    if (end == bytes.npos) end = bytes.size();
    const std::string line = trimmed(bytes.substr(at, end - at));
    at = end + 1;
    const std::size_t equals = line.find('=');
    if (equals == std::string::npos) break;
    const std::string key = lower_case(trimmed(line.substr(0, equals)));
    header[key] = trimmed(line.substr(equals + 1));
    if (key != "elementdatafile") continue;
    data = at < bytes.size() ? bytes.substr(at) : std::string_view();
    break;
  }
  return header;
}

std::vector<double> numbers_or_none(TextHeader& header, std::initializer_list<const char*> keys) {
  for (const char* key : keys)
    if (header.count(key)) return numbers_in(header[key]).value_or(std::vector<double>());
  return {};
}

Result<GridFrame> frame_of(TextHeader& header, bool& flip_k, const std::string& where) {
  GridFrame frame;
  const auto sizes = numbers_or_none(header, {"dimsize"});
  const auto channels = numbers_or_none(header, {"elementnumberofchannels"});
  if (sizes.size() != 3 || (!channels.empty() && channels[0] != 1))
    return fail("is not three-dimensional with one value per voxel", where,
                "Export one scalar volume");
  for (std::size_t a = 0; a < 3; ++a) frame.size[a] = whole_number(sizes[a]).value_or(0);
  const auto spacing = numbers_or_none(header, {"elementspacing"});
  if (spacing.size() != 3)
    return fail("has no 'ElementSpacing'", where, "Export it with its voxel spacing");
  const auto axes = numbers_or_none(header, {"transformmatrix", "orientation", "rotation"});
  Mat3 steps = Mat3::Identity();
  if (axes.size() == 9)
    for (int n = 0; n < 9; ++n) steps(n % 3, n / 3) = axes[static_cast<std::size_t>(n)];
  for (int a = 0; a < 3; ++a) steps.col(a) *= spacing[static_cast<std::size_t>(a)] * 0.001;
  if (auto set = set_axes(steps, frame, flip_k, where); !set) return tl::unexpected(set.error());
  const auto origin = numbers_or_none(header, {"offset", "position", "origin"});
  if (origin.size() == 3) frame.origin_P = Vec3(origin[0], origin[1], origin[2]) * 0.001;
  return frame;
}

/// Name of the file beside this one that holds the voxels; empty: they are in this one.
std::string meta_data_file(TextHeader& header) {
  const std::string name = header["elementdatafile"];
  return lower_case(name) == "local" ? std::string() : name;
}

bool is_meta_packed(TextHeader& header) { return lower_case(header["compresseddata"]) == "true"; }

/// The voxels' bytes, unpacked; `kept` holds them where they are not this file's own.
Result<std::string_view> data_of(TextHeader& header, std::string_view attached,
                                 const fs::path& folder, const std::string& where,
                                 std::string& kept) {
  const std::string name = header["elementdatafile"];
  if (lower_case(name) != "local") {
    if (name.empty() || folder.empty() || fs::path(name).has_parent_path() ||
        name.find('%') != name.npos || name.rfind("LIST", 0) == 0)
      return fail("has its data in '" + name + "', which is not one file in the same folder", where,
                  "Export it as one .mha file");
    auto detached = read_file(folder / name, kVolumeLimitBytes);
    if (!detached) return tl::unexpected(detached.error());
    kept = std::move(*detached);
    attached = kept;
  }
  if (!is_meta_packed(header)) return attached;
  auto unpacked = gunzip(attached, kVolumeLimitBytes, where);
  if (!unpacked) return tl::unexpected(unpacked.error());
  kept = std::move(*unpacked);
  return std::string_view(kept);
}

Result<TextVolumeHead> parse_meta_head(std::string_view bytes, const std::string& where) {
  TextVolumeHead head;
  head.header = read_header(bytes, head.attached);
  if (!head.header.count("elementdatafile"))
    return fail("is not a MetaImage file", where, "Export it again");
  const auto type = types().find(lower_case(head.header["elementtype"]));
  if (type == types().end())
    return fail("has voxels of type '" + head.header["elementtype"] + "', which is not supported",
                where, "Export it as 16-bit numbers");
  head.type = type->second;
  const auto frame = frame_of(head.header, head.flip_k, where);
  if (!frame) return tl::unexpected(frame.error());
  head.frame = *frame;
  if (auto sane = check_size(*frame, where); !sane) return tl::unexpected(sane.error());
  return head;
}

}  // namespace

Result<Volume> parse_meta(std::string_view bytes, const fs::path& folder,
                          const std::string& where) {
  auto head = parse_meta_head(bytes, where);
  if (!head) return tl::unexpected(head.error());
  TextHeader& header = head->header;
  std::string kept;
  const auto data = data_of(header, head->attached, folder, where, kept);
  if (!data) return tl::unexpected(data.error());
  RawLayout layout;
  layout.type = head->type;
  layout.big_endian = lower_case(header["binarydatabyteordermsb"]) == "true" ||
                      lower_case(header["elementbyteordermsb"]) == "true";
  std::string_view voxels = *data;
  // A header size of -1: the voxels are the end of the file.
  const std::size_t needed = head->frame.count() * size_of(layout.type);
  if (header["headersize"] == "-1" && voxels.size() > needed)
    voxels = voxels.substr(voxels.size() - needed);
  auto volume = unpack_values(head->frame, voxels, layout, where);
  if (volume && head->flip_k) turn_k(*volume);
  return volume;
}

Result<VolumeHead> head_of_meta(const fs::path& file) {
  const auto bytes = read_start(file);
  if (!bytes) return tl::unexpected(bytes.error());
  auto head = parse_meta_head(*bytes, file.string());
  if (!head) return tl::unexpected(head.error());
  return volume_head(*head, file, meta_data_file(head->header), is_meta_packed(head->header));
}

Result<Volume> read_meta(const fs::path& file) {
  const auto bytes = read_file(file, kVolumeLimitBytes);
  if (!bytes) return tl::unexpected(bytes.error());
  return parse_meta(*bytes, folder_of(file), file.string());
}

}  // namespace osteon
