#include "dicom/dicom_put.h"

#include <gdcmTrace.h>
#include <gdcmWriter.h>

#include <cmath>
#include <cstdio>
#include <exception>
#include <sstream>
#include <utility>

#include "osteon/base/file.h"
#include "osteon/base/hash.h"

namespace osteon {

std::string dicom_decimal(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.10g", std::abs(value) < 1e-9 ? 0.0 : value);
  if (std::string(text).size() > 16) std::snprintf(text, sizeof text, "%.7e", value);
  return text;
}

void put_dicom(gdcm::DataSet& data, std::uint16_t group, std::uint16_t element, gdcm::VR vr,
               std::string text) {
  if (text.size() % 2) text += vr == gdcm::VR::UI ? '\0' : ' ';
  gdcm::DataElement entry(gdcm::Tag(group, element));
  entry.SetVR(vr);
  entry.SetByteValue(text.data(), static_cast<std::uint32_t>(text.size()));
  data.Replace(entry);
}

void put_dicom_number(gdcm::DataSet& data, std::uint16_t group, std::uint16_t element,
                      std::uint16_t value) {
  const char bytes[2] = {static_cast<char>(value & 0xff), static_cast<char>(value >> 8)};
  put_dicom(data, group, element, gdcm::VR::US, std::string(bytes, 2));
}

void put_dicom_nobody(gdcm::DataSet& data) {
  using gdcm::VR;
  put_dicom(data, 0x0008, 0x0020, VR::DA, "20000101");
  put_dicom(data, 0x0008, 0x0030, VR::TM, "000000");
  put_dicom(data, 0x0008, 0x0070, VR::LO, "Osteon");
  put_dicom(data, 0x0010, 0x0010, VR::PN, "VIRTUAL");
  put_dicom(data, 0x0010, 0x0020, VR::LO, "VIRTUAL");
}

std::string dicom_uid(std::uint64_t seed, std::uint64_t hash, std::uint64_t part) {
  Hasher hasher;
  hasher.add(seed);
  hasher.add(hash);
  hasher.add(part);
  return "2.25." + std::to_string(hasher.value());
}

Result<void> write_dicom_file(gdcm::Writer& writer, const std::filesystem::path& file) {
  gdcm::Trace::WarningOff();
  gdcm::Trace::ErrorOff();
  try {
    writer.GetFile().GetHeader().SetDataSetTransferSyntax(
        gdcm::TransferSyntax::ExplicitVRLittleEndian);
    // Into memory first: GDCM aborts when a disk is full.
    std::ostringstream bytes;
    writer.SetStream(bytes);
    if (!writer.Write()) return fail("cannot be made", file.string());
    return write_file_atomic(file, bytes.str());
  } catch (const std::exception& e) {
    return fail(std::string("cannot be written (") + e.what() + ")", file.string(),
                "Check the free space on the disk");
  }
}

}  // namespace osteon
