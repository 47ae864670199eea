#include "dicom_header.h"

#include <gdcmReader.h>
#include <gdcmTrace.h>

#include <charconv>
#include <cmath>
#include <exception>
#include <sstream>
#include <vector>

#include "dicom_walk.h"
#include "osteon/base/file.h"

namespace osteon {
namespace {

constexpr std::uint64_t kLimitBytes = 256ull << 20;

std::string text_at(const gdcm::DataSet& data, std::uint16_t group, std::uint16_t element) {
  const gdcm::Tag tag(group, element);
  if (!data.FindDataElement(tag)) return {};
  const gdcm::ByteValue* bytes = data.GetDataElement(tag).GetByteValue();
  if (!bytes) return {};
  std::string text(bytes->GetPointer(), bytes->GetLength());
  while (!text.empty() && (text.back() == ' ' || text.back() == '\0')) text.pop_back();
  return text;
}

/// Backslash-separated decimal numbers; empty when one is none.
std::vector<double> decimals_at(const gdcm::DataSet& data, std::uint16_t group,
                                std::uint16_t element) {
  const std::string text = text_at(data, group, element);
  std::vector<double> out;
  for (std::size_t from = 0; from <= text.size() && !text.empty();) {
    std::size_t to = text.find('\\', from);
    if (to == std::string::npos) to = text.size();
    while (from < to && (text[from] == ' ' || text[from] == '+')) ++from;
    double value = 0;
    const auto parsed = std::from_chars(text.data() + from, text.data() + to, value);
    if (parsed.ec != std::errc() || !std::isfinite(value)) return {};
    out.push_back(value);
    from = to + 1;
  }
  return out;
}

int whole_at(const gdcm::DataSet& data, std::uint16_t group, std::uint16_t element, int otherwise) {
  const auto numbers = decimals_at(data, group, element);
  return numbers.size() == 1 && std::abs(numbers[0]) < 1e9 ? static_cast<int>(numbers[0])
                                                           : otherwise;
}

int short_at(const gdcm::DataSet& data, std::uint16_t group, std::uint16_t element) {
  const gdcm::Tag tag(group, element);
  if (!data.FindDataElement(tag)) return 0;
  const gdcm::ByteValue* bytes = data.GetDataElement(tag).GetByteValue();
  if (!bytes || bytes->GetLength() < 2) return 0;
  const auto* b = reinterpret_cast<const unsigned char*>(bytes->GetPointer());
  return b[0] | b[1] << 8;
}

void read_geometry(const gdcm::DataSet& data, DicomHeader& header) {
  const auto position = decimals_at(data, 0x0020, 0x0032);
  if (position.size() == 3) header.position_P = Vec3(position[0], position[1], position[2]) * 0.001;
  const auto axes = decimals_at(data, 0x0020, 0x0037);
  if (axes.size() == 6) {
    const Vec3 i(axes[0], axes[1], axes[2]), j(axes[3], axes[4], axes[5]);
    if (std::abs(i.norm() - 1) < 1e-2 && std::abs(j.norm() - 1) < 1e-2 &&
        std::abs(i.dot(j)) < 1e-2) {
      Mat3 R;
      R.col(0) = i.normalized();
      R.col(2) = i.cross(j).normalized();
      R.col(1) = R.col(2).cross(R.col(0));
      header.axes_P = R;
    }
  }
  const auto spacing = decimals_at(data, 0x0028, 0x0030);
  if (spacing.size() == 2) {
    header.spacing_j_m = spacing[0] * 0.001;
    header.spacing_i_m = spacing[1] * 0.001;
  }
}

DicomHeader header_of(const gdcm::DataSet& data) {
  DicomHeader header;
  header.series_uid = text_at(data, 0x0020, 0x000e);
  header.modality = text_at(data, 0x0008, 0x0060);
  header.image_type = text_at(data, 0x0008, 0x0008);
  header.series_number = whole_at(data, 0x0020, 0x0011, 0);
  header.frames = whole_at(data, 0x0028, 0x0008, 1);
  header.rows = short_at(data, 0x0028, 0x0010);
  header.columns = short_at(data, 0x0028, 0x0011);
  const auto slope = decimals_at(data, 0x0028, 0x1053);
  const auto intercept = decimals_at(data, 0x0028, 0x1052);
  header.has_rescale = slope.size() == 1 && intercept.size() == 1;
  if (header.has_rescale) {
    header.slope = slope[0];
    header.intercept = intercept[0];
  }
  read_geometry(data, header);
  return header;
}

}  // namespace

Result<std::string> read_dicom_bytes(const std::filesystem::path& file) {
  auto bytes = read_file(file, kLimitBytes);
  if (!bytes) return bytes;
  if (auto whole = check_dicom_structure(*bytes, file.string()); !whole)
    return tl::unexpected(whole.error());
  return bytes;
}

Result<DicomHeader> read_dicom_header(const std::filesystem::path& file) {
  auto bytes = read_dicom_bytes(file);
  if (!bytes) return tl::unexpected(bytes.error());
  return parse_dicom_header(std::move(*bytes), file);
}

Result<DicomHeader> parse_dicom_header(std::string bytes, const std::filesystem::path& file) {
  gdcm::Trace::WarningOff();
  gdcm::Trace::ErrorOff();
  const auto broken = [&] {
    return fail("is damaged: its header cannot be read", file.string(),
                "Copy or export the series again, or remove the file");
  };
  try {
    std::istringstream stream(std::move(bytes));
    gdcm::Reader reader;
    reader.SetStream(stream);
    if (!reader.ReadUpToTag(gdcm::Tag(0x7fe0, 0x0010))) return broken();
    DicomHeader header = header_of(reader.GetFile().GetDataSet());
    header.file = file;
    if (header.series_uid.empty()) return broken();
    return header;
  } catch (const std::exception&) {
    return broken();
  }
}

}  // namespace osteon
