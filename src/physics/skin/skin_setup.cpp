#include "osteon/physics/skin_setup.h"

#include <algorithm>
#include <cmath>

#include "mass_properties.h"
#include "osteon/base/hash.h"
#include "osteon/mesh/distance.h"
#include "osteon/physics/soft_setup.h"
#include "osteon/physics/solid_cutter.h"
#include "osteon/scene/event.h"
#include "osteon/scene/instrument.h"
#include "osteon/scene/needle.h"
#include "osteon/scene/tool_set.h"
#include "osteon/tissue/skin_place.h"
#include "skin/skin_cover.h"

namespace osteon {
namespace {

constexpr const char* kSkin = "skin";
constexpr const char* kSkinWhere = "--soft";
constexpr std::string_view kSkinAt = "skin:";
constexpr const char* kForPortal = "portal_";
constexpr std::array kUsualPlaces{"portal_al", "portal_am", "pes_anserinus", "portal_3_4",
                                  "portal_6r"};
// Own defaults: room for a portal, and for an incision over the tendons' insertion.
constexpr double kPortalWidth_m = 0.030, kPortalHeight_m = 0.036;
constexpr double kSiteWidth_m = 0.040, kSiteHeight_m = 0.056;
constexpr double kSkinEdge_m = 0.0012, kReliefCell_m = 0.002;
constexpr double kSkinReach_m =
    0.015;  // the way out of the skin is its mean so far about the place
// Of the table's figures: the sheet's own answer to a tip of 5 mm with its usual numbers, and the
// share of a trocar's force at which an edge goes in (own default).
constexpr double kUsual_n_per_m = 400, kEdgeShare = 0.04;
constexpr double kTableRadius_m = 0.0025, kSkinPi = 3.141592653589793;

struct PlaceAsked {
  std::string name;
  Vec3 near_W = Vec3::Zero();
  bool is_portal = false;
  std::uint32_t landmark = kNoSubject;
};

std::optional<PlaceAsked> place_named(const Case& the_case, std::string_view name) {
  for (std::uint32_t i = 0; i < the_case.landmarks.size(); ++i) {
    const Landmark& landmark = the_case.landmarks[i];
    if (landmark.name == name)
      return PlaceAsked{landmark.name, landmark.p_W, name.starts_with(kForPortal), i};
  }
  for (const SoftPart& part : the_case.softs)
    for (const Attachment& end : part.attachments)
      if (end.name == name) return PlaceAsked{end.name, end.p_W, false, kNoSubject};
  return {};
}

std::string places_of(const Case& the_case) {
  std::string text;
  for (const Landmark& landmark : the_case.landmarks)
    text += (text.empty() ? "" : ", ") + std::string(kSkinAt) + landmark.name;
  return text.empty() ? "Give a case with landmarks, such as builtin:knee" : "Choose from " + text;
}

Result<std::vector<PlaceAsked>> places_asked(const Case& the_case,
                                             std::span<const std::string> names) {
  std::vector<PlaceAsked> out;
  const auto add = [&](const PlaceAsked& place) {
    if (std::none_of(out.begin(), out.end(),
                     [&](const PlaceAsked& other) { return other.name == place.name; }))
      out.push_back(place);
  };
  for (const std::string& name : names) {
    if (name == kSkin) {
      for (const char* usual : kUsualPlaces)
        if (const auto place = place_named(the_case, usual)) add(*place);
      continue;
    }
    const auto place = place_named(the_case, std::string_view(name).substr(kSkinAt.size()));
    if (!place)
      return fail("the case has no place '" + name.substr(kSkinAt.size()) + "'", kSkinWhere,
                  places_of(the_case));
    add(*place);
  }
  if (out.empty())
    return fail("the case has no usual place for a patch of skin", kSkinWhere, places_of(the_case));
  if (out.size() > kMaxSkins)
    return fail("more than " + std::to_string(kMaxSkins) + " patches of skin", kSkinWhere,
                "Give fewer");
  return out;
}

std::optional<std::uint32_t> skin_of(const Case& the_case) {
  for (std::size_t i = 0; i < the_case.softs.size(); ++i)
    if (the_case.softs[i].kind == kSkin && !the_case.softs[i].mesh_W.triangles.empty())
      return static_cast<std::uint32_t>(i);
  return {};
}

// The bone whose surface is nearest: what lies on it goes with it.
BoneId bone_under(const Case& the_case, const Vec3& p_W) {
  BoneId best{0};
  double least = 1e300;
  for (std::uint32_t b = 0; b < the_case.bones.size(); ++b) {
    const Vec3 p_B = the_case.bones[b].X_WB.inverse() * p_W;
    for (const Vec3& q : the_case.bones[b].mesh.vertices)
      if ((q - p_B).squaredNorm() < least) {
        least = (q - p_B).squaredNorm();
        best = BoneId{b};
      }
  }
  return best;
}

// A patch at a landmark goes with the landmark's bone, as far as that is known.
BoneId bone_of_patch(const Case& the_case, std::uint32_t landmark, const Vec3& p_W) {
  if (landmark < the_case.landmarks.size() && !the_case.landmarks[landmark].bone.empty())
    if (const BoneId named = the_case.find(the_case.landmarks[landmark].bone); named.valid())
      return named;
  return bone_under(the_case, p_W);
}

// Along a bone that is at least twice as long as it is thick, to the side of `up_W`; else that.
Vec3 along_bone(const Case& the_case, BoneId id, const Vec3& up_W) {
  const Bone& bone = the_case.bone(id);
  const std::vector<Vec3>& at_B = bone.mesh.vertices;
  if (at_B.empty()) return up_W;
  Vec3 middle = Vec3::Zero();
  for (const Vec3& p : at_B) middle += p;
  middle /= static_cast<double>(at_B.size());
  Mat3 spread = Mat3::Zero();
  for (const Vec3& p : at_B) spread += (p - middle) * (p - middle).transpose();
  Vec3 values;
  const Mat3 axes = principal_axes(spread, values);
  int longest = 0;
  values.maxCoeff(&longest);
  const double thick = std::max(values[(longest + 1) % 3], values[(longest + 2) % 3]);
  if (!(values[longest] >= 4 * thick)) return up_W;
  const Vec3 along_W = bone.X_WB.rotate(axes.col(longest));
  return along_W.dot(up_W) < 0 ? Vec3(-along_W) : along_W;
}

Result<Pose> frame_at(const Case& the_case, std::uint32_t soft, const PlaceAsked& place,
                      const SkinUps& ups) {
  const bool by_bone = ups.along_bones && !place.is_portal && !the_case.bones.empty();
  const Vec3 up_W =
      by_bone
          ? along_bone(the_case, bone_of_patch(the_case, place.landmark, place.near_W), ups.up_W)
          : ups.up_W;
  return sheet_frame(the_case.softs[soft].mesh_W, place.near_W, up_W, 0, kSkinReach_m);
}

Result<SkinRelief> relief_of(const TriMesh& skin_W, const Pose& X_WS, double width_m,
                             double height_m) {
  const auto nx = static_cast<std::size_t>(std::lround(width_m / kReliefCell_m)) + 1;
  const auto ny = static_cast<std::size_t>(std::lround(height_m / kReliefCell_m)) + 1;
  TriMesh grid;
  for (std::size_t j = 0; j < ny; ++j)
    for (std::size_t i = 0; i < nx; ++i)
      grid.vertices.emplace_back(kReliefCell_m * (double(i) - 0.5 * double(nx - 1)),
                                 kReliefCell_m * (double(j) - 0.5 * double(ny - 1)), 0);
  const auto laid = lay_on(skin_W, X_WS, grid);
  if (!laid) return tl::unexpected(laid.error());
  std::vector<double> heights;
  for (const Vec3& p : laid->vertices) heights.push_back((X_WS.inverse() * p).z());
  return SkinRelief(kReliefCell_m, nx, std::move(heights));
}

SheetMaterial skin_material(const SkinNumbers& numbers) {
  SheetMaterial out;
  const double scale = numbers.stiffness_n_per_m / kUsual_n_per_m;
  out.tension_n_per_m *= scale;
  out.foundation_n_per_m3 *= scale;
  out.pierce_pa = numbers.cutting_n / (kSkinPi * kTableRadius_m * kTableRadius_m);
  return out;
}

std::unique_ptr<const SheetYield> whole_yield(const SkinSheet& sheet) {
  SheetWork work(sheet, whole_sheet(sheet));
  while (!work.step()) {
  }
  return work.take();
}

double usual_width_m(const PlaceAsked& place) {
  return place.is_portal ? kPortalWidth_m : kSiteWidth_m;
}

/// Where a patch lies, and how wide it may be. Of two that would overlap each has half of the way
/// between their middles.
struct PatchRoom {
  Pose X_WS;
  double most_wide_m = 1;
};

// A place where the skin is much bent, or that lies near another one, gets a smaller patch.
Result<SkinPatch> patch_at(const Case& the_case, std::uint32_t soft, const PlaceAsked& place,
                           const PatchRoom& room, const SkinNumbers& numbers) {
  const TriMesh& skin_W = the_case.softs[soft].mesh_W;
  bool near = false;
  SkinPatch out;
  out.name = std::string(kSkinAt) + place.name;
  out.soft = soft;
  out.bone = bone_of_patch(the_case, place.landmark, room.X_WS.p);
  out.X_BS = the_case.bone(out.bone).X_WB.inverse() * room.X_WS;
  for (const double share : {1.0, 0.8, 0.6, 0.45}) {
    out.width_m = share * usual_width_m(place);
    out.height_m = share * (place.is_portal ? kPortalHeight_m : kSiteHeight_m);
    near = out.width_m > room.most_wide_m;
    if (near) continue;
    auto relief = relief_of(skin_W, room.X_WS, out.width_m, out.height_m);
    if (!relief) continue;
    out.relief = std::move(*relief);
    auto sheet = SkinSheet::make(out.width_m, out.height_m, kSkinEdge_m, skin_material(numbers));
    if (!sheet) return tl::unexpected(sheet.error());
    out.sheet = std::make_shared<const SkinSheet>(std::move(*sheet));
    out.whole = whole_yield(*out.sheet);
    out.cover = cover_of(the_case, room.X_WS, out.relief, out.sheet->material().fat_m);
    out.edge_n = kEdgeShare * numbers.cutting_n;
    return out;
  }
  if (near)
    return fail("the patch " + out.name + " and one beside it overlap", kSkinWhere,
                "Leave out one of them");
  return fail("the skin at '" + place.name + "' is too bent for a patch", kSkinWhere,
              "Choose another place");
}

Result<std::vector<PatchRoom>> rooms_of(const Case& the_case, std::uint32_t soft,
                                        std::span<const PlaceAsked> places, const SkinUps& ups) {
  std::vector<PatchRoom> out;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto X_WS = frame_at(the_case, soft, places[i], ups);
    if (!X_WS) return tl::unexpected(X_WS.error());
    PatchRoom room{*X_WS};
    for (std::size_t j = 0; j < i; ++j) {
      const double apart_m = (room.X_WS.p - out[j].X_WS.p).norm();
      if (apart_m >= 0.5 * (usual_width_m(places[i]) + usual_width_m(places[j]))) continue;
      room.most_wide_m = std::min(room.most_wide_m, apart_m);
      out[j].most_wide_m = std::min(out[j].most_wide_m, apart_m);
    }
    out.push_back(room);
  }
  return out;
}

}  // namespace

bool names_skin(std::string_view name) { return name == kSkin || name.starts_with(kSkinAt); }

bool is_for_portal(const SkinPatch& patch) {
  return std::string_view(patch.name).starts_with(std::string(kSkinAt) + kForPortal);
}

std::uint64_t hash_of(std::span<const SkinPatch> patches) {
  Hasher h;
  for (const SkinPatch& patch : patches) {
    h.add(std::string_view(patch.name));
    h.add(patch.soft);
    h.add(patch.bone.index);
    h.add(patch.X_BS);
    for (const double x : {patch.width_m, patch.height_m, patch.sheet->edge_m(), patch.edge_n})
      h.add(x);
    const SheetMaterial& m = patch.sheet->material();
    for (const double x :
         {m.stretch_n_per_m, m.poisson, m.tension_n_per_m, m.foundation_n_per_m3, m.fat_m,
          m.tether_n_per_m3, m.thickness_m, m.friction, m.pierce_pa, m.fat_pierce_pa})
      h.add(x);
    for (const double x : patch.relief.heights_m()) h.add(x);
    for (const double x : patch.cover.heights_m()) h.add(x);
    for (const double radius_m : {0.001, 0.002, 0.004}) h.add(patch.share.at(radius_m, 1000));
  }
  return h.value();
}

SkinTool skin_tool(const Tool& tool, bool pierces) {
  SkinTool out;
  if (tool.use.cuts)
    if (const auto edge = slicing_with(tool)) {
      out.edge = edge->works;
      out.flat_T = edge->flat_T;
    }
  const bool has_shaft = (tool.shaft.p1 - tool.shaft.p0).norm() > 0;
  if (has_shaft && out.edge == 0) out.through_m = tool.shaft.radius;
  out.pierces = pierces && out.through_m > 0;
  return out;
}

Result<std::vector<SkinTool>> make_skin_tools(std::span<const std::string> tray) {
  std::vector<SkinTool> out(tray.size());
  if (tray.empty()) return out;
  const auto instruments = load_instruments();
  if (!instruments) return tl::unexpected(instruments.error());
  for (std::size_t i = 0; i < tray.size(); ++i) {
    const auto named = parse_tool_name(tray[i]);
    const std::string name = tray[i].substr(0, tray[i].find(':'));
    const Instrument* found = find_instrument(*instruments, name);
    if (!named || !found) continue;
    const auto size = named->size_mm ? find_size(*found, *named->size_mm)
                                     : std::optional<std::size_t>(found->usual_size);
    if (!size) return fail("the instrument has no such size", tray[i]);
    out[i] = skin_tool(make_tool(*found, *size), pierces_skin(name));
    out[i].makes_portal = name != kSpinalNeedle;
    out[i].retracts = found->can(InstrumentFunction::kRetract);
  }
  return out;
}

void add_skins(SoftSetup& setup, std::vector<SkinPatch> patches, std::vector<SkinTool> tools) {
  if (patches.empty()) return;
  setup.skins = std::move(patches);
  setup.skin_tools = std::move(tools);
  Hasher h;
  h.add(setup.hash);
  h.add(hash_of(setup.skins));
  for (const SkinTool& tool : setup.skin_tools) {
    h.add(tool.edge);
    h.add(tool.flat_T);
    h.add(tool.through_m);
    h.add(tool.pierces);
  }
  setup.hash = h.value();
}

void let_wounds_be_held_open(SoftSetup& setup) {
  const auto retracts = [](const SkinTool& tool) { return tool.retracts; };
  const auto& tools = setup.skin_tools;
  if (setup.skins.empty() || std::none_of(tools.begin(), tools.end(), retracts)) return;
  setup.wounds_open = true;
  tell_hash(setup, "wounds are held open");
}

std::vector<Portal> portals_to_make(const Case& the_case, std::span<const std::string> names,
                                    const PortalSkin& skin) {
  std::vector<std::string> skins;
  for (const std::string& name : names)
    if (names_skin(name)) skins.push_back(name);
  std::vector<Portal> out;
  if (skins.empty()) return out;
  const auto places = places_asked(the_case, skins);
  if (!places) return out;
  for (const PlaceAsked& place : *places)
    for (Portal& portal :
         room_to_make(place.name, place.landmark, static_cast<std::uint32_t>(out.size()), skin))
      out.push_back(std::move(portal));
  return out;
}

Result<Pose> patch_frame(const Case& the_case, const std::string& name, const SkinUps& ups) {
  const auto places = places_asked(the_case, std::span(&name, 1));
  if (!places) return tl::unexpected(places.error());
  const auto soft = skin_of(the_case);
  if (!soft) return fail("the case has no skin", kSkinWhere, "Give another case");
  return frame_at(the_case, *soft, places->front(), ups);
}

Result<std::vector<SkinPatch>> make_skin_patches(const Case& the_case,
                                                 std::span<const std::string> names,
                                                 const SkinUps& ups, const SkinNumbers& numbers) {
  const auto places = places_asked(the_case, names);
  if (!places) return tl::unexpected(places.error());
  const auto soft = skin_of(the_case);
  if (!soft || the_case.bones.empty())
    return fail("the case has no skin", kSkinWhere, "Give another case, such as builtin:knee");
  if (!(numbers.stiffness_n_per_m > 0 && numbers.cutting_n > 0))
    return fail("skin has no stiffness, or nothing cuts it", kSkinWhere,
                "Correct the tissue table");
  const auto rooms = rooms_of(the_case, *soft, *places, ups);
  if (!rooms) return tl::unexpected(rooms.error());
  std::vector<SkinPatch> out;
  for (std::size_t i = 0; i < places->size(); ++i) {
    auto patch = patch_at(the_case, *soft, (*places)[i], (*rooms)[i], numbers);
    if (!patch) return tl::unexpected(patch.error());
    patch->share = out.empty() ? FatShare::of(*patch->sheet) : out.front().share;
    out.push_back(std::move(*patch));
  }
  return out;
}

}  // namespace osteon
