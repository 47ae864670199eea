#include "io/vtk.h"

#include <array>
#include <charconv>
#include <utility>
#include <vector>

#include "io/words.h"

namespace osteon {
namespace {

constexpr long long kTetrahedronType = 10;
constexpr long long kLastFlatType = 9;  // points, lines, polygons
constexpr long long kLargestVersion = 5;

/// The cells of a file, in either way of writing them: each one's corners lie between two starts.
struct VtkCells {
  std::vector<std::size_t> start{0};
  std::vector<std::uint32_t> corner;
  std::vector<std::size_t> line;  ///< of the file, of each cell
  std::size_t count() const { return start.size() - 1; }
};

class VtkReader {
 public:
  VtkReader(std::string_view bytes, const std::string& where)
      : words_(bytes), size_(bytes.size()), where_(where) {}
  Result<TetMesh> run();

 private:
  Result<void> read_head();
  Result<void> read_section(std::string_view name);
  Result<void> read_points();
  Result<void> read_cells();
  Result<void> read_counted_cells(std::size_t cells, std::size_t numbers);
  Result<void> read_offset_cells(std::size_t offsets, std::size_t corners);
  Result<void> read_types();
  Result<void> pass_field();
  void pass_metadata();
  Result<void> collect();

  bool read_count(std::size_t& count);
  bool read_corner(std::uint32_t& corner);
  /// Whether the rest of the file can hold so many words.
  bool fits(std::size_t words) const { return words <= (size_ - words_.offset()) / 2 + 1; }
  std::string here() const { return where_ + ":" + std::to_string(words_.line()); }
  tl::unexpected<Error> broken(const std::string& what) const {
    return fail(what, here(), "Write the file again, as a legacy VTK file in ASCII");
  }

  Words words_;
  std::size_t size_;
  std::string where_;
  long long version_ = 0;
  TetMesh mesh_;
  VtkCells cells_;
  std::vector<long long> types_;
  bool has_points_ = false, has_cells_ = false, has_types_ = false;
};

bool VtkReader::read_count(std::size_t& count) {
  long long value = 0;
  if (!parse_integer(words_.next(), value) || value < 0) return false;
  count = static_cast<std::size_t>(value);
  return true;
}

bool VtkReader::read_corner(std::uint32_t& corner) {
  std::size_t value = 0;
  if (!read_count(value) || value >= mesh_.vertices.size()) return false;
  corner = static_cast<std::uint32_t>(value);
  return true;
}

// "# vtk DataFile Version 3.0", a title, "ASCII", "DATASET UNSTRUCTURED_GRID".
Result<void> VtkReader::read_head() {
  const std::string_view first = words_.rest_of_line();
  constexpr std::string_view kMark = "# vtk DataFile Version ";
  if (!first.starts_with(kMark))
    return fail("is not a legacy VTK file", where_, "Use one in ASCII");
  Words version(first.substr(kMark.size()));
  const std::string_view number = version.next();
  if (!parse_integer(number.substr(0, number.find('.')), version_) || version_ < 1 ||
      version_ > kLargestVersion)
    return broken("the file's version is not one of 1 to 5");
  words_.rest_of_line();
  const std::string_view coding = words_.next();
  if (same_word(coding, "binary")) return broken("the file is binary");
  if (!same_word(coding, "ascii")) return broken("the third line is not ASCII");
  const bool dataset = same_word(words_.next(), "dataset");
  if (!dataset || !same_word(words_.next(), "unstructured_grid"))
    return broken("the data set is not an unstructured grid");
  return {};
}

Result<void> VtkReader::read_points() {
  std::size_t count = 0;
  if (has_points_ || !read_count(count)) return broken("POINTS has no count, or is given twice");
  words_.next();  // the type of the numbers
  if (count > 0xffffffffu || !fits(3 * count))
    return broken("the file is truncated: " + std::to_string(count) + " points do not fit");
  mesh_.vertices.resize(count);
  for (Vec3& v : mesh_.vertices)
    for (Vec3::Index k = 0; k < 3; ++k)
      if (!parse_number(words_.next(), v[k])) return broken("a coordinate is not a number");
  has_points_ = true;
  return {};
}

Result<void> VtkReader::read_counted_cells(std::size_t cells, std::size_t numbers) {
  if (!fits(numbers) || cells > numbers)
    return broken("the file is truncated: " + std::to_string(numbers) + " numbers do not fit");
  for (std::size_t i = 0; i < cells; ++i) {
    std::size_t corners = 0;
    if (!read_count(corners) || corners > numbers) return broken("a cell has no count");
    for (std::size_t k = 0; k < corners; ++k) {
      std::uint32_t corner = 0;
      if (!read_corner(corner)) return broken("a cell refers to a point that does not exist");
      cells_.corner.push_back(corner);
    }
    cells_.start.push_back(cells_.corner.size());
    cells_.line.push_back(words_.line());
  }
  return {};
}

Result<void> VtkReader::read_offset_cells(std::size_t offsets, std::size_t corners) {
  if (offsets == 0 || !fits(offsets) || !fits(corners))
    return broken("the file is truncated: the cells do not fit");
  if (!same_word(words_.next(), "offsets")) return broken("OFFSETS is missing");
  words_.next();
  cells_.start.resize(offsets);
  for (std::size_t i = 0; i < offsets; ++i) {
    const std::size_t least = i == 0 ? 0 : cells_.start[i - 1];
    if (!read_count(cells_.start[i]) || cells_.start[i] < least || cells_.start[i] > corners)
      return broken("the offsets do not increase from 0 to the number of corners");
  }
  if (cells_.start.front() != 0 || cells_.start.back() != corners)
    return broken("the offsets do not increase from 0 to the number of corners");
  if (!same_word(words_.next(), "connectivity")) return broken("CONNECTIVITY is missing");
  words_.next();
  cells_.corner.resize(corners);
  for (std::uint32_t& corner : cells_.corner)
    if (!read_corner(corner)) return broken("a cell refers to a point that does not exist");
  cells_.line.assign(cells_.count(), words_.line());
  return {};
}

Result<void> VtkReader::read_cells() {
  std::size_t first = 0, second = 0;
  if (!has_points_) return broken("CELLS comes before POINTS");
  if (has_cells_ || !read_count(first) || !read_count(second))
    return broken("CELLS has no two counts, or is given twice");
  has_cells_ = true;
  return version_ >= 5 ? read_offset_cells(first, second) : read_counted_cells(first, second);
}

Result<void> VtkReader::read_types() {
  std::size_t count = 0;
  if (has_types_ || !read_count(count) || !fits(count))
    return broken("CELL_TYPES has a wrong count, or is given twice");
  types_.resize(count);
  for (long long& type : types_)
    if (!parse_integer(words_.next(), type)) return broken("a cell's type is not a number");
  has_types_ = true;
  return {};
}

// "FIELD name arrays", then of each array "name components tuples type" and its values.
Result<void> VtkReader::pass_field() {
  std::size_t arrays = 0;
  words_.next();
  if (!read_count(arrays) || !fits(arrays)) return broken("FIELD has a wrong count");
  for (std::size_t i = 0; i < arrays; ++i) {
    std::size_t components = 0, tuples = 0;
    words_.next();
    if (!read_count(components) || !read_count(tuples) || !fits(components) || !fits(tuples) ||
        !fits(components * tuples))
      return broken("an array of FIELD has a wrong size");
    words_.next();
    for (std::size_t k = 0; k < components * tuples; ++k) words_.next();
  }
  return {};
}

// Up to an empty line.
void VtkReader::pass_metadata() {
  words_.rest_of_line();
  while (!words_.at_end()) {
    Words line(words_.rest_of_line());
    if (line.next().empty()) return;
  }
}

Result<void> VtkReader::read_section(std::string_view name) {
  if (same_word(name, "points")) return read_points();
  if (same_word(name, "cells")) return read_cells();
  if (same_word(name, "cell_types")) return read_types();
  if (same_word(name, "field")) return pass_field();
  if (!same_word(name, "metadata"))
    return broken("'" + std::string(name.substr(0, 40)) + "' is not expected here");
  pass_metadata();
  return {};
}

Result<void> VtkReader::collect() {
  if (!has_points_ || !has_cells_ || !has_types_)
    return broken("the file is truncated: POINTS, CELLS or CELL_TYPES is missing");
  if (types_.size() != cells_.count())
    return broken("there are " + std::to_string(cells_.count()) + " cells and " +
                  std::to_string(types_.size()) + " types");
  for (std::size_t i = 0; i < types_.size(); ++i) {
    const std::string at = where_ + ":" + std::to_string(cells_.line[i]);
    if (types_[i] >= 0 && types_[i] <= kLastFlatType) continue;
    if (types_[i] != kTetrahedronType)
      return fail("cell " + std::to_string(i) + " is of type " + std::to_string(types_[i]) +
                      ", not a tetrahedron (10)",
                  at, "Split the cells into tetrahedra first");
    const std::uint32_t* corner = cells_.corner.data() + cells_.start[i];
    if (cells_.start[i + 1] - cells_.start[i] != 4)
      return fail("tetrahedron " + std::to_string(i) + " does not have four corners", at);
    const Tetrahedron tet{corner[0], corner[1], corner[2], corner[3]};
    for (std::size_t k = 0; k < 4; ++k)
      for (std::size_t j = 0; j < k; ++j)
        if (tet[k] == tet[j])
          return fail("tetrahedron " + std::to_string(i) + " uses a point twice", at);
    mesh_.tets.push_back(tet);
  }
  if (mesh_.tets.empty()) return fail("holds no tetrahedron", where_, "Export the solid's mesh");
  return {};
}

Result<TetMesh> VtkReader::run() {
  if (auto head = read_head(); !head) return tl::unexpected(head.error());
  for (std::string_view name = words_.next(); !name.empty(); name = words_.next()) {
    // What hangs on points and cells is of no use here, and comes last.
    if (same_word(name, "cell_data") || same_word(name, "point_data")) break;
    if (auto section = read_section(name); !section) return tl::unexpected(section.error());
  }
  if (auto collected = collect(); !collected) return tl::unexpected(collected.error());
  return std::move(mesh_);
}

void write_number(std::string& out, double value) {
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  out.append(text.data(), end);
}

}  // namespace

Result<TetMesh> parse_vtk(std::string_view bytes, const std::string& where) {
  return VtkReader(bytes, where).run();
}

std::string format_vtk(const TetMesh& mesh, double metres_per_unit) {
  const std::string tets = std::to_string(mesh.tets.size());
  std::string out = "# vtk DataFile Version 3.0\ntetrahedra by Osteon\nASCII\n";
  out += "DATASET UNSTRUCTURED_GRID\nPOINTS " + std::to_string(mesh.vertices.size()) + " double\n";
  for (const Vec3& v : mesh.vertices)
    for (Vec3::Index k = 0; k < 3; ++k) {
      write_number(out, v[k] / metres_per_unit);
      out += k < 2 ? ' ' : '\n';
    }
  out += "CELLS " + tets + " " + std::to_string(5 * mesh.tets.size()) + "\n";
  for (const Tetrahedron& tet : mesh.tets) {
    out += '4';
    for (const std::uint32_t v : tet) {
      out += ' ';
      out += std::to_string(v);
    }
    out += '\n';
  }
  out += "CELL_TYPES " + tets + "\n";
  for (std::size_t i = 0; i < mesh.tets.size(); ++i) out += "10\n";
  return out;
}

}  // namespace osteon
