#include <algorithm>
#include <fstream>
#include <map>
#include <system_error>

#include "dicom/dicom_header.h"
#include "osteon/image/dicom.h"

namespace osteon {
namespace fs = std::filesystem;
namespace {

Result<std::vector<fs::path>> files_in(const fs::path& folder) {
  std::error_code ec;
  fs::directory_iterator entries(folder, ec);
  if (ec) return fail("cannot be read (" + ec.message() + ")", folder.string(), "Check the name");
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : entries)
    if (entry.is_regular_file(ec) && is_dicom_file(entry.path())) files.push_back(entry.path());
  if (files.empty())
    return fail("holds no DICOM files", folder.string(),
                "Name the folder that holds the slices of the series themselves");
  std::sort(files.begin(), files.end());
  return files;
}

std::string describe(const DicomSeries& series) {
  return std::to_string(series.number) + " (" + series.modality + ", " +
         std::to_string(series.files.size()) + " files, " + series.uid + ")";
}

Result<std::vector<DicomSeries>> group(const std::vector<fs::path>& files) {
  std::map<std::string, DicomSeries> by_uid;
  for (const fs::path& file : files) {
    const auto header = read_dicom_header(file);
    if (!header) return tl::unexpected(header.error());
    // Scouts show where the slices were planned; they are no slices.
    if (header->image_type.find("LOCALIZER") != std::string::npos) continue;
    // Reports of the dose and their like come along with many scans.
    if (!header->has_pixels) continue;
    DicomSeries& series = by_uid[header->series_uid];
    series.uid = header->series_uid;
    series.modality = header->modality;
    series.number = header->series_number;
    series.files.push_back(file);
  }
  std::vector<DicomSeries> all;
  for (auto& [uid, series] : by_uid) all.push_back(std::move(series));
  std::stable_sort(all.begin(), all.end(),
                   [](const auto& a, const auto& b) { return a.number < b.number; });
  return all;
}

}  // namespace

bool is_dicom_file(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  char start[132] = {};
  in.read(start, sizeof start);
  return in.gcount() == sizeof start && std::string(start + 128, 4) == "DICM" &&
         file.filename() != "DICOMDIR";
}

Result<std::vector<DicomSeries>> list_dicom_series(const fs::path& source) {
  std::error_code ec;
  const bool folder = fs::is_directory(source, ec);
  const auto files = files_in(folder                         ? source
                              : source.parent_path().empty() ? fs::path(".")
                                                             : source.parent_path());
  if (!files) return tl::unexpected(files.error());
  auto all = group(*files);
  if (!all || folder) return all;
  const auto header = read_dicom_header(source);
  if (!header) return tl::unexpected(header.error());
  std::erase_if(*all, [&](const DicomSeries& s) { return s.uid != header->series_uid; });
  return all;
}

Result<DicomSeries> choose_series(const std::vector<DicomSeries>& all, const std::string& wanted,
                                  const std::string& where) {
  std::vector<const DicomSeries*> fitting;
  std::string list;
  for (const DicomSeries& series : all) {
    list += (list.empty() ? "" : "; ") + describe(series);
    const bool fits = wanted.empty()
                          ? series.modality == "CT"
                          : wanted == series.uid || wanted == std::to_string(series.number);
    if (fits) fitting.push_back(&series);
  }
  if (fitting.size() == 1) return *fitting.front();
  if (all.empty()) return fail("holds no series of slices", where, "Choose another folder");
  if (fitting.empty() && wanted.empty())
    return fail("holds no CT series, only: " + list, where,
                "CT is needed, because bone is found by its Hounsfield units");
  if (fitting.empty())
    return fail("has no series '" + wanted + "', only: " + list, where, "Choose one with --series");
  return fail("holds several series: " + list, where, "Choose one with --series NUMBER or UID");
}

}  // namespace osteon
