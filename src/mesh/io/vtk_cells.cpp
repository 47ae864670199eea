#include "io/vtk_cells.h"

#include <cstring>

#include "io/polygon_faces.h"

namespace osteon {
namespace {

// The corners of cell i; empty when they are no vertices of the mesh.
std::vector<std::uint32_t> corners_of(const TriMesh& mesh, const VtkFaces& faces, std::size_t i) {
  const std::int64_t first = faces.offset[i], last = faces.offset[i + 1];
  const auto count = static_cast<std::int64_t>(faces.corner.size());
  std::vector<std::uint32_t> corners;
  if (first < 0 || last < first || last > count) return corners;
  for (std::int64_t c = first; c < last; ++c) {
    const std::int64_t v = faces.corner[static_cast<std::size_t>(c)];
    if (v < 0 || v >= static_cast<std::int64_t>(mesh.vertices.size())) return {};
    corners.push_back(static_cast<std::uint32_t>(v));
  }
  return corners;
}

template <class Number>
double as(const char* bytes) {
  Number value;
  std::memcpy(&value, bytes, sizeof value);
  return static_cast<double>(value);
}

struct NumberType {
  std::string_view name;
  std::size_t size;
  double (*read)(const char*);
};

// Names of the legacy files, of VTK's own types and of the XML files.
constexpr NumberType kTypes[] = {
    {"float", 4, as<float>},
    {"double", 8, as<double>},
    {"char", 1, as<std::int8_t>},
    {"unsigned_char", 1, as<std::uint8_t>},
    {"short", 2, as<std::int16_t>},
    {"unsigned_short", 2, as<std::uint16_t>},
    {"int", 4, as<std::int32_t>},
    {"unsigned_int", 4, as<std::uint32_t>},
    {"long", 8, as<std::int64_t>},
    {"unsigned_long", 8, as<std::uint64_t>},
    {"vtkIdType", 4, as<std::int32_t>},  // in legacy files always an int
    {"vtktypeint64", 8, as<std::int64_t>},
    {"vtktypeint32", 4, as<std::int32_t>},
    {"vtktypeuint8", 1, as<std::uint8_t>},
    {"Float32", 4, as<float>},
    {"Float64", 8, as<double>},
    {"Int8", 1, as<std::int8_t>},
    {"UInt8", 1, as<std::uint8_t>},
    {"Int16", 2, as<std::int16_t>},
    {"UInt16", 2, as<std::uint16_t>},
    {"Int32", 4, as<std::int32_t>},
    {"UInt32", 4, as<std::uint32_t>},
    {"Int64", 8, as<std::int64_t>},
    {"UInt64", 8, as<std::uint64_t>},
};

const NumberType* find_type(std::string_view name) {
  for (const NumberType& type : kTypes)
    if (type.name == name) return &type;
  return nullptr;
}

}  // namespace

bool add_vtk_polygons(TriMesh& mesh, const VtkFaces& faces) {
  for (std::size_t i = 0; i + 1 < faces.offset.size(); ++i)
    if (!add_polygon(mesh, corners_of(mesh, faces, i))) return false;
  return true;
}

// Every other triangle of a strip runs the other way.
bool add_vtk_strips(TriMesh& mesh, const VtkFaces& faces) {
  for (std::size_t i = 0; i + 1 < faces.offset.size(); ++i) {
    const std::vector<std::uint32_t> c = corners_of(mesh, faces, i);
    if (c.size() < 3) return false;
    for (std::size_t k = 0; k + 2 < c.size(); ++k)
      mesh.triangles.push_back(k % 2 == 0 ? Triangle{c[k], c[k + 1], c[k + 2]}
                                          : Triangle{c[k + 1], c[k], c[k + 2]});
  }
  return true;
}

std::size_t vtk_type_size(std::string_view type) {
  const NumberType* known = find_type(type);
  return known ? known->size : 0;
}

double vtk_number(const char* bytes, std::string_view type) { return find_type(type)->read(bytes); }

}  // namespace osteon
