#include "segment/scan_folder.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <system_error>

#include "cases/whole_folder.h"
#include "osteon/image/dicom.h"

namespace osteon {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kMostEntries = 2000, kMostLookedInto = 50;
constexpr std::array<std::string_view, 7> kScanEndings = {".nrrd",   ".nhdr", ".nii", ".mha",
                                                          ".nii.gz", ".mhd",  ".inv3"};
constexpr std::array<std::string_view, 2> kDicomEndings = {".dcm", ".ima"};
constexpr std::array<std::string_view, 3> kPictureEndings = {".png", ".tif", ".tiff"};

std::string lower(std::string text) {
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return text;
}

template <class Endings>
bool ends_as(const std::string& name, const Endings& endings) {
  return std::any_of(endings.begin(), endings.end(),
                     [&](std::string_view end) { return name.ends_with(end); });
}

class FolderLister {
 public:
  explicit FolderLister(ScanFolder& out) : out_(out) {}

  void add(const fs::directory_entry& entry) {
    const std::string name = entry.path().filename().string();
    if (name.empty() || name[0] == '.') return;
    std::error_code ec;
    if (entry.is_directory(ec)) return list(entry, true);
    if (!entry.is_regular_file(ec)) return;
    const std::string ending = lower(name);
    if (ends_as(ending, kScanEndings)) return list(entry, false);
    if (ends_as(ending, kPictureEndings)) ++out_.pictures;
    if (is_dicom(entry.path(), ending)) ++out_.dicom_files;
  }

 private:
  void list(const fs::directory_entry& entry, bool is_folder) {
    if (out_.entries.size() < kMostEntries)
      out_.entries.push_back({entry.path().filename().string(), entry.path(), is_folder});
    else
      out_.more = true;
  }

  /// DICOM files often have no ending, or one that counts them: a few are looked into.
  bool is_dicom(const fs::path& file, const std::string& name) {
    if (ends_as(name, kDicomEndings)) return true;
    if (ends_as(name, kPictureEndings) || looked_into_ >= kMostLookedInto) return false;
    ++looked_into_;
    return is_dicom_file(file);
  }

  ScanFolder& out_;
  std::size_t looked_into_ = 0;
};

}  // namespace

ScanFolder list_scan_folder(const fs::path& folder) {
  ScanFolder out;
  std::error_code ec;
  out.path = fs::absolute(folder, ec).lexically_normal();
  if (!out.path.has_filename() && out.path.has_parent_path()) out.path = out.path.parent_path();
  fs::directory_iterator at(out.path, ec), end;
  FolderLister lister(out);
  for (; !ec && at != end; at.increment(ec)) lister.add(*at);
  if (ec) out.problem = ec.message();
  std::sort(out.entries.begin(), out.entries.end(), [](const auto& a, const auto& b) {
    return a.is_folder != b.is_folder ? a.is_folder : a.name < b.name;
  });
  return out;
}

Result<std::filesystem::path> scan_among(const std::vector<std::string>& paths) {
  if (paths.empty()) return fail("nothing was chosen");
  const fs::path first = plain_folder(paths.front());
  if (paths.size() == 1) return first;
  const bool together = std::all_of(paths.begin(), paths.end(), [&](const std::string& path) {
    return plain_folder(path).parent_path() == first.parent_path();
  });
  if (!together)
    return fail("these lie in several folders", first.parent_path().string(),
                "Choose one file, one folder, or slices of one folder");
  return first.parent_path();
}

}  // namespace osteon
