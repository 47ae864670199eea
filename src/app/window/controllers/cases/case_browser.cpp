#include "window/controllers/cases/case_browser.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string_view>
#include <system_error>
#include <utility>

#include "cases/felt_choice.h"
#include "cases/xdg.h"
#include "osteon/image/dicom.h"
#include "osteon/mesh/mesh_io.h"
#include "ui/label.h"

namespace osteon {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kMostEntries = 2000, kMostRecent = 12, kMostKnown = 40;
constexpr std::size_t kLookedAt = 200;  // names in a folder, to tell what it holds
constexpr std::size_t kLookedInto = 8;  // files in it, where their names do not tell
constexpr std::array<std::string_view, 7> kScans = {".nrrd", ".nhdr",   ".nii", ".mha",
                                                    ".mhd",  ".nii.gz", ".inv3"};
constexpr std::array<std::string_view, 2> kSlices = {".dcm", ".ima"};
constexpr const char* kBuiltinPrefix = "builtin:";

template <class Endings>
bool ends_as(const fs::path& file, const Endings& endings) {
  std::string name = file.filename().string();
  for (char& c : name)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return std::any_of(endings.begin(), endings.end(),
                     [&](std::string_view end) { return name.ends_with(end); });
}

// DICOM files often have no ending, or one that counts them.
bool may_be_dicom(const fs::path& file) {
  const std::string ending = file.extension().string();
  return ending.empty() ||
         std::all_of(ending.begin() + 1, ending.end(), [](char c) { return c >= '0' && c <= '9'; });
}

bool is_slice(const fs::path& file, std::size_t& may_look_into) {
  if (ends_as(file, kSlices)) return true;
  if (!may_be_dicom(file) || may_look_into == 0) return false;
  --may_look_into;
  return is_dicom_file(file);
}

const char* about(OpenKind kind) {
  switch (kind) {
    case OpenKind::kFolder:
      return "folder";
    case OpenKind::kCase:
      return "case";
    case OpenKind::kRecording:
      return "recording";
    case OpenKind::kMeshes:
      return "meshes to import";
    case OpenKind::kScan:
      return "scan, opened for segmentation";
    case OpenKind::kNothing:
      break;
  }
  return "";
}

// A folder of slices or meshes is opened as a whole; with folders in it, it is looked into.
OpenKind kind_of_folder(const fs::path& folder) {
  std::error_code ec;
  if (fs::exists(folder / "case.toml", ec)) return OpenKind::kCase;
  std::size_t meshes = 0, slices = 0, folders = 0, looked_at = 0, may_look_into = kLookedInto;
  for (fs::directory_iterator at(folder, ec), end; !ec && at != end && looked_at < kLookedAt;
       at.increment(ec), ++looked_at) {
    std::error_code ignored;
    if (at->is_directory(ignored))
      ++folders;
    else if (is_mesh_file(at->path()))
      ++meshes;
    else if (is_slice(at->path(), may_look_into))
      ++slices;
  }
  if (folders == 0 && meshes > 0) return OpenKind::kMeshes;
  if (folders == 0 && slices > 1) return OpenKind::kScan;
  return OpenKind::kFolder;
}

std::string name_of(const std::string& path) {
  if (path.starts_with(kBuiltinPrefix))
    return label_of(path.substr(std::string_view(kBuiltinPrefix).size()));
  const fs::path file = path;
  return file.has_filename() ? file.filename().string() : file.parent_path().filename().string();
}

OpenEntry entry_of(const std::string& path, const std::string& where = {}) {
  const OpenKind kind = kind_of(path);
  const std::string text = where.empty() ? about(kind) : where;
  return {kind, name_of(path), text, path};
}

bool before(const OpenEntry& a, const OpenEntry& b) {
  const bool a_folder = a.kind == OpenKind::kFolder, b_folder = b.kind == OpenKind::kFolder;
  return a_folder != b_folder ? a_folder : a.label < b.label;
}

}  // namespace

OpenKind kind_of(const std::string& path) {
  if (path.starts_with(kBuiltinPrefix)) return OpenKind::kCase;
  std::error_code ec;
  const fs::path plain = source_without_choice(path);
  if (fs::is_directory(plain, ec)) return kind_of_folder(plain);
  if (!fs::is_regular_file(plain, ec)) return OpenKind::kNothing;
  if (plain.extension() == ".osr") return OpenKind::kRecording;
  if (plain.filename() == "case.toml") return OpenKind::kCase;
  if (is_mesh_file(plain)) return OpenKind::kMeshes;
  std::size_t may_look_into = 1;
  const bool scan = ends_as(plain, kScans) || is_slice(plain, may_look_into);
  return scan ? OpenKind::kScan : OpenKind::kNothing;
}

std::vector<std::string> with_recent(std::vector<std::string> recent, const std::string& name) {
  std::erase(recent, name);
  recent.insert(recent.begin(), name);
  if (recent.size() > kMostRecent) recent.resize(kMostRecent);
  return recent;
}

// Names carry their date: the newest is the last by name.
void CaseBrowser::add_folder_of(const fs::path& folder, const char* what) {
  std::vector<OpenEntry> found;
  std::error_code ec;
  for (fs::directory_iterator at(folder, ec), end; !ec && at != end; at.increment(ec)) {
    OpenEntry entry = entry_of(at->path().string(), what);
    if (std::any_of(model_.known.begin(), model_.known.end(),
                    [&](const OpenEntry& known) { return known.path == entry.path; }))
      continue;
    if (entry.kind == OpenKind::kCase || entry.kind == OpenKind::kRecording)
      found.push_back(std::move(entry));
  }
  std::sort(found.begin(), found.end(),
            [](const OpenEntry& a, const OpenEntry& b) { return a.label > b.label; });
  if (found.size() > kMostKnown) found.resize(kMostKnown);
  model_.known.insert(model_.known.end(), found.begin(), found.end());
}

void CaseBrowser::toggle(const std::vector<std::string>& recent) {
  model_.open = !model_.open;
  if (!model_.open) return;
  model_.known.clear();
  model_.known.push_back(entry_of("builtin:wrist", "built in"));
  model_.known.push_back(entry_of("builtin:knee", "built in"));
  for (const std::string& path : recent)
    if (!path.starts_with(kBuiltinPrefix) && kind_of(path) != OpenKind::kNothing)
      model_.known.push_back(entry_of(path, "opened recently"));
  add_folder_of(home_ / "cases", "saved patient");
  add_folder_of(home_ / "recordings", "recording");
  if (!folder_.empty()) return look_into(folder_);
  const char* const home = std::getenv("HOME");
  look_into(home && *home ? fs::path(home) : fs::current_path());
}

void CaseBrowser::look_into(const fs::path& folder) {
  std::error_code ec;
  folder_ = fs::absolute(folder, ec).lexically_normal();
  if (!folder_.has_filename() && folder_.has_parent_path()) folder_ = folder_.parent_path();
  model_.folder = folder_.string();
  model_.files.clear();
  model_.problem.clear();
  fs::directory_iterator at(folder_, ec), end;
  for (; !ec && at != end && model_.files.size() < kMostEntries; at.increment(ec)) {
    const std::string name = at->path().filename().string();
    if (name.empty() || name[0] == '.') continue;
    OpenEntry entry = entry_of(at->path().string());
    if (entry.kind != OpenKind::kNothing) model_.files.push_back(std::move(entry));
  }
  if (ec) model_.problem = ec.message();
  std::sort(model_.files.begin(), model_.files.end(), before);
}

void CaseBrowser::import(const std::vector<fs::path>& sources) {
  if (import_ || sources.empty()) return;
  const fs::path& source = sources.front();
  ImportOptions options;
  options.source = source;
  if (sources.size() > 1) options.files = sources;
  options.in_window = true;
  options.metres_per_unit = model_.in_millimetres ? 1e-3 : 1;
  const fs::path named = sources.size() > 1 ? source.parent_path() : source;
  options.out = dated_file(home_ / "cases", named.stem().string(), "");
  struct Stopped {};
  import_ = std::make_unique<SideJob<std::string>>(
      [options](const Progress& progress) mutable -> Result<std::string> {
        options.progress = [&progress](double share) {
          if (!progress("Reading the meshes", share)) throw Stopped{};
        };
        try {
          const auto imported = import_meshes(options);
          if (!imported) return tl::unexpected(imported.error());
          return options.out.string();
        } catch (const Stopped&) {
          return std::string();
        }
      });
}

void CaseBrowser::stop_import() {
  if (import_) import_->cancel();
}

Result<std::string> CaseBrowser::take_imported() {
  if (!import_ || !import_->done()) return std::string();
  Result<std::string> made = import_->take();
  import_.reset();
  return made;
}

BrowserModel CaseBrowser::model() const {
  BrowserModel model = model_;
  model.importing = import_ != nullptr;
  if (import_) model.fraction = import_->progress().fraction;
  return model;
}

}  // namespace osteon
