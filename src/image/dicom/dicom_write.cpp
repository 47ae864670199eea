#include <gdcmWriter.h>

#include <cstdio>

#include "dicom/dicom_put.h"
#include "osteon/base/hash.h"
#include "osteon/image/dicom.h"

namespace osteon {
namespace {

constexpr const char* kCtSopClass = "1.2.840.10008.5.1.4.1.1.2";

struct SeriesIds {
  std::string study, series, frame;
};

void put_identity(gdcm::DataSet& data, const SeriesIds& ids, const DicomWriteOptions& options) {
  using gdcm::VR;
  put_dicom(data, 0x0008, 0x0008, VR::CS, "DERIVED\\SECONDARY\\AXIAL");
  put_dicom(data, 0x0008, 0x0016, VR::UI, kCtSopClass);
  put_dicom_nobody(data);
  put_dicom(data, 0x0008, 0x0060, VR::CS, "CT");
  put_dicom(data, 0x0008, 0x103e, VR::LO, options.description);
  put_dicom(data, 0x0020, 0x000d, VR::UI, ids.study);
  put_dicom(data, 0x0020, 0x000e, VR::UI, ids.series);
  put_dicom(data, 0x0020, 0x0052, VR::UI, ids.frame);
  put_dicom(data, 0x0020, 0x0011, VR::IS, "1");
  put_dicom(data, 0x0018, 0x5100, VR::CS, "FFS");
}

void put_geometry(gdcm::DataSet& data, const GridFrame& frame, int slice) {
  using gdcm::VR;
  const Vec3 p_mm = frame.point_P(Vec3(0, 0, slice)) * 1000;
  const Vec3 i = frame.axes_P.col(0), j = frame.axes_P.col(1), s_mm = frame.spacing_m * 1000;
  const auto triple = [](const Vec3& v) {
    return dicom_decimal(v.x()) + "\\" + dicom_decimal(v.y()) + "\\" + dicom_decimal(v.z());
  };
  put_dicom(data, 0x0018, 0x0050, VR::DS, dicom_decimal(s_mm.z()));
  put_dicom(data, 0x0018, 0x1120, VR::DS, "0");
  put_dicom(data, 0x0020, 0x0013, VR::IS, std::to_string(slice + 1));
  put_dicom(data, 0x0020, 0x0032, VR::DS, triple(p_mm));
  put_dicom(data, 0x0020, 0x0037, VR::DS, triple(i) + "\\" + triple(j));
  put_dicom(data, 0x0028, 0x0030, VR::DS, dicom_decimal(s_mm.y()) + "\\" + dicom_decimal(s_mm.x()));
}

void put_pixels(gdcm::DataSet& data, const Volume& volume, int slice) {
  using gdcm::VR;
  put_dicom_number(data, 0x0028, 0x0002, 1);
  put_dicom(data, 0x0028, 0x0004, VR::CS, "MONOCHROME2");
  put_dicom_number(data, 0x0028, 0x0010, static_cast<std::uint16_t>(volume.frame.size[1]));
  put_dicom_number(data, 0x0028, 0x0011, static_cast<std::uint16_t>(volume.frame.size[0]));
  put_dicom_number(data, 0x0028, 0x0100, 16);
  put_dicom_number(data, 0x0028, 0x0101, 16);
  put_dicom_number(data, 0x0028, 0x0102, 15);
  put_dicom_number(data, 0x0028, 0x0103, 0);
  put_dicom(data, 0x0028, 0x1050, VR::DS, "400");
  put_dicom(data, 0x0028, 0x1051, VR::DS, "1800");
  put_dicom(data, 0x0028, 0x1052, VR::DS, "-1024");
  put_dicom(data, 0x0028, 0x1053, VR::DS, "1");
  const std::size_t first = volume.frame.index(0, 0, slice);
  const std::size_t count = volume.frame.index(0, 0, 1);
  std::string bytes;
  bytes.reserve(2 * count);
  for (std::size_t n = first; n < first + count; ++n) {
    const int stored = volume.values[n] + 1024;
    const auto word = static_cast<std::uint16_t>(stored < 0 ? 0 : stored);
    bytes += static_cast<char>(word & 0xff);
    bytes += static_cast<char>(word >> 8);
  }
  put_dicom(data, 0x7fe0, 0x0010, VR::OW, std::move(bytes));
}

Result<void> write_slice(const Volume& volume, int slice, const SeriesIds& ids,
                         const DicomWriteOptions& options, const std::filesystem::path& file) {
  gdcm::Writer writer;
  gdcm::DataSet& data = writer.GetFile().GetDataSet();
  put_identity(data, ids, options);
  put_dicom(data, 0x0008, 0x0018, gdcm::VR::UI,
            ids.series + "." + std::to_string(static_cast<unsigned>(slice) + 1));
  put_geometry(data, volume.frame, slice);
  put_pixels(data, volume, slice);
  return write_dicom_file(writer, file);
}

std::uint64_t hash_of(const Volume& volume) {
  Hasher hasher;
  for (const int n : volume.frame.size) hasher.add(n);
  hasher.add(volume.frame.spacing_m);
  hasher.add(volume.frame.origin_P);
  hasher.bytes(volume.values.data(), volume.values.size() * sizeof(std::int16_t));
  return hasher.value();
}

}  // namespace

Result<void> write_dicom(const Volume& volume, const std::filesystem::path& folder,
                         const DicomWriteOptions& options) {
  const std::uint64_t hash = hash_of(volume);
  const SeriesIds ids = {dicom_uid(options.seed, hash, 1), dicom_uid(options.seed, hash, 2),
                         dicom_uid(options.seed, hash, 3)};
  const int slices = volume.frame.size[2];
  for (int slice = 0; slice < slices; ++slice) {
    if (!goes_on(options.progress, "Writing slices", static_cast<double>(slice) / slices))
      return stopped();
    char name[16];
    std::snprintf(name, sizeof name, "%04d.dcm", slice + 1);
    auto written = write_slice(volume, slice, ids, options, folder / name);
    if (!written) return written;
  }
  return {};
}

}  // namespace osteon
