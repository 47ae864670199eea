#include "osteon/physics/heat_pulse.h"

#include <algorithm>

#include "osteon/physics/joint_water.h"

namespace osteon {
namespace {

constexpr std::size_t kMarked = 0, kPassed = 1;

}  // namespace

double irrigation_m3_s(const CarvingSetup& setup, const std::optional<FluidJoint>& joint,
                       const BoneSnapshot& bones) {
  double flow = setup.irrigation_m3_s;
  if (joint && bones.water.on)
    flow += fluid_flows(*joint, drive_of(bones.water), bones.water.pressure_pa).in;
  return flow;
}

HeatPulses::HeatPulses(const CarvingSetup& setup, std::optional<FluidJoint> joint)
    : chips_share_(setup.table.chips_heat_share),
      rubbing_share_(setup.table.rubbing_heat_share),
      outrun_m_per_s_(setup.table.outrun_m_per_s),
      joint_(std::move(joint)) {}

// The bone before a quick drill goes with the heat in it.
void HeatPulses::gather(std::size_t hand, const CarvingReadout& readout, double step_s) {
  if (!(readout.cutting_w + readout.rubbing_w > 0)) return;
  HeatPulse::Source& source = waits_[kPassed].sources[hand];
  const double stays = 1 / (1 + readout.advance_m / step_s / outrun_m_per_s_);
  if (source.bone != readout.bone) source = {};
  source.bone = readout.bone;
  source.heat.tip_B = readout.tip_B;
  source.heat.axis_B = readout.axis_B;
  source.heat.radius_m = readout.radius_m;
  source.heat.ball = readout.ball;
  source.heat.joules +=
      stays * (chips_share_ * readout.cutting_w + rubbing_share_ * readout.rubbing_w) * step_s;
  warmed_ = true;
}

void HeatPulses::add(const Carving& carving, const BoneSnapshot& bones, const Command& command,
                     double step_s) {
  const std::uint32_t mark = mark_of(command);
  if (mark < kMaxMarks) {
    waits_[kMarked] = {};
    waits_[kMarked].kind =
        command.kind == CommandKind::kMark ? HeatPulse::Kind::kKeep : HeatPulse::Kind::kGoBack;
    waits_[kMarked].mark = mark;
    is_due_[kMarked] = true;
  }
  for (std::size_t h = 0; h < kMaxHands; ++h) gather(h, carving.readout(h), step_s);
  if (!warmed_) return;
  HeatPulse& passed = waits_[kPassed];
  passed.dt_s += step_s;
  passed.flow_m3_s = irrigation_m3_s(carving.setup(), joint_, bones);
  is_due_[kPassed] = passed.dt_s >= kEvery_s - 0.5 * step_s;
}

const HeatPulse* HeatPulses::due() const {
  for (std::size_t n = 0; n < waits_.size(); ++n)
    if (is_due_[n]) return &waits_[n];
  return nullptr;
}

void HeatPulses::pop() {
  const std::size_t n = is_due_[kMarked] ? kMarked : kPassed;
  waits_[n] = {};
  is_due_[n] = false;
}

void HeatOfBones::take(const HeatPulse& pulse, const FieldOf& field_of) {
  if (pulse.kind != HeatPulse::Kind::kPasses) {
    if (pulse.mark >= kMaxMarks) return;
    if (pulse.kind == HeatPulse::Kind::kKeep)
      kept_[pulse.mark] = now_;
    else if (kept_[pulse.mark])
      now_ = *kept_[pulse.mark];
    return;
  }
  for (const HeatPulse::Source& source : pulse.sources) {
    const CarvedField* const field =
        source.bone == CarvingHand::kNoBone ? nullptr : field_of(source.bone);
    if (!field) continue;
    if (now_.size() <= source.bone) now_.resize(source.bone + 1);
    std::optional<BoneHeat>& bone = now_[source.bone];
    if (!bone) bone.emplace(*field, material_);
    bone->add(*field, source.heat);
  }
  for (std::uint32_t b = 0; b < now_.size(); ++b) {
    const CarvedField* const field = now_[b] ? field_of(b) : nullptr;
    if (!field) continue;
    now_[b]->step(*field, pulse.dt_s, water_, pulse.flow_m3_s);
    hottest_c_ = std::max(hottest_c_, now_[b]->hottest_c());
  }
}

const BoneHeat* HeatOfBones::bone(std::uint32_t index) const {
  return index < now_.size() && now_[index] ? &*now_[index] : nullptr;
}

double HeatOfBones::necrosis_m3(std::size_t rule) const {
  double sum = 0;
  for (const auto& bone : now_)
    if (bone) sum += bone->necrosis_m3(rule);
  return sum;
}

}  // namespace osteon
