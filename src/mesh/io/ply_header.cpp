#include "io/ply_header.h"

#include <utility>

#include "io/words.h"

namespace osteon {
namespace {

std::optional<PlyType> type_of(std::string_view word) {
  static constexpr std::pair<std::string_view, PlyType> kTypes[] = {
      {"char", PlyType::kInt8},      {"int8", PlyType::kInt8},       {"uchar", PlyType::kUint8},
      {"uint8", PlyType::kUint8},    {"short", PlyType::kInt16},     {"int16", PlyType::kInt16},
      {"ushort", PlyType::kUint16},  {"uint16", PlyType::kUint16},   {"int", PlyType::kInt32},
      {"int32", PlyType::kInt32},    {"uint", PlyType::kUint32},     {"uint32", PlyType::kUint32},
      {"float", PlyType::kFloat32},  {"float32", PlyType::kFloat32}, {"double", PlyType::kFloat64},
      {"float64", PlyType::kFloat64}};
  for (const auto& [name, type] : kTypes)
    if (name == word) return type;
  return {};
}

bool parse_format(Words& words, PlyHeader& header) {
  const std::string_view format = words.next_on_line();
  if (format == "ascii")
    header.format = PlyFormat::kAscii;
  else if (format == "binary_little_endian")
    header.format = PlyFormat::kLittleEndian;
  else if (format == "binary_big_endian")
    header.format = PlyFormat::kBigEndian;
  else
    return false;
  return words.next_on_line() == "1.0";
}

bool parse_element(Words& words, PlyHeader& header) {
  PlyElement element;
  element.name = words.next_on_line();
  long long count = 0;
  if (element.name.empty() || !parse_integer(words.next_on_line(), count) || count < 0)
    return false;
  element.count = static_cast<std::uint64_t>(count);
  header.elements.push_back(std::move(element));
  return true;
}

bool parse_property(Words& words, PlyHeader& header) {
  if (header.elements.empty()) return false;
  PlyProperty property;
  std::string_view word = words.next_on_line();
  if (word == "list") {
    property.count_type = type_of(words.next_on_line());
    if (!property.count_type) return false;
    word = words.next_on_line();
  }
  const auto type = type_of(word);
  property.name = words.next_on_line();
  if (!type || property.name.empty()) return false;
  property.type = *type;
  header.elements.back().properties.push_back(std::move(property));
  return true;
}

bool parse_line(std::string_view word, Words& words, PlyHeader& header) {
  if (word == "format") return parse_format(words, header);
  if (word == "element") return parse_element(words, header);
  if (word == "property") return parse_property(words, header);
  return word == "comment" || word == "obj_info";
}

// An element without properties has no bytes: its count would cost nothing to claim.
bool has_empty_element(const PlyHeader& header) {
  for (const PlyElement& element : header.elements)
    if (element.properties.empty() && element.count > 0) return true;
  return false;
}

}  // namespace

Result<PlyHeader> parse_ply_header(std::string_view bytes, const std::string& where) {
  Words words(bytes);
  PlyHeader header;
  const auto broken = [&] {
    return fail("the header is broken", where + ":" + std::to_string(words.line()),
                "Copy or export the file again");
  };
  if (words.next() != "ply") return broken();
  words.rest_of_line();
  bool has_format = false;
  for (std::string_view word = words.next(); word != "end_header"; word = words.next()) {
    if (word.empty() || !parse_line(word, words, header)) return broken();
    has_format = has_format || word == "format";
    words.rest_of_line();
  }
  if (!has_format || has_empty_element(header)) return broken();
  words.rest_of_line();
  header.size = words.offset();
  return header;
}

}  // namespace osteon
