// VTK surfaces as 3D Slicer and ParaView write them: legacy and XML, every encoding. The files are
// made here byte by byte, after Kitware's "VTK file formats".
#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <cstring>

#include "mesh/shapes.h"
#include "osteon/mesh/measure.h"
#include "osteon/mesh/mesh_io.h"

namespace osteon {
namespace {

using test::cube;

Result<TriMesh> load(const std::string& bytes, const std::string& extension) {
  return load_mesh_from_memory(bytes, extension, 1, "test." + extension);
}

void expect_cube(const std::string& bytes, const std::string& extension) {
  const auto mesh = load(bytes, extension);
  ASSERT_TRUE(mesh) << mesh.error().message();
  EXPECT_EQ(mesh->triangles.size(), 12u);
  EXPECT_TRUE(topology(*mesh).closed());
  EXPECT_NEAR(volume(*mesh), 1, 1e-6);
}

template <class Number>
std::string bytes_of(Number value, bool highest_first) {
  std::string bytes(sizeof value, '\0');
  std::memcpy(bytes.data(), &value, sizeof value);
  if (highest_first) std::reverse(bytes.begin(), bytes.end());
  return bytes;
}

// Numbers of the cube as text or bytes.
std::string points(bool binary, bool highest_first) {
  std::string out;
  for (const Vec3& v : cube().vertices)
    for (Eigen::Index k = 0; k < 3; ++k)
      out +=
          binary ? bytes_of(static_cast<float>(v[k]), highest_first) : std::to_string(v[k]) + " ";
  return out;
}

std::string legacy(bool binary) {
  const auto number = [&](std::int32_t value) {
    return binary ? bytes_of(value, true) : std::to_string(value) + " ";
  };
  std::string out = "# vtk DataFile Version 3.0\ntitle\n";
  out += binary ? "BINARY\n" : "ASCII\n";
  out += "DATASET POLYDATA\nPOINTS 8 float\n" + points(binary, true) + "\nPOLYGONS 12 48\n";
  for (const Triangle& t : cube().triangles) {
    out += number(3);
    for (const std::uint32_t v : t) out += number(static_cast<std::int32_t>(v));
  }
  return out + "\nCELL_DATA 12\nSCALARS a float\n";
}

// Version 5.1 keeps where each polygon begins, and all corners.
std::string legacy_offsets(bool binary) {
  const auto number = [&](std::int64_t value) {
    return binary ? bytes_of(value, true) : std::to_string(value) + "\n";
  };
  std::string out = "# vtk DataFile Version 5.1\ntitle\n";
  out += binary ? "BINARY\n" : "ASCII\n";
  out += "DATASET POLYDATA\nPOINTS 8 float\n" + points(binary, true);
  out += "\nMETADATA\nINFORMATION 0\n\nPOLYGONS 13 36\nOFFSETS vtktypeint64\n";
  for (int i = 0; i <= 12; ++i) out += number(3 * i);
  out += "\nCONNECTIVITY vtktypeint64\n";
  for (const Triangle& t : cube().triangles)
    for (const std::uint32_t v : t) out += number(v);
  return out + "\n";
}

TEST(VtkSurface, LegacyAsciiAndBinary) {
  expect_cube(legacy(false), "vtk");
  expect_cube(legacy(true), "vtk");
  expect_cube(legacy_offsets(false), "vtk");
  expect_cube(legacy_offsets(true), "vtk");
}

TEST(VtkSurface, StripsTurnEveryOtherTriangle) {
  const std::string text =
      "# vtk DataFile Version 2.0\nstrip\nASCII\nDATASET POLYDATA\nPOINTS 4 double\n"
      "0 0 0  1 0 0  0 1 0  1 1 0\nTRIANGLE_STRIPS 1 5\n4 0 1 2 3\n";
  const auto mesh = load(text, "vtk");
  ASSERT_TRUE(mesh) << mesh.error().message();
  ASSERT_EQ(mesh->triangles.size(), 2u);
  EXPECT_EQ(topology(*mesh).misoriented_edges, 0u);
}

TEST(VtkSurface, APieceOfALegacyFileIsRefused) {
  for (const bool binary : {false, true})
    for (const std::string& whole : {legacy(binary), legacy_offsets(binary)})
      for (std::size_t length = 0; length + 40 < whole.size(); length += 7) {
        const auto mesh = load(whole.substr(0, length), "vtk");
        EXPECT_FALSE(mesh && mesh->triangles.size() == 12) << length;
      }
}

std::string base64(const std::string& bytes) {
  const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k)
      bits = bits << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k)
      out += i + k > bytes.size() ? '=' : digits[bits >> (18 - 6 * k) & 63];
  }
  return out;
}

enum class Way { kAscii, kBase64, kAppendedRaw, kAppendedBase64 };

// One array of the file: its bytes as VTK writes them, with their header.
std::string encoded(const std::string& data, bool packed, bool in_base64) {
  const auto size = bytes_of(static_cast<std::uint32_t>(data.size()), false);
  if (!packed) return in_base64 ? base64(size + data) : size + data;
  // Two blocks: what is left over is the last.
  const std::size_t block = (data.size() + 1) / 2 + 3;
  std::string blocks;
  std::string head = bytes_of(std::uint32_t{2}, false) +
                     bytes_of(static_cast<std::uint32_t>(block), false) +
                     bytes_of(static_cast<std::uint32_t>(data.size() - block), false);
  for (std::size_t at = 0; at < data.size(); at += block) {
    const std::string part = data.substr(at, block);
    uLongf made = ::compressBound(static_cast<uLong>(part.size()));
    std::string out(made, '\0');
    ::compress(reinterpret_cast<Bytef*>(out.data()), &made,
               reinterpret_cast<const Bytef*>(part.data()), static_cast<uLong>(part.size()));
    blocks += out.substr(0, made);
    head += bytes_of(static_cast<std::uint32_t>(made), false);
  }
  return in_base64 ? base64(head) + base64(blocks) : head + blocks;
}

std::string vtp(Way way, bool packed) {
  std::string corners, offsets, corner_text, offset_text, appended;
  for (const Triangle& t : cube().triangles)
    for (const std::uint32_t v : t) {
      corners += bytes_of(static_cast<std::int64_t>(v), false);
      corner_text += std::to_string(v) + " ";
    }
  for (int i = 1; i <= 12; ++i) {
    offsets += bytes_of(std::int64_t{3} * i, false);
    offset_text += std::to_string(3 * i) + " ";
  }
  const auto array = [&](const std::string& head, const std::string& data,
                         const std::string& text) {
    const std::string begin = "<DataArray " + head + " format=\"";
    if (way == Way::kAscii) return begin + "ascii\">\n" + text + "\n</DataArray>\n";
    if (way == Way::kBase64)
      return begin + "binary\">\n  " + encoded(data, packed, true) + "\n</DataArray>\n";
    const std::string offset = std::to_string(appended.size());
    appended += encoded(data, packed, way == Way::kAppendedBase64);
    return begin + "appended\" offset=\"" + offset + "\"/>\n";
  };
  std::string out =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"0.1\" "
      "byte_order=\"LittleEndian\"";
  if (packed) out += " compressor=\"vtkZLibDataCompressor\"";
  out += ">\n<PolyData><Piece NumberOfPoints=\"8\" NumberOfPolys=\"12\">\n<Points>";
  out += array("type=\"Float32\" Name=\"Points\" NumberOfComponents=\"3\"", points(true, false),
               points(false, false));
  out += "</Points>\n<Polys>";
  out += array("type=\"Int64\" Name=\"connectivity\"", corners, corner_text);
  out += array("type=\"Int64\" Name=\"offsets\"", offsets, offset_text);
  out += "</Polys>\n</Piece></PolyData>\n";
  if (!appended.empty())
    out += std::string("<AppendedData encoding=\"") +
           (way == Way::kAppendedRaw ? "raw" : "base64") + "\">\n  _" + appended +
           "\n</AppendedData>\n";
  return out + "</VTKFile>\n";
}

TEST(VtkSurface, XmlInEveryEncoding) {
  for (const Way way : {Way::kAscii, Way::kBase64, Way::kAppendedRaw, Way::kAppendedBase64})
    for (const bool packed : {false, true}) {
      SCOPED_TRACE(static_cast<int>(way) * 10 + packed);
      expect_cube(vtp(way, packed), "vtp");
    }
}

TEST(VtkSurface, ADamagedXmlFileIsRefusedOrReadNeverACrash) {
  for (const Way way : {Way::kAscii, Way::kBase64, Way::kAppendedRaw})
    for (const bool packed : {false, true}) {
      const std::string whole = vtp(way, packed);
      for (std::size_t at = 0; at < whole.size(); at += 5) {
        std::string damaged = whole;
        damaged[at] = static_cast<char>(damaged[at] ^ 0x55);
        (void)load(damaged, "vtp");
        (void)load(whole.substr(0, at), "vtp");
      }
    }
}

TEST(VtkSurface, WhatIsNoSurfaceIsNamed) {
  const auto grid =
      load("# vtk DataFile Version 3.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\n", "vtk");
  ASSERT_FALSE(grid);
  EXPECT_NE(grid.error().message().find("POLYDATA"), std::string::npos);
  const auto xml = load("<VTKFile type=\"ImageData\"></VTKFile>", "vtp");
  ASSERT_FALSE(xml);
  EXPECT_NE(xml.error().message().find("PolyData"), std::string::npos);
}

}  // namespace
}  // namespace osteon
