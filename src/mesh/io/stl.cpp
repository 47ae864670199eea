#include "io/stl.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <initializer_list>

#include "io/words.h"

namespace osteon {
namespace {

constexpr std::size_t kHeader = 80;
constexpr std::size_t kPreamble = kHeader + 4;
constexpr std::size_t kRecord = 50;

// Little-endian, whatever the machine.
std::uint32_t read_u32(const char* p) {
  std::uint32_t value = 0;
  for (int i = 3; i >= 0; --i) value = (value << 8) | static_cast<unsigned char>(p[i]);
  return value;
}

void write_u32(std::string& out, std::uint32_t value) {
  for (int i = 0; i < 4; ++i) out.push_back(static_cast<char>((value >> (8 * i)) & 0xffu));
}

Vec3 read_vec3(const char* p) {
  Vec3 v;
  for (int i = 0; i < 3; ++i) v[i] = std::bit_cast<float>(read_u32(p + 4 * i));
  return v;
}

void write_vec3(std::string& out, const Vec3& v) {
  for (int i = 0; i < 3; ++i)
    write_u32(out, std::bit_cast<std::uint32_t>(static_cast<float>(v[i])));
}

// Of the corners as they are stored: reading a file and writing it again gives the same bytes.
// They are read back because g++ 12 at -O3 drops the rounding of double -> float -> double.
Vec3 stored_normal(const char* corners) {
  const Vec3 a = read_vec3(corners);
  const Vec3 b = read_vec3(corners + 12);
  const Vec3 c = read_vec3(corners + 24);
  const Vec3 n = (b - a).cross(c - a);
  const double length = n.norm();
  return length > 0 ? Vec3(n / length) : Vec3(Vec3::Zero());
}

void add_triangle(TriMesh& mesh, const std::array<Vec3, 3>& corners) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), corners.begin(), corners.end());
  mesh.triangles.push_back({first, first + 1, first + 2});
}

Result<TriMesh> parse_binary(std::string_view bytes, const std::string& where) {
  const std::uint64_t count = read_u32(bytes.data() + kHeader);
  if (bytes.size() < kPreamble + kRecord * count)
    return fail("is truncated: it declares " + std::to_string(count) + " triangles but holds " +
                    std::to_string((bytes.size() - kPreamble) / kRecord),
                where, "Copy or export the file again");
  TriMesh mesh;
  mesh.vertices.reserve(3 * count);
  mesh.triangles.reserve(count);
  for (std::uint64_t t = 0; t < count; ++t) {
    const char* record = bytes.data() + kPreamble + kRecord * t;
    add_triangle(mesh, {read_vec3(record + 12), read_vec3(record + 24), read_vec3(record + 36)});
  }
  return mesh;
}

bool expect(Words& words, std::initializer_list<std::string_view> wanted) {
  return std::all_of(wanted.begin(), wanted.end(),
                     [&](std::string_view w) { return same_word(words.next(), w); });
}

bool parse_vec3(Words& words, Vec3& v) {
  for (int i = 0; i < 3; ++i)
    if (!parse_number(words.next(), v[i])) return false;
  return true;
}

// What follows the word "facet".
bool parse_facet(Words& words, TriMesh& mesh) {
  Vec3 ignored_normal;
  if (!expect(words, {"normal"}) || !parse_vec3(words, ignored_normal)) return false;
  if (!expect(words, {"outer", "loop"})) return false;
  std::array<Vec3, 3> corners;
  for (Vec3& corner : corners)
    if (!expect(words, {"vertex"}) || !parse_vec3(words, corner)) return false;
  if (!expect(words, {"endloop", "endfacet"})) return false;
  add_triangle(mesh, corners);
  return true;
}

Result<TriMesh> parse_ascii(std::string_view bytes, const std::string& where) {
  Words words(bytes);
  TriMesh mesh;
  bool inside = false;
  for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
    bool fine = true;
    if (same_word(word, inside ? "endsolid" : "solid")) {
      inside = !inside;
      words.rest_of_line();
    } else {
      fine = inside && same_word(word, "facet") && parse_facet(words, mesh);
    }
    if (!fine)
      return fail("is truncated or not ASCII STL here", where + ":" + std::to_string(words.line()),
                  "Export the file again, preferably as binary STL");
  }
  if (inside)
    return fail("is truncated: the last solid is not closed", where,
                "Copy or export the file again");
  return mesh;
}

// Some writers begin a binary file with "solid" too: then the size decides.
bool is_binary(std::string_view bytes) {
  if (bytes.size() >= kPreamble &&
      bytes.size() == kPreamble + kRecord * std::uint64_t{read_u32(bytes.data() + kHeader)})
    return true;
  return !same_word(Words(bytes).next(), "solid");
}

}  // namespace

Result<TriMesh> parse_stl(std::string_view bytes, const std::string& where) {
  if (!is_binary(bytes)) return parse_ascii(bytes, where);
  if (bytes.size() < kPreamble)
    return fail("is too short for an STL file", where, "Copy or export the file again");
  return parse_binary(bytes, where);
}

std::string format_stl(const TriMesh& mesh, double metres_per_unit) {
  std::string out = "Osteon binary STL";
  out.reserve(kPreamble + kRecord * mesh.triangles.size());
  out.resize(kHeader, '\0');
  write_u32(out, static_cast<std::uint32_t>(mesh.triangles.size()));
  for (const Triangle& t : mesh.triangles) {
    std::string corners;
    for (const std::uint32_t v : t) write_vec3(corners, mesh.vertices[v] / metres_per_unit);
    write_vec3(out, stored_normal(corners.data()));
    out += corners;
    out.append(2, '\0');
  }
  return out;
}

}  // namespace osteon
