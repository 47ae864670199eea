#include "io/obj.h"

#include <algorithm>
#include <array>
#include <vector>

#include "io/polygon_faces.h"
#include "io/words.h"

namespace osteon {
namespace {

// What says nothing about the surface. Points (p) and lines (l) have no area.
constexpr std::array<std::string_view, 18> kPassedOver = {
    "vt",     "vn",     "vp",    "g",   "o", "s", "mg",       "usemtl",   "mtllib",
    "usemap", "maplib", "bevel", "lod", "p", "l", "c_interp", "d_interp", "shadow_obj"};

bool parse_vertex(Words& words, TriMesh& mesh) {
  Vec3 v;
  for (int i = 0; i < 3; ++i)
    if (!parse_number(words.next_on_line(), v[i])) return false;
  mesh.vertices.push_back(v);
  words.rest_of_line();  // a weight or a colour
  return true;
}

// "7", "7/1", "7//3", "7/1/3"; a negative index counts back from the last vertex.
bool parse_corner(std::string_view word, std::size_t vertex_count, std::uint32_t& corner) {
  const std::string_view first = word.substr(0, word.find('/'));
  const auto count = static_cast<long long>(vertex_count);
  long long index = 0;
  if (!parse_integer(first, index)) return false;
  if (index < 0) index += count + 1;
  if (index < 1 || index > count) return false;
  corner = static_cast<std::uint32_t>(index - 1);
  return true;
}

bool parse_face(Words& words, TriMesh& mesh) {
  std::vector<std::uint32_t> corners;
  for (std::string_view word = words.next_on_line(); !word.empty(); word = words.next_on_line()) {
    std::uint32_t corner = 0;
    if (!parse_corner(word, mesh.vertices.size(), corner)) return false;
    corners.push_back(corner);
  }
  return add_polygon(mesh, corners);
}

}  // namespace

Result<TriMesh> parse_obj(std::string_view bytes, const std::string& where) {
  Words words(bytes);
  TriMesh mesh;
  for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
    const std::string here = where + ":" + std::to_string(words.line());
    const bool passed_over =
        std::find(kPassedOver.begin(), kPassedOver.end(), word) != kPassedOver.end();
    if (word.front() == '#' || passed_over) {
      words.rest_of_line();
    } else if (word == "v") {
      if (!parse_vertex(words, mesh)) return fail("the vertex does not have three numbers", here);
    } else if (word == "f") {
      if (!parse_face(words, mesh))
        return fail(
            "the face does not name 3 to " + std::to_string(kMostCorners) + " vertices above it",
            here, "Copy or export the file again");
    } else {
      return fail("is not valid OBJ", here, "Copy or export the file again");
    }
  }
  return mesh;
}

}  // namespace osteon
