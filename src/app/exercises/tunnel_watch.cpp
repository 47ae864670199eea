#include "exercises/tunnel_watch.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <utility>

#include "cases/felt_choice.h"
#include "cases/open_case.h"
#include "cases/undrilled.h"
#include "loops/realtime.h"
#include "osteon/mesh/distance.h"
#include "osteon/procedure/tunnel_events.h"
#include "osteon/scene/marks_now.h"

namespace osteon {
namespace {

constexpr double kTunnelWatchHz = 100;
constexpr double kFarFromMark_m = 0.02;
constexpr double kStill_m = 0.001;   // so far a pin may wander while it is held still
constexpr double kBeyond_m = 0.002;  // a line through a bone ends so far behind it
constexpr double kLongest_m = 0.15;
constexpr const char* kTunnelBones[] = {"femur", "tibia"};

bool is_tunnel_rule(const PlannedRule& rule) {
  const std::string& kind = rule.rule.kind;
  return kind == "felt" || kind == "tunnel_located" || kind == "graft_tested" ||
         kind == "tunnel_drilled" || kind == "socket_drilled" || kind == "drilled_free" ||
         kind == "drilled_into" || kind == "plunged_past" || kind == "located_unseen" ||
         std::any_of(kTunnelValueNames.begin(), kTunnelValueNames.end(),
                     [&](std::string_view name) { return kind == "outside_" + std::string(name); });
}

// By TunnelValue.
std::vector<std::pair<TunnelValue, double>> values_of(const FemoralTunnel& t) {
  return {{TunnelValue::kFemoralDepth, 100 * t.depth_share},
          {TunnelValue::kFemoralHeight, 100 * t.height_share},
          {TunnelValue::kFemoralOff, 1e3 * t.off_target_m},
          {TunnelValue::kFemoralClock, 180 / std::numbers::pi * t.from_roof_rad},
          {TunnelValue::kFemoralChannel, 1e3 * t.channel_m},
          {TunnelValue::kFemoralSocket, 1e3 * t.drilled_m},
          {TunnelValue::kBackWall, 1e3 * t.back_wall_m}};
}
std::vector<std::pair<TunnelValue, double>> values_of(const TibialTunnel& t) {
  return {{TunnelValue::kAmisJakob, 100 * t.front_share},
          {TunnelValue::kTibialMedial, 100 * t.medial_share},
          {TunnelValue::kTibialLength, 1e3 * t.length_m},
          {TunnelValue::kBehindRoof, 1e3 * t.behind_roof_m}};
}
std::vector<std::pair<TunnelValue, double>> values_of(const GraftOutcome& g) {
  return {{TunnelValue::kExcursion, 1e3 * g.excursion_m},
          {TunnelValue::kLachman, 1e3 * (g.lachman.anterior_m - g.lachman_whole_m)},
          {TunnelValue::kPivot, 1e3 * (g.pivot.anterior_m - g.pivot_whole_m)}};
}

bool is_same(const std::optional<DrilledHole>& a, const std::optional<DrilledHole>& b) {
  if (!a || !b) return a.has_value() == b.has_value();
  return a->line.from_W == b->line.from_W && a->line.to_W == b->line.to_W &&
         a->line.diameter_m == b->line.diameter_m && a->channel_m == b->channel_m;
}

// How a graft was placed and fixed by hand.
GraftChoices choices_of(const GraftPlacingState& placing) {
  const PlacingPlan& plan = placing.plan;
  const PlacingScrew& screw = placing.screw;
  const Vec3 out_B = (plan.tibia.outer_B - plan.tibia.mouth_B).normalized();
  GraftChoices choices;
  choices.diameter_m =
      std::min(plan.graft_m, 2 * std::min(plan.femur.radius_m, plan.tibia.radius_m));
  choices.length_m = plan.graft_length_m;
  choices.loop_m = plan.loop_m;
  choices.button_gap_m = placing.gap_m;
  choices.tension_n = screw.tension_n;
  choices.flexion_deg = screw.flexion_deg;
  choices.screw_m = screw.width_m;
  choices.screw_length_m = std::min(screw.in_m, screw.length_m);
  choices.divergence_rad = std::acos(std::clamp(screw.out_B.dot(out_B), -1.0, 1.0));
  choices.cycles = screw.cycles;
  return choices;
}

Event told(const ToolState& tool, std::size_t hand, EventKind kind, SubjectKind about,
           std::uint32_t subject, std::array<double, 3> values) {
  return {tool.tick, kind, static_cast<std::uint8_t>(hand), about, subject, tool.X_WP.p, values};
}

// From a place on a bone along a direction into it to behind where it leaves the bone.
double way_through_m(const MeshDistance& bone, const Vec3& p_B, const Vec3& in_B) {
  constexpr double kUnderSurface_m = 0.002, kLeast_m = 1e-5;
  double way = kUnderSurface_m;
  while (way < kLongest_m) {
    const double inside = -bone.closest(p_B + way * in_B).signed_distance;
    if (inside < kLeast_m) break;
    way += inside;
  }
  return way + kBeyond_m;
}

}  // namespace

bool asks_about_tunnels(const ScenarioPlan& plan) {
  for (const auto& goals : plan.goals)
    if (std::any_of(goals.begin(), goals.end(), is_tunnel_rule)) return true;
  return std::any_of(plan.errors.begin(), plan.errors.end(), is_tunnel_rule);
}

TunnelWatch::TunnelWatch(const ScenarioPlan& plan, const Case& the_case, TunnelSources sources,
                         std::vector<char> pins, std::vector<double> widths_m, double tick_s)
    : case_(&the_case),
      sources_(std::move(sources)),
      pins_(std::move(pins)),
      tick_s_(tick_s),
      stride_(std::max<std::uint64_t>(
          1, static_cast<std::uint64_t>(1 / (kTunnelWatchHz * tick_s) + 0.5))),
      holds_(pins_.size()) {
  work_.spec = source_before_drilling(source_without_choice(sources_.case_spec));
  work_.felt = &the_case;
  work_.had_tunnels = work_.spec != source_without_choice(sources_.case_spec);
  if (!sources_.graft) bench_ = find_graft_bench(the_case);
  DrillWatch::Bones drilled{kNoSubject, kNoSubject};
  for (std::size_t k = 0; k < kBones; ++k) {
    work_.names[k] = kTunnelBones[k];
    if (const BoneId bone = the_case.find(kTunnelBones[k]); bone.valid()) bones_[k] = bone.index;
  }
  for (const auto& goals : plan.goals)
    for (const PlannedRule& goal : goals) {
      const std::string& kind = goal.rule.kind;
      for (std::size_t m = 0; kind == "felt" && m < goal.bones.size(); ++m)
        felt_.push_back(
            {goal.bones[m], meniscus_under(the_case, goal.bones[m]).value_or(kNoSubject)});
      const bool is_drilled = kind == "tunnel_drilled" || kind == "socket_drilled";
      if (kind != "tunnel_located" && !is_drilled) continue;
      const auto& n = goal.rule.numbers;
      for (std::size_t k = 0; k < kBones; ++k) {
        if (std::find(goal.bones.begin(), goal.bones.end(), bones_[k]) == goal.bones.end())
          continue;
        is_socket_[k] = kind == "socket_drilled";
        if (is_drilled)
          drilled[k] = bones_[k];
        else
          wanted_[k] = {true, n.at("force_n"), n.at("for_s"), n.at("depth_mm") / 1000,
                        n.at("reamed_mm") / 1000};
      }
    }
  if (drilled[0] != kNoSubject || drilled[1] != kNoSubject)
    drills_.emplace(the_case, drilled, std::move(widths_m), tick_s, pins_.size());
  work_.bones = bones_;
  // What others drilled is measured before anything is done.
  fresh_ = drills_ && work_.had_tunnels;
}

void TunnelWatch::add(std::span<const ToolState* const> tools, const BoneSnapshot& bones,
                      std::vector<Event>& out) {
  for (std::size_t h = 0; h < std::min(tools.size(), holds_.size()); ++h) {
    const ToolState& tool = *tools[h];
    last_tick_ = std::max(last_tick_, tool.tick);
    if (!is_finite(tool.X_WP)) continue;
    if (pins_[h] && !drills_) follow_pin(tool, h, bones, out);
    if (tool.tick % stride_ == 0) see_marks(tool, h, bones, out);
  }
  if (drills_) follow_drills(tools, bones, out);
  if (!job_.valid() || job_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return;
  work_ = job_.get();
  asked_.tick = last_tick_;
  tell_measured(asked_, out);
}

// Measured at once where a bone is done; while one measurement goes on, the next one waits.
void TunnelWatch::follow_drills(std::span<const ToolState* const> tools, const BoneSnapshot& bones,
                                std::vector<Event>& out) {
  drills_->add(tools, bones, out);
  if (bones.epoch != epoch_) look_again(bones);
  if (bench_) follow_bench(bones.bench);
  if (job_.valid()) return;
  for (std::size_t k = 0; k < kBones; ++k)
    if (drills_->take_done(k)) take_cuts(k);
  if (fresh_) measure(measured_at(), out);
  if (!job_.valid()) follow_fixing(bones, out);
}

Event TunnelWatch::measured_at() const {
  Event at;
  at.tick = last_tick_;
  for (std::size_t h = 0; h < pins_.size(); ++h)
    if (pins_[h]) at.hand = static_cast<std::uint8_t>(h);
  return at;
}

// The bones came back from a restore point: what was measured may be there no longer.
void TunnelWatch::look_again(const BoneSnapshot& bones) {
  epoch_ = bones.epoch;
  at_hand_ = false;
  for (std::size_t k = 0; k < kBones; ++k)
    if (work_.holes[k]) drills_->look_again(k);
}

// The graft is fixed: the knee is tested with what holds it.
void TunnelWatch::follow_fixing(const BoneSnapshot& bones, std::vector<Event>& out) {
  const GraftPlacingState& placing = bones.placing;
  if (!placing.on || !placing.screw.done) {
    fixed_ = false;
    if (work_.choices) work_.choices.reset();
    return;
  }
  if (std::exchange(fixed_, true)) return;
  work_.choices = choices_of(placing);
  if (const auto& made = bench_ ? made_ : sources_.graft)
    work_.choices->pretension_s = made->creep_s;
  fresh_ = true;
  measure(measured_at(), out);
}

std::optional<KneeGraft> TunnelWatch::fixed() const {
  const auto& graft = work_.report.graft;
  const bool tested = fixed_ && !fresh_ && !job_.valid() && work_.choices && graft;
  return tested ? std::optional(graft->graft) : std::nullopt;
}

// A graft is ready when its button hangs on it. What the board does to it is counted until then.
void TunnelWatch::follow_bench(const GraftBenchState& bench) {
  const auto graft = bench.loop_m > 0 ? graft_on(*bench_, bench) : std::nullopt;
  const bool same =
      graft.has_value() == made_.has_value() &&
      (!graft || (graft->diameter_m == made_->diameter_m && graft->length_m == made_->length_m &&
                  bench.loop_m == made_->loop_m));
  if (made_) made_->creep_s = bench.creep_s;
  if (same) return;
  made_.reset();
  if (graft) made_ = {graft->length_m, graft->diameter_m, bench.loop_m, bench.creep_s};
  plan_graft();
}

// What was drilled is a graft's way once both bones are through.
void TunnelWatch::plan_graft() {
  placing_.reset();
  room_.reset();
  refused_.reset();
  at_hand_ = drills_ && measured_epoch_ == epoch_;
  const auto &f = work_.holes[0], &t = work_.holes[1];
  if (!f || !t || !(f->channel_m > 0) || !t->through || !case_) return;
  const auto hole = [](const DrilledHole& found) {
    return PlacingHole{found.line.from_W, found.line.to_W, found.line.diameter_m};
  };
  const auto& made = bench_ ? made_ : sources_.graft;
  PlacingGraft graft;
  if (made) graft = {made->diameter_m, made->length_m, made->loop_m};
  placing_ = plan_placing(*case_, hole(*f), hole(*t), graft);
  if (!placing_) return;
  const auto [narrow_m, wide_m] = std::minmax(f->line.diameter_m, t->line.diameter_m);
  room_ = {placing_->femur.length_m(), placing_->socket_m, narrow_m, wide_m};
  if (bench_ && !made_) placing_.reset();  // it is still being made
  constexpr double kTight_m = 0.0005;
  if (!placing_ || placing_->graft_m <= narrow_m + kTight_m) return;
  placing_.reset();
  refused_ = Error{"the graft is thicker than the tunnels", "graft",
                   "Drill wider tunnels, or make a thinner graft"};
}

void TunnelWatch::take_cuts(std::size_t k) {
  if (!sources_.carved) return;
  work_.cuts[k] = sources_.carved(bones_[k]);
  const bool whole_again = !work_.cuts[k] && work_.holes[k].has_value();
  if (whole_again) {
    work_.holes[k].reset();
    work_.lines[k] = {};
  }
  fresh_ = fresh_ || whole_again || work_.cuts[k].has_value();
}

// A mark on a meniscus is felt there, any other one on bone.
void TunnelWatch::see_marks(const ToolState& tool, std::size_t hand, const BoneSnapshot& bones,
                            std::vector<Event>& out) const {
  if (!is_finite(tool.force_W) || hand >= kMaxHands) return;
  const SoftTouch& soft = bones.softs.touches[hand];
  for (const FeltMark& mark : felt_) {
    const bool touched = mark.soft == kNoSubject ? tool.contact_count > 0
                                                 : soft.force_n > 0 && soft.soft == mark.soft;
    if (!touched) continue;
    const double away = (place_now(*case_, mark.landmark, bones) - tool.X_WP.p).norm();
    if (away < kFarFromMark_m)
      out.push_back(told(tool, hand, kMarkFelt, SubjectKind::kLandmark, mark.landmark,
                         {1e3 * away, tool.force_W.norm(), 0}));
  }
}

// Which of the bones that are asked for a tool stands on hard enough.
std::size_t TunnelWatch::pressed(const ToolState& tool, const BoneSnapshot& bones) const {
  for (std::uint32_t i = 0; i < tool.contact_count; ++i)
    for (std::size_t k = 0; k < kBones; ++k)
      if (wanted_[k].asked && tool.contacts[i].bone.index == bones_[k] && bones_[k] < bones.count &&
          is_finite(tool.force_W) && tool.force_W.norm() >= wanted_[k].force_n)
        return k;
  return kBones;
}

void TunnelWatch::follow_pin(const ToolState& tool, std::size_t hand, const BoneSnapshot& bones,
                             std::vector<Event>& out) {
  Hold& hold = holds_[hand];
  const std::size_t k = pressed(tool, bones);
  if (k == kBones) {
    hold = {};
    return;
  }
  const Pose X_BT = bones.bones[bones_[k]].X_WB.inverse() * tool.X_WP;
  if (hold.bone != k || (X_BT.p - hold.tip_B).norm() > kStill_m)
    hold = {k, tool.tick, X_BT.p, false};
  const double held_s = static_cast<double>(tool.tick - hold.since) * tick_s_;
  if (hold.told || held_s < wanted_[k].for_s) return;
  hold.told = true;
  locate(tool, hand, X_BT, out);
}

void TunnelWatch::locate(const ToolState& tool, std::size_t hand, const Pose& X_BT,
                         std::vector<Event>& out) {
  const std::size_t k = holds_[hand].bone;
  for (std::uint32_t mark = 0; mark < case_->landmarks.size(); ++mark)
    out.push_back(told(tool, hand, kTunnelBegun, SubjectKind::kLandmark, mark, {}));
  const Vec3 in_B = X_BT.rotate(-Vec3::UnitZ());
  const double length_m =
      wanted_[k].depth_m > 0
          ? wanted_[k].depth_m
          : way_through_m(MeshDistance(case_->bones[bones_[k]].mesh), X_BT.p, in_B);
  work_.is_new = {true, true};
  work_.lines[k] = {true, X_BT.p - kBeyond_m * in_B, X_BT.p + length_m * in_B, wanted_[k].reamed_m};
  fresh_ = true;
  out.push_back(
      told(tool, hand, kTunnelLocated, SubjectKind::kBone, bones_[k], {1e3 * length_m, 0, 0}));
  if (all_located())
    measure(told(tool, hand, kTunnelMeasured, SubjectKind::kNothing, kNoSubject, {}), out);
}

bool TunnelWatch::all_located() const {
  return std::all_of(work_.lines.begin(), work_.lines.end(),
                     [](const Line& line) { return line.known; });
}

void TunnelWatch::finish(std::vector<Event>& out) {
  Event at;
  at.tick = last_tick_;
  at.kind = kTunnelMeasured;
  for (std::size_t h = 0; h < pins_.size(); ++h)
    if (pins_[h]) at.hand = static_cast<std::uint8_t>(h);
  if (job_.valid()) {
    work_ = job_.get();
    tell_measured(at, out);
  }
  for (std::size_t k = 0; drills_ && k < kBones; ++k)
    if (drills_->take_drilled(k)) take_cuts(k);
  sources_.in_background = false;
  over_ = true;
  if (fresh_ || std::find(untold_.begin(), untold_.end(), true) != untold_.end()) measure(at, out);
}

// Lines of what was drilled since: the holes in what is left.
void TunnelWatch::find_lines(Work& work) {
  for (std::size_t k = 0; k < kBones; ++k) {
    if (!work.cuts[k]) continue;
    const auto known = work.holes[k];
    const MeshDistance before(work.felt->bones[work.bones[k]].mesh);
    for (const BoneDef& bone : work.whole->bones)
      if (bone.name == work.names[k])
        work.holes[k] = find_drilled(*work.cuts[k], MeshDistance(bone.mesh), before);
    // One that came back with a restore point was told before.
    work.is_new[k] = !is_same(known, work.holes[k]);
    work.cuts[k].reset();
    if (const auto& hole = work.holes[k])
      work.lines[k] = {true, hole->line.from_W, hole->line.to_W, hole->line.diameter_m,
                       hole->line.open};
    else
      work.lines[k] = {};
  }
}

Result<AclReport> TunnelWatch::report_of(Work& work) {
  if (!work.whole) {
    auto grown = open_case_def(work.spec);
    if (!grown) return tl::unexpected(grown.error());
    work.whole = std::make_shared<const CaseDef>(std::move(*grown));
  }
  if (work.had_tunnels && !work.old) {
    work.old.emplace();
    for (std::size_t k = 0; k < kBones; ++k)
      for (const DrilledLine& line : holes_of(work.felt->bones[work.bones[k]].mesh))
        (*work.old)[k].push_back(in_world(work, k, line));
  }
  find_lines(work);
  AclDrilling drilling;
  std::array<double, kBones> channels_m{};
  for (std::size_t k = 0; k < kBones; ++k) {
    const Line& line = work.lines[k];
    if (!line.known) continue;
    (k == 0 ? drilling.femur : drilling.tibia) =
        in_world(work, k, {line.from_B, line.to_B, line.wide_m, line.open});
    if (work.holes[k]) channels_m[k] = work.holes[k]->channel_m;
  }
  if (work.old)
    return report_beside_old(*work.whole, *work.old, drilling, channels_m, work.choices);
  return make_acl_report(*work.whole, drilling, work.choices);
}

DrilledLine TunnelWatch::in_world(const Work& work, std::size_t k, const DrilledLine& line_B) {
  for (const BoneDef& bone : work.whole->bones)
    if (bone.name == work.names[k])
      return {bone.X_WB * line_B.from_W, bone.X_WB * line_B.to_W, line_B.diameter_m, line_B.open};
  return line_B;
}

TunnelWatch::Work TunnelWatch::measured(Work work) {
  auto made = report_of(work);
  work.problem = made ? std::nullopt : std::optional<Error>(made.error());
  work.report = made ? std::move(*made) : AclReport();
  return work;
}

// `at`: who measures, and when.
void TunnelWatch::measure(const Event& at, std::vector<Event>& out) {
  asked_ = at;
  if (!std::exchange(fresh_, false)) return tell_measured(at, out);
  measured_epoch_ = epoch_;
  if (sources_.in_background) {
    job_ = std::async(std::launch::async, [work = work_]() mutable {
      take_late_turns();
      return measured(std::move(work));
    });
    for (auto& cuts : work_.cuts) cuts.reset();
    return;
  }
  work_ = measured(std::move(work_));
  tell_measured(at, out);
}

void TunnelWatch::tell_drilled(const Event& at, std::vector<Event>& out) const {
  for (std::size_t k = 0; drills_ && k < kBones; ++k) {
    const auto& hole = work_.holes[k];
    if (!hole || !work_.is_new[k]) continue;
    out.push_back(at);
    out.back().kind = is_socket_[k] ? kSocketDrilled : kTunnelDrilled;
    out.back().subject_kind = SubjectKind::kBone;
    out.back().subject = bones_[k];
    out.back().values = {1e3 * hole->length_m, 1e3 * hole->line.diameter_m,
                         is_socket_[k] ? 1e3 * hole->channel_m : (hole->through ? 1.0 : 0.0)};
  }
}

void TunnelWatch::tell_measured(const Event& at, std::vector<Event>& out) {
  const auto tell = [&](EventKind kind, std::array<double, 3> values) {
    out.push_back(at);
    out.back().kind = kind;
    out.back().values = values;
  };
  const auto tell_all = [&](const auto& found) {
    for (const auto& [which, value] : values_of(found))
      tell(kTunnelMeasured, {static_cast<double>(which), value, 0});
  };
  plan_graft();
  // What is wrong with a tunnel counts before the tunnel itself, which may be the last goal.
  std::vector<Event> drilled;
  tell_drilled(at, drilled);
  const AclTunnels& tunnels = work_.report.tunnels;
  std::array<bool, kBones> is_new = std::exchange(work_.is_new, {});
  for (std::size_t k = 0; k < kBones; ++k) {
    is_new[k] = is_new[k] || untold_[k];
    // A tunnel that has only been begun is judged once it is through, or at the end.
    untold_[k] =
        is_new[k] && !over_ && work_.holes[k] && !is_socket_[k] && !work_.holes[k]->through;
    is_new[k] = is_new[k] && !untold_[k];
  }
  const auto tell_gap = [&](TunnelValue which, const std::optional<double>& gap_m) {
    if (gap_m) tell(kTunnelMeasured, {static_cast<double>(which), 1e3 * *gap_m, 0});
  };
  if (tunnels.femur && is_new[0]) tell_all(*tunnels.femur);
  if (tunnels.tibia && is_new[1]) tell_all(*tunnels.tibia);
  if (is_new[0]) tell_gap(TunnelValue::kFemoralToOld, work_.report.femur_to_old_m);
  if (is_new[1]) tell_gap(TunnelValue::kTibialToOld, work_.report.tibia_to_old_m);
  const auto& graft = work_.report.graft;
  if (graft && (is_new[0] || is_new[1])) tell_all(*graft);
  out.insert(out.end(), drilled.begin(), drilled.end());
  if (graft) tell(kGraftTested, {1e3 * (graft->lachman.anterior_m - graft->lachman_whole_m), 0, 0});
}

}  // namespace osteon
