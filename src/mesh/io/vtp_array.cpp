#include "io/vtp_array.h"

#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <cstring>

#include "io/vtk_cells.h"
#include "io/words.h"

namespace osteon {
namespace {

constexpr std::size_t kMostBytes = std::size_t{1} << 31;  // of one array

int base64_digit(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  return c == '+' ? 62 : c == '/' ? 63 : -1;
}

/// Bytes that may be written in base64. Each part (a header, the data) may end with padding, so
/// that the next begins with a fresh group of four digits.
class Source {
 public:
  Source(std::string_view text, bool base64) : text_(text), base64_(base64) {}

  bool take(std::size_t count, std::string& out) {
    return base64_ ? take_base64(count, out) : take_raw(count, out);
  }
  /// After a part: what is left of its last group is padding.
  void end_part() { left_.clear(); }

 private:
  bool take_raw(std::size_t count, std::string& out) {
    if (count > text_.size()) return false;
    out.append(text_.substr(0, count));
    text_.remove_prefix(count);
    return true;
  }
  bool take_base64(std::size_t count, std::string& out) {
    if (count > left_.size() + text_.size()) return false;
    while (left_.size() < count)
      if (!decode_group()) return false;
    out.append(left_, 0, count);
    left_.erase(0, count);
    return true;
  }
  bool decode_group() {
    std::uint32_t bits = 0;
    int digits = 0, padding = 0;
    while (digits + padding < 4) {
      if (text_.empty()) return false;
      const char c = text_.front();
      text_.remove_prefix(1);
      if (c == ' ' || (c >= '\t' && c <= '\r')) continue;
      const int digit = base64_digit(c);
      if (digit < 0 && c != '=') return false;
      (c == '=' ? padding : digits) += 1;
      bits = bits << 6 | static_cast<std::uint32_t>(std::max(digit, 0));
    }
    for (int k = 0; k < 3 - padding; ++k)
      left_.push_back(static_cast<char>(bits >> (16 - 8 * k) & 0xff));
    return true;
  }

  std::string_view text_;
  bool base64_;
  std::string left_;
};

bool take_count(Source& source, bool wide, std::uint64_t& value) {
  std::string bytes;
  if (!source.take(wide ? 8 : 4, bytes)) return false;
  bytes.resize(8, '\0');
  std::memcpy(&value, bytes.data(), 8);
  return value <= kMostBytes;
}

bool unpack(const std::string& packed, std::size_t size, std::string& out) {
  // Zlib packs no tighter than about 1030 to 1: more would be a lie that only takes memory.
  if (size / 1100 > packed.size()) return false;
  std::string block(size, '\0');
  uLongf made = static_cast<uLongf>(size);
  const int status = ::uncompress(reinterpret_cast<Bytef*>(block.data()), &made,
                                  reinterpret_cast<const Bytef*>(packed.data()),
                                  static_cast<uLong>(packed.size()));
  if (status != Z_OK || made != size) return false;
  out += block;
  return true;
}

// Count of blocks, size of each, size of the last (0: as the others), packed size of each.
bool read_packed(Source& source, bool wide, std::string& out) {
  std::uint64_t blocks = 0, size = 0, last = 0;
  if (!take_count(source, wide, blocks) || !take_count(source, wide, size) ||
      !take_count(source, wide, last))
    return false;
  if (blocks > kMostBytes / 64 || (blocks > 0 && size > kMostBytes / blocks)) return false;
  std::vector<std::uint64_t> packed;
  for (std::uint64_t i = 0; i < blocks; ++i) {
    std::uint64_t bytes = 0;
    if (!take_count(source, wide, bytes)) return false;
    packed.push_back(bytes);
  }
  source.end_part();
  for (std::uint64_t i = 0; i < blocks; ++i) {
    std::string block;
    const std::uint64_t whole = i + 1 == blocks && last > 0 ? last : size;
    if (!source.take(packed[i], block) || !unpack(block, whole, out)) return false;
  }
  return true;
}

bool read_bytes(Source source, const VtpEncoding& encoding, std::string& out) {
  if (encoding.packed) return read_packed(source, encoding.wide_header, out);
  std::uint64_t size = 0;
  return take_count(source, encoding.wide_header, size) && source.take(size, out);
}

std::optional<std::vector<double>> ascii_numbers(std::string_view text) {
  Words words(text);
  std::vector<double> out;
  for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
    double value = 0;
    if (!parse_number(word, value)) return std::nullopt;
    out.push_back(value);
  }
  return out;
}

}  // namespace

std::string_view XmlElement::attribute(std::string_view name) const {
  for (std::size_t at = head.find(name); at != std::string_view::npos;
       at = head.find(name, at + 1)) {
    const std::size_t quote = at + name.size() + 1;
    if (at == 0 || head[at - 1] > ' ' || quote >= head.size() || head[quote - 1] != '=') continue;
    const std::size_t end = head.find(head[quote], quote + 1);
    if (end == std::string_view::npos) return {};
    return head.substr(quote + 1, end - quote - 1);
  }
  return {};
}

std::optional<XmlElement> next_element(std::string_view text, std::string_view name,
                                       std::size_t& at) {
  const std::string open = "<" + std::string(name), close = "</" + std::string(name) + ">";
  std::size_t start = text.find(open, at);
  const auto longer = [&](std::size_t s) {
    return s + open.size() < text.size() && text[s + open.size()] > ' ' &&
           text[s + open.size()] != '>' && text[s + open.size()] != '/';
  };
  while (start != std::string_view::npos && longer(start)) start = text.find(open, start + 1);
  if (start == std::string_view::npos) return std::nullopt;
  const std::size_t end = text.find('>', start);
  if (end == std::string_view::npos) return std::nullopt;
  XmlElement out;
  out.head = text.substr(start + 1, end - start - 1);
  at = end + 1;
  if (text[end - 1] == '/') return out;
  const std::size_t last = text.find(close, end);
  out.body = text.substr(end + 1, last == std::string_view::npos ? last : last - end - 1);
  at = last == std::string_view::npos ? text.size() : last + close.size();
  return out;
}

std::optional<std::vector<double>> vtp_numbers(const XmlElement& array,
                                               const VtpEncoding& encoding) {
  const std::string_view format = array.attribute("format"), type = array.attribute("type");
  if (format.empty() || format == "ascii") return ascii_numbers(array.body);
  const std::size_t size = vtk_type_size(type);
  if (size == 0) return std::nullopt;
  std::string bytes;
  if (format == "appended") {
    long long offset = 0;
    if (!parse_integer(array.attribute("offset"), offset) || offset < 0 ||
        static_cast<std::size_t>(offset) > encoding.appended.size())
      return std::nullopt;
    const std::string_view from = encoding.appended.substr(static_cast<std::size_t>(offset));
    if (!read_bytes(Source(from, encoding.appended_base64), encoding, bytes)) return std::nullopt;
  } else if (format != "binary" || !read_bytes(Source(array.body, true), encoding, bytes)) {
    return std::nullopt;
  }
  if (bytes.size() % size != 0) return std::nullopt;
  std::vector<double> out;
  for (std::size_t at = 0; at < bytes.size(); at += size)
    out.push_back(vtk_number(bytes.data() + at, type));
  return out;
}

}  // namespace osteon
