#include "dicom/dicom_picture.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace osteon {
namespace {

constexpr std::string_view kImplicit = "1.2.840.10008.1.2", kExplicit = "1.2.840.10008.1.2.1",
                           kBigEndian = "1.2.840.10008.1.2.2";
constexpr std::string_view kCtImageStorage = "1.2.840.10008.5.1.4.1.1.2";

/// How the pixels are stored.
struct PixelKind {
  unsigned rows = 0, columns = 0;
  unsigned allocated = 0, stored = 0, high = 0;  ///< bits, and the place of the highest
  unsigned is_signed = 0;
};

PixelKind kind_of(const DicomElements& data) {
  PixelKind kind;
  kind.rows = data.number(0x0028, 0x0010, 0);
  kind.columns = data.number(0x0028, 0x0011, 0);
  kind.allocated = data.number(0x0028, 0x0100, 0);
  kind.stored = data.number(0x0028, 0x0101, kind.allocated);
  kind.high = data.number(0x0028, 0x0102, kind.stored - 1);
  kind.is_signed = data.number(0x0028, 0x0103, 0);
  return kind;
}

bool is_usual(const PixelKind& kind) {
  const bool whole = kind.allocated == 8 || kind.allocated == 12 || kind.allocated == 16;
  return whole && kind.stored > 0 && kind.stored <= kind.allocated && kind.high < kind.allocated &&
         kind.high + 1 >= kind.stored && kind.is_signed <= 1;
}

bool is_grey(const DicomElements& data) {
  const std::string_view colours = data.text(0x0028, 0x0004);
  return data.number(0x0028, 0x0002, 1) == 1 && (colours.empty() || colours.starts_with("MONO"));
}

bool is_plain(const DicomElements& data) {
  return data.syntax == kImplicit || data.syntax == kExplicit || data.syntax == kBigEndian;
}

/// Elements with their kinds, in the order of bytes of the pixels.
class Writer {
 public:
  explicit Writer(bool big_endian) : big_(big_endian) {}
  std::string take() { return std::move(bytes_); }
  void raw(std::string_view bytes) { bytes_ += bytes; }
  void number16(unsigned value) {
    const std::array<char, 2> b{static_cast<char>(value & 0xff),
                                static_cast<char>(value >> 8 & 0xff)};
    bytes_ += b[big_ ? 1 : 0];
    bytes_ += b[big_ ? 0 : 1];
  }
  void number32(std::uint32_t value) {
    number16(big_ ? value >> 16 : value & 0xffff);
    number16(big_ ? value & 0xffff : value >> 16);
  }
  void tag(std::uint32_t tag) {
    number16(tag >> 16);
    number16(tag & 0xffff);
  }
  void text(std::uint32_t at, std::string_view kind, std::string value, char filling) {
    if (value.size() % 2) value += filling;
    tag(at);
    raw(kind);
    number16(static_cast<unsigned>(value.size()));
    raw(value);
  }
  void number(std::uint32_t at, unsigned value) {
    tag(at);
    raw("US");
    number16(2);
    number16(value);
  }
  /// Head of an element of `length` bytes, or of an open one.
  void pixels(std::string_view kind, std::uint32_t length) {
    tag(dicom_tag(0x7fe0, 0x0010));
    raw(kind);
    number16(0);
    number32(length);
  }
  /// One with a length to fill up.
  void item(std::string_view value) {
    tag(dicom_tag(0xfffe, 0xe000));
    number32(static_cast<std::uint32_t>(value.size() + value.size() % 2));
    raw(value);
    if (value.size() % 2) bytes_ += '\0';
  }

 private:
  bool big_;
  std::string bytes_;
};

/// The part before the data, which is never big-endian.
std::string file_start(std::string_view syntax) {
  Writer meta(false);
  meta.text(dicom_tag(0x0002, 0x0002), "UI", std::string(kCtImageStorage), '\0');
  meta.text(dicom_tag(0x0002, 0x0010), "UI", std::string(syntax), '\0');
  const std::string rest = meta.take();
  Writer start(false);
  start.raw(std::string(128, '\0') + "DICM");
  start.tag(dicom_tag(0x0002, 0x0000));
  start.raw("UL");
  start.number16(4);
  start.number32(static_cast<std::uint32_t>(rest.size()));
  start.raw(rest);
  return start.take();
}

void write_kind(Writer& out, const PixelKind& kind) {
  out.text(dicom_tag(0x0008, 0x0016), "UI", std::string(kCtImageStorage), '\0');
  out.number(dicom_tag(0x0028, 0x0002), 1);
  out.text(dicom_tag(0x0028, 0x0004), "CS", "MONOCHROME2", ' ');
  out.number(dicom_tag(0x0028, 0x0010), kind.rows);
  out.number(dicom_tag(0x0028, 0x0011), kind.columns);
  out.number(dicom_tag(0x0028, 0x0100), kind.allocated);
  out.number(dicom_tag(0x0028, 0x0101), kind.stored);
  out.number(dicom_tag(0x0028, 0x0102), kind.high);
  out.number(dicom_tag(0x0028, 0x0103), kind.is_signed);
}

/// Pixels beyond the picture, which some files have, are left out.
std::string plain_file(const DicomElements& elements, const PixelKind& kind, std::size_t needed) {
  Writer out(elements.big_endian);
  out.raw(file_start(elements.big_endian ? kBigEndian : kExplicit));
  write_kind(out, kind);
  out.pixels("OW", static_cast<std::uint32_t>(needed + needed % 2));
  out.raw(elements.plain_pixels.substr(0, needed));
  if (needed % 2) out.raw(std::string_view("\0", 1));
  return out.take();
}

std::string compressed_file(const DicomElements& elements, const PixelKind& kind) {
  Writer out(false);
  out.raw(file_start(elements.syntax));
  write_kind(out, kind);
  out.pixels("OB", 0xffffffff);
  out.item({});  // one picture needs no table of offsets
  for (std::size_t n = 1; n < elements.pixel_fragments.size(); ++n)
    out.item(elements.pixel_fragments[n]);
  out.tag(dicom_tag(0xfffe, 0xe0dd));
  out.number32(0);
  return out.take();
}

}  // namespace

Result<std::string> picture_file(const DicomElements& elements, const std::string& where) {
  if (!is_grey(elements))
    return fail("is a colour picture", where, "Choose the series of the CT slices");
  const PixelKind kind = kind_of(elements);
  if (!is_usual(kind))
    return fail("has pixels of an unusual kind", where, "Export it as 16-bit CT");
  if (!elements.pixel_fragments.empty()) {
    if (fits_header(
            {elements.syntax, kind.rows, kind.columns, kind.allocated, elements.pixel_fragments}))
      return compressed_file(elements, kind);
    return fail("has compressed pixels that do not fit its header, or an unsupported compression",
                where, "Copy or export the series again, preferably uncompressed");
  }
  const std::size_t bits = std::size_t{kind.rows} * kind.columns * kind.allocated;
  const std::size_t needed = (bits + 7) / 8;
  if (!is_plain(elements) || elements.plain_pixels.size() < needed)
    return fail("holds fewer pixels than it says, or has an unsupported compression", where,
                "Copy or export the series again, preferably uncompressed");
  return plain_file(elements, kind, needed);
}

}  // namespace osteon
