#include "commands/teaching/live_play.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <deque>
#include <optional>
#include <utility>

#include "commands/teaching/led_hand.h"
#include "loops/realtime.h"
#include "loops/runtime.h"
#include "loops/stop_signal.h"
#include "osteon/base/clock.h"
#include "runs/hands/live_run.h"
#include "runs/pictures/carved_picture.h"

namespace osteon {
namespace {

constexpr std::int64_t kMostTicksAtOnce = 4;  // what is late beyond that is left out
constexpr double kArmed_s = 1.0;  // the force's ramp twice: the hands wait at their places
constexpr double kGrace_s = 30;   // in which what is measured beside the run may yet come

// What comes back when the user says so; everything else ends the run.
bool can_resume(ForceOff cause) {
  return cause == ForceOff::kWatchdog || cause == ForceOff::kVelocity;
}

// The hands of the run, spread over the devices: the last one has all that are left.
struct Spread {
  std::vector<LedHands> devices;
  std::vector<std::size_t> device_of, place_of;  ///< by hand
};

Result<Spread> spread_hands(std::span<const HandWill> wills, std::vector<LedDevice> devices,
                            const std::function<void()>& step_devices) {
  Spread spread;
  for (std::size_t d = 0, h = 0; d < devices.size(); ++d) {
    const std::size_t last = d + 1 == devices.size() ? wills.size() : h + 1;
    std::vector<Pose> starts;
    for (; h < last; ++h) {
      spread.device_of.push_back(d);
      spread.place_of.push_back(starts.size());
      starts.push_back(wills[h].start());
    }
    auto led = LedHands::make(std::move(devices[d].device), devices[d].label, starts);
    if (!led) return tl::unexpected(led.error());
    if (auto there = led->go_to_start(step_devices); !there) return tl::unexpected(there.error());
    spread.devices.push_back(std::move(*led));
  }
  return spread;
}

Result<void> check_devices(const HeadlessRun& run, std::span<const LedDevice> devices) {
  const std::size_t hands = run.hands.size();
  const std::size_t least = std::min<std::size_t>(hands, 2);
  if (devices.size() < least)
    return fail(devices.empty() ? "a live run needs devices"
                                : "the exercise needs both hands at once, and one device is not "
                                  "enough for them",
                "--device", least == 2 ? "Give two devices" : "Give a device");
  if (devices.size() > hands)
    return fail("the exercise has " + std::to_string(hands) + (hands == 1 ? " hand" : " hands") +
                    ", and there are more devices",
                "--device", "Give fewer");
  return {};
}

// One run while it goes on.
class LivePlayer {
 public:
  LivePlayer(const HeadlessRun& run, RunParts parts, std::vector<HandWill> wills, Spread spread,
             std::unique_ptr<RecordFeed> feed)
      : run_(run),
        tick_s_(parts.settings.haptic.tick_s),
        physics_s_(parts.settings.physics.step_s),
        wills_(std::move(wills)),
        spread_(std::move(spread)),
        carved_(parts.carving),
        orders_(wills_.size()),
        judged_(wills_.size()),
        last_(wills_.size()),
        tripped_s_(wills_.size(), 0) {
    RunPlan plan;
    plan.the_case = run.the_case;
    plan.settings = parts.settings;
    plan.carving = parts.carving;
    plan.softs = parts.softs;
    std::vector<HandPlan> hands;
    for (std::size_t h = 0; h < wills_.size(); ++h) {
      LedHands& led = device_of(h);
      HandPlan hand;
      hand.mapping = led.mapping();
      hand.mapping_settings.axes = MappingAxes::kPatient;
      hand.device = led.take(spread_.place_of[h]);
      hands.push_back(std::move(hand));
      played_.hands.push_back({parts.settings.hands[h].name, led.label(), {}, 0});
    }
    runtime_ = std::make_unique<Runtime>(plan, std::move(hands), std::move(feed), parts.tray);
    runtime_->judge_ticks();
  }

  Result<LivePlayed> play(const std::function<void()>& step_devices) {
    if (run_.on_begin) run_.on_begin(sight());
    if (step_devices) {
      while (!is_over()) step_all(step_devices);
      runtime_->drain_records_once();
      return finish();
    }
    // This thread stands for a person, who waits for no other program.
    (void)request_early_turns();
    runtime_->start();
    const std::int64_t started = steady_now_ns();
    std::int64_t acted = started;  // so far
    const auto period = static_cast<std::int64_t>(std::llround(tick_s_ * 1e9));
    while (!is_over()) {
      sleep_until_ns(acted + period);
      look();
      const std::int64_t due = (steady_now_ns() - acted) / period;
      for (std::int64_t i = 0; i < std::min(due, kMostTicksAtOnce); ++i) tick();
      acted += due * period;
    }
    played_.wall_s = static_cast<double>(steady_now_ns() - started) * 1e-9;
    return finish();
  }

 private:
  // What the loops do side by side, one after the other.
  void step_all(const std::function<void()>& step_devices) {
    step_devices();
    for (std::size_t h = 0; h < wills_.size(); ++h) runtime_->step_haptic_once(h);
    if ((physics_due_s_ += tick_s_) > physics_s_ - 0.5 * tick_s_) {
      physics_due_s_ = 0;
      runtime_->step_physics_once();
    }
    runtime_->drain_records_once();
    look();
    tick();
  }

  LedHands& device_of(std::size_t hand) { return spread_.devices[spread_.device_of[hand]]; }
  double now_s() { return static_cast<double>(last_[0].tick) * tick_s_; }

  RunSight sight() {
    RunSight sight;
    sight.bones = [this] { return bones_; };
    sight.carved = [this](std::uint32_t bone) { return carved_.cut_bone(bone); };
    return sight;
  }

  bool is_over() {
    if (stop_requested()) played_.broken_off = "it was stopped";
    if (!played_.broken_off.empty() || (run_.over && run_.over())) return true;
    if (!runtime_->recording()) {
      played_.broken_off = runtime_->recording_failure();
      return true;
    }
    const bool done =
        std::all_of(wills_.begin(), wills_.end(), [](const HandWill& w) { return w.done(); });
    done_s_ = done ? done_s_ + tick_s_ : 0;
    return done_s_ > (run_.over ? kGrace_s : 0) || (run_.longest_s > 0 && now_s() > run_.longest_s);
  }

  // What the loops have told since.
  void look() {
    bones_ = &runtime_->snapshot(0).bones;
    CutsPatch patch;
    if (CutsFeed* feed = runtime_->cuts_feed())
      while (feed->take(patch)) carved_.take(patch);
    for (std::size_t h = 0; h < wills_.size(); ++h) {
      ToolState tool;
      while (runtime_->pop_judged(tool, h)) judged_[h].push_back(tool);
      Event event;
      while (runtime_->pop_event(event, h)) {
      }
      Telemetry point;
      while (runtime_->pop_telemetry(point, h)) {
      }
      see_device(h);
    }
    follow();
  }

  // Where one hand's ticks have a gap the others wait for it.
  void follow() {
    const auto all_have = [&] {
      return std::all_of(judged_.begin(), judged_.end(), [](const auto& q) { return !q.empty(); });
    };
    std::vector<const ToolState*> tools;
    for (const ToolState& tool : last_) tools.push_back(&tool);
    while (all_have()) {
      std::uint64_t tick = 0;
      for (const auto& queue : judged_) tick = std::max(tick, queue.front().tick);
      for (std::size_t h = 0; h < judged_.size(); ++h)
        while (!judged_[h].empty() && judged_[h].front().tick <= tick) {
          last_[h] = judged_[h].front();
          judged_[h].pop_front();
        }
      if (run_.on_hands) run_.on_hands(tools, *bones_);
    }
  }

  // A trip of the watchdog or of a movement that was too fast: whoever plays waits, and switches
  // the force on again, as a user does. Anything else ends the run.
  void see_device(std::size_t h) {
    const DeviceStatus& status = runtime_->device_status(h);
    LivePlayed::Hand& hand = played_.hands[h];
    hand.peak_force_n = std::max(hand.peak_force_n, status.force_at_hand_V.norm());
    const bool was_waiting = tripped_s_[h] > 0;
    tripped_s_[h] = std::max(0.0, tripped_s_[h] - tick_s_);
    if (status.cause == ForceOff::kNone || status.cause == ForceOff::kSoftware) return;
    if (!can_resume(status.cause)) {
      played_.broken_off = hand.device + ": " + describe(status.cause);
      return;
    }
    if (tripped_s_[h] > 0) return;
    if (!was_waiting) ++played_.resumed;
    runtime_->set_force_enabled(true, h);
    tripped_s_[h] = kArmed_s;
  }

  bool must_wait() const {
    if (armed_s_ < kArmed_s) return true;
    return std::any_of(tripped_s_.begin(), tripped_s_.end(), [](double s) { return s > 0; }) ||
           std::any_of(spread_.devices.begin(), spread_.devices.end(),
                       [](const LedHands& led) { return led.is_changing(); });
  }

  void tick() {
    say();
    if (must_wait()) {
      armed_s_ += tick_s_;
      played_.waited_s += tick_s_;
      return;
    }
    for (std::size_t h = 0; h < wills_.size(); ++h) {
      wills_[h].feel(last_[h].force_W);
      wills_[h].step(tick_s_);
      device_of(h).lead(spread_.place_of[h], wills_[h], tick_s_);
      if (wills_[h].said().kind != CommandKind::kNone) orders_[h].push_back(wills_[h].said());
    }
  }

  // One thing a hand and a tick, as the loops take it; for physics one every other tick.
  void say() {
    for (std::size_t h = 0; h < orders_.size(); ++h)
      if (!orders_[h].empty() && runtime_->send(orders_[h].front(), h)) orders_[h].pop_front();
    steps_next_ = !steps_next_;
    if (!steps_next_) return;
    if (!beside_ && run_.beside) beside_ = run_.beside();
    if (beside_ && runtime_->send(*beside_)) beside_.reset();
  }

  Result<LivePlayed> finish() {
    for (std::size_t h = 0; h < wills_.size(); ++h) {
      played_.hands[h].loop = runtime_->haptic_stats(h);
      played_.turns += spread_.place_of[h] == 0 ? device_of(h).turns() : 0;
    }
    played_.physics = runtime_->physics_stats();
    played_.duration_s = now_s();
    const Result<void> stopped = runtime_->stop();
    runtime_.reset();
    if (!stopped) return tl::unexpected(stopped.error());
    return std::move(played_);
  }

  const HeadlessRun& run_;
  double tick_s_, physics_s_;
  std::vector<HandWill> wills_;
  Spread spread_;
  CarvedPicture carved_;
  std::unique_ptr<Runtime> runtime_;
  std::vector<std::deque<Command>> orders_;
  std::optional<Command> beside_;
  std::vector<std::deque<ToolState>> judged_;
  std::vector<ToolState> last_;
  std::vector<double> tripped_s_;
  const BoneSnapshot* bones_ = nullptr;
  double armed_s_ = 0, done_s_ = 0, physics_due_s_ = 0;
  bool steps_next_ = false;
  LivePlayed played_;
};

std::string loop_text(const LoopStats& loop, const char* what) {
  char line[200];
  std::snprintf(line, sizeof line,
                "%llu %s at %.0f Hz: p50 %.0f us, p99 %.0f us, p99.9 %.0f us, longest %.0f us, "
                "missed %llu",
                static_cast<unsigned long long>(loop.ticks), what, loop.rate_hz, loop.p50_us,
                loop.p99_us, loop.p999_us, loop.max_us,
                static_cast<unsigned long long>(loop.missed));
  return line;
}

}  // namespace

std::string to_text(const LivePlayed& played) {
  std::string text;
  char line[200];
  for (const LivePlayed::Hand& hand : played.hands) {
    std::snprintf(line, sizeof line, "; peak %.2f N\n", hand.peak_force_n);
    text += hand.name + " (" + hand.device + "): " + loop_text(hand.loop, "ticks") + line;
  }
  text += "physics: " + loop_text(played.physics, "steps") + "\n";
  std::snprintf(line, sizeof line,
                "%.1f s of the session in %.1f s; waited %.1f s; force resumed %llu times; devices "
                "changed hands %llu times\n",
                played.duration_s, played.wall_s, played.waited_s,
                static_cast<unsigned long long>(played.resumed),
                static_cast<unsigned long long>(played.turns));
  return text + line;
}

Result<LivePlayed> play_live(const HeadlessRun& run, std::vector<LedDevice> devices,
                             const std::function<void()>& step_devices) {
  if (auto ok = check_devices(run, devices); !ok) return tl::unexpected(ok.error());
  const std::vector<std::string> tray = tray_of_hands(run.hands);
  std::vector<HandWill> wills;
  for (const HeadlessHand& hand : run.hands) wills.emplace_back(hand, tray);
  auto spread = spread_hands(wills, std::move(devices), step_devices);
  if (!spread) return tl::unexpected(spread.error());
  SessionSettings settings = run.settings;
  for (const LedHands& led : spread->devices)
    keep_to_weakest(settings_for(led.info(), {}, led.mapping().scale).haptic, settings.haptic);
  auto parts = parts_of_run(run, run.hands, settings);
  if (!parts) return tl::unexpected(parts.error());
  auto writer =
      RecordingWriter::create(*run.record_to, header_of_run(run, parts->settings, parts->tray));
  if (!writer) return tl::unexpected(writer.error());
  auto feed = std::make_unique<RecordFeed>(std::move(*writer), 8.0, run.hands.size());
  LivePlayer player(run, std::move(*parts), std::move(wills), std::move(*spread), std::move(feed));
  return player.play(step_devices);
}

}  // namespace osteon
