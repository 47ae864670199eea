#include "osteon/results/names.h"

#include <nlohmann/json.hpp>
#include <system_error>

#include "osteon/base/file.h"

namespace osteon {

Result<LearnerNames> load_names(const std::filesystem::path& file) {
  std::error_code ec;
  if (!std::filesystem::exists(file, ec)) return LearnerNames{};
  const auto text = read_file(file, 64u << 20);
  if (!text) return tl::unexpected(text.error());
  try {
    return nlohmann::json::parse(*text).get<LearnerNames>();
  } catch (const nlohmann::json::exception& e) {
    return fail(std::string("is not a map of names (") + e.what() + ")", file.string(),
                "Correct it or move it away");
  }
}

Result<void> save_names(const LearnerNames& names, const std::filesystem::path& file) {
  std::error_code ec;
  if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path(), ec);
  return write_file_atomic(file, nlohmann::json(names).dump(2) + "\n");
}

}  // namespace osteon
