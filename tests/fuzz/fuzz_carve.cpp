// Cuts from the bytes in a small block: whatever they are, the surface stays closed, the parts that
// changed give the same as the whole marched anew, and undo puts the bone back.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>

#include "osteon/base/check.h"
#include "osteon/carve/carved_surface.h"
#include "osteon/carve/removed.h"
#include "osteon/mesh/measure.h"

namespace {

using namespace osteon;

class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}
  bool left() const { return at_ < size_; }
  // -1 to 1, or not a number where the byte is the lowest.
  double number() {
    const auto byte = static_cast<std::int8_t>(left() ? data_[at_++] : 0);
    return byte == -128 ? std::nan("") : byte / 127.0;
  }
  Vec3 vector() {
    const double x = number();
    const double y = number();
    const double z = number();
    return {x, y, z};
  }

 private:
  const std::uint8_t* data_;
  std::size_t size_;
  std::size_t at_ = 0;
};

std::shared_ptr<const UncutField> small_block() {
  TriMesh mesh;
  for (int c = 0; c < 8; ++c)
    mesh.vertices.push_back(0.003 * Vec3(c & 1 ? 1 : -1, c & 2 ? 1 : -1, c & 4 ? 1 : -1));
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  UncutFieldOptions options;
  options.cell_m = 0.0004;
  auto made = UncutField::make(mesh, options);
  demand(made.has_value(), "a block has no field");
  return *made;
}

Pose read_pose(Bytes& bytes) {
  Pose X;
  X.p = 0.004 * bytes.vector();
  const Vec3 v = bytes.vector();
  X.q = Quat(1, v.x(), v.y(), v.z());
  X.q.normalize();
  return X;
}

void check_closed(const TriMesh& mesh) { demand(topology(mesh).closed(), "the surface is open"); }

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const auto block = small_block();
  auto made = CarvedField::make(block, {}, 400);
  CarvedField field = std::move(*made);
  CarvedSurface surface(field);
  surface.mesh_all(field);
  const auto whole = field.hash();
  const CarveState before = field.save();
  Bytes bytes(data, size);
  const auto kinds = cutter_kinds();
  for (int n = 0; n < 24 && bytes.left(); ++n) {
    const double share = bytes.number();
    const auto kind = static_cast<std::size_t>(std::isnan(share) ? 0 : 4.99 * (1 + share));
    const double width = 0.0005 + 0.001 * std::abs(bytes.number());
    const auto tool = make_cutter(kinds[kind].name, width);
    if (!tool) continue;
    const Pose from = read_pose(bytes);
    Pose to = from;
    to.p += 0.001 * bytes.vector();
    field.cut(*tool, from, to);
    if (n % 5 == 0) surface.update(field);
  }
  surface.update(field);
  const TriMesh mesh = surface.joined();
  check_closed(mesh);
  const auto anew = carved_mesh(field);
  demand(anew ? anew->vertices == mesh.vertices && anew->triangles == mesh.triangles
              : mesh.triangles.empty(),
         "blocks and whole differ");
  const double removed = total(removed_volume(field));
  demand(removed >= 0 && removed <= 1.02 * 0.006 * 0.006 * 0.006, "more went than there was");
  demand(field.restore(before).has_value() && field.hash() == whole, "undo left something");
  return 0;
}
