#include "osteon/physics/carving.h"

#include <algorithm>

#include "carving_push.h"
#include "osteon/base/check.h"
#include "osteon/scene/carve_events.h"

namespace osteon {

using namespace carving;

namespace {

constexpr std::size_t kMostEvents = 32;  // of a step; no step has so many

using Way = CarvingTool::Way;
bool needs_power(Way way) { return way == Way::kDrill || way == Way::kBurr; }

}  // namespace

Carving::Carving(std::shared_ptr<const CarvingSetup> setup, std::size_t hands,
                 double coupling_n_per_m)
    : setup_(std::move(setup)),
      count_(std::min(hands, kMaxHands)),
      most_shaken_m_(setup_->table.chatter_most_n / coupling_n_per_m) {
  for (const auto& bone : setup_->bones) {
    bones_.emplace_back();
    if (!bone) continue;
    auto field = CarvedField::make(bone, setup_->layers, setup_->most_blocks, setup_->air_m);
    demand(field.has_value(), "a setup for carving has layers that do not fit together");
    Bone& made = bones_.back();
    made.field = std::move(*field);
    made.loose = std::make_unique<LoosePieces>(*made.field);
    made.removed = std::make_unique<RemovedNodes>(*made.field);
    made.tissue_gone = std::make_unique<RemovedTissue>(*made.field);
    made.whole = whole_nodes(bone->bare() ? *bone->bare() : *bone).count;
  }
  for (const Bone& bone : bones_) carved_fields_.push_back(bone.field ? &*bone.field : nullptr);
  if (setup_->pieces) pieces_.emplace(setup_->pieces);
  changed_.reserve((kMaxHands + bones_.size()) * setup_->most_blocks);
  events_.reserve(kMostEvents);
}

const CarvedField* Carving::field(std::size_t bone) const {
  return bone < bones_.size() && bones_[bone].field ? &*bones_[bone].field : nullptr;
}

void Carving::tell(std::size_t hand, const Push& push, EventKind kind,
                   std::array<double, 3> values) {
  const CarvingHand& h = hands_[hand];
  const std::uint32_t bone = push.bone == CarvingHand::kNoBone ? h.bone : push.bone;
  if (events_.size() == kMostEvents) return;
  events_.push_back({push.tool->tick, kind, static_cast<std::uint8_t>(hand), SubjectKind::kBone,
                     bone, push.tool->X_WP.p, values});
}

void Carving::step(std::span<const ToolState* const> tools, const BoneSnapshot& bones,
                   double step_s, const PieceSoftGround* softs) {
  changed_.clear();
  fallen_.clear();
  events_.clear();
  readouts_ = {};
  ++steps_;
  for (std::size_t h = 0; h < std::min(tools.size(), count_); ++h)
    step_hand(h, *tools[h], bones, step_s);
  if (steps_ % kLookEvery == 0) drop_pieces(tools, bones);
  if (pieces_) step_pieces(tools, bones, step_s, softs);
}

void Carving::step_hand(std::size_t hand, const ToolState& tool, const BoneSnapshot& bones,
                        double step_s) {
  if (tool.tick == 0 || tool.epoch != bones.epoch || tool.instrument >= setup_->tray.size()) return;
  guides_[hand] = {};
  CarvingHand& h = hands_[hand];
  if (h.instrument == CarvingHand::kAnyInstrument) h.instrument = tool.instrument;
  if (h.instrument != tool.instrument) {
    // Who takes another instrument lets a pin go; who takes one beside a pin takes that.
    ToolState chuck = tool;
    chuck.jaw = 1;
    const auto pins = [&] {
      return std::count_if(rods_.begin(), rods_.end(),
                           [](const GuideRod& rod) { return rod.kind == GuideRod::Kind::kPin; });
    };
    const auto stood = pins();
    if (h.instrument < setup_->tray.size())
      if (const auto& before = setup_->tray[h.instrument]) {
        if (before->stays) follow_chuck(hand, *before, chuck, bones);
        if (h.in_hole) keep_hole(h, *before);
      }
    Push nothing;
    nothing.tool = &tool;
    run_smoothly(hand, nothing);
    h = {};
    h.instrument = tool.instrument;
    chuck.jaw = 0;
    h.jaw_open = true;
    const bool let_go = pins() != stood;  // what was let go is not what is taken
    if (const auto& now = setup_->tray[tool.instrument]; !let_go && now && now->stays)
      follow_chuck(hand, *now, chuck, bones);
    h.jaw_open = false;
  }
  cut_with(hand, tool, bones, step_s);
  publish(hand, tool, bones);
}

void Carving::cut_with(std::size_t hand, const ToolState& tool, const BoneSnapshot& bones,
                       double step_s) {
  const auto& with = setup_->tray[tool.instrument];
  CarvingHand& h = hands_[hand];
  if (!with) {
    if (tool.instrument < setup_->aimers.size() && setup_->aimers[tool.instrument])
      follow_aimer(hand, *setup_->aimers[tool.instrument], tool, bones);
    return;
  }
  if (with->stays) follow_chuck(hand, *with, tool, bones);
  if (with->stays && h.jaw_open) return slide_on_pin(hand, tool, bones);
  if (goes_forward(with->way)) leave_hole(hand, *with, tool, bones);
  if (with->way == Way::kDrill) {
    follow_rods(hand, *with, tool, bones);
    come_back(hand, *with, tool, bones);
  }
  Push push;
  push.tool = &tool;
  // The bone that is pressed most; of equals the first.
  double most = 0;
  for (std::uint32_t b = 0; b < bones_.size() && b < bones.count; ++b) {
    if (!bones_[b].field) continue;
    Vec3 force_W = Vec3::Zero(), moment_W = Vec3::Zero();
    double sum = 0;
    for (std::uint32_t i = 0; i < tool.contact_count; ++i) {
      if (tool.contacts[i].bone.index != b) continue;
      const double share = tool.contacts[i].force_on_tool_W.norm();
      force_W += tool.contacts[i].force_on_tool_W;
      moment_W += share * tool.contacts[i].p_W;
      sum += share;
    }
    if (!(force_W.norm() > most)) continue;
    most = force_W.norm();
    push.bone = b;
    push.force_B = bones.bones[b].X_WB.q.conjugate() * force_W;
    push.at_B = bones.bones[b].X_WB.inverse() * Vec3(moment_W / sum);
  }
  const std::uint32_t at = push.bone == CarvingHand::kNoBone ? h.bone : push.bone;
  if (at < bones.count) {
    push.X_WB = bones.bones[at].X_WB;
    push.X_BT = push.X_WB.inverse() * tool.X_WP;
  }
  if (with->way == Way::kBite) {
    for (std::uint32_t b = 0; b < bones_.size() && b < bones.count; ++b)
      if (bones_[b].field) bite(hand, *with, tool, bones.bones[b].X_WB.inverse() * tool.X_WP, b);
    h.jaw_open = tool.jaw > 0.5 || (h.jaw_open && tool.jaw > 0.1);
    return;
  }
  const bool off = needs_power(with->way) && !(tool.power > 0);
  if (off || push.bone == CarvingHand::kNoBone) return rest(hand, push);
  if (with->way == Way::kStrike)
    strike(hand, *with, push, step_s);
  else if (goes_forward(with->way))
    drill(hand, *with, push, step_s);
  else
    burr(hand, *with, push, step_s);
}

bool Carving::remove(std::size_t hand, const Cutter& cutter, const Pose& from_B, const Pose& to_B) {
  const std::uint32_t bone = hands_[hand].bone;
  CarvedField& field = *bones_[bone].field;
  const std::uint64_t before = field.step();
  const CarveStep did = field.cut(cutter, from_B, to_B);
  full_ = full_ || (did.status & CarveStep::kBlocksFull) != 0;
  if ((did.status & (CarveStep::kBlocksFull | CarveStep::kNotFinite | CarveStep::kTooLong)) != 0)
    return false;
  for (std::size_t n = 0; n < field.block_count(); ++n)
    if (field.changed_at(n) > before) changed_.push_back({bone, field.block_at(n)});
  return true;
}

// Once: it stays so until the bone is put back.
void Carving::tell_full(std::size_t hand, const Push& push, bool was_full) {
  if (full_ && !was_full) tell(hand, push, kCarvingFull, {});
}

void Carving::note_tissue(std::size_t hand, const Push& push, std::optional<BoneTissue> tissue) {
  CarvingHand& h = hands_[hand];
  const auto now = static_cast<std::uint8_t>(tissue ? 1 + static_cast<int>(*tissue) : 0);
  if (now == h.tissue) return;
  h.tissue = now;
  const double thrust = setup_->thrust_scale * push.force_B.norm();
  const double depth_mm = 1000 * h.drill.depth_m;
  if (tissue == BoneTissue::kCartilage) tell(hand, push, kCartilageEntered, {depth_mm, thrust, 0});
  if (tissue == BoneTissue::kCortical) tell(hand, push, kCortexEntered, {depth_mm, thrust, 0});
  if (tissue == BoneTissue::kCancellous)
    tell(hand, push, kCancellousEntered, {depth_mm, thrust, 0});
}

void Carving::rest(std::size_t hand, const Push& push) {
  CarvingHand& h = hands_[hand];
  if (h.bone == CarvingHand::kNoBone) return;
  h.drill.was_cutting = false;
  const auto& with = setup_->tray[push.tool->instrument];
  if (with && goes_forward(with->way)) follow_out(hand, push);
  if (++h.idle < kRestSteps) return;
  run_smoothly(hand, push);
  if (h.out > 0) return;
  const double seconds = kStep_s * static_cast<double>(steps_ - h.since);
  if (h.most_torque_nm > 0 || (h.was_in && !h.in_hole))
    tell(hand, push, kCutEnd, {1000 * h.drill.depth_m, seconds, 1000 * h.most_torque_nm});
  h.most_torque_nm = 0;
  h.since = steps_;
  if (h.in_hole) return;
  h = anew(h);
}

}  // namespace osteon
