#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "osteon/base/result.h"

namespace osteon {

/// A folder as someone sees it who looks for a scan in it.
struct ScanFolder {
  struct Entry {
    std::string name;
    std::filesystem::path path;
    bool is_folder = false;
  };
  std::filesystem::path path;
  std::vector<Entry> entries;  ///< folders, then files that hold a scan each; by their names
  std::size_t dicom_files = 0, pictures = 0;  ///< that make one scan of the folder itself
  bool more = false;                          ///< not all is listed
  std::string problem;                        ///< why it cannot be read; empty: it can
};

/// Hidden entries and files that no reader takes are left out. Reads the start of files without an
/// ending to see whether they are DICOM.
ScanFolder list_scan_folder(const std::filesystem::path& folder);

/// What to look at when these were dropped or chosen together: one path is itself, several files of
/// one folder are slices of the scan in that folder. Fails when they lie in several folders.
Result<std::filesystem::path> scan_among(const std::vector<std::string>& paths);

}  // namespace osteon
