#include "runs/pictures/film_view.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "cases/scoped_case.h"
#include "osteon/base/file.h"
#include "osteon/mesh/measure.h"
#include "osteon/render/joint_roof.h"
#include "osteon/render/joint_room.h"
#include "osteon/render/scope_renderer.h"
#include "osteon/render/soft_surface.h"
#include "osteon/scene/graft_bench.h"
#include "runs/pictures/carved_picture.h"
#include "runs/pictures/film_fluoro.h"
#include "runs/pictures/heat_picture.h"
#include "runs/pictures/panorama.h"
#include "runs/pictures/scope_lens.h"
#include "runs/pictures/work_camera.h"
#include "water/water_drift.h"

namespace osteon {
namespace {

// Places that an outside view goes to from the joint.
constexpr const char *kAtBench = "bench", *kAtFascia = "fascia", *kAtSkin = "skin";

constexpr double kRoomMoves_m = 0.015;  // of the tip, before the joint's wall is shaped anew

void put(const Image& part, int left, int top, Image& into) {
  for (int y = 0; y < part.height; ++y) {
    const auto from = static_cast<std::ptrdiff_t>(3) * y * part.width;
    const auto to = 3 * (static_cast<std::ptrdiff_t>(top + y) * into.width + left);
    std::copy_n(part.rgb.begin() + from, 3 * part.width, into.rgb.begin() + to);
  }
}

Image black(int width, int height) {
  Image image{width, height, {}};
  image.rgb.assign(3u * static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0);
  return image;
}

tl::unexpected<Error> no_memory() {
  return fail("the graphics driver has no memory for the picture", "the film",
              "Choose a smaller --size");
}

}  // namespace

Result<FilmView> parse_film_view(const std::string& text) {
  const std::pair<const char*, FilmView> views[] = {{"scope", FilmView::kScope},
                                                    {"outside", FilmView::kOutside},
                                                    {"panorama", FilmView::kPanorama},
                                                    {"fluoro", FilmView::kFluoro},
                                                    {"layout", FilmView::kLayout}};
  for (const auto& [name, view] : views)
    if (text == name) return view;
  return fail("\"" + text + "\" is not a view of a film", "--view",
              "Choose scope, outside, panorama, fluoro or layout");
}

struct FilmPainter::Impl {
  std::shared_ptr<const Case> the_case;
  Order order;
  Lenses lenses;
  bool has_scope = false;
  // The context comes before what was made in it, so that it goes last.
  std::optional<OffscreenContext> context;
  std::optional<Renderer> renderer;
  std::optional<Renderer> beside;  ///< of a layout's panorama: keeps a picture of its own
  std::optional<ScopeRenderer> scope;
  std::optional<FilmFluoro> fluoro;
  std::optional<JointRoom> room;
  std::optional<JointRoof> roof;
  std::optional<WaterDrift> drift;  ///< none: there is no joint with water
  std::optional<Vec3> room_W;       ///< that its wall was shaped around

  bool uses(FilmView view) const { return order.view == view || order.view == FilmView::kLayout; }
  Result<void> open(const SessionSettings& settings, const Tray& tray);
  Result<void> open_pictures(const Tray& tray);
  static std::span<const ToolState> tools(const FilmMoment& moment);

  Result<Image> outside(const FilmMoment& moment, int width, int height);
  Result<Image> panorama(const FilmMoment& moment, const std::string& side, int width, int height);
  Result<Image> through_scope(const FilmMoment& moment, int width, int height);
  Result<Image> through_beam(const FilmMoment& moment, int width, int height);
  Result<Image> layout(const FilmMoment& moment);
  Result<Image> scene(Renderer& by, const FilmMoment& moment, const ViewState& view, int width,
                      int height);
  ViewState plain_view(double aspect) const;
  ViewState with_felt(ViewState view) const;
  bool looks_at_bench(const FilmMoment& moment);
  bool looks_through_scope(const FilmMoment& moment) const;
  std::string place_outside(const FilmMoment& moment);
  const ViewState& outside_view(double aspect, const std::string& place);
  const ViewState& panorama_of(const std::string& side, double aspect);
  void shape_room(const BoneSnapshot& bones, const Vec3& tip_W);
  void show_carved();
  void set_loose(const CarvedPicture::Piece& piece);
  void flow(const FilmMoment& moment);
  void drift_on(const FilmMoment& moment, const Vec3& tip_W);
  CarvedPicture carved{nullptr};
  std::optional<FluidJoint> joint;      ///< where a scope is drawn and the joint is filled
  std::optional<OtherPump> other_pump;  ///< none: the recorded one
  double obscured_s = 0;
  std::optional<double> flowed_s;  ///< to this time
  struct Look {
    std::string side;
    double aspect = 0;
    ViewState view;
  };
  std::optional<Look> looked_outside, looked_panorama;  ///< made once: they ask the whole case
  std::optional<GraftBenchPlan> bench;                  ///< beside a limb
  double at_bench_until_s = -1, at_skin_until_s = -1;
  std::optional<Pose> X_WSite;  ///< of skin that is there for no portal, over bones at rest
  std::vector<Aabb> bone_boxes_B;
  std::vector<std::uint32_t> felt_softs;   ///< what gives way is seen
  std::optional<std::uint32_t> felt_skin;  ///< seen from outside, and not through
};

std::span<const ToolState> FilmPainter::Impl::tools(const FilmMoment& moment) {
  return {moment.tools.data(), moment.hands};
}

Result<void> FilmPainter::Impl::open_pictures(const Tray& tray) {
  const auto data_dir = find_data_dir();
  if (!data_dir) return tl::unexpected(data_dir.error());
  auto made = OffscreenContext::create();
  if (!made) return tl::unexpected(made.error());
  context.emplace(std::move(*made));
  if (the_case->find("femur").valid()) bench = find_graft_bench(*the_case);
  for (const Bone& bone : the_case->bones) bone_boxes_B.push_back(bounds(bone.mesh));
  const PreparedCase prepared = prepare_case(*the_case);
  if (order.view != FilmView::kScope) {
    auto drawn = Renderer::create(*the_case, *tray.front(), *data_dir, prepared);
    if (!drawn) return tl::unexpected(drawn.error());
    renderer.emplace(std::move(*drawn));
    renderer->set_tray(tray);
    if (order.view == FilmView::kLayout) beside.emplace(renderer->another_view());
  }
  if (!uses(FilmView::kScope) || !has_scope) return {};
  auto looked = renderer ? ScopeRenderer::create(*the_case, *data_dir, *renderer)
                         : ScopeRenderer::create(*the_case, *data_dir, prepared);
  if (!looked) return tl::unexpected(looked.error());
  scope.emplace(std::move(*looked));
  scope->set_tray(tray);
  room.emplace(*the_case);
  joint = filled_joint(*the_case);
  if (joint) {
    roof.emplace(*the_case);
    drift.emplace(*joint, tray);
  }
  if (joint && order.water) other_pump.emplace(*joint, *order.water);
  return {};
}

Result<void> FilmPainter::Impl::open(const SessionSettings& settings, const Tray& tray) {
  auto found = lenses_of(settings.tray);
  if (!found) return tl::unexpected(found.error());
  lenses = std::move(*found);
  if (auto side = panorama_camera(*the_case, order.side, 1); !side)
    return tl::unexpected(side.error());
  if (order.view == FilmView::kScope && !has_scope)
    return fail("no hand of the recording holds a scope", "--view scope",
                "Choose outside, panorama, fluoro or layout");
  if (uses(FilmView::kFluoro)) {
    auto made = FilmFluoro::create(*the_case, tray);
    if (!made) return tl::unexpected(made.error());
    fluoro.emplace(std::move(*made));
  }
  if (order.view == FilmView::kFluoro) return {};
  return open_pictures(tray);
}

ViewState FilmPainter::Impl::plain_view(double aspect) const {
  ViewState view = default_view(*the_case);
  view.camera = preset_camera(ViewPreset::kDorsal, *the_case, aspect);
  view.show_hand_ghost = false;
  view.show_heat = order.heat;
  return view;
}

/// What gives way is seen.
ViewState FilmPainter::Impl::with_felt(ViewState view) const {
  for (const std::uint32_t soft : felt_softs)
    if (soft < view.softs.size()) view.softs[soft].visible = true;
  return view;
}

Result<Image> FilmPainter::Impl::scene(Renderer& by, const FilmMoment& moment,
                                       const ViewState& view, int width, int height) {
  by.set_others({moment.tools.data() + 1, moment.hands - 1});
  Image image = by.draw_next_image({moment.bones, moment.tools[0]}, view, width, height);
  if (image.rgb.empty()) return no_memory();
  return image;
}

// To the bench the picture goes with the hands that work there, and not back at once.
bool FilmPainter::Impl::looks_at_bench(const FilmMoment& moment) {
  constexpr double kStays_s = 1;
  if (!bench) return false;
  for (const ToolState& tool : tools(moment))
    if (is_finite(tool.X_WP) && is_at_bench(*bench, tool.X_WP.p))
      at_bench_until_s = moment.time_s + kStays_s;
  return moment.time_s < at_bench_until_s;
}

// To skin that is cut as well. It is drawn where bones are now: they stand still meanwhile.
std::string FilmPainter::Impl::place_outside(const FilmMoment& moment) {
  constexpr double kStays_s = 1.5;
  const auto& blades = moment.bones.softs.skin.blades;
  if (std::any_of(blades.begin(), blades.end(), [](const SkinBlade& blade) { return blade.in; }))
    at_skin_until_s = moment.time_s + kStays_s;
  if (looks_at_bench(moment)) {
    const auto& tendons = moment.bones.bench.tendons;
    const bool found = std::all_of(tendons.begin(), tendons.end(),
                                   [](const TendonOnBench& tendon) { return tendon.found; });
    return found ? kAtBench : kAtFascia;
  }
  return X_WSite && moment.time_s < at_skin_until_s ? kAtSkin : "";
}

// One that was put down beside the limb has no bone within its sight.
bool FilmPainter::Impl::looks_through_scope(const FilmMoment& moment) const {
  constexpr double kSight_m = 0.06;
  const auto hand = first_looking(lenses, tools(moment));
  if (!hand) return false;
  for (std::size_t b = 0; b < std::min<std::size_t>(bone_boxes_B.size(), moment.bones.count); ++b) {
    const Vec3 tip_B = moment.bones.bones[b].X_WB.inverse() * moment.tools[*hand].X_WP.p;
    const Aabb& box = bone_boxes_B[b];
    if ((box.lo - tip_B).cwiseMax(tip_B - box.hi).cwiseMax(0).norm() < kSight_m) return true;
  }
  return false;
}

const ViewState& FilmPainter::Impl::outside_view(double aspect, const std::string& place) {
  if (looked_outside && looked_outside->aspect == aspect && looked_outside->side == place)
    return looked_outside->view;
  ViewState view = plain_view(aspect);
  if (place == kAtBench || place == kAtFascia)
    view.camera = bench_camera(view.camera, *bench, aspect, place == kAtFascia);
  if (place == kAtSkin) view.camera = skin_camera(view.camera, *X_WSite);
  if (felt_skin) {
    view.softs[*felt_skin].visible = true;
    view.softs[*felt_skin].opacity = 1;
  }
  return looked_outside.emplace(Look{place, aspect, with_felt(std::move(view))}).view;
}

const ViewState& FilmPainter::Impl::panorama_of(const std::string& side, double aspect) {
  if (looked_panorama && looked_panorama->aspect == aspect && looked_panorama->side == side)
    return looked_panorama->view;
  ViewState view = panorama_view(*the_case, *panorama_camera(*the_case, side, aspect));
  return looked_panorama.emplace(Look{side, aspect, with_felt(std::move(view))}).view;
}

Result<Image> FilmPainter::Impl::outside(const FilmMoment& moment, int width, int height) {
  const double aspect = static_cast<double>(width) / height;
  return scene(*renderer, moment, outside_view(aspect, place_outside(moment)), width, height);
}

Result<Image> FilmPainter::Impl::panorama(const FilmMoment& moment, const std::string& side,
                                          int width, int height) {
  Renderer& by = beside ? *beside : *renderer;
  by.set_moving_marks(sight_marks(lenses, tools(moment)));
  return scene(by, moment, panorama_of(side, static_cast<double>(width) / height), width, height);
}

// Where the tip stands in bone for a moment, the wall stays as it was.
void FilmPainter::Impl::shape_room(const BoneSnapshot& bones, const Vec3& tip_W) {
  if (room_W && (tip_W - *room_W).norm() < kRoomMoves_m) return;
  const auto wall = room->wall(bones, tip_W);
  if (!wall) return;
  scope->set_wall(*wall);
  if (roof) roof = roof->with_wall(*wall);
  room_W = tip_W;
}

void FilmPainter::Impl::flow(const FilmMoment& moment) {
  if (!joint || !moment.bones.water.on) return scope->set_water({});
  if (other_pump) other_pump->go_to(moment.time_s, moment.bones.water);
  const FluidState now = other_pump ? other_pump->state() : fluid_of(moment.bones.water);
  const double passed_s = flowed_s ? moment.time_s - *flowed_s : 0;
  if (passed_s > 0 && is_obscured(*joint, now)) obscured_s += passed_s;
  flowed_s = moment.time_s;
  scope->set_water(scope_water(*joint, moment.bones, &now));
}

void FilmPainter::Impl::drift_on(const FilmMoment& moment, const Vec3& tip_W) {
  if (!drift) return;
  drift->go_to(moment.time_s, tools(moment), moment.bones, tip_W,
               [&](const Vec3& p_W, double most_m) {
                 return roof->distance(moment.bones, p_W, Vec3::UnitZ(), most_m);
               });
  scope->set_water_bits(drift->bits());
}

Result<Image> FilmPainter::Impl::through_scope(const FilmMoment& moment, int width, int height) {
  flow(moment);
  const auto hand = first_looking(lenses, tools(moment));
  if (!hand) return black(width, height);
  std::vector<ToolState> others;
  for (std::size_t h = 0; h < moment.hands; ++h)
    if (h != *hand) others.push_back(moment.tools[h]);
  const Pose& X_WT = moment.tools[*hand].X_WP;
  scope->set_scene(moment.bones, others);
  shape_room(moment.bones, X_WT.p);
  drift_on(moment, X_WT.p);
  const ScopeCamera camera(*lens_of_tool(lenses, moment.tools[*hand]), scope_pose(X_WT));
  Image image = scope->draw_image(camera, width, height, RenderQuality::kFast);
  if (image.rgb.empty()) return no_memory();
  return image;
}

Result<Image> FilmPainter::Impl::through_beam(const FilmMoment& moment, int width, int height) {
  return fluoro->draw(moment, width, height, [this] { return carved.cut_scene(); });
}

/// Large: the scope while one is in the joint, else the outside. Beside it three small ones.
Result<Image> FilmPainter::Impl::layout(const FilmMoment& moment) {
  constexpr int kGap = 2;
  const int main = std::max(2 * order.width / 3 - kGap, 1);
  const int small = std::max(order.width - main - kGap, 1), high = std::max(order.height / 3, 1);
  Image whole = black(order.width, order.height);
  const bool in_joint = has_scope && looks_through_scope(moment);
  const auto large =
      in_joint ? through_scope(moment, main, order.height) : outside(moment, main, order.height);
  if (!large) return large;
  put(*large, 0, 0, whole);
  for (int row = 0; row < 3; ++row) {
    const int tall = std::max(high - (row < 2 ? kGap : 0), 1);
    const auto part = row == 0    ? panorama(moment, order.side, small, tall)
                      : row == 2  ? through_beam(moment, small, tall)
                      : in_joint  ? outside(moment, small, tall)
                      : has_scope ? through_scope(moment, small, tall)
                                  : panorama(moment, "top", small, tall);
    if (!part) return part;
    put(*part, main + kGap, row * high, whole);
  }
  return whole;
}

FilmPainter::FilmPainter(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
double FilmPainter::obscured_s() const { return impl_->obscured_s; }
FilmPainter::~FilmPainter() = default;
FilmPainter::FilmPainter(FilmPainter&&) noexcept = default;
FilmPainter& FilmPainter::operator=(FilmPainter&&) noexcept = default;

Result<FilmPainter> FilmPainter::create(std::shared_ptr<const Case> the_case,
                                        const SessionSettings& settings, const Tray& tray,
                                        bool scope_is_held, const Order& order) {
  auto impl = std::make_unique<Impl>();
  impl->the_case = std::move(the_case);
  impl->order = order;
  impl->has_scope = scope_is_held;
  Tray held = tray;
  if (held.empty())
    held.push_back(std::make_shared<const Tool>(make_wrist_probe(settings.probe_radius_m)));
  if (auto ok = impl->open(settings, held); !ok) return tl::unexpected(ok.error());
  return FilmPainter(std::move(impl));
}

void FilmPainter::set_carving(std::shared_ptr<const CarvingSetup> setup) {
  impl_->carved = CarvedPicture(std::move(setup));
}

void FilmPainter::set_softs(const std::shared_ptr<const SoftSetup>& setup) {
  impl_->looked_outside.reset();
  impl_->looked_panorama.reset();
  impl_->felt_softs.clear();
  impl_->felt_skin.reset();
  impl_->X_WSite.reset();
  if (setup) {
    for (const SoftBand& band : setup->bands) impl_->felt_softs.push_back(band.soft);
    for (const SoftSolid& solid : setup->solids) impl_->felt_softs.push_back(solid.soft);
    if (!setup->skins.empty()) impl_->felt_skin = setup->skins[0].soft;
    for (const SkinPatch& patch : setup->skins)
      if (!is_for_portal(patch))
        impl_->X_WSite = impl_->the_case->bone(patch.bone).X_WB * patch.X_BS;
  }
}

void FilmPainter::take(const CutsPatch& cut) { impl_->carved.take(cut); }

void FilmPainter::Impl::set_loose(const CarvedPicture::Piece& piece) {
  if (renderer) renderer->set_loose(piece.shape, BoneId{piece.bone}, piece.surface);
  if (scope) scope->set_loose(piece.shape, BoneId{piece.bone}, piece.surface);
}

void FilmPainter::Impl::show_carved() {
  for (const CarvedPicture::Changed& changed : carved.changes()) {
    if (renderer) renderer->set_cubes(changed.bone, changed.grid, changed.cubes);
    if (scope) scope->set_cubes(changed.bone, changed.grid, changed.cubes);
  }
  for (const CarvedPicture::Piece& piece : carved.new_pieces()) set_loose(piece);
  if (!order.heat || !renderer) return;
  (void)carved.follow_heat();
  for (const CarvedPicture::Warmed& warmed : carved.warmed())
    renderer->set_heat(warmed.bone, heat_cells(warmed.volume));
}

void FilmPainter::take(const SoftLooks& looks) {
  const Case& the_case = *impl_->the_case;
  for (const SoftShapes::Changed& changed : looks.surfaces) {
    const auto show = [&](auto& painter) {
      set_soft_surface(painter, the_case, changed.soft, changed.mesh_W, changed.depth_m);
    };
    if (impl_->renderer) show(*impl_->renderer);
    if (impl_->scope) show(*impl_->scope);
  }
  for (const CarvedPicture::Piece& piece : looks.pieces) impl_->set_loose(piece);
}

Result<Image> FilmPainter::draw(const FilmMoment& moment) {
  impl_->show_carved();
  const int width = impl_->order.width, height = impl_->order.height;
  switch (impl_->order.view) {
    case FilmView::kScope:
      return impl_->through_scope(moment, width, height);
    case FilmView::kPanorama:
      return impl_->panorama(moment, impl_->order.side, width, height);
    case FilmView::kFluoro:
      return impl_->through_beam(moment, width, height);
    case FilmView::kLayout:
      return impl_->layout(moment);
    case FilmView::kOutside:
      break;
  }
  return impl_->outside(moment, width, height);
}

Result<bool> holds_a_scope(RecordingReader& recording, const SessionSettings& settings) {
  const auto lenses = lenses_of(settings.tray);
  if (!lenses) return tl::unexpected(lenses.error());
  const auto looks = [&](std::uint32_t place) {
    return place < lenses->size() && (*lenses)[place].has_value();
  };
  for (const HandSettings& hand : settings.hands)
    if (looks(hand.instrument)) return true;
  for (std::uint64_t next = 1;;) {
    const auto events = recording.read_events(next);
    if (!events) return tl::unexpected(events.error());
    if (events->empty()) return false;
    for (const Event& event : *events)
      if (event.kind == EventKind::kInstrumentTaken && looks(event.subject)) return true;
    next += events->size();
  }
}

}  // namespace osteon
