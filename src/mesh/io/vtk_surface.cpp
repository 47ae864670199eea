#include "io/vtk_surface.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "io/vtk_cells.h"
#include "io/words.h"

namespace osteon {
namespace {

// Kitware, "VTK file formats" (2023): sections of a name, counts and numbers follow each other.
class LegacySurface {
 public:
  LegacySurface(std::string_view bytes, const std::string& where) : bytes_(bytes), where_(where) {}

  Result<TriMesh> run() {
    if (!read_head()) return broken("has no legacy VTK header with DATASET POLYDATA");
    while (!done_) {
      const std::string_view name = word();
      if (name.empty()) break;
      if (auto read = read_section(name); !read) return tl::unexpected(read.error());
    }
    if (!add_vtk_polygons(mesh_, polygons_) || !add_vtk_strips(mesh_, strips_))
      return broken("has a polygon with corners that do not exist");
    return std::move(mesh_);
  }

 private:
  std::string_view line() {
    const std::size_t start = at_;
    const std::size_t end = std::min(bytes_.find('\n', at_), bytes_.size());
    at_ = std::min(end + 1, bytes_.size());
    std::string_view text = bytes_.substr(start, end - start);
    if (text.ends_with('\r')) text.remove_suffix(1);
    return text;
  }
  std::string_view word() {
    const auto blank = [](char c) { return c == ' ' || (c >= '\t' && c <= '\r'); };
    while (at_ < bytes_.size() && blank(bytes_[at_])) ++at_;
    const std::size_t start = at_;
    while (at_ < bytes_.size() && !blank(bytes_[at_])) ++at_;
    return bytes_.substr(start, at_ - start);
  }
  bool count(std::size_t& value) {
    long long read = 0;
    // No number takes less than a byte, so a larger count is a lie.
    const bool good = parse_integer(word(), read) && read >= 0 &&
                      static_cast<unsigned long long>(read) <= bytes_.size();
    value = good ? static_cast<std::size_t>(read) : 0;
    return good;
  }
  tl::unexpected<Error> broken(const std::string& what) const {
    return fail(what, where_ + ", byte " + std::to_string(at_),
                "Write the file again, as a surface (VTK PolyData)");
  }

  bool read_head() {
    const std::string_view head = line();
    constexpr std::string_view kVersion = "# vtk DataFile Version ";
    if (!head.starts_with(kVersion)) return false;
    double version = 0;
    if (!parse_number(head.substr(kVersion.size()), version)) return false;
    has_offsets_ = version >= 5;
    line();  // the title
    const std::string_view kind = word();
    binary_ = same_word(kind, "binary");
    if (!binary_ && !same_word(kind, "ascii")) return false;
    return same_word(word(), "dataset") && same_word(word(), "polydata");
  }

  Result<void> read_section(std::string_view name) {
    if (same_word(name, "points")) return read_points();
    if (same_word(name, "polygons")) return read_faces(polygons_);
    if (same_word(name, "triangle_strips")) return read_faces(strips_);
    VtkFaces other;
    if (same_word(name, "vertices") || same_word(name, "lines")) return read_faces(other);
    if (same_word(name, "field")) return pass_field();
    if (same_word(name, "metadata")) {
      line();
      while (at_ < bytes_.size() && !line().empty()) {
      }
      return {};
    }
    // What is known of the points and cells: colours and the like.
    if (same_word(name, "point_data") || same_word(name, "cell_data")) {
      done_ = true;
      return {};
    }
    return broken("has the unknown section '" + std::string(name.substr(0, 32)) + "'");
  }

  bool numbers(std::string_view type, std::size_t wanted, std::vector<double>& out) {
    if (!binary_) return ascii_numbers(wanted, out);
    line();  // the rest of the line that names the type
    const std::size_t size = vtk_type_size(type);
    if (size == 0 || wanted > (bytes_.size() - at_) / size) return false;
    for (std::size_t i = 0; i < wanted; ++i, at_ += size) {
      char least_first[8];
      for (std::size_t k = 0; k < size; ++k) least_first[k] = bytes_[at_ + size - 1 - k];
      out.push_back(vtk_number(least_first, type));
    }
    return true;
  }
  bool ascii_numbers(std::size_t wanted, std::vector<double>& out) {
    for (std::size_t i = 0; i < wanted; ++i) {
      double value = 0;
      if (!parse_number(word(), value)) return false;
      out.push_back(value);
    }
    return true;
  }
  bool indices(std::string_view type, std::size_t wanted, std::vector<std::int64_t>& out) {
    std::vector<double> values;
    if (!numbers(type, wanted, values)) return false;
    for (const double v : values) {
      if (!(std::abs(v) < 1e15)) return false;
      out.push_back(static_cast<std::int64_t>(v));
    }
    return true;
  }

  Result<void> read_points() {
    std::size_t points = 0;
    std::vector<double> values;
    if (!mesh_.vertices.empty() || !count(points) || !numbers(word(), 3 * points, values))
      return broken("has points that cannot be read");
    for (std::size_t i = 0; i < points; ++i)
      mesh_.vertices.emplace_back(values[3 * i], values[3 * i + 1], values[3 * i + 2]);
    return {};
  }

  Result<void> read_faces(VtkFaces& faces) {
    std::size_t cells = 0, size = 0;
    const bool read =
        count(cells) && count(size) &&
        (has_offsets_ ? read_offsets(cells, size, faces) : read_counted(cells, size, faces));
    if (read) return {};
    return broken("has polygons that cannot be read");
  }
  bool read_offsets(std::size_t offsets, std::size_t corners, VtkFaces& faces) {
    faces = {{}, {}};
    if (offsets > 0 && (!same_word(word(), "offsets") || !indices(word(), offsets, faces.offset)))
      return false;
    return corners == 0 ||
           (same_word(word(), "connectivity") && indices(word(), corners, faces.corner));
  }
  // Of each cell the count of its corners, then they.
  bool read_counted(std::size_t cells, std::size_t size, VtkFaces& faces) {
    std::vector<std::int64_t> values;
    if (!indices("int", size, values)) return false;
    std::size_t at = 0;
    for (std::size_t i = 0; i < cells; ++i) {
      if (at >= values.size() || values[at] < 0) return false;
      const auto corners = static_cast<std::size_t>(values[at++]);
      if (corners > values.size() - at) return false;
      for (std::size_t k = 0; k < corners; ++k) faces.corner.push_back(values[at++]);
      faces.offset.push_back(static_cast<std::int64_t>(faces.corner.size()));
    }
    return at == values.size();
  }

  Result<void> pass_field() {
    word();  // its name
    std::size_t arrays = 0;
    if (!count(arrays)) return broken("has a field that cannot be read");
    for (std::size_t i = 0; i < arrays; ++i) {
      word();
      std::size_t components = 0, tuples = 0;
      std::vector<double> passed;
      if (!count(components) || !count(tuples) || components > 64 ||
          !numbers(word(), components * tuples, passed))
        return broken("has a field that cannot be read");
    }
    return {};
  }

  std::string_view bytes_;
  std::string where_;
  std::size_t at_ = 0;
  bool binary_ = false, has_offsets_ = false, done_ = false;
  TriMesh mesh_;
  VtkFaces polygons_, strips_;
};

}  // namespace

Result<TriMesh> parse_vtk_surface(std::string_view bytes, const std::string& where) {
  return LegacySurface(bytes, where).run();
}

}  // namespace osteon
