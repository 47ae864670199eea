#include "osteon/physics/pieces_setup.h"

#include <algorithm>

#include "osteon/scene/instrument.h"
#include "soft/of_tray.h"

namespace osteon {
namespace {

constexpr double kCovered_m = 0.015;  // soft parts over the outermost bone; own default

PieceTool piece_tool(const Instrument& instrument, std::size_t size) {
  PieceTool out;
  out.parts = make_tool(instrument, size).parts;
  out.jaws = gripper_of(instrument, size);
  if (instrument.can(InstrumentFunction::kSuck))
    out.bore_m = kBoreOfOuter * instrument.sizes_m.at(size);
  for (const Primitive& part : out.parts)
    out.bore_T.z() = std::min(out.bore_T.z(), -support(part, -Vec3::UnitZ()));
  return out;
}

PieceObstacle obstacle_of(const Bone& bone) {
  PieceObstacle out;
  for (const Hull& hull : bone.pieces) {
    PieceObstacle::Part part;
    for (const Vec3& v : hull.vertices) part.box_B.include(v);
    part.planes_B = hull.planes;
    if (part.box_B.empty()) continue;
    out.box_B.include(part.box_B.lo);
    out.box_B.include(part.box_B.hi);
    out.parts.push_back(std::move(part));
  }
  return out;
}

}  // namespace

Result<PiecesSetup> make_pieces(const Case& the_case, std::span<const std::string> tray) {
  PiecesSetup out;
  auto tools = of_tray<PieceTool>(tray, piece_tool);
  if (!tools) return tl::unexpected(tools.error());
  for (std::optional<PieceTool>& tool : *tools)
    out.tray.push_back(tool ? std::move(*tool) : PieceTool{});
  for (const Bone& bone : the_case.bones) {
    out.bones.push_back(obstacle_of(bone));
    for (const Vec3& v : bone.mesh.vertices) {
      const Vec3 v_W = bone.X_WB * v;
      out.box_W.include(v_W);
      if (bone.fma_id != 0) out.limb_W.include(v_W);
    }
  }
  if (!out.limb_W.empty()) out.limb_W = out.limb_W.grown(kCovered_m);
  return out;
}

}  // namespace osteon
