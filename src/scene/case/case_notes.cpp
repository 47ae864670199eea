#include "osteon/scene/case_notes.h"

#include <toml++/toml.h>

#include <exception>
#include <system_error>
#include <utility>

#include "case/case_toml_reader.h"
#include "numbers.h"
#include "osteon/base/file.h"

namespace osteon {
namespace {

constexpr const char* kNotesFile = "notes.toml";
constexpr std::uint64_t kNotesLimit_bytes = 1u << 20;
constexpr double kFarthestNote_m = 2;

std::string note_quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + "\"";
}

// What was written must be read again: TOML's reader knows what UTF-8 is.
bool is_one_line_of_utf8(const std::string& text) {
  for (const char c : text)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) return false;
  try {
    (void)toml::parse("text = " + note_quoted(text));
  } catch (const toml::parse_error&) {
    return false;
  }
  return true;
}

Result<CaseNote> read_note(const toml::table& table, const std::string& where, std::size_t number) {
  CaseTomlReader reader(table, where, "note " + std::to_string(number));
  reader.allow_only({"text", "bone", "position_m"});
  CaseNote note;
  note.text = reader.text("text");
  note.bone = reader.text_or("bone", "");
  note.p_F = reader.position("position_m");
  if (reader.error()) return tl::unexpected(*reader.error());
  const std::string place = case_toml_place(where, table.source());
  if (auto sound = check_note(note, place); !sound) return tl::unexpected(sound.error());
  return note;
}

Result<CaseNotes> read_notes(const toml::table& table, const std::string& where) {
  CaseTomlReader reader(table, where, "");
  reader.allow_only({"format", "notes"});
  (void)reader.number("format", {1, 1});
  const auto tables = reader.tables_or_empty("notes");
  if (tables.size() > kMostNotes) reader.set_error("there are more than 200 notes", "notes");
  if (reader.error()) return tl::unexpected(*reader.error());
  CaseNotes notes;
  for (const toml::table* one : tables) {
    auto note = read_note(*one, where, notes.size() + 1);
    if (!note) return tl::unexpected(note.error());
    notes.push_back(std::move(*note));
  }
  return notes;
}

}  // namespace

Result<void> check_note(const CaseNote& note, const std::string& where) {
  if (note.text.find_first_not_of(' ') == std::string::npos)
    return fail("the note has no text", where, "Write its text");
  if (note.text.size() > kLongestNote)
    return fail("the note has " + std::to_string(note.text.size()) + " bytes, more than " +
                    std::to_string(kLongestNote),
                where, "Shorten it, or write two notes");
  if (!is_one_line_of_utf8(note.text))
    return fail("the note is not one line of UTF-8 text", where, "Write it without line breaks");
  if (!note.p_F.allFinite() || note.p_F.norm() > kFarthestNote_m)
    return fail("the note's position is more than 2 m away", where, "Positions are in mm, World");
  return {};
}

Result<CaseNotes> parse_notes(std::string_view text, const std::string& where) {
  try {
    return read_notes(toml::parse(text), where);
  } catch (const toml::parse_error& e) {
    return fail("is not TOML: " + std::string(e.description()), case_toml_place(where, e.source()),
                "Fix the line");
  } catch (const std::exception& e) {
    return fail(std::string("cannot be read (") + e.what() + ")", where);
  }
}

std::string notes_text(const CaseNotes& notes) {
  std::string text =
      "# Notes on an Osteon case. Positions in metres, in the frame of the bone, else in World.\n"
      "format = 1\n";
  for (const CaseNote& note : notes) {
    text += "\n[[notes]]\ntext = " + note_quoted(note.text) + "\n";
    if (!note.bone.empty()) text += "bone = " + note_quoted(note.bone) + "\n";
    text += "position_m = [" + format_number(note.p_F.x()) + ", " + format_number(note.p_F.y()) +
            ", " + format_number(note.p_F.z()) + "]\n";
  }
  return text;
}

Result<CaseNotes> load_notes(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / kNotesFile;
  std::error_code ec;
  if (!std::filesystem::exists(file, ec)) return CaseNotes();
  const auto text = read_file(file, kNotesLimit_bytes);
  if (!text) return tl::unexpected(text.error());
  return parse_notes(*text, file.string());
}

Result<void> save_notes(const CaseNotes& notes, const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / kNotesFile;
  if (!notes.empty()) return write_file_atomic(file, notes_text(notes));
  std::error_code ec;
  std::filesystem::remove(file, ec);
  if (ec) return fail("cannot be removed (" + ec.message() + ")", file.string());
  return {};
}

}  // namespace osteon
