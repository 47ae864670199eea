#include <gdcmAttribute.h>
#include <gdcmTrace.h>
#include <gdcmUIDGenerator.h>
#include <gdcmWriter.h>

#include <cmath>
#include <cstdio>
#include <exception>
#include <sstream>

#include "osteon/base/file.h"
#include "osteon/base/hash.h"
#include "osteon/image/dicom.h"

namespace osteon {
namespace {

constexpr const char* kCtImageStorage = "1.2.840.10008.5.1.4.1.1.2";

/// Number written short enough for a decimal string (16 characters).
std::string decimal(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.10g", std::abs(value) < 1e-9 ? 0.0 : value);
  if (std::string(text).size() > 16) std::snprintf(text, sizeof text, "%.7e", value);
  return text;
}

void put(gdcm::DataSet& data, std::uint16_t group, std::uint16_t element, gdcm::VR vr,
         std::string text) {
  if (text.size() % 2) text += vr == gdcm::VR::UI ? '\0' : ' ';
  gdcm::DataElement entry(gdcm::Tag(group, element));
  entry.SetVR(vr);
  entry.SetByteValue(text.data(), static_cast<std::uint32_t>(text.size()));
  data.Replace(entry);
}

void put_number(gdcm::DataSet& data, std::uint16_t group, std::uint16_t element,
                std::uint16_t value) {
  const char bytes[2] = {static_cast<char>(value & 0xff), static_cast<char>(value >> 8)};
  put(data, group, element, gdcm::VR::US, std::string(bytes, 2));
}

/// UIDs under 2.25, the root for numbers drawn by anyone.
std::string make_uid(std::uint64_t seed, std::uint64_t hash, std::uint64_t part) {
  Hasher hasher;
  hasher.add(seed);
  hasher.add(hash);
  hasher.add(part);
  return "2.25." + std::to_string(hasher.value());
}

struct SeriesIds {
  std::string study, series, frame;
};

void put_identity(gdcm::DataSet& data, const SeriesIds& ids, const DicomWriteOptions& options) {
  using gdcm::VR;
  put(data, 0x0008, 0x0008, VR::CS, "DERIVED\\SECONDARY\\AXIAL");
  put(data, 0x0008, 0x0016, VR::UI, kCtImageStorage);
  put(data, 0x0008, 0x0020, VR::DA, "20000101");
  put(data, 0x0008, 0x0030, VR::TM, "000000");
  put(data, 0x0008, 0x0060, VR::CS, "CT");
  put(data, 0x0008, 0x0070, VR::LO, "Osteon");
  put(data, 0x0008, 0x103e, VR::LO, options.description);
  put(data, 0x0010, 0x0010, VR::PN, "VIRTUAL");
  put(data, 0x0010, 0x0020, VR::LO, "VIRTUAL");
  put(data, 0x0020, 0x000d, VR::UI, ids.study);
  put(data, 0x0020, 0x000e, VR::UI, ids.series);
  put(data, 0x0020, 0x0052, VR::UI, ids.frame);
  put(data, 0x0020, 0x0011, VR::IS, "1");
  put(data, 0x0018, 0x5100, VR::CS, "FFS");
}

void put_geometry(gdcm::DataSet& data, const GridFrame& frame, int slice) {
  using gdcm::VR;
  const Vec3 p_mm = frame.point_P(Vec3(0, 0, slice)) * 1000;
  const Vec3 i = frame.axes_P.col(0), j = frame.axes_P.col(1), s_mm = frame.spacing_m * 1000;
  const auto triple = [](const Vec3& v) {
    return decimal(v.x()) + "\\" + decimal(v.y()) + "\\" + decimal(v.z());
  };
  put(data, 0x0018, 0x0050, VR::DS, decimal(s_mm.z()));
  put(data, 0x0018, 0x1120, VR::DS, "0");
  put(data, 0x0020, 0x0013, VR::IS, std::to_string(slice + 1));
  put(data, 0x0020, 0x0032, VR::DS, triple(p_mm));
  put(data, 0x0020, 0x0037, VR::DS, triple(i) + "\\" + triple(j));
  put(data, 0x0028, 0x0030, VR::DS, decimal(s_mm.y()) + "\\" + decimal(s_mm.x()));
}

void put_pixels(gdcm::DataSet& data, const Volume& volume, int slice) {
  using gdcm::VR;
  put_number(data, 0x0028, 0x0002, 1);
  put(data, 0x0028, 0x0004, VR::CS, "MONOCHROME2");
  put_number(data, 0x0028, 0x0010, static_cast<std::uint16_t>(volume.frame.size[1]));
  put_number(data, 0x0028, 0x0011, static_cast<std::uint16_t>(volume.frame.size[0]));
  put_number(data, 0x0028, 0x0100, 16);
  put_number(data, 0x0028, 0x0101, 16);
  put_number(data, 0x0028, 0x0102, 15);
  put_number(data, 0x0028, 0x0103, 0);
  put(data, 0x0028, 0x1050, VR::DS, "400");
  put(data, 0x0028, 0x1051, VR::DS, "1800");
  put(data, 0x0028, 0x1052, VR::DS, "-1024");
  put(data, 0x0028, 0x1053, VR::DS, "1");
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
  put(data, 0x7fe0, 0x0010, VR::OW, std::move(bytes));
}

Result<void> write_slice(const Volume& volume, int slice, const SeriesIds& ids,
                         const DicomWriteOptions& options, const std::filesystem::path& file) {
  gdcm::Writer writer;
  gdcm::DataSet& data = writer.GetFile().GetDataSet();
  put_identity(data, ids, options);
  put(data, 0x0008, 0x0018, gdcm::VR::UI,
      ids.series + "." + std::to_string(static_cast<unsigned>(slice) + 1));
  put_geometry(data, volume.frame, slice);
  put_pixels(data, volume, slice);
  writer.GetFile().GetHeader().SetDataSetTransferSyntax(
      gdcm::TransferSyntax::ExplicitVRLittleEndian);
  // Into memory first: GDCM aborts when a disk is full.
  std::ostringstream bytes;
  writer.SetStream(bytes);
  if (!writer.Write()) return fail("cannot be made", file.string());
  return write_file_atomic(file, bytes.str());
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
  gdcm::Trace::WarningOff();
  gdcm::Trace::ErrorOff();
  const std::uint64_t hash = hash_of(volume);
  const SeriesIds ids = {make_uid(options.seed, hash, 1), make_uid(options.seed, hash, 2),
                         make_uid(options.seed, hash, 3)};
  const int slices = volume.frame.size[2];
  for (int slice = 0; slice < slices; ++slice) {
    if (!goes_on(options.progress, "Writing slices", static_cast<double>(slice) / slices))
      return stopped();
    char name[16];
    std::snprintf(name, sizeof name, "%04d.dcm", slice + 1);
    try {
      auto written = write_slice(volume, slice, ids, options, folder / name);
      if (!written) return written;
    } catch (const std::exception& e) {
      return fail(std::string("cannot be written (") + e.what() + ")", (folder / name).string(),
                  "Check that the disk has room");
    }
  }
  return {};
}

}  // namespace osteon
