#include "osteon/record/recording_note.h"

#include "database.h"
#include "format.h"
#include "recording_meta.h"

namespace osteon {
namespace {

constexpr std::size_t kLongestName = 60;
constexpr std::size_t kLongestNote = std::size_t{4} << 20;

// Never a key of the header's own.
std::string note_key(std::string_view name) { return "note_" + std::string(name); }

}  // namespace

Result<void> write_note(const std::filesystem::path& recording, std::string_view name,
                        std::string_view text) {
  if (name.empty() || name.size() > kLongestName || text.size() > kLongestNote)
    return fail("the note '" + std::string(name.substr(0, kLongestName)) +
                    "' is too long or has "
                    "no name",
                recording.string());
  auto database = Database::reopen(recording);
  if (!database) return tl::unexpected(database.error());
  if (auto sound = check_format(*database); !sound) return sound;
  auto statement = database->prepare("INSERT OR REPLACE INTO meta(key, value) VALUES(?, ?)");
  if (!statement) return tl::unexpected(statement.error());
  const std::string key = note_key(name);
  statement->bind_text(1, key);
  statement->bind_text(2, text);
  return statement->run();
}

Result<std::optional<std::string>> read_note(const std::filesystem::path& recording,
                                             std::string_view name) {
  auto database = Database::open(recording);
  if (!database) return tl::unexpected(database.error());
  if (auto sound = check_format(*database); !sound) return tl::unexpected(sound.error());
  const auto meta = read_meta(*database);
  if (!meta) return tl::unexpected(meta.error());
  const auto found = meta->find(note_key(name));
  if (found == meta->end()) return std::optional<std::string>{};
  return std::optional<std::string>(found->second);
}

}  // namespace osteon
