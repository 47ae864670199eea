#include "io/vtp.h"

#include <cmath>
#include <utility>

#include "io/vtk_cells.h"
#include "io/vtp_array.h"

namespace osteon {
namespace {

class VtpSurface {
 public:
  VtpSurface(std::string_view bytes, const std::string& where) : bytes_(bytes), where_(where) {}

  Result<TriMesh> run() {
    std::size_t at = 0;
    const auto file = next_element(bytes_, "VTKFile", at);
    if (!file || file->attribute("type") != "PolyData")
      return broken("is not a VTK XML file of the type PolyData");
    if (file->attribute("byte_order") == "BigEndian")
      return broken("is big-endian, which is not supported");
    const std::string_view packer = file->attribute("compressor");
    if (!packer.empty() && packer != "vtkZLibDataCompressor")
      return broken("is compressed by " + std::string(packer) + ", which is not supported");
    encoding_.packed = !packer.empty();
    encoding_.wide_header = file->attribute("header_type") == "UInt64";
    std::string_view text = file->body;
    if (const std::size_t mark = text.find("<AppendedData"); mark != std::string_view::npos) {
      if (!find_appended(text.substr(mark))) return broken("has appended data that cannot be read");
      text = text.substr(0, mark);
    }
    for (at = 0; const auto piece = next_element(text, "Piece", at);)
      if (auto read = read_piece(piece->body); !read) return tl::unexpected(read.error());
    return std::move(mesh_);
  }

 private:
  tl::unexpected<Error> broken(const std::string& what) const {
    return fail(what, where_, "Write the file again, as PolyData in ASCII or compressed by zlib");
  }

  bool find_appended(std::string_view text) {
    const std::size_t end = text.find('>');
    if (end == std::string_view::npos) return false;
    const XmlElement element{text.substr(1, end - 1), {}};
    encoding_.appended_base64 = element.attribute("encoding") == "base64";
    const std::size_t underscore = text.find('_', end);
    if (underscore == std::string_view::npos) return false;
    encoding_.appended = text.substr(underscore + 1);
    return true;
  }

  Result<void> read_piece(std::string_view piece) {
    TriMesh part;
    if (!read_points(piece, part)) return broken("has points that cannot be read");
    for (const bool strips : {false, true}) {
      VtkFaces faces;
      if (!read_faces(piece, strips ? "Strips" : "Polys", faces) ||
          !(strips ? add_vtk_strips(part, faces) : add_vtk_polygons(part, faces)))
        return broken("has polygons that cannot be read");
    }
    const auto first = static_cast<std::uint32_t>(mesh_.vertices.size());
    mesh_.vertices.insert(mesh_.vertices.end(), part.vertices.begin(), part.vertices.end());
    for (const Triangle& t : part.triangles)
      mesh_.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    return {};
  }

  bool read_points(std::string_view piece, TriMesh& part) const {
    std::size_t at = 0;
    const auto points = next_element(piece, "Points", at);
    if (!points) return false;
    at = 0;
    const auto array = next_element(points->body, "DataArray", at);
    if (!array) return false;
    const auto values = vtp_numbers(*array, encoding_);
    if (!values || values->size() % 3 != 0) return false;
    for (std::size_t i = 0; i < values->size(); i += 3)
      part.vertices.emplace_back((*values)[i], (*values)[i + 1], (*values)[i + 2]);
    return true;
  }

  // `offsets` holds where each cell ends.
  bool read_faces(std::string_view piece, std::string_view kind, VtkFaces& faces) const {
    std::size_t at = 0;
    const auto cells = next_element(piece, kind, at);
    if (!cells) return true;
    for (at = 0; const auto array = next_element(cells->body, "DataArray", at);) {
      const std::string_view name = array->attribute("Name");
      if (name != "connectivity" && name != "offsets") continue;
      const auto values = vtp_numbers(*array, encoding_);
      if (!values) return false;
      for (const double v : *values) {
        if (!(std::abs(v) < 1e15)) return false;
        (name == "offsets" ? faces.offset : faces.corner).push_back(static_cast<std::int64_t>(v));
      }
    }
    return true;
  }

  std::string_view bytes_;
  std::string where_;
  VtpEncoding encoding_;
  TriMesh mesh_;
};

}  // namespace

Result<TriMesh> parse_vtp(std::string_view bytes, const std::string& where) {
  return VtpSurface(bytes, where).run();
}

}  // namespace osteon
