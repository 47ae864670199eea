// Files of every format, made byte by byte, all with the frame of small_frame().
#pragma once

#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <string>
#include <utility>

#include "volumes.h"

namespace osteon {

inline std::string raw_bytes(const Volume& volume) {
  return std::string(reinterpret_cast<const char*>(volume.values.data()), volume.values.size() * 2);
}

inline std::string swapped(std::string bytes) {
  for (std::size_t n = 0; n + 1 < bytes.size(); n += 2) std::swap(bytes[n], bytes[n + 1]);
  return bytes;
}

inline std::string gzip(const std::string& bytes) {
  std::string out(bytes.size() + 1000, '\0');
  z_stream stream{};
  deflateInit2(&stream, 6, Z_DEFLATED, 15 + 16, 8, Z_DEFAULT_STRATEGY);
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  deflate(&stream, Z_FINISH);
  out.resize(stream.total_out);
  deflateEnd(&stream);
  return out;
}

// The frame of small_frame() in the words of each format.
inline std::string nrrd_header(const std::string& encoding, const std::string& more = {}) {
  return "NRRD0004\n# made by a test\ntype: short\ndimension: 3\nspace: left-posterior-superior\n"
         "sizes: 9 7 5\nspace directions: (0.4,0,0) (0,0.6,0) (0,0,1.1)\n"
         "space origin: (-12,34,100)\nendian: little\nencoding: " +
         encoding + "\nkey:=value\n" + more + "\n";
}

inline std::string meta_header(const std::string& more, const std::string& data) {
  return "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\n" +
         more +
         "TransformMatrix = 1 0 0 0 1 0 0 0 1\nOffset = -12 34 100\n"
         "ElementSpacing = 0.4 0.6 1.1\nDimSize = 9 7 5\nElementType = MET_SHORT\n"
         "ElementDataFile = " +
         data + "\n";
}

template <class T>
inline void set(std::string& bytes, std::size_t at, T value, bool big = false) {
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  if (big) std::reverse(raw, raw + sizeof(T));
  bytes.replace(at, sizeof(T), raw, sizeof(T));
}

// RAS, with the affine that stands for small_frame() in LPS.
inline std::string nifti(const Volume& volume, bool big, bool sform) {
  std::string h(352, '\0');
  set<std::int32_t>(h, 0, 348, big);
  const std::int16_t dim[4] = {3, 9, 7, 5};
  for (std::size_t n = 0; n < 4; ++n) set(h, 40 + 2 * n, dim[n], big);
  set<std::int16_t>(h, 70, 4, big);
  const float pixdim[4] = {1, 0.4f, 0.6f, 1.1f};
  for (std::size_t n = 0; n < 4; ++n) set(h, 76 + 4 * n, pixdim[n], big);
  set(h, 108, 352.0f, big);
  h[123] = 2;
  if (sform) {
    set<std::int16_t>(h, 254, 1, big);
    const float rows[12] = {-0.4f, 0, 0, 12, 0, -0.6f, 0, -34, 0, 0, 1.1f, 100};
    for (std::size_t n = 0; n < 12; ++n) set(h, 280 + 4 * n, rows[n], big);
  } else {
    set<std::int16_t>(h, 252, 1, big);
    set(h, 264, 1.0f, big);  // half a turn about z
    const float offset[3] = {12, -34, 100};
    for (std::size_t n = 0; n < 3; ++n) set(h, 268 + 4 * n, offset[n], big);
  }
  h.replace(344, 3, "n+1");
  const std::string raw = raw_bytes(volume);
  return h + (big ? swapped(raw) : raw);
}

inline void add_to_tar(std::string& tar, const std::string& name, const std::string& content) {
  std::string head(512, '\0');
  head.replace(0, name.size(), name);
  char size[13];
  std::snprintf(size, sizeof size, "%011zo", content.size());
  head.replace(124, 11, size, 11);
  head[156] = '0';
  head.replace(257, 5, "ustar");
  tar += head + content + std::string((512 - content.size() % 512) % 512, '\0');
}

inline std::string plist(const std::string& dtype, const std::string& modality) {
  return "<dict><key>matrix</key><dict><key>dtype</key><string>" + dtype +
         "</string><key>filename</key><string>matrix.dat</string><key>shape</key><array>"
         "<integer>5</integer><integer>7</integer><integer>9</integer></array></dict>"
         "<key>modality</key><string>" +
         modality +
         "</string><key>name</key><string>SECRET</string><key>spacing</key><array>"
         "<real>0.4</real><real>0.6</real><real>1.1</real></array></dict>";
}

inline std::string inv3(const std::string& main, const std::string& matrix) {
  std::string tar;
  add_to_tar(tar, "tmp/main.plist", main);
  add_to_tar(tar, "tmp/matrix.dat", matrix);
  return gzip(tar + std::string(1024, '\0'));
}

}  // namespace osteon
