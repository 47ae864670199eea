#include <zlib.h>

#include <algorithm>
#include <climits>

#include "files/raw_values.h"

namespace osteon {

Result<std::string> gunzip(std::string_view bytes, std::uint64_t limit, const std::string& where) {
  z_stream stream{};
  // 32: gzip or zlib by what the header says; 15: the largest window.
  if (inflateInit2(&stream, 32 + 15) != Z_OK) return fail("there is not enough memory", where);
  std::string out;
  const char* next = bytes.data();
  std::size_t left = bytes.size();
  int status = Z_OK;
  std::string block(1 << 20, '\0');
  while (status == Z_OK || status == Z_BUF_ERROR) {
    if (stream.avail_in == 0 && left > 0) {
      const std::size_t part = std::min<std::size_t>(left, UINT_MAX / 2);
      stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(next));
      stream.avail_in = static_cast<uInt>(part);
      next += part;
      left -= part;
    }
    stream.next_out = reinterpret_cast<Bytef*>(block.data());
    stream.avail_out = static_cast<uInt>(block.size());
    status = inflate(&stream, Z_NO_FLUSH);
    const std::size_t got = block.size() - stream.avail_out;
    out.append(block, 0, got);
    if (out.size() > limit || (got == 0 && stream.avail_in == 0 && left == 0)) break;
  }
  inflateEnd(&stream);
  if (out.size() > limit)
    return fail("unpacks to more than " + std::to_string(limit >> 20) + " MiB", where,
                "Crop it to the joint first");
  if (status != Z_STREAM_END)
    return fail("is truncated or damaged: its compressed part ends early", where,
                "Copy or export it again");
  return out;
}

}  // namespace osteon
