#include "new_file.h"

namespace osteon {

namespace fs = std::filesystem;

fs::path unfinished_name(const fs::path& file) {
  fs::path name = file;
  name += ".part";
  return name;
}

Result<void> name_new_file(const fs::path& file) {
  const fs::path part = unfinished_name(file);
  std::error_code error;
  // A link never replaces a file; a rename may.
  fs::create_hard_link(part, file, error);
  const bool linked = !error;
  std::error_code ignored;
  if (!linked && !fs::exists(fs::symlink_status(file, ignored)))
    fs::rename(part, file, error);  // no links on this disk
  if (linked || error) fs::remove(part, ignored);
  if (error)
    return fail("the recording cannot be made (" + error.message() + ")", file.string(),
                "Give the name of a new file in a writable folder");
  return {};
}

}  // namespace osteon
