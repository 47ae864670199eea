#include "io/ply.h"

#include <array>
#include <bit>
#include <cmath>
#include <vector>

#include "io/ply_header.h"
#include "io/polygon_faces.h"
#include "io/words.h"

namespace osteon {
namespace {

std::size_t size_of(PlyType type) {
  switch (type) {
    case PlyType::kInt8:
    case PlyType::kUint8:
      return 1;
    case PlyType::kInt16:
    case PlyType::kUint16:
      return 2;
    case PlyType::kInt32:
    case PlyType::kUint32:
    case PlyType::kFloat32:
      return 4;
    case PlyType::kFloat64:
      return 8;
  }
  return 8;
}

double decode(PlyType type, std::uint64_t bits) {
  switch (type) {
    case PlyType::kInt8:
      return static_cast<std::int8_t>(bits);
    case PlyType::kUint8:
      return static_cast<std::uint8_t>(bits);
    case PlyType::kInt16:
      return static_cast<std::int16_t>(bits);
    case PlyType::kUint16:
      return static_cast<std::uint16_t>(bits);
    case PlyType::kInt32:
      return static_cast<std::int32_t>(bits);
    case PlyType::kUint32:
      return static_cast<std::uint32_t>(bits);
    case PlyType::kFloat32:
      return std::bit_cast<float>(static_cast<std::uint32_t>(bits));
    case PlyType::kFloat64:
      return std::bit_cast<double>(bits);
  }
  return 0;
}

// The values after the header, one by one.
class PlyValues {
 public:
  PlyValues(std::string_view data, PlyFormat format) : data_(data), words_(data), format_(format) {}

  // False at the end of the data and for a word that is no number.
  bool next(PlyType type, double& value) {
    if (format_ == PlyFormat::kAscii) return parse_number(words_.next(), value);
    const std::size_t size = size_of(type);
    if (data_.size() - at_ < size) return false;
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < size; ++i) {
      const std::size_t from = format_ == PlyFormat::kBigEndian ? i : size - 1 - i;
      bits = (bits << 8) | static_cast<unsigned char>(data_[at_ + from]);
    }
    at_ += size;
    value = decode(type, bits);
    return true;
  }

  bool next_count(PlyType type, std::uint64_t& count) {
    double value = 0;
    if (!next(type, value) || !(value >= 0 && value <= 4294967295.0)) return false;
    count = static_cast<std::uint64_t>(value);
    return static_cast<double>(count) == value;
  }

 private:
  std::string_view data_;
  Words words_;
  PlyFormat format_;
  std::size_t at_ = 0;
};

bool read_list(PlyValues& values, const PlyProperty& property, std::vector<double>& list) {
  list.clear();
  std::uint64_t count = 0;
  if (!values.next_count(*property.count_type, count)) return false;
  for (std::uint64_t i = 0; i < count; ++i) {
    double value = 0;
    if (!values.next(property.type, value)) return false;
    list.push_back(value);
  }
  return true;
}

bool read_vertex(PlyValues& values, const PlyElement& element, TriMesh& mesh) {
  static constexpr std::array<std::string_view, 3> kAxes = {"x", "y", "z"};
  Vec3 v = Vec3::Zero();
  std::vector<double> ignored;
  for (const PlyProperty& property : element.properties) {
    double value = 0;
    if (property.count_type ? !read_list(values, property, ignored)
                            : !values.next(property.type, value))
      return false;
    for (std::size_t i = 0; i < 3; ++i)
      if (!property.count_type && property.name == kAxes[i]) v[static_cast<int>(i)] = value;
  }
  mesh.vertices.push_back(v);
  return true;
}

bool is_corner_list(const PlyProperty& property) {
  return property.count_type &&
         (property.name == "vertex_indices" || property.name == "vertex_index");
}

bool as_corners(const std::vector<double>& list, std::vector<std::uint32_t>& corners) {
  corners.clear();
  for (const double value : list) {
    if (!(value >= 0 && value < 4294967295.0) || value != std::floor(value)) return false;
    corners.push_back(static_cast<std::uint32_t>(value));
  }
  return true;
}

struct PlyFace {
  std::vector<std::uint32_t> corners;
  bool sound = true;
};

bool read_face(PlyValues& values, const PlyElement& element, PlyFace& face) {
  std::vector<double> list;
  for (const PlyProperty& property : element.properties) {
    double value = 0;
    if (property.count_type ? !read_list(values, property, list)
                            : !values.next(property.type, value))
      return false;
    if (is_corner_list(property)) face.sound = as_corners(list, face.corners);
  }
  return true;
}

bool has_position(const PlyElement& element) {
  int axes = 0;
  for (const PlyProperty& p : element.properties)
    axes += !p.count_type && (p.name == "x" || p.name == "y" || p.name == "z");
  return axes == 3;
}

tl::unexpected<Error> truncated(const std::string& name, std::uint64_t index,
                                const std::string& where) {
  return fail("is truncated or broken in " + name + " " + std::to_string(index), where,
              "Copy or export the file again");
}

}  // namespace

Result<TriMesh> parse_ply(std::string_view bytes, const std::string& where) {
  const auto header = parse_ply_header(bytes, where);
  if (!header) return tl::unexpected(header.error());
  PlyValues values(bytes.substr(header->size), header->format);
  TriMesh mesh;
  std::vector<std::vector<std::uint32_t>> faces;  // may stand before the vertices
  for (const PlyElement& element : header->elements) {
    const bool is_vertex = element.name == "vertex";
    if (is_vertex && !has_position(element)) return fail("its vertices lack x, y or z", where);
    for (std::uint64_t i = 0; i < element.count; ++i) {
      PlyFace face;
      if (is_vertex ? !read_vertex(values, element, mesh) : !read_face(values, element, face))
        return truncated(element.name, i, where);
      if (element.name != "face") continue;
      if (!face.sound) return truncated(element.name, i, where);
      faces.push_back(std::move(face.corners));
    }
  }
  for (std::size_t i = 0; i < faces.size(); ++i)
    if (!add_polygon(mesh, faces[i]))
      return fail("face " + std::to_string(i) + " does not name 3 to " +
                      std::to_string(kMostCorners) + " of the vertices",
                  where, "Copy or export the file again");
  return mesh;
}

}  // namespace osteon
