#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "instrument/instrument_look.h"
#include "instrument/instrument_reader.h"
#include "osteon/base/check.h"
#include "osteon/mesh/measure.h"
#include "osteon/scene/wide_field.h"

namespace osteon {
namespace {

constexpr double kShortestShaft = 0.001;
constexpr double kFarthest = 1.0;  // m, of any part from the tip
constexpr double kThinnest = 1e-5;

Primitive felt_of(const Instrument& instrument, const FeltRod& rod, double size_m, double opening) {
  const Pose X = jaw_pose(instrument, rod.jaw, size_m, opening);
  return make_rod(X * rod.from.at(size_m), X * rod.to.at(size_m), rod.radius.at(size_m));
}

Primitive felt_of(const Instrument& instrument, const FeltBox& box, double size_m, double opening) {
  const Pose X = jaw_pose(instrument, box.jaw, size_m, opening);
  return make_box(X * Pose{box.at.at(size_m), turn_of(box.turn_deg)}, box.half.at(size_m));
}

void append(TriMesh& mesh, const TriMesh& part, const Pose& X) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (const Vec3& p : part.vertices) mesh.vertices.push_back(X * p);
  for (const Triangle& t : part.triangles)
    mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
}

Capsule shaft_of(const Instrument& instrument, double size_m) {
  const ShaftDef& shaft = instrument.shaft;
  return {shaft.from.at(size_m), shaft.to.at(size_m), shaft.radius.at(size_m)};
}

// Where something is wrong with it at a size: the part.
struct SizeCheck {
  const Instrument& instrument;
  double size_m;

  bool sound(const Capsule& rod) const {
    return rod.radius >= kThinnest && rod.radius <= kThickestFelt_m && rod.p0.norm() < kFarthest &&
           rod.p1.norm() < kFarthest;
  }
  bool sound(const FeltPart& part) const {
    if (const auto* rod = std::get_if<FeltRod>(&part))
      return sound(Capsule{rod->from.at(size_m), rod->to.at(size_m), rod->radius.at(size_m)});
    const FeltBox& box = std::get<FeltBox>(part);
    return box.half.at(size_m).minCoeff() >= kThinnest && box.at.at(size_m).norm() < kFarthest;
  }
  // Closed and not inside out; a tube that doubles back or a plate that is not seen whole from its
  // middle shows as a surface without volume.
  bool sound(const LookPart& part) const {
    const TriMesh mesh = look_mesh(part, size_m);
    for (const Vec3& p : mesh.vertices)
      if (!is_finite(p) || p.norm() >= kFarthest) return false;
    return !mesh.triangles.empty() && topology(mesh).closed() && volume(mesh) > 0;
  }
  template <class Part>
  std::string wrong_part(const std::vector<Part>& parts, const char* kind) const {
    for (std::size_t i = 0; i < parts.size(); ++i)
      if (!sound(parts[i])) return std::string(kind) + " " + std::to_string(i + 1);
    return {};
  }
  std::string wrong() const {
    const Capsule shaft = shaft_of(instrument, size_m);
    if (!sound(shaft) || (shaft.p1 - shaft.p0).norm() < kShortestShaft) return "the shaft";
    const std::string felt = wrong_part(instrument.felt, "felt");
    return felt.empty() ? wrong_part(instrument.look, "look") : felt;
  }
};

ToolUse use_of(const Instrument& instrument) {
  ToolUse use;
  use.cuts =
      instrument.can(InstrumentFunction::kCut) && !instrument.can(InstrumentFunction::kRemove);
  use.removes = instrument.removal.has_value();
  use.burns = instrument.can(InstrumentFunction::kBurn);
  use.sucks = instrument.can(InstrumentFunction::kSuck);
  return use;
}

ToolOptics optics_of(const OpticsDef& optics) {
  constexpr double kRadOfDegrees = std::numbers::pi / 180;
  return {optics.angle_deg * kRadOfDegrees, 0.5 * optics.field_deg * kRadOfDegrees};
}

}  // namespace

Result<void> check_instrument(const Instrument& instrument) {
  for (const double size_m : instrument.sizes_m) {
    const std::string wrong = SizeCheck{instrument, size_m}.wrong();
    if (!wrong.empty())
      return fail(
          "in size " + std::to_string(1e3 * size_m) + " mm " + wrong +
              " is too thin, thicker than 36 mm, farther than 1 m from the tip, or inside out",
          instrument.name, "Correct its lengths");
  }
  return {};
}

TriMesh instrument_mesh(const Instrument& instrument, std::size_t size, double opening) {
  const double size_m = instrument.sizes_m.at(size);
  const Capsule shaft = shaft_of(instrument, size_m);
  TriMesh mesh = bar_mesh(shaft.p0, shaft.p1, shaft.radius);
  for (const LookPart& part : instrument.look)
    append(mesh, look_mesh(part, size_m), jaw_pose(instrument, part.jaw, size_m, opening));
  return mesh;
}

Tool make_tool(const Instrument& instrument, std::size_t size, double opening) {
  demand(size < instrument.sizes_m.size() && opening >= 0 && opening <= 1,
         "a tool needs one of the instrument's sizes and an opening from 0 to 1");
  const double size_m = instrument.sizes_m[size];
  Tool tool;
  tool.name = instrument.name;
  tool.use = use_of(instrument);
  if (instrument.optics) tool.optics = optics_of(*instrument.optics);
  tool.shaft = shaft_of(instrument, size_m);
  for (const FeltPart& part : instrument.felt)
    tool.parts.push_back(
        std::visit([&](const auto& p) { return felt_of(instrument, p, size_m, opening); }, part));
  tool.parts.push_back(make_rod(tool.shaft.p0, tool.shaft.p1, tool.shaft.radius));
  tool.mesh = instrument_mesh(instrument, size, opening);
  for (std::size_t n = 1; instrument.jaws && n <= kJawSteps; ++n)
    tool.opened.push_back(
        instrument_mesh(instrument, size, static_cast<double>(n) / double{kJawSteps}));
  const Primitive& tip = tool.parts.front();
  tool.tip_radius_m = tip.kind == Primitive::Kind::kRod ? tip.rod.radius : tip.half.minCoeff();
  return tool;
}

}  // namespace osteon
