#include "osteon/image/dicom_xray.h"

#include <gdcmWriter.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "dicom/dicom_put.h"
#include "osteon/base/hash.h"

namespace osteon {
namespace {

constexpr const char* kXaImageStorage = "1.2.840.10008.5.1.4.1.1.12.1";
constexpr int kBits = 12;
constexpr double kLargest = (1 << kBits) - 1;

std::string pixel_bytes(const XrayFilm& film) {
  std::string bytes;
  bytes.reserve(2 * film.grey.size());
  for (const float grey : film.grey) {
    const double g = grey >= 0 ? std::min(1.0, static_cast<double>(grey)) : 0;  // 0 of a NaN
    const auto word = static_cast<std::uint16_t>(std::lround(g * kLargest));
    bytes += static_cast<char>(word & 0xff);
    bytes += static_cast<char>(word >> 8);
  }
  return bytes;
}

std::string whole(double value) { return std::to_string(std::lround(value)); }
std::string degrees(double rad) { return dicom_decimal(rad * 180 / std::numbers::pi); }
std::string in_mm(double m) { return dicom_decimal(1000 * m); }

void put_film_identity(gdcm::DataSet& data, std::uint64_t hash, const XrayFilm& film,
                       const XrayFilmOptions& options) {
  using gdcm::VR;
  const std::string series = dicom_uid(options.seed, hash, 2);
  put_dicom_nobody(data);
  put_dicom(data, 0x0008, 0x0008, VR::CS, "DERIVED\\PRIMARY\\SINGLE PLANE");
  put_dicom(data, 0x0008, 0x0016, VR::UI, kXaImageStorage);
  put_dicom(data, 0x0008, 0x0018, VR::UI, series + "." + std::to_string(film.number));
  put_dicom(data, 0x0008, 0x0060, VR::CS, "XA");
  put_dicom(data, 0x0008, 0x103e, VR::LO, options.description);
  put_dicom(data, 0x0020, 0x000d, VR::UI, dicom_uid(options.seed, hash, 1));
  put_dicom(data, 0x0020, 0x000e, VR::UI, series);
  put_dicom(data, 0x0020, 0x0011, VR::IS, "1");
  put_dicom(data, 0x0020, 0x0013, VR::IS, std::to_string(film.number));
}

void put_exposure(gdcm::DataSet& data, const XrayFilm& film) {
  using gdcm::VR;
  put_dicom(data, 0x0018, 0x0060, VR::DS, dicom_decimal(film.kv));
  put_dicom(data, 0x0018, 0x1110, VR::DS, in_mm(film.source_detector_m));
  put_dicom(data, 0x0018, 0x1111, VR::DS, in_mm(film.source_isocenter_m));
  put_dicom(data, 0x0018, 0x1114, VR::DS,
            dicom_decimal(film.source_detector_m / film.source_isocenter_m));
  put_dicom(data, 0x0018, 0x1150, VR::IS, whole(1000 * film.exposure_s));
  put_dicom(data, 0x0018, 0x1153, VR::IS, whole(1000 * film.mas));  // uAs: mAs must be whole
  put_dicom(data, 0x0018, 0x1154, VR::DS, dicom_decimal(1000 * film.exposure_s));
  put_dicom(data, 0x0018, 0x1155, VR::CS, "SC");
  put_dicom(data, 0x0018, 0x115e, VR::DS,
            dicom_decimal(0.01 * film.kerma_area_mgy_cm2));  // dGy cm2
  put_dicom(data, 0x0018, 0x1164, VR::DS, in_mm(film.pixel_m) + "\\" + in_mm(film.pixel_m));
  put_dicom(data, 0x0018, 0x1500, VR::CS, "CARM");
  put_dicom(data, 0x0018, 0x1510, VR::DS, degrees(film.orbit_rad));
  put_dicom(data, 0x0018, 0x1511, VR::DS, degrees(film.angulation_rad));
}

void put_film_pixels(gdcm::DataSet& data, const XrayFilm& film) {
  using gdcm::VR;
  put_dicom_number(data, 0x0028, 0x0002, 1);
  put_dicom(data, 0x0028, 0x0004, VR::CS, "MONOCHROME2");
  put_dicom_number(data, 0x0028, 0x0010, static_cast<std::uint16_t>(film.height));
  put_dicom_number(data, 0x0028, 0x0011, static_cast<std::uint16_t>(film.width));
  put_dicom_number(data, 0x0028, 0x0100, 16);
  put_dicom_number(data, 0x0028, 0x0101, kBits);
  put_dicom_number(data, 0x0028, 0x0102, kBits - 1);
  put_dicom_number(data, 0x0028, 0x0103, 0);
  put_dicom(data, 0x0028, 0x1040, VR::CS, "LOG");
  put_dicom(data, 0x7fe0, 0x0010, VR::OW, pixel_bytes(film));
}

std::uint64_t hash_of_film(const XrayFilm& film) {
  Hasher hasher;
  hasher.add(film.width);
  hasher.add(film.kv);
  hasher.add(film.orbit_rad);
  hasher.add(film.angulation_rad);
  hasher.bytes(film.grey.data(), film.grey.size() * sizeof(float));
  return hasher.value();
}

}  // namespace

Result<void> write_dicom_xray(const XrayFilm& film, const std::filesystem::path& file,
                              const XrayFilmOptions& options) {
  constexpr int kMost = 65535;
  if (film.width < 1 || film.height < 1 || film.width > kMost || film.height > kMost ||
      film.grey.size() !=
          static_cast<std::size_t>(film.width) * static_cast<std::size_t>(film.height))
    return fail("the picture is empty, or its size does not match its pixels", file.string());
  gdcm::Writer writer;
  gdcm::DataSet& data = writer.GetFile().GetDataSet();
  put_film_identity(data, hash_of_film(film), film, options);
  put_exposure(data, film);
  put_film_pixels(data, film);
  return write_dicom_file(writer, file);
}

}  // namespace osteon
