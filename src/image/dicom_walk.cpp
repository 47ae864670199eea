#include "dicom_walk.h"

#include <cstdint>
#include <set>

namespace osteon {
namespace {

constexpr std::uint32_t kUndefined = 0xffffffff;
constexpr std::uint32_t kItem = 0xfffee000, kItemEnd = 0xfffee00d, kSequenceEnd = 0xfffee0dd;
constexpr std::uint32_t kPixels = 0x7fe00010, kTransferSyntax = 0x00020010;
constexpr int kDeepest = 32;

struct Syntax {
  bool explicit_vr = true;
  bool big_endian = false;
};

/// Position in the file; `good` turns false at the first thing that does not fit.
class Walker {
 public:
  explicit Walker(std::string_view bytes) : bytes_(bytes) {}

  bool walk_file();

 private:
  struct Element {
    std::uint32_t tag = 0, length = 0;
    bool sequence = false, unknown = false;
  };

  bool has(std::size_t count) const { return bytes_.size() - at_ >= count; }
  std::uint32_t byte(std::size_t n) const { return static_cast<unsigned char>(bytes_[at_ + n]); }
  std::uint32_t word16(std::size_t n, bool big) const {
    return big ? byte(n) << 8 | byte(n + 1) : byte(n) | byte(n + 1) << 8;
  }
  std::uint32_t word32(std::size_t n, bool big) const {
    return big ? word16(n, big) << 16 | word16(n + 2, big)
               : word16(n, big) | word16(n + 2, big) << 16;
  }
  bool read_element(const Syntax& syntax, Element& element);
  bool read_meta(Syntax& syntax);
  bool walk_data(const Syntax& syntax, bool nested, int depth);
  bool walk_items(const Syntax& syntax, bool fragments, int depth);

  std::string_view bytes_;
  std::size_t at_ = 0;
  bool saw_pixels_ = false;
};

bool Walker::read_element(const Syntax& syntax, Element& element) {
  static const std::set<std::string_view> kLong = {"OB", "OW", "OF", "OD", "OL", "OV", "SQ",
                                                   "UC", "UR", "UT", "UN", "SV", "UV"};
  if (!has(8)) return false;
  const bool big = syntax.big_endian;
  element = {};
  element.tag = word16(0, big) << 16 | word16(2, big);
  if (!syntax.explicit_vr || element.tag >> 16 == 0xfffe) {
    element.length = word32(4, big);
    at_ += 8;
    return true;
  }
  const std::string_view vr = bytes_.substr(at_ + 4, 2);
  for (const char c : vr)
    if (c < 'A' || c > 'Z') return false;
  element.sequence = vr == "SQ";
  element.unknown = vr == "UN";
  if (!kLong.count(vr)) {
    element.length = word16(6, big);
    at_ += 8;
    return true;
  }
  if (!has(12)) return false;
  element.length = word32(8, big);
  at_ += 12;
  return true;
}

bool Walker::read_meta(Syntax& syntax) {
  bool named = false;
  while (has(8) && word16(0, false) == 2) {
    Element element;
    if (!read_element({}, element) || !has(element.length)) return false;
    if (element.tag == kTransferSyntax) {
      std::string_view uid = bytes_.substr(at_, element.length);
      while (!uid.empty() && (uid.back() == '\0' || uid.back() == ' ')) uid.remove_suffix(1);
      syntax.explicit_vr = uid != "1.2.840.10008.1.2";
      syntax.big_endian = uid == "1.2.840.10008.1.2.2";
      if (uid == "1.2.840.10008.1.2.1.99") return false;  // deflated as a whole
      named = true;
    }
    at_ += element.length;
  }
  return named;
}

/// Items up to the end of the sequence; `fragments`: those of compressed pixels.
bool Walker::walk_items(const Syntax& syntax, bool fragments, int depth) {
  if (depth > kDeepest) return false;
  for (;;) {
    Element item;
    if (!read_element(syntax, item)) return false;
    if (item.tag == kSequenceEnd) return true;
    if (item.tag != kItem) return false;
    if (item.length == kUndefined) {
      if (fragments || !walk_data(syntax, true, depth + 1)) return false;
    } else {
      if (!has(item.length)) return false;
      at_ += item.length;
    }
  }
}

bool Walker::walk_data(const Syntax& syntax, bool nested, int depth) {
  while (at_ < bytes_.size()) {
    Element element;
    if (!read_element(syntax, element)) return false;
    if (nested && element.tag == kItemEnd) return true;
    if (!nested && element.tag == kPixels) saw_pixels_ = true;
    if (element.length == kUndefined) {
      const bool fragments = element.tag == kPixels;
      // Unknown elements of unknown length are written the implicit way.
      const Syntax inner = element.unknown ? Syntax{false, false} : syntax;
      if (!walk_items(inner, fragments, depth + 1)) return false;
    } else {
      if (!has(element.length)) return false;
      at_ += element.length;
    }
  }
  return !nested;
}

bool Walker::walk_file() {
  if (bytes_.size() < 132 || bytes_.substr(128, 4) != "DICM") return false;
  at_ = 132;
  Syntax syntax;
  return read_meta(syntax) && walk_data(syntax, false, 0) && saw_pixels_;
}

}  // namespace

Result<void> check_dicom_structure(std::string_view bytes, const std::string& where) {
  if (Walker(bytes).walk_file()) return {};
  return fail("is truncated, damaged or no DICOM picture", where,
              "Copy or export the series again, or remove the file");
}

}  // namespace osteon
