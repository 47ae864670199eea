#include <algorithm>

#include "instrument/instrument_reader.h"

namespace osteon {
namespace {

FeltRod read_ball(InstrumentReader& in) {
  in.allow_only({"kind", "at_mm", "radius_mm", "jaw"});
  const SizedPoint at = in.point("at_mm");
  return {at, at, in.length("radius_mm", true), in.jaw("jaw")};
}

FeltRod read_rod(InstrumentReader& in) {
  in.allow_only({"kind", "from_mm", "to_mm", "radius_mm", "jaw"});
  return {in.point("from_mm"), in.point("to_mm"), in.length("radius_mm", true), in.jaw("jaw")};
}

FeltBox read_box(InstrumentReader& in) {
  in.allow_only({"kind", "at_mm", "half_mm", "turn_deg", "jaw"});
  return {in.point("at_mm"), in.point("half_mm", true), in.turn_deg("turn_deg"), in.jaw("jaw")};
}

void read_turned(InstrumentReader& in, LookPart& part) {
  in.allow_only({"kind", "at_mm", "profile_mm", "turn_deg", "jaw"});
  part.at = in.point("at_mm");
  part.profile = in.rows<2>("profile_mm");
  part.turn_deg = in.turn_deg("turn_deg");
  if (part.profile.size() < 2) in.set_error("'profile_mm' needs two rows or more", "profile_mm");
}

void read_tube(InstrumentReader& in, LookPart& part) {
  in.allow_only({"kind", "points_mm", "radii_mm", "jaw"});
  for (const auto& row : in.rows<3>("points_mm")) part.points.push_back({row});
  part.radii = in.lengths("radii_mm");
  if (part.points.size() < 2) in.set_error("'points_mm' needs two points or more", "points_mm");
  if (part.radii.size() != 1 && part.radii.size() != part.points.size())
    in.set_error("'radii_mm' needs one radius, or one for each point", "radii_mm");
}

void read_plate(InstrumentReader& in, LookPart& part) {
  in.allow_only({"kind", "at_mm", "outline_mm", "thickness_mm", "turn_deg", "jaw"});
  part.at = in.point("at_mm");
  for (const auto& row : in.rows<2>("outline_mm"))
    part.points.push_back({{row[0], SizedLength{}, row[1]}});
  part.thickness = in.length("thickness_mm", true);
  part.turn_deg = in.turn_deg("turn_deg");
  if (part.points.size() < 3) in.set_error("'outline_mm' needs three points or more", "outline_mm");
}

void read_spiral(InstrumentReader& in, LookPart& part) {
  in.allow_only({"kind", "at_mm", "length_mm", "radius_mm", "depth_mm", "pitch_mm", "starts",
                 "turn_deg", "jaw"});
  part.at = in.point("at_mm");
  part.length = in.length("length_mm", true);
  part.radius = in.length("radius_mm", true);
  part.depth = in.length("depth_mm", true);
  part.pitch_m = kMmPerFile * in.number("pitch_mm", {0.2, 500});
  part.starts = in.integer_or("starts", {1, 8}, 1);
  part.turn_deg = in.turn_deg("turn_deg");
}

void read_ring(InstrumentReader& in, LookPart& part) {
  in.allow_only({"kind", "at_mm", "radius_mm", "thickness_mm", "turn_deg", "jaw"});
  part.at = in.point("at_mm");
  part.radius = in.length("radius_mm", true);
  part.thickness = in.length("thickness_mm", true);
  part.turn_deg = in.turn_deg("turn_deg");
}

void read_look_box(InstrumentReader& in, LookPart& part) {
  const FeltBox box = read_box(in);
  part.at = box.at;
  part.half = box.half;
  part.turn_deg = box.turn_deg;
}

struct LookKind {
  std::string_view name;
  LookPart::Kind kind;
  void (*read)(InstrumentReader& in, LookPart& part);
};
constexpr std::array<LookKind, 6> kLookKinds{{{"turned", LookPart::Kind::kTurned, read_turned},
                                              {"tube", LookPart::Kind::kTube, read_tube},
                                              {"box", LookPart::Kind::kBox, read_look_box},
                                              {"plate", LookPart::Kind::kPlate, read_plate},
                                              {"spiral", LookPart::Kind::kSpiral, read_spiral},
                                              {"ring", LookPart::Kind::kRing, read_ring}}};

}  // namespace

FeltPart read_felt(InstrumentReader& in) {
  const std::string kind = in.text("kind");
  if (kind == "ball") return read_ball(in);
  if (kind == "box") return read_box(in);
  if (kind != "rod") in.set_error("'kind' must be \"ball\", \"rod\" or \"box\"", "kind");
  return read_rod(in);
}

LookPart read_look(InstrumentReader& in) {
  LookPart part;
  const std::string name = in.text("kind");
  const auto kind = std::find_if(kLookKinds.begin(), kLookKinds.end(),
                                 [&](const LookKind& k) { return k.name == name; });
  if (kind == kLookKinds.end()) {
    in.set_error("'kind' must be \"turned\", \"tube\", \"box\", \"plate\", \"spiral\" or \"ring\"",
                 "kind");
    return part;
  }
  part.kind = kind->kind;
  part.jaw = in.jaw("jaw");
  kind->read(in, part);
  return part;
}

}  // namespace osteon
