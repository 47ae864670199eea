#include "osteon/scene/tool_rods.h"

#include <algorithm>

namespace osteon {
namespace {

Capsule rod_about(const Primitive& part) {
  if (part.kind == Primitive::Kind::kRod) return part.rod;
  Eigen::Index longest = 0;
  const double half = part.half.maxCoeff(&longest);
  const double radius = 0.5 * (part.half.sum() - half);
  const Vec3 along = part.X_TB.rotate(Vec3::Unit(longest)) * std::max(0.0, half - radius);
  return {part.X_TB.p - along, part.X_TB.p + along, radius};
}

}  // namespace

std::vector<Capsule> tool_rods(const Tool& tool) {
  std::vector<Capsule> rods;
  for (const Primitive& part : tool.parts) rods.push_back(rod_about(part));
  if (!rods.empty()) return rods;
  if (!tool.rods.empty()) return tool.rods;
  for (const ConvexBody& body : tool.bodies)
    rods.push_back({body.center, body.center, body.radius});
  return rods;
}

std::vector<RoundBox> tool_shapes(const Tool& tool) {
  std::vector<RoundBox> shapes;
  for (const Primitive& part : tool.parts) shapes.push_back(round_box(part));
  if (!shapes.empty()) return shapes;
  for (const Capsule& rod : tool_rods(tool)) shapes.push_back(round_box(rod));
  return shapes;
}

std::vector<RoundBox> soft_shapes(const Tool& tool) {
  if (!tool.use.cuts) return tool_shapes(tool);
  std::vector<RoundBox> shapes;
  for (const Capsule& rod : tool_rods(tool)) shapes.push_back(round_box(rod));
  return shapes;
}

}  // namespace osteon
