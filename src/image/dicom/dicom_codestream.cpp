// The heads of JPEG (ITU-T T.81, B.2), JPEG-LS (T.87, C.2.2), JPEG 2000 (T.800, A.5.1) and RLE
// (DICOM PS3.5, annex G).
#include "dicom/dicom_codestream.h"

#include <cstddef>
#include <string>

namespace osteon {
namespace {

constexpr unsigned kMostBits = 16;
constexpr std::size_t kRleHeaderBytes = 64;

/// Numbers by their places; beyond the end they are 0.
class Stream {
 public:
  explicit Stream(std::string_view bytes) : bytes_(bytes) {}
  std::size_t size() const { return bytes_.size(); }
  unsigned byte(std::size_t at) const {
    return at < bytes_.size() ? static_cast<unsigned char>(bytes_[at]) : 0u;
  }
  unsigned word(std::size_t at) const { return byte(at) << 8 | byte(at + 1); }
  std::size_t whole(std::size_t at) const {
    return static_cast<std::size_t>(word(at)) << 16 | word(at + 2);
  }
  std::size_t little(std::size_t at) const {
    return byte(at) | byte(at + 1) << 8 | byte(at + 2) << 16 |
           static_cast<std::size_t>(byte(at + 3)) << 24;
  }

 private:
  std::string_view bytes_;
};

bool is_frame_head(unsigned marker) {
  const bool jpeg =
      marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
  return jpeg || marker == 0xf7;  // that of JPEG-LS
}

/// The first frame head, and that there is no second one, which would count instead.
bool jpeg_fits(const Stream& s, const EncodedPixels& pixels) {
  if (s.word(0) != 0xffd8) return false;
  bool found = false;
  for (std::size_t at = 2; at + 4 <= s.size();) {
    if (s.byte(at) != 0xff) return false;
    const unsigned marker = s.byte(at + 1);
    if (marker == 0xff) {  // fill
      ++at;
      continue;
    }
    if (marker == 0xda) return found;  // the pixels begin
    if (is_frame_head(marker)) {
      const unsigned precision = s.byte(at + 4);
      if (found || precision < 2 || precision > kMostBits || precision > pixels.bits ||
          s.word(at + 5) != pixels.rows || s.word(at + 7) != pixels.columns || s.byte(at + 9) != 1)
        return false;
      found = true;
    }
    const std::size_t length = s.word(at + 2);
    if (length < 2) return false;
    at += 2 + length;
  }
  return false;
}

bool stands_alone(unsigned marker) {
  return (marker >= 0xff30 && marker <= 0xff3f) || marker == 0xff4f || marker == 0xff92;
}

/// Walks the marker segments from the start of the stream to the start of the pixels (SOD). True
/// when each lies within the stream and a whole COD segment is among them: a decoder that trusts
/// their lengths then stays inside. Ends because each turn goes on by two bytes or more.
bool jpeg2000_segments_lie_within(const Stream& s) {
  constexpr unsigned kCod = 0xff52, kSod = 0xff93, kFirstMarker = 0xff30;
  constexpr std::size_t kLeastCod = 12;  // T.800, table A.13, with its own length
  bool coding_style = false;
  for (std::size_t at = 0; at + 2 <= s.size();) {
    const unsigned marker = s.word(at);
    if (marker == kSod) return coding_style;
    if (marker < kFirstMarker) return false;
    at += 2;
    if (stands_alone(marker)) continue;
    const std::size_t length = s.word(at);
    if (length < (marker == kCod ? kLeastCod : 2) || length > s.size() - at) return false;
    coding_style = coding_style || marker == kCod;
    at += length;
  }
  return false;
}

bool jpeg2000_fits(const Stream& s, const EncodedPixels& pixels) {
  if (s.whole(0) != 0xff4fff51 || s.word(40) != 1) return false;
  const std::size_t right = s.whole(8), bottom = s.whole(12), left = s.whole(16), top = s.whole(20);
  const unsigned precision = (s.byte(42) & 0x7f) + 1;
  const bool one_sample_a_pixel = s.byte(43) == 1 && s.byte(44) == 1;
  return right >= left && bottom >= top && right - left == pixels.columns &&
         bottom - top == pixels.rows && precision <= kMostBits && precision <= pixels.bits &&
         one_sample_a_pixel && s.whole(24) > 0 && s.whole(28) > 0 &&
         jpeg2000_segments_lie_within(s);
}

/// One segment a byte of a pixel, each within the fragment.
bool rle_fits(const Stream& s, const EncodedPixels& pixels) {
  const std::size_t segments = s.little(0);
  if (s.size() < kRleHeaderBytes || segments == 0 || segments * 8 != pixels.bits) return false;
  std::size_t before = kRleHeaderBytes - 1;
  for (std::size_t n = 0; n < segments; ++n) {
    const std::size_t offset = s.little(4 + 4 * n);
    if (offset <= before || offset >= s.size()) return false;
    before = offset;
  }
  return true;
}

}  // namespace

bool fits_header(const EncodedPixels& pixels) {
  if (pixels.fragments.size() < 2 || pixels.bits > kMostBits) return false;
  for (std::size_t n = 1; n < pixels.fragments.size(); ++n)
    if (pixels.fragments[n].empty()) return false;
  const std::string_view root = "1.2.840.10008.1.2.";
  if (!pixels.syntax.starts_with(root)) return false;
  const std::string_view kind = pixels.syntax.substr(root.size());
  if (kind == "5")
    return pixels.fragments.size() == 2 && rle_fits(Stream(pixels.fragments[1]), pixels);
  std::string joined;
  for (std::size_t n = 1; n < pixels.fragments.size(); ++n) joined += pixels.fragments[n];
  const Stream stream(joined);
  if (kind == "4.90" || kind == "4.91") return jpeg2000_fits(stream, pixels);
  const bool jpeg = kind == "4.50" || kind == "4.51" || kind == "4.57" || kind == "4.70" ||
                    kind == "4.80" || kind == "4.81";
  return jpeg && jpeg_fits(stream, pixels);
}

}  // namespace osteon
