#include "dicom/dicom_walk.h"

#include <set>
#include <utility>

namespace osteon {
namespace {

constexpr std::uint32_t kUndefined = 0xffffffff;
constexpr std::uint32_t kItem = 0xfffee000, kItemEnd = 0xfffee00d, kSequenceEnd = 0xfffee0dd;
constexpr std::uint32_t kPixels = 0x7fe00010, kTransferSyntax = 0x00020010;
constexpr std::uint32_t kLongestKept = 1024;
constexpr int kDeepest = 32;

std::string_view without_filling(std::string_view text) {
  while (!text.empty() && (text.back() == '\0' || text.back() == ' ')) text.remove_suffix(1);
  return text;
}

struct Syntax {
  bool explicit_vr = true;
  bool big_endian = false;
};

/// Position in the file; `good` turns false at the first thing that does not fit.
class Walker {
 public:
  explicit Walker(std::string_view bytes) : bytes_(bytes) {}

  bool walk_file();
  DicomElements take() { return std::move(found_); }

 private:
  struct Element {
    std::uint32_t tag = 0, length = 0;
    bool sequence = false, unknown = false;
    bool may_be_open = true;  ///< of a kind whose length need not be known
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
  void keep(const Element& element);

  std::string_view bytes_;
  std::size_t at_ = 0;
  DicomElements found_;
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
  element.may_be_open =
      element.sequence || element.unknown || (element.tag == kPixels && (vr == "OB" || vr == "OW"));
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
      const std::string_view uid = without_filling(bytes_.substr(at_, element.length));
      syntax.explicit_vr = uid != "1.2.840.10008.1.2";
      syntax.big_endian = uid == "1.2.840.10008.1.2.2";
      if (uid == "1.2.840.10008.1.2.1.99") return false;  // deflated as a whole
      found_.syntax = uid;
      found_.big_endian = syntax.big_endian;
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
      if (fragments) found_.pixel_fragments.push_back(bytes_.substr(at_, item.length));
      at_ += item.length;
    }
  }
}

/// Of an outermost element that has a length.
void Walker::keep(const Element& element) {
  const std::string_view value = bytes_.substr(at_, element.length);
  if (element.tag == kPixels) {
    found_.has_pixels = true;
    found_.plain_pixels = value;
    return;
  }
  const std::uint32_t group = element.tag >> 16;
  if (group != 0x0008 && group != 0x0020 && group != 0x0028) return;
  if (!element.sequence && element.length <= kLongestKept)
    found_.values.emplace(element.tag, value);
}

bool Walker::walk_data(const Syntax& syntax, bool nested, int depth) {
  while (at_ < bytes_.size()) {
    Element element;
    if (!read_element(syntax, element)) return false;
    if (nested && element.tag == kItemEnd) return true;
    const bool pixels = !nested && element.tag == kPixels;
    if (pixels && found_.has_pixels) return false;
    if (element.length == kUndefined) {
      if (!element.may_be_open) return false;
      if (pixels) found_.has_pixels = true;
      // Unknown elements of unknown length are written the implicit way.
      const Syntax inner = element.unknown ? Syntax{false, false} : syntax;
      if (!walk_items(inner, pixels, depth + 1)) return false;
    } else {
      if (!has(element.length)) return false;
      if (!nested) keep(element);
      at_ += element.length;
    }
  }
  return !nested;
}

bool Walker::walk_file() {
  if (bytes_.size() < 132 || bytes_.substr(128, 4) != "DICM") return false;
  at_ = 132;
  Syntax syntax;
  return read_meta(syntax) && walk_data(syntax, false, 0);
}

}  // namespace

std::string_view DicomElements::text(std::uint16_t group, std::uint16_t element) const {
  const auto found = values.find(dicom_tag(group, element));
  return found == values.end() ? std::string_view() : without_filling(found->second);
}

unsigned DicomElements::number(std::uint16_t group, std::uint16_t element,
                               unsigned otherwise) const {
  const auto found = values.find(dicom_tag(group, element));
  if (found == values.end() || found->second.size() < 2) return otherwise;
  const auto first = static_cast<unsigned char>(found->second[0]);
  const auto second = static_cast<unsigned char>(found->second[1]);
  return big_endian ? first << 8u | second : first | second << 8u;
}

Result<DicomElements> walk_dicom(std::string_view bytes, const std::string& where) {
  Walker walker(bytes);
  if (walker.walk_file()) return walker.take();
  return fail("is truncated, damaged or not a DICOM picture", where,
              "Copy or export the series again, or remove the file");
}

}  // namespace osteon
