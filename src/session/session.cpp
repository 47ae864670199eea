#include "osteon/session/session.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "hand_half.h"
#include "osteon/base/check.h"
#include "osteon/base/hash.h"
#include "osteon/scene/instrument_size.h"
#include "whole_tray.h"
#include "world_half.h"

namespace osteon {
namespace {

std::vector<Portal> portals_of(const Case& the_case, const SessionSettings& settings) {
  auto portals = open_portals(the_case, settings);
  demand(portals.has_value(), "a session's settings name a portal that its case does not have");
  return std::move(*portals);
}

std::vector<double> sizes_of(const Tray& tray, const SessionSettings& settings) {
  std::vector<double> sizes_mm;
  for (std::size_t i = 0; i < tray.size(); ++i)
    sizes_mm.push_back(
        size_in_use_mm(i < settings.tray.size() ? settings.tray[i] : tray[i]->name, *tray[i]));
  return sizes_mm;
}

// By the name in the tray, which a size follows.
BenchTool::Kind bench_kind(const std::string& tray_name) {
  const std::string name = tray_name.substr(0, tray_name.find(':'));
  if (name.starts_with("scalpel")) return BenchTool::Kind::kBlade;
  if (name == "tendon_stripper") return BenchTool::Kind::kStripper;
  if (name == "graft_sizer") return BenchTool::Kind::kSizer;
  if (name == "endobutton") return BenchTool::Kind::kButton;
  if (name == "clamp") return BenchTool::Kind::kClamp;
  if (name == "needle_holder") return BenchTool::Kind::kNeedle;
  return BenchTool::Kind::kOther;
}

std::vector<BenchTool> bench_tools(const Tray& tray, const SessionSettings& settings,
                                   const std::vector<double>& sizes_mm) {
  std::vector<BenchTool> tools;
  for (std::size_t i = 0; i < tray.size(); ++i)
    tools.push_back({bench_kind(i < settings.tray.size() ? settings.tray[i] : tray[i]->name),
                     sizes_mm[i] / 1000});
  return tools;
}

PlacingTool::Kind placing_kind(const std::string& tray_name) {
  const std::string name = tray_name.substr(0, tray_name.find(':'));
  if (name == "passing_pin") return PlacingTool::Kind::kPassingPin;
  if (name == "clamp" || name == "grasper") return PlacingTool::Kind::kClamp;
  if (name == "interference_screw") return PlacingTool::Kind::kScrew;
  return PlacingTool::Kind::kOther;
}

std::vector<PlacingTool> placing_tools(const Tray& tray, const SessionSettings& settings,
                                       const std::vector<double>& sizes_mm) {
  std::vector<PlacingTool> tools;
  for (std::size_t i = 0; i < tray.size(); ++i)
    tools.push_back({placing_kind(i < settings.tray.size() ? settings.tray[i] : tray[i]->name),
                     sizes_mm[i] / 1000});
  return tools;
}

}  // namespace

struct Session::Impl {
  Impl(std::shared_ptr<const Case> c, const SessionSettings& settings, Tray given,
       const std::shared_ptr<const CarvingSetup>& carving,
       std::shared_ptr<const SoftSetup> soft_setup)
      : the_case(std::move(c)),
        tray(whole_tray(std::move(given), settings)),
        portals(portals_of(*the_case, settings)),
        softs(std::move(soft_setup)),
        world(the_case, settings),
        ticks_per_step(static_cast<std::uint64_t>(
            std::round(settings.physics.step_s / settings.haptic.tick_s))) {
    const std::vector<double> sizes_mm = sizes_of(tray, settings);
    for (std::size_t i = 0; i < settings.hands.size(); ++i) {
      hands.push_back(std::make_unique<HandHalf>(the_case, tray, portals, settings, i));
      hands.back()->set_sizes(sizes_mm);
    }
    world.set_bench(bench_tools(tray, settings, sizes_mm));
    world.set_placing(placing_tools(tray, settings, sizes_mm));
    world.set_water(tray, settings.water);
    if (softs) set_softs(settings);
    if (carving) set_carving(carving);
    if (settings.structures) world.set_structures(settings.soft_structures);
  }

  std::shared_ptr<const Case> the_case;
  Tray tray;
  std::vector<Portal> portals;
  std::shared_ptr<const SoftSetup> softs;
  std::vector<std::unique_ptr<HandHalf>> hands;
  WorldHalf world;

  // For `tick` alone.
  std::uint64_t ticks_per_step;
  Command for_next_step;
  int last_steps = 0;

  void step_if_due(std::uint64_t tick);

 private:
  std::uint32_t first_made() const {
    const auto fixed = std::count_if(portals.begin(), portals.end(),
                                     [](const Portal& portal) { return portal.made == kNotMade; });
    return static_cast<std::uint32_t>(fixed);
  }
  void set_carving(const std::shared_ptr<const CarvingSetup>& carving) {
    std::vector<FeltCuts*> felt;
    for (const auto& hand : hands) felt.push_back(&hand->set_carving(*carving));
    world.set_carving(carving, std::move(felt));
  }
  void set_softs(const SessionSettings& settings) {
    std::vector<FeltBands*> felt;
    for (const auto& hand : hands) felt.push_back(&hand->set_bands(softs->bands, softs->friction));
    world.set_softs(std::make_unique<SoftHalf>(
        std::make_unique<SoftWorld>(softs, tray, settings.haptic.stiffness_n_per_m,
                                    settings.force_limit_n, settings.physics.step_s, first_made()),
        std::move(felt)));
  }
};

Session::Session(std::shared_ptr<const Case> the_case, const SessionSettings& settings, Tray tray,
                 std::shared_ptr<const CarvingSetup> carving,
                 std::shared_ptr<const SoftSetup> softs) {
  assert(check_settings(settings));
  impl_ = std::make_unique<Impl>(std::move(the_case), settings, std::move(tray), carving,
                                 std::move(softs));
}
Session::~Session() = default;
Session::Session(Session&&) noexcept = default;

void Session::Impl::step_if_due(std::uint64_t tick) {
  last_steps = tick % ticks_per_step == 0 ? 1 : 0;
  if (last_steps == 0) return;
  std::array<const ToolState*, kMaxHands> tools{};
  for (std::size_t i = 0; i < hands.size(); ++i) tools[i] = &hands[i]->tool_state();
  (void)world.step(std::span(tools).first(hands.size()), for_next_step);
  for_next_step = {};
  world.catch_up();
}

const ToolState& Session::tick(std::span<const HandInput> inputs) {
  Impl& in = *impl_;
  assert(inputs.size() == in.hands.size());
  OtherTools others{};
  for (std::size_t i = 0; i < in.hands.size(); ++i)
    others[i] = seen_from_outside(in.hands[i]->tool_state());
  for (std::size_t i = 0; i < in.hands.size(); ++i) {
    const Command& command = inputs[i].command;
    (void)in.hands[i]->tick(inputs[i].input, in.world.bones(), others, command);
    // Between two steps the newest command counts.
    if (is_for_physics(command.kind)) in.for_next_step = command;
  }
  in.step_if_due(in.hands.front()->tool_state().tick);
  return in.hands.front()->tool_state();
}

const ToolState& Session::tick(const ToolInput& input, const Command& command) {
  const HandInput one{input, command};
  return tick(std::span(&one, 1));
}

const ToolState& Session::haptic_tick(std::size_t hand, const ToolInput& input,
                                      const BoneSnapshot& bones, const OtherTools& others,
                                      const Command& command) {
  return impl_->hands[hand]->tick(input, bones, others, command);
}

const ToolState& Session::haptic_tick(const ToolInput& input, const BoneSnapshot& bones,
                                      const Command& command) {
  return haptic_tick(0, input, bones, {}, command);
}

const BoneSnapshot& Session::physics_step(std::span<const ToolState* const> tools,
                                          const Command& command) {
  return impl_->world.step(tools, command);
}

const BoneSnapshot& Session::physics_step(const ToolState& tool, const Command& command) {
  const ToolState* const one = &tool;
  return physics_step(std::span(&one, 1), command);
}

const TickRecord& Session::last_tick_record(std::size_t hand) const {
  return impl_->hands[hand]->record();
}
const StepRecord& Session::last_step_record() const { return impl_->world.record(); }
std::span<const Event> Session::last_events(std::size_t hand) const {
  return impl_->hands[hand]->events();
}
int Session::last_steps() const { return impl_->last_steps; }
const Case& Session::the_case() const { return *impl_->the_case; }
std::size_t Session::hands() const { return impl_->hands.size(); }
const Tool& Session::tool(std::size_t hand) const { return impl_->hands[hand]->tool(); }
const ToolState& Session::tool_state(std::size_t hand) const {
  return impl_->hands[hand]->tool_state();
}
const Tray& Session::tray() const { return impl_->tray; }
std::span<const Portal> Session::portals() const { return impl_->portals; }
const Carving* Session::carving() const { return impl_->world.carving(); }
bool Session::told(std::size_t hand) const { return impl_->world.told(hand); }
void Session::catch_up() { impl_->world.catch_up(); }
CutsFeed* Session::cuts_feed() { return impl_->world.cuts_feed(); }
const SoftWorld* Session::softs() const { return impl_->world.softs(); }
const BoneSnapshot& Session::bones() const { return impl_->world.bones(); }

std::uint64_t Session::state_hash() const {
  Hasher hasher;
  for (const auto& hand : impl_->hands) hasher.add(hand->hash());
  hasher.add(impl_->world.hash());
  return hasher.value();
}

void Session::save_hand(std::size_t hand, HandState& into) const { impl_->hands[hand]->save(into); }
void Session::save_world(WorldState& into) const { impl_->world.save(into); }

SessionState Session::save() const {
  SessionState state;
  state.hands.resize(hands());
  for (std::size_t i = 0; i < hands(); ++i) save_hand(i, state.hands[i]);
  save_world(state.world);
  state.for_next_step = impl_->for_next_step;
  return state;
}

Result<void> Session::restore(const SessionState& state) {
  const SessionState now = save();
  bool fits =
      state.hands.size() == now.hands.size() && state.world.bones.count == now.world.bones.count;
  for (std::size_t i = 0; fits && i < state.hands.size(); ++i)
    fits = impl_->hands[i]->fits(state.hands[i]);
  for (const WorldMark& mark : state.world.marks)
    fits = fits && (!mark.set || mark.bones.count == now.world.bones.count);
  fits = fits && impl_->world.fits(state.world);
  if (!fits)
    return fail("the state is not one of this case with these hands and instruments", "state",
                "Give the case and the settings that it was saved with");
  for (std::size_t i = 0; i < hands(); ++i) impl_->hands[i]->restore(state.hands[i]);
  impl_->world.restore(state.world);
  impl_->for_next_step = state.for_next_step;
  return {};
}

}  // namespace osteon
