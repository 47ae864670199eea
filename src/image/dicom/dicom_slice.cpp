#include "dicom/dicom_slice.h"

#include <gdcmImageReader.h>
#include <gdcmTrace.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <sstream>
#include <utility>
#include <vector>

#include "dicom/dicom_picture.h"
#include "dicom/dicom_stack.h"

namespace osteon {
namespace {

template <class T>
void to_hu(const std::vector<char>& bytes, const DicomHeader& slice, std::int16_t* out) {
  const auto* stored = reinterpret_cast<const T*>(bytes.data());
  const std::size_t count =
      static_cast<std::size_t>(slice.rows) * static_cast<std::size_t>(slice.columns);
  for (std::size_t n = 0; n < count; ++n) {
    const double hu = stored[n] * slice.slope + slice.intercept;
    out[n] = static_cast<std::int16_t>(std::lround(std::clamp(hu, -32768.0, 32767.0)));
  }
}

Result<void> convert(const gdcm::Image& image, const DicomHeader& slice, std::int16_t* out) {
  const std::string file = slice.file.string();
  const std::size_t count =
      static_cast<std::size_t>(slice.rows) * static_cast<std::size_t>(slice.columns);
  const gdcm::PixelFormat& format = image.GetPixelFormat();
  const std::size_t length = image.GetBufferLength();
  std::vector<char> bytes(length);
  if (length != count * format.GetPixelSize() || !image.GetBuffer(bytes.data()))
    return fail("holds fewer pixels than it says, or has an unsupported compression", file,
                "Copy or export the series again, preferably uncompressed");
  switch (format.GetScalarType()) {
    case gdcm::PixelFormat::INT12:
    case gdcm::PixelFormat::INT16:
      to_hu<std::int16_t>(bytes, slice, out);
      return {};
    case gdcm::PixelFormat::UINT12:
    case gdcm::PixelFormat::UINT16:
      to_hu<std::uint16_t>(bytes, slice, out);
      return {};
    case gdcm::PixelFormat::INT8:
      to_hu<std::int8_t>(bytes, slice, out);
      return {};
    case gdcm::PixelFormat::UINT8:
      to_hu<std::uint8_t>(bytes, slice, out);
      return {};
    default:
      return fail("has pixels of an unusual kind", file, "Export it as 16-bit CT");
  }
}

}  // namespace

Result<void> decode_dicom_slice(const DicomElements& elements, const DicomHeader& header,
                                std::int16_t* out) {
  auto picture = picture_file(elements, header.file.string());
  if (!picture) return tl::unexpected(picture.error());
  gdcm::Trace::WarningOff();
  gdcm::Trace::ErrorOff();
  const auto broken = [&] {
    return fail("is truncated or damaged: its pixels cannot be read", header.file.string(),
                "Copy or export the series again");
  };
  try {
    std::istringstream stream(std::move(*picture));
    gdcm::ImageReader reader;
    reader.SetStream(stream);
    if (!reader.Read()) return broken();
    return convert(reader.GetImage(), header, out);
  } catch (const std::exception&) {
    return broken();
  }
}

Result<Volume> parse_dicom_slice(std::string_view bytes, const std::string& where) {
  const auto elements = walk_dicom(bytes, where);
  if (!elements) return tl::unexpected(elements.error());
  const auto header = dicom_header(*elements, where);
  if (!header) return tl::unexpected(header.error());
  if (auto sound = check_slice(*header); !sound) return tl::unexpected(sound.error());
  Volume volume;
  volume.frame.size = {header->columns, header->rows, 1};
  volume.frame.spacing_m = Vec3(header->spacing_i_m, header->spacing_j_m, 0.001);
  volume.frame.origin_P = *header->position_P;
  volume.frame.axes_P = *header->axes_P;
  volume.values.resize(volume.frame.count());
  auto decoded = decode_dicom_slice(*elements, *header, volume.values.data());
  if (!decoded) return tl::unexpected(decoded.error());
  return volume;
}

}  // namespace osteon
