// The joystick's round trip through the real libusb against a device that umockdev plays, at 1 kHz.
// Prints percentiles of
//   read to force: from taking a reading in `read` until the force made from it is handed to
//   libusb; device to device: from the frame in which the device gave its last reading before a
//   force was handed over to the frame in which it took that force; whole frames of 1 ms; period:
//   of the loop itself.
// umockdev answers each ioctl on a thread of its own, at some tens of us: a real bus is quicker.
// The program starts itself again under umockdev's preloaded library.
#include <benchmark/benchmark.h>
#include <sys/prctl.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

#include "emulated/emulated_pid_joystick.h"
#include "emulated/emulated_vector_joystick.h"
#include "emulated/virtual_usb.h"
#include "joystick/joystick_driver.h"
#include "osteon/base/clock.h"
#include "osteon/base/percentiles.h"
#include "umockdev/mock_usb.h"
#include "usb/libusb_bus.h"

namespace osteon {
namespace {

constexpr std::int64_t kPeriod_ns = 1'000'000;

// A joystick on a mocked bus whose frames go by the real clock.
struct Rig {
  explicit Rig(bool pid) : testbed(umockdev_testbed_new()) {
    std::shared_ptr<EmulatedUsbDevice> device;
    if (pid)
      device = std::make_shared<EmulatedPidJoystick>();
    else
      device = std::make_shared<EmulatedVectorJoystick>();
    usb = std::make_unique<testing::MockUsb>(
        testbed, device, pid ? pid_joystick_descriptors() : vector_joystick_descriptors(), 2,
        testing::MockUsb::Clock::kReal);
    usb->plug();
    const auto profiles =
        load_joystick_profiles(std::filesystem::path(OSTEON_SOURCE_DIR) / "assets" / "devices");
    const auto bus = open_libusb_bus();
    if (!bus) return;
    const auto infos = list_joysticks(**bus, profiles);
    if (infos.empty()) return;
    auto opened = open_joystick(**bus, profiles, infos.front());
    if (opened)
      joystick = std::move(*opened);
    else
      std::fprintf(stderr, "%s\n", opened.error().message().c_str());
  }
  ~Rig() {
    joystick.reset();
    usb.reset();
    g_object_unref(testbed);
  }

  UMockdevTestbed* testbed;
  std::unique_ptr<testing::MockUsb> usb;
  std::unique_ptr<HapticDevice> joystick;
};

void sleep_until(std::int64_t time_ns) {
  const timespec until{time_ns / 1'000'000'000, time_ns % 1'000'000'000};
  clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr);
}

struct RoundTrip {
  Percentiles read_to_force;
  Percentiles device_to_device;
  Percentiles period;
};

void measure(Rig& rig, int ticks, RoundTrip& out) {
  std::int64_t due_ns = steady_now_ns();
  std::int64_t last_ns = due_ns;
  std::int64_t last_taken_us = 0;
  for (int n = 0; n < ticks; ++n) {
    const std::int64_t start_ns = steady_now_ns();
    const DeviceSample sample = rig.joystick->read();
    rig.joystick->write_force(Vec3(-200 * sample.X_VD.p.x(), 1, 0));
    out.read_to_force.add_ns(steady_now_ns() - start_ns);
    if (n > 0) out.period.add_ns(start_ns - last_ns);
    last_ns = start_ns;
    const testing::MockUsb::Answer answer = rig.usb->locked([&] { return rig.usb->last_answer(); });
    if (answer.taken_us > last_taken_us && last_taken_us > 0)
      out.device_to_device.add_ns(1000 * (answer.taken_us - answer.given_us));
    last_taken_us = answer.taken_us;
    // Missed ticks are skipped.
    due_ns = std::max(due_ns + kPeriod_ns, steady_now_ns());
    sleep_until(due_ns);
  }
}

void count(benchmark::State& state, const char* name, const Percentiles& p) {
  state.counters[std::string(name) + "_p50_us"] = 1e-3 * p.quantile_ns(0.50);
  state.counters[std::string(name) + "_p99_us"] = 1e-3 * p.quantile_ns(0.99);
}

void round_trip(benchmark::State& state, bool pid) {
  Rig rig(pid);
  if (!rig.joystick) return state.SkipWithError("no mocked joystick");
  prctl(PR_SET_TIMERSLACK, 1);
  RoundTrip result;
  for (auto _ : state) measure(rig, 1000, result);
  count(state, "read_to_force", result.read_to_force);
  count(state, "device_to_device", result.device_to_device);
  count(state, "period", result.period);
}

void usb_vector(benchmark::State& state) { round_trip(state, false); }
void usb_pid(benchmark::State& state) { round_trip(state, true); }
BENCHMARK(usb_vector)->Iterations(5)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(usb_pid)->Iterations(5)->Unit(benchmark::kMillisecond)->UseRealTime();

// What the driver itself takes for a reading and a force, on the emulated bus, whose own time does
// not count.
void driver_alone(benchmark::State& state, const char* profile_file) {
  const auto profile = load_joystick_profile(std::filesystem::path(OSTEON_SOURCE_DIR) / "assets" /
                                             "devices" / profile_file);
  if (!profile) return state.SkipWithError("no profile");
  auto device = VirtualUsbJoystick::open(*profile);
  if (!device) return state.SkipWithError("no emulated joystick");
  Percentiles times;
  for (auto _ : state) {
    (*device)->bus().advance(kPeriod_ns);
    const std::int64_t start_ns = steady_now_ns();
    const DeviceSample sample = (*device)->read_newest();
    (*device)->write_force(Vec3(-200 * sample.X_VD.p.x(), 1, 0));
    const std::int64_t taken_ns = steady_now_ns() - start_ns;
    times.add_ns(taken_ns);
    state.SetIterationTime(1e-9 * static_cast<double>(taken_ns));
  }
  count(state, "read_to_force", times);
}
BENCHMARK_CAPTURE(driver_alone, vector, "joystick_vector.toml")->UseManualTime();
BENCHMARK_CAPTURE(driver_alone, pid, "joystick_pid.toml")->UseManualTime();

constexpr const char* kPreload = "libumockdev-preload.so.0";

bool is_preloaded() {
  const char* preloaded = std::getenv("LD_PRELOAD");
  return preloaded && std::strstr(preloaded, "umockdev");
}

}  // namespace
}  // namespace osteon

int main(int argc, char** argv) {
  if (!osteon::is_preloaded()) {
    setenv("LD_PRELOAD", osteon::kPreload, 1);
    execv("/proc/self/exe", argv);
    std::perror("cannot start again under umockdev");
    return 1;
  }
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
