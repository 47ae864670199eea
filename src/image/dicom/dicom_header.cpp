#include "dicom/dicom_header.h"

#include <charconv>
#include <cmath>
#include <vector>

#include "osteon/base/file.h"

namespace osteon {
namespace {

constexpr std::uint64_t kDicomHeaderBytes = 256ull << 20;

/// Backslash-separated decimal numbers; empty when one is none.
std::vector<double> decimals_at(const DicomElements& data, std::uint16_t group,
                                std::uint16_t element) {
  const std::string_view text = data.text(group, element);
  std::vector<double> out;
  for (std::size_t from = 0; from <= text.size() && !text.empty();) {
    std::size_t to = text.find('\\', from);
    if (to == std::string_view::npos) to = text.size();
    while (from < to && (text[from] == ' ' || text[from] == '+')) ++from;
    double value = 0;
    const auto parsed = std::from_chars(text.data() + from, text.data() + to, value);
    if (parsed.ec != std::errc() || !std::isfinite(value)) return {};
    out.push_back(value);
    from = to + 1;
  }
  return out;
}

int whole_at(const DicomElements& data, std::uint16_t group, std::uint16_t element, int otherwise) {
  const auto numbers = decimals_at(data, group, element);
  return numbers.size() == 1 && std::abs(numbers[0]) < 1e9 ? static_cast<int>(numbers[0])
                                                           : otherwise;
}

void read_geometry(const DicomElements& data, DicomHeader& header) {
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

DicomHeader header_of(const DicomElements& data) {
  DicomHeader header;
  header.series_uid = data.text(0x0020, 0x000e);
  header.modality = data.text(0x0008, 0x0060);
  header.image_type = data.text(0x0008, 0x0008);
  header.series_number = whole_at(data, 0x0020, 0x0011, 0);
  header.frames = whole_at(data, 0x0028, 0x0008, 1);
  header.rows = static_cast<int>(data.number(0x0028, 0x0010, 0));
  header.columns = static_cast<int>(data.number(0x0028, 0x0011, 0));
  const auto slope = decimals_at(data, 0x0028, 0x1053);
  const auto intercept = decimals_at(data, 0x0028, 0x1052);
  header.has_pixels = data.has_pixels;
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
  return read_file(file, kDicomHeaderBytes);
}

Result<DicomHeader> dicom_header(const DicomElements& elements, const std::filesystem::path& file) {
  DicomHeader header = header_of(elements);
  header.file = file;
  const bool damaged = header.series_uid.empty() || (header.modality == "CT" && !header.has_pixels);
  if (!damaged) return header;
  return fail("is damaged: its header or its pixels are missing", file.string(),
              "Copy or export the series again, or remove the file");
}

Result<DicomHeader> read_dicom_header(const std::filesystem::path& file) {
  const auto bytes = read_dicom_bytes(file);
  if (!bytes) return tl::unexpected(bytes.error());
  const auto elements = walk_dicom(*bytes, file.string());
  if (!elements) return tl::unexpected(elements.error());
  return dicom_header(*elements, file);
}

}  // namespace osteon
