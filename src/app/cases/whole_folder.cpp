#include "cases/whole_folder.h"

#include <system_error>

#include "osteon/base/links.h"

namespace osteon {
namespace fs = std::filesystem;
namespace {

fs::path unused_sibling(const fs::path& out) {
  std::error_code ec;
  for (int n = 1;; ++n) {
    fs::path sibling = out;
    sibling += ".part" + std::to_string(n);
    if (!fs::exists(sibling, ec)) return sibling;
  }
}

}  // namespace

fs::path plain_folder(const fs::path& folder) {
  const fs::path path = folder.lexically_normal();
  return path.has_filename() ? path : path.parent_path();
}

Result<void> refuse_existing(const fs::path& out) {
  std::error_code ec;
  if (!fs::exists(out, ec)) return {};
  if (fs::is_directory(out, ec) && fs::is_empty(out, ec)) return {};
  return fail("already exists", out.string(), "Choose a new folder, or remove the old one first");
}

Result<void> write_whole_folder(const fs::path& out,
                                const std::function<Result<void>(const fs::path& part)>& write) {
  const fs::path target = behind_links(out);
  const fs::path part = unused_sibling(target);
  auto written = write(part);
  std::error_code ec;
  if (written) {
    fs::rename(part, target, ec);
    if (!ec) return {};
    written =
        fail("could not be made (" + ec.message() + ")", out.string(), "Choose another folder");
  }
  fs::remove_all(part, ec);
  return written;
}

}  // namespace osteon
