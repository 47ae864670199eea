// What a hand's loop does in a tick, from its device's reading to its force, with a recording and
// the other hand: whatever happens it takes nothing from the heap, waits at no lock and logs
// nothing.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <map>

#include "app/loops/fake_device.h"
#include "count_allocations.h"
#include "count_locks.h"
#include "loops/runtime.h"
#include "osteon/base/random.h"
#include "osteon/record/recording.h"

namespace osteon {
namespace {

constexpr std::uint64_t kTicks = 4000;
constexpr std::uint64_t kFault = 1500, kHealed = 1600;

// A hand that presses on a block and slides, over and over.
DeviceSample press(std::uint64_t tick, double x_m) {
  DeviceSample sample = test::press_and_slide(tick % 900);
  sample.time_ns = static_cast<std::int64_t>(tick) * 1'000'000;
  sample.X_VD.p.x() += x_m;
  if (tick % 900 > 800) sample.X_VD.p.z() += 1e-4 * static_cast<double>(tick % 900 - 800);
  return sample;
}

/// Keeps only the newest force.
class QuietDevice : public HapticDevice {
 public:
  explicit QuietDevice(test::FakeDevice::Script script) : script_(std::move(script)) {}
  const DeviceInfo& info() const override { return info_; }
  DeviceSample read() override { return script_(tick_++); }
  void write_force(const Vec3& force_V) override { force_V_ = force_V; }
  void close() override {}

 private:
  test::FakeDevice::Script script_;
  DeviceInfo info_ = test::fake_device_info("quiet");
  Vec3 force_V_ = Vec3::Zero();
  std::uint64_t tick_ = 0;
};

struct TwoQuietHands {
  TwoQuietHands()
      : file(std::filesystem::path(::testing::TempDir()) /
             ("haptic_thread_" + std::to_string(::getpid()) + ".osr")) {
    std::filesystem::remove(file);
    plan.the_case = test::blocks_case();
    plan.settings.physics.hold_bones = false;
    plan.settings.hands = {{"left", 0}, {"right", 0}};
    plan.settings.tray = {"thin", "thick"};
    tray = {std::make_shared<const Tool>(make_wrist_probe(0.00075)),
            std::make_shared<const Tool>(make_wrist_probe(0.0015))};
  }
  ~TwoQuietHands() { std::filesystem::remove(file); }

  std::unique_ptr<Runtime> start() {
    auto writer = RecordingWriter::create(
        file, recording_header(*plan.the_case, plan.settings, "test", "test", tray));
    EXPECT_TRUE(writer);
    std::vector<HandPlan> hands(2);
    hands[0].device = std::make_unique<QuietDevice>([](std::uint64_t n) { return press(n, 0); });
    hands[1].device = std::make_unique<QuietDevice>([](std::uint64_t n) {
      DeviceSample sample = press(n, 0.001);
      sample.connected = n < kFault || n >= kHealed;
      if (n % 1100 == 1050) sample.X_VD.p.y() = std::nan("");
      return sample;
    });
    return std::make_unique<Runtime>(
        plan, std::move(hands), std::make_unique<RecordFeed>(std::move(*writer), 8.0, 2), tray);
  }

  std::filesystem::path file;
  RunPlan plan;
  Tray tray;
};

// What the window's thread sends at random: restore points, going back, instruments, power, force.
void wish_at_random(Runtime& runtime, Random& random) {
  const double which = random.uniform();
  const double what = std::floor(random.uniform(0, 4));
  const auto hand = static_cast<std::size_t>(what) % 2;
  if (which < 0.010)
    runtime.send({CommandKind::kMark, what});
  else if (which < 0.020)
    runtime.send({CommandKind::kRestore, what});
  else if (which < 0.030)
    runtime.send({CommandKind::kTake, std::floor(what / 2)}, hand);
  else if (which < 0.040)
    runtime.send({CommandKind::kPower, 0.25 * what}, hand);
  else if (which < 0.045)
    runtime.set_force_enabled(what > 1, hand);
}

TEST(HapticThread, AllocatesLocksAndWritesNothingWhateverHappens) {
  TwoQuietHands hands;
  const std::unique_ptr<Runtime> runtime = hands.start();
  Random random(8);
  double most_n = 0;
  for (std::uint64_t n = 0; n < kTicks; ++n) {
    wish_at_random(*runtime, random);
    for (std::size_t h = 0; h < 2; ++h) {
      const std::uint64_t taken = testing::allocations();
      const std::uint64_t locked = testing::locks(), written = testing::writes();
      runtime->step_haptic_once(h);
      ASSERT_EQ(testing::allocations(), taken) << n;
      ASSERT_EQ(testing::locks(), locked) << n;
      ASSERT_EQ(testing::writes(), written) << n;
    }
    if (n % 2 == 1) runtime->step_physics_once();
    if (n % 20 == 0) runtime->drain_records_once();
    most_n = std::max(most_n, runtime->session().tool_state(0).force_W.norm());
  }
  ASSERT_TRUE(runtime->stop());
  EXPECT_GT(most_n, 1);
  // All of it did happen.
  const auto recording = load_recording(hands.file);
  ASSERT_TRUE(recording) << recording.error().message();
  EXPECT_GT(recording->states.size(), 3u);
  std::map<EventKind, int> seen;
  for (const Event& event : recording->events) ++seen[event.kind];
  for (const EventKind kind : {EventKind::kMark, EventKind::kRestored, EventKind::kInstrumentTaken,
                               EventKind::kPowered, EventKind::kFault, EventKind::kContactBegin})
    EXPECT_GT(seen[kind], 1) << find_event_kind(kind)->name;
}

}  // namespace
}  // namespace osteon
