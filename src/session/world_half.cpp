#include "world_half.h"

#include <algorithm>
#include <cmath>

#include "osteon/base/hash.h"
#include "osteon/physics/fallen_pieces.h"

namespace osteon {
namespace {

// A recording has a state to start from at least so often.
constexpr double kKeepEvery_s = 5;
// A joint is bent so fast; a cycle goes from straight to bent (own defaults).
constexpr double kBend_deg_per_s = 90, kStraight_deg = 20, kBent_deg = 80;

PhysicsParams physics_of(const SessionSettings& settings) {
  PhysicsParams params = settings.physics;
  params.contact_n_per_m = std::max(params.contact_n_per_m, settings.haptic.stiffness_n_per_m);
  return params;
}

}  // namespace

WorldHalf::WorldHalf(std::shared_ptr<const Case> the_case, const SessionSettings& settings)
    : the_case_(the_case),
      world_(the_case, physics_of(settings)),
      knee_(the_case, settings.physics.step_s),
      step_s_(settings.physics.step_s),
      coupling_n_per_m_(settings.haptic.stiffness_n_per_m),
      keep_every_(static_cast<std::uint64_t>(std::ceil(kKeepEvery_s / settings.physics.step_s))) {
  auto rings = std::make_unique<LooseRings>(std::move(the_case), step_s_);
  if (rings->count() > 0) rings_ = std::move(rings);
  begin_bent();
}

// A joint that begins otherwise bent than its bones lie at rest.
void WorldHalf::begin_bent() {
  if (the_case_->joints.empty() || !the_case_->joints.front().begin_deg) return;
  const CaseJoint& joint = the_case_->joints.front();
  BendState bend;
  bend.on = true;
  bend.now_deg = bend.wanted_deg = *joint.begin_deg;
  world_.set_bend(bend);
  const Pose& X_WF = world_.snapshot().bones[joint.fixed.index].X_WB;
  for (const CaseJoint::Moved& moved : joint.bones)
    world_.place(moved.bone.index, {X_WF * pose_at(moved.X_FB, bend.now_deg)});
}

// Whatever moves the other bones, rings are where jaws and gravity have put them.
void WorldHalf::place_rings() {
  for (std::size_t i = 0; i < rings_->count(); ++i)
    world_.place(rings_->bone(i), rings_->motion(i));
}

void WorldHalf::set_carving(std::shared_ptr<const CarvingSetup> setup,
                            std::vector<FeltCuts*> hands) {
  feed_ = std::make_unique<CutsFeed>(*setup, filled_joint(*the_case_));
  carving_ = std::make_unique<Carving>(std::move(setup), hands.size(), coupling_n_per_m_);
  felt_ = std::move(hands);
}

std::shared_ptr<const CarvingState> WorldHalf::carved() const {
  return carving_ ? std::make_shared<const CarvingState>(carving_->save()) : nullptr;
}

const BoneSnapshot& WorldHalf::step(std::span<const ToolState* const> tools,
                                    const Command& command) {
  obey(command);
  if (carving_) {
    const bool meets = softs_ && carving_->any_pieces();
    carving_->step(tools, world_.snapshot(), step_s_,
                   meets ? softs_->world().ground(world_.snapshot()) : nullptr);
    if (!world_.held()) lighten();
    show_loose();
  }
  if (bench_) {
    GraftBenchState bench = world_.snapshot().bench;
    bench_->step(tools, world_.snapshot(), bench);
    world_.set_bench(bench);
  }
  if (placing_) {
    GraftPlacingState placing = world_.snapshot().placing;
    placing_->step(tools, world_.snapshot(), placing);
    world_.set_placing(placing);
  }
  lead();
  const BoneSnapshot& bones = world_.step(tools);
  bend();
  if (carving_) {
    publish(*carving_, bones.step, all_changed_, felt_);
    feed_->note(*carving_, all_changed_);
    feed_->note_heat(*carving_, bones, command, step_s_);
  }
  if (rings_) {
    rings_->step(tools, bones.epoch);
    place_rings();
  }
  if (softs_) step_softs(tools, bones);
  if (water_) let_flow(tools);
  if (structures_) look_inside(tools);
  all_changed_ = false;
  record_ = {};
  record_.step = bones.step;
  for (std::size_t i = 0; i < tools.size(); ++i) record_.tool_ticks[i] = tools[i]->tick;
  record_.command = command;
  const bool marked = command.kind == CommandKind::kMark && mark_of(command) < kMaxMarks;
  if (marked || bones.step % keep_every_ == 0) world_.ask_to_keep();
  return bones;
}

void WorldHalf::step_softs(std::span<const ToolState* const> tools, const BoneSnapshot& bones) {
  softs_->step(tools, bones, carving_ ? carving_->fields() : std::span<const CarvedField* const>());
  world_.set_softs(softs_->world().told());
  if (carving_ && softs_->world().setup().pieces_are_stopped) {
    if (softs_->world().ground_parts())
      carving_->stir_pieces();
    else if (softs_->world().ground_is_cut())
      carving_->stir_pieces_by(tools, bones);
  }
  show_loose();
}

// Pieces of bone, after them those of soft parts.
void WorldHalf::show_loose() {
  LooseBones loose = carving_ ? carving_->loose() : LooseBones{};
  if (softs_)
    for (const FallenPiece& piece : softs_->world().lying())
      loose.bones[loose.count++] = {piece.shape->hash(), piece.shape->grid().bone, piece.X_WB,
                                    piece.soft};
  world_.set_loose(loose);
}

void WorldHalf::set_bench(std::vector<BenchTool> tray) {
  auto plan = find_graft_bench(*the_case_);
  if (!plan) return;
  world_.set_bench(fresh_bench(*plan));
  bench_ = std::make_unique<GraftBenchWork>(std::move(*plan), std::move(tray), step_s_);
}

void WorldHalf::set_placing(std::vector<PlacingTool> tray) {
  placing_tray_ = std::move(tray);
  own_plan_ = find_placing(*the_case_);
  if (!own_plan_) return;
  auto made = GraftPlacing::make(*own_plan_, placing_tray_, step_s_);
  if (!made) return;
  placing_ = std::make_unique<GraftPlacing>(std::move(*made));
  world_.set_placing(placing_->begin());
}

// Who places what a state says is there; a state of the same graft keeps him.
void WorldHalf::make_placing(const GraftPlacingState& state) {
  if (own_plan_) return;
  if (!state.on) {
    placing_.reset();
    return;
  }
  if (placing_ && placing_numbers(placing_->plan()) == placing_numbers(state.plan)) return;
  auto made = GraftPlacing::make(state.plan, placing_tray_, step_s_);
  placing_ = made ? std::make_unique<GraftPlacing>(std::move(*made)) : nullptr;
}

// A graft for a case that has none of its own is told number by number; with the last one it is
// there. What is no plan for this case is forgotten. Allocates with the last number alone.
bool WorldHalf::takes_graft(const Command& command) {
  if (command.kind != CommandKind::kGraftOrder && command.kind != CommandKind::kGraftNumber)
    return false;
  GraftPlacingState state = world_.snapshot().placing;
  if (own_plan_) return true;
  if (command.kind == CommandKind::kGraftOrder) {
    state.told = 1;
    state.numbers = {};
  } else if (state.told > 0) {
    state.numbers[state.told - 1] = command.value;
    ++state.told;
  }
  if (state.told <= kPlacingNumbers) {
    world_.set_placing(state);
    return true;
  }
  state.told = 0;
  if (const auto plan = plan_of_numbers(*the_case_, state.numbers)) {
    GraftPlacingState fresh;
    fresh.on = fresh.ordered = true;
    fresh.plan = *plan;
    make_placing(fresh);
    if (placing_) state = fresh;
  }
  world_.set_placing(state);
  return true;
}

void WorldHalf::order_bend(double degrees) {
  if (the_case_->joints.empty() || !std::isfinite(degrees)) return;
  const CaseJoint& joint = the_case_->joints.front();
  BendState bend = world_.snapshot().bend;
  if (!bend.on) bend.now_deg = joint.at_deg;
  bend.on = true;
  bend.wanted_deg = std::clamp(degrees, joint.min_deg(), joint.max_deg());
  world_.set_bend(bend);
}

// Whoever pulls at a knee that was never bent holds it as it lies.
bool WorldHalf::examines(const Command& command) {
  KneeExamState exam = world_.snapshot().exam;
  if (!knee_.obey(command, exam)) return false;
  world_.set_exam(exam);
  const BendState& bend = world_.snapshot().bend;
  if (is_wanted(exam) && !bend.on) order_bend(the_case_->joints.front().at_deg);
  return true;
}

// The joint goes to where it is wanted, and its bones with it, however they are held.
void WorldHalf::bend() {
  BendState bend = world_.snapshot().bend;
  if (!bend.on) return;
  const CaseJoint& joint = the_case_->joints.front();
  const double most = kBend_deg_per_s * step_s_;
  const double before = bend.now_deg;
  bend.now_deg += std::clamp(bend.wanted_deg - bend.now_deg, -most, most);
  KneeExamState exam = world_.snapshot().exam;
  const KneeGive gave = exam.give;
  // Bent farther than it can be examined it is let go first.
  if (is_loaded(exam)) bend.now_deg = std::min(bend.now_deg, KneeGiveTable::kMost_deg);
  knee_.step(bend, exam);
  world_.set_exam(exam);
  if (bend.now_deg <= kStraight_deg) bend.straight = true;
  if (bend.straight && bend.now_deg >= kBent_deg) {
    bend.straight = false;
    ++bend.cycles;
  }
  world_.set_bend(bend);
  const Pose& X_WF = world_.snapshot().bones[joint.fixed.index].X_WB;
  for (const CaseJoint::Moved& moved : joint.bones) {
    const Pose was = X_WF * knee_.pose_in_fixed(joint, moved, before, gave);
    const Pose now = X_WF * knee_.pose_in_fixed(joint, moved, bend.now_deg, exam.give);
    // So small a turn is twice the vector part of its quaternion.
    const Quat turn = now.q * was.q.conjugate();
    const double sign = turn.w() < 0 ? -2 : 2;
    world_.place(moved.bone.index, {now, (now.p - was.p) / step_s_, sign / step_s_ * turn.vec()});
  }
}

void WorldHalf::set_water(std::span<const std::shared_ptr<const Tool>> tray, bool hashed) {
  const auto joint = filled_joint(*the_case_);
  if (!joint) return;
  water_.emplace(*joint, tray, step_s_);
  water_hashed_ = hashed;
  world_.set_water(fresh_water());
}

WaterState WorldHalf::fresh_water() const {
  WaterState water = water_->begin();
  water.hashed = water_hashed_;
  return water;
}

void WorldHalf::let_flow(std::span<const ToolState* const> tools) {
  const BoneSnapshot& bones = world_.snapshot();
  WaterState water = bones.water;
  std::optional<GoneBone> gone;
  if (carving_ && bones.step % JointWater::kLookEvery == 0) gone = carving_->gone();
  const std::span<const SoftOpening> openings =
      softs_ ? softs_->world().openings() : std::span<const SoftOpening>();
  water_->step(tools, bones, openings, gone ? &*gone : nullptr, water);
  world_.set_water(water);
}

void WorldHalf::set_structures(bool softs) {
  std::vector<std::uint32_t> felt;
  if (softs_) {
    const SoftSetup& setup = softs_->world().setup();
    for (const SoftBand& band : setup.bands) felt.push_back(band.soft);
    for (const SoftSolid& solid : setup.solids) felt.push_back(solid.soft);
    for (const SkinPatch& patch : setup.skins) felt.push_back(patch.soft);
  }
  auto watch = std::make_unique<StructureWatch>(*the_case_);
  if (softs) watch->add_softs(*the_case_, felt);
  for (std::uint32_t b = 0; carving_ && b < the_case_->bones.size(); ++b)
    if (carving_->field(b)) watch->add_bone(*the_case_, b);
  if (watch->count() > 0) structures_ = std::move(watch);
}

void WorldHalf::look_inside(std::span<const ToolState* const> tools) {
  const BoneSnapshot& bones = world_.snapshot();
  for (std::size_t h = 0; h < tools.size(); ++h) {
    InsideList list = bones.inside[h];
    structures_->look(*tools[h], bones, list);
    world_.set_inside(h, list);
  }
}

// A line of the bench or of a tunnel leads before one of what is carved.
void WorldHalf::lead() {
  if (!carving_ && !bench_ && !placing_) return;
  std::array<ToolGuide, kMaxHands> guides{};
  if (carving_) guides = carving_->guides();
  if (bench_)
    for (std::size_t h = 0; h < guides.size(); ++h)
      if (bench_->guides()[h].on) guides[h] = bench_->guides()[h];
  if (placing_) placing_->lead(world_.snapshot().placing, guides);
  world_.set_guides(guides, carving_ ? carving_->rods() : GuideRods{});
}

// Bones that move weigh what is left of them.
void WorldHalf::lighten() {
  const std::vector<Bone>& bones = the_case_->bones;
  for (std::size_t b = 0; b < bones.size(); ++b)
    if (carving_->field(b)) world_.set_loss(b, carving_->loss(b, bones[b].mass_kg));
}

void WorldHalf::catch_up() {
  for (FeltCuts* hand : felt_) hand->catch_up();
}

void WorldHalf::obey(const Command& command) {
  const std::uint32_t mark = mark_of(command);
  if (command.kind == CommandKind::kHoldBones && command.value >= 0 && command.value <= 1)
    world_.set_hold(command.value >= 0.5);
  else if (water_ && (command.kind == CommandKind::kPump || command.kind == CommandKind::kOutlet))
    turn_pump(command);
  else if (takes_graft(command))
    return;
  else if (command.kind == CommandKind::kBend)
    order_bend(command.value);
  else if (command.kind == CommandKind::kTension)
    pull_tail(command.value);
  else if (command.kind == CommandKind::kBareSkin) {
    if (softs_) softs_->bare_skin(command.value >= 0.5 ? SkinBare::kAll : SkinBare::kPortals);
  } else if (examines(command))
    return;
  else if (command.kind == CommandKind::kMark && mark < kMaxMarks)
    keep(mark);
  else if (command.kind == CommandKind::kRestore && mark < kMaxMarks && marks_[mark].set)
    go_back(marks_[mark]);
}

void WorldHalf::pull_tail(double tension_n) {
  GraftPlacingState placing = world_.snapshot().placing;
  GraftPlacing::pull(tension_n, placing);
  world_.set_placing(placing);
}

void WorldHalf::turn_pump(const Command& command) {
  WaterState water = world_.snapshot().water;
  if (command.kind == CommandKind::kPump) set_pump(command.value, water);
  if (command.kind == CommandKind::kOutlet) set_outlet(command.value, water);
  world_.set_water(water);
}

void WorldHalf::go_back(const WorldMark& mark) {
  world_.go_back(mark.bones, mark.hold);
  if (water_) world_.set_water(JointWater::gone_back(mark.bones.water, world_.snapshot().water));
  if (softs_) softs_->go_back(mark.softs, world_.snapshot().epoch);
  if (softs_) world_.set_softs(softs_->world().told());
  if (rings_) rings_->go_back(mark.rings);
  if (bench_) world_.set_bench(GraftBenchWork::gone_back(mark.bones.bench));
  make_placing(mark.bones.placing);
  world_.set_placing(GraftPlacing::gone_back(mark.bones.placing));
  BendState bend = mark.bones.bend;
  bend.wanted_deg = bend.now_deg;
  world_.set_bend(bend);
  knee_.restore(mark.knee);
  world_.set_exam(let_go(mark.bones.exam));
  if (!carving_ || !mark.carved) return;
  carving_->restore(*mark.carved);
  carving_->let_pieces_go();
  all_changed_ = true;
}

void WorldHalf::keep(std::uint32_t mark) {
  marks_[mark] = {true,
                  world_.held(),
                  world_.snapshot(),
                  carved(),
                  softs_ ? softs_->world().save() : SoftState{},
                  rings_ ? rings_->state() : RingsState{},
                  knee_.told()};
  mark_hashes_[mark] = hash_of(marks_[mark].bones);
}

std::uint64_t WorldHalf::hash() const {
  Hasher hasher;
  hasher.add(world_.state_hash());
  if (carving_) hasher.add(carving_->hash());
  if (softs_) hasher.add(softs_->world().hash());
  if (rings_) hasher.add(rings_->hash());
  for (std::size_t i = 0; i < marks_.size(); ++i) {
    hasher.add(marks_[i].set);
    if (!marks_[i].set) continue;
    hasher.add(marks_[i].hold);
    hasher.add(mark_hashes_[i]);
  }
  return hasher.value();
}

void WorldHalf::save(WorldState& into) const {
  into.bones = world_.snapshot();
  into.hold = world_.held();
  into.carved = carved();
  if (softs_) into.softs = softs_->world().save();
  if (rings_) into.rings = rings_->state();
  into.knee = knee_.told();
  into.marks = marks_;
}

bool WorldHalf::fits_placing(const GraftPlacingState& state) const {
  if (own_plan_) return state.on == (placing_ != nullptr) && !state.ordered;
  if (!state.on) return !state.ordered;
  const auto bone = [&](std::uint32_t n) { return n < the_case_->bones.size(); };
  return state.ordered && bone(state.plan.femur.bone) && bone(state.plan.tibia.bone) &&
         GraftPlacing::make(state.plan, placing_tray_, step_s_).has_value();
}

bool WorldHalf::fits(const WorldState& state) const {
  const auto good = [&](const std::shared_ptr<const CarvingState>& carved) {
    return carving_ ? carved && carving_->fits(*carved) : !carved;
  };
  const auto fit = [&](const SoftState& softs) {
    return softs_ ? softs_->world().fits(softs) : !softs.on;
  };
  const auto hang = [&](const RingsState& rings) {
    return rings_ ? rings_->fits(rings) : !rings.on;
  };
  const auto lies = [&](const BoneSnapshot& bones) {
    const bool flows = !bones.water.on || (water_ && JointWater::fits(bones.water));
    const bool bends = !bones.bend.on || !the_case_->joints.empty();
    return bones.bench.on == (bench_ != nullptr) && fits_placing(bones.placing) && flows && bends;
  };
  if (!lies(state.bones) || !knee_.fits(state.bones.exam, state.knee)) return false;
  for (const WorldMark& mark : state.marks)
    if (mark.set && !(lies(mark.bones) && knee_.fits(mark.bones.exam, mark.knee))) return false;
  for (const WorldMark& mark : state.marks)
    if (mark.set && !(good(mark.carved) && fit(mark.softs) && hang(mark.rings))) return false;
  return good(state.carved) && fit(state.softs) && hang(state.rings);
}

void WorldHalf::restore(const WorldState& from) {
  world_.restore(from.bones, from.hold);
  make_placing(from.bones.placing);
  // A state of an older version does not say what its case has.
  const auto own = [&](GraftPlacingState placing) {
    if (own_plan_) placing.plan = *own_plan_;
    return placing;
  };
  world_.set_placing(own(from.bones.placing));
  if (water_ && !from.bones.water.on) world_.set_water(fresh_water());
  if (carving_ && from.carved) {
    carving_->restore(*from.carved);
    for (FeltCuts* hand : felt_) hand->copy(*carving_);
    feed_->note_all(*carving_);
  }
  if (softs_) softs_->restore(from.softs, from.bones.epoch);
  show_loose();
  if (softs_) world_.set_softs(softs_->world().told());
  if (rings_) rings_->restore(from.rings);
  knee_.restore(from.knee);
  marks_ = from.marks;
  for (WorldMark& mark : marks_)
    if (mark.set) mark.bones.placing = own(mark.bones.placing);
  for (WorldMark& mark : marks_)
    if (water_ && mark.set && !mark.bones.water.on) mark.bones.water = fresh_water();
  for (std::size_t i = 0; i < marks_.size(); ++i)
    mark_hashes_[i] = marks_[i].set ? hash_of(marks_[i].bones) : 0;
  record_ = {};
  record_.step = from.bones.step;
}

}  // namespace osteon
