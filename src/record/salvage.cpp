#include "salvage.h"

#include <array>
#include <cstdint>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "database.h"
#include "osteon/scene/state.h"
#include "recording_meta.h"

namespace osteon {
namespace {

namespace fs = std::filesystem;

// The header of an SQLite file (sqlite.org/fileformat2.html, 1.3): numbers are big-endian.
constexpr std::size_t kHeaderBytes = 100, kPageSizeAt = 16, kPageCountAt = 28;
constexpr std::string_view kMagic{"SQLite format 3\0", 16};

struct FileSize {
  std::uint64_t page_bytes = 0, pages = 0;  // as the header says
  std::uint64_t bytes = 0;                  // as it is
};

std::uint64_t big_endian(const std::array<char, kHeaderBytes>& header, std::size_t at,
                         std::size_t count) {
  std::uint64_t value = 0;
  for (std::size_t i = at; i < at + count; ++i)
    value = value << 8 | static_cast<unsigned char>(header[i]);
  return value;
}

std::optional<FileSize> size_of(const fs::path& file) {
  std::array<char, kHeaderBytes> header{};
  std::ifstream in(file, std::ios::binary);
  if (!in.read(header.data(), header.size())) return {};
  if (std::string_view(header.data(), kMagic.size()) != kMagic) return {};
  std::error_code error;
  FileSize size{big_endian(header, kPageSizeAt, 2), big_endian(header, kPageCountAt, 4),
                fs::file_size(file, error)};
  if (size.page_bytes == 1) size.page_bytes = 65536;
  if (error || size.page_bytes < 512) return {};
  return size;
}

// Makes the file one of whole pages, and its header say so: SQLite then reads what is there, and
// calls damaged only what refers to a page beyond the end.
bool accept_the_end(const fs::path& file) {
  const auto size = size_of(file);
  const std::uint64_t pages = size ? size->bytes / size->page_bytes : 0;
  if (pages == 0) return false;
  std::error_code error;
  fs::resize_file(file, pages * size->page_bytes, error);
  if (error) return false;
  std::fstream out(file, std::ios::binary | std::ios::in | std::ios::out);
  out.seekp(kPageCountAt);
  for (int shift = 24; shift >= 0; shift -= 8) out.put(static_cast<char>(pages >> shift & 0xff));
  return static_cast<bool>(out.flush());
}

struct Copied {
  std::string select, insert;
  int columns = 0;
};

void bind_column(const Statement& from, int column, Statement& to) {
  if (from.is_integer(column))
    to.bind(column + 1, from.integer(column));
  else if (from.is_text(column))
    to.bind_text(column + 1, from.bytes(column));
  else
    to.bind_blob(column + 1, from.bytes(column));
}

// True when all rows could be read. A row that cannot be read is the end, no error.
Result<bool> copy_rows(Database& from, Database& to, const Copied& rows) {
  auto source = from.prepare(rows.select.c_str());
  if (!source) return false;
  auto target = to.prepare(rows.insert.c_str());
  if (!target) return tl::unexpected(target.error());
  for (;;) {
    const auto row = source->next();
    if (!row) return false;
    if (!*row) return true;
    for (int column = 0; column < rows.columns; ++column) bind_column(*source, column, *target);
    if (const auto done = target->run(); !done) return tl::unexpected(done.error());
  }
}

Result<void> copy_tables(Database& from, Database& to) {
  const Copied meta{
      "SELECT key, value FROM meta WHERE key NOT IN ('complete', 'ticks', 'events', 'steps')",
      "INSERT INTO meta VALUES(?, ?)", 2};
  const auto whole = copy_rows(from, to, meta);
  if (!whole) return tl::unexpected(whole.error());
  if (!*whole)
    return fail("the recording is cut short, and too little of it is left to read its beginning",
                to.name(), "Copy it again from the computer that recorded it");
  const std::string insert_chunk = " VALUES(?, ?, ?, ?, ?)";
  std::vector<Copied> tables;
  for (std::size_t h = 0; h < kMaxHands; ++h)
    tables.push_back({"SELECT * FROM ticks WHERE hand = " + std::to_string(h) + " ORDER BY first",
                      "INSERT INTO ticks VALUES(?, ?, ?, ?, ?, ?)", 6});
  for (const std::string table : {"steps", "events"})
    tables.push_back(
        {"SELECT * FROM " + table + " ORDER BY first", "INSERT INTO " + table + insert_chunk, 5});
  tables.push_back(
      {"SELECT * FROM states ORDER BY step", "INSERT INTO states VALUES(?, ?, ?, ?, ?, ?, ?)", 7});
  for (const Copied& table : tables)
    if (const auto copied = copy_rows(from, to, table); !copied)
      return tl::unexpected(copied.error());
  return {};
}

}  // namespace

bool is_cut_short(const fs::path& file) {
  const auto size = size_of(file);
  if (!size || size->bytes >= size->pages * size->page_bytes) return false;
  std::error_code error;
  const std::uintmax_t log = fs::file_size(file.string() + "-wal", error);
  return error || log == 0;
}

Result<void> salvage(const fs::path& cut, const fs::path& into) {
  // Symbols: a recording is an SQLite file; its rows lie in trees of pages, and pages are taken in
  // the order in which they are needed. Invariant: rows are copied in the order of their numbers,
  // so each table of `into` is a beginning of the table that was, without a gap. Ends: each row is
  // read once, and the first that refers to a page beyond the end is the last.
  if (!accept_the_end(cut))
    return fail("the recording is cut short before its first page", cut.string(),
                "Copy it again from the computer that recorded it");
  auto from = Database::reopen(cut);
  if (!from) return tl::unexpected(from.error());
  auto to = Database::create(into);
  if (!to) return tl::unexpected(to.error());
  if (const auto done = to->run("BEGIN"); !done) return done;
  if (const auto done = make_tables(*to); !done) return done;
  if (const auto done = copy_tables(*from, *to); !done) return done;
  return to->run("COMMIT");
}

}  // namespace osteon
