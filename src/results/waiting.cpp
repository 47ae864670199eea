#include <algorithm>
#include <system_error>

#include "osteon/base/file.h"
#include "osteon/results/store.h"

namespace osteon {

namespace fs = std::filesystem;

Result<KeptAttempt> keep_attempt(const AttemptRow& row, const std::string& store,
                                 const fs::path& waiting, double wait_s) {
  std::error_code ec;
  fs::create_directories(waiting, ec);
  const fs::path file = waiting / (row.id + ".json");
  const auto written = write_file_atomic(file, to_json(row));
  auto opened = ResultStore::open(store, wait_s);
  const Result<bool> added =
      opened ? opened->add(row) : Result<bool>(tl::unexpected(opened.error()));
  if (added) {
    fs::remove(file, ec);
    return KeptAttempt{true, {}};
  }
  if (!written) return tl::unexpected(written.error());
  Error why = added.error();
  why.todo = "The attempt waits in " + file.string() + " and is added by the next results command";
  return KeptAttempt{false, why};
}

Result<int> take_waiting(ResultStore& store, const fs::path& waiting) {
  std::error_code ec;
  std::vector<fs::path> files;
  if (!fs::is_directory(waiting, ec)) return 0;
  for (const auto& entry : fs::directory_iterator(waiting, ec))
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  int taken = 0;
  for (const fs::path& file : files) {
    const auto text = read_file(file, 64u << 20);
    if (!text && !fs::exists(file, ec)) continue;  // another program was quicker
    if (!text) return tl::unexpected(text.error());
    const auto row = parse_attempt_row(*text, file.string());
    if (!row) return tl::unexpected(row.error());
    if (const auto added = store.add(*row); !added) return tl::unexpected(added.error());
    fs::remove(file, ec);
    ++taken;
  }
  return taken;
}

}  // namespace osteon
