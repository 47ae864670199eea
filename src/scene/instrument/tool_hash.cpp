#include "osteon/scene/tool_hash.h"

#include <string_view>

#include "osteon/base/hash.h"

namespace osteon {
namespace {

void add_rod(Hasher& hasher, const Capsule& rod) {
  hasher.add(rod.p0);
  hasher.add(rod.p1);
  hasher.add(rod.radius);
}

void add_part(Hasher& hasher, const Primitive& part) {
  hasher.add(static_cast<std::uint8_t>(part.kind));
  add_rod(hasher, part.rod);
  hasher.add(part.X_TB);
  hasher.add(part.half);
}

}  // namespace

std::uint64_t felt_hash(const Tool& tool) {
  Hasher hasher;
  hasher.add(std::string_view(tool.name));
  for (const Hull& piece : tool.pieces)
    for (const Vec3& corner : piece.vertices) hasher.add(corner);
  for (const Capsule& rod : tool.rods) add_rod(hasher, rod);
  for (const Primitive& part : tool.parts) add_part(hasher, part);
  add_rod(hasher, tool.shaft);
  hasher.add(tool.tip_radius_m);
  return hasher.value();
}

std::uint64_t felt_hash(std::span<const std::shared_ptr<const Tool>> tray) {
  Hasher hasher;
  for (const auto& tool : tray) hasher.add(felt_hash(*tool));
  return hasher.value();
}

}  // namespace osteon
