#include "checkup/computer_findings.h"

#include <epoxy/gl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <string>
#include <thread>

#include "checkup/printed.h"
#include "loops/realtime.h"
#include "loops/tick_pacer.h"
#include "osteon/base/clock.h"
#include "osteon/base/file.h"
#include "osteon/base/percentiles.h"
#include "osteon/device/udev_rules.h"
#include "osteon/render/renderer.h"
#include "osteon/render/software_gl.h"

namespace osteon {
namespace fs = std::filesystem;
namespace {

struct LoopMeasure {
  bool priority = false, memory = false;
  std::uint64_t ticks = 0, missed = 0;
  double seconds = 0;
  Percentiles late;
};

// On a thread of its own: a real-time priority shall not stay with the caller.
LoopMeasure measure_loop(double seconds, const std::function<bool()>& cancelled) {
  LoopMeasure m;
  std::thread([&] {
    // As the haptic loop asks, so that both say the same.
    m.memory = lock_memory();
    m.priority = request_priority();
    TickPacer pacer(1'000'000);
    const std::int64_t start_ns = steady_now_ns();
    pacer.start(start_ns);
    const auto end_ns = start_ns + static_cast<std::int64_t>(seconds * 1e9);
    std::int64_t now_ns = start_ns;
    while (now_ns < end_ns && !(cancelled && cancelled())) {
      const std::int64_t due_ns = pacer.next(now_ns);
      sleep_until_ns(due_ns);
      now_ns = steady_now_ns();
      m.late.add_ns(std::max<std::int64_t>(0, now_ns - due_ns));
      ++m.ticks;
    }
    m.missed = pacer.missed();
    m.seconds = static_cast<double>(now_ns - start_ns) * 1e-9;
  }).join();
  return m;
}

Finding loop_finding(const LoopMeasure& m) {
  Finding f{FindingLevel::kGood, "Loop", {}, {}};
  f.text =
      printed("%.0f ticks a second, late by p50 %.0f us, p99 %.0f us, at most %.1f ms; %llu missed",
              static_cast<double>(m.ticks) / std::max(1e-3, m.seconds),
              m.late.quantile_ns(0.5) * 1e-3, m.late.quantile_ns(0.99) * 1e-3,
              m.late.max_ns() * 1e-6, static_cast<unsigned long long>(m.missed));
  // One tick in a hundred that comes late by half a period is felt as roughness.
  if (m.late.quantile_ns(0.99) > 500e3 || m.missed > m.ticks / 100) {
    f.level = FindingLevel::kNote;
    f.todo = "Close other programs; see the limits below";
  }
  return f;
}

Finding limit_finding(bool priority, bool memory) {
  const RealtimeLimits limits = realtime_limits();
  Finding f{FindingLevel::kGood, "Limits", {}, {}};
  f.text = std::string("rtprio ") + limits.priority + ", memlock " + limits.memory +
           (priority ? ": real-time priority granted" : ": no real-time priority") +
           (memory ? ", memory locked" : ", no locked memory");
  if (priority && memory) return f;
  f.level = FindingLevel::kNote;
  f.todo =
      "As root, write this into /etc/security/limits.d/osteon.conf, then log in again:\n"
      "@plugdev - rtprio 50\n@plugdev - memlock unlimited\n@plugdev - nice -10";
  return f;
}

// Where the rule is: in `folder`, or where a package would put it; empty: nowhere.
fs::path installed_rule(const fs::path& folder) {
  std::error_code ec;
  for (const fs::path& where :
       {folder, fs::path("/usr/lib/udev/rules.d"), fs::path("/lib/udev/rules.d")})
    if (fs::exists(where / kUdevFile, ec)) return where / kUdevFile;
  return {};
}

}  // namespace

Findings realtime_findings(double seconds, const std::function<bool()>& cancelled) {
  const LoopMeasure m = measure_loop(seconds, cancelled);
  return {loop_finding(m), limit_finding(m.priority, m.memory)};
}

Finding gl_finding() {
  const auto context = OffscreenContext::create();
  if (!context)
    return {FindingLevel::kBad, "OpenGL", context.error().message(), context.error().todo};
  const auto string = [](GLenum name) {
    const auto* s = reinterpret_cast<const char*>(glGetString(name));
    return std::string(s ? s : "unknown");
  };
  return gl_finding(string(GL_VERSION), string(GL_RENDERER));
}

Finding gl_finding(const std::string& version, const std::string& renderer) {
  Finding f{FindingLevel::kGood, "OpenGL", version + ", " + renderer, {}};
  if (is_software_gl(renderer)) {
    f.level = FindingLevel::kNote;
    f.todo =
        "The processor draws the pictures; a graphics card would leave more time for the loops";
  }
  return f;
}

Findings usb_findings() {
  std::error_code ec;
  if (!fs::exists("/dev/bus/usb", ec))
    return {{FindingLevel::kNote, "USB", "this computer shows no USB bus (/dev/bus/usb)", ""}};
  if (const fs::path rule = installed_rule(kUdevFolder); !rule.empty())
    return {{FindingLevel::kGood, "USB", "the udev rule is installed: " + rule.string(), ""}};
  if (::geteuid() == 0)
    return {{FindingLevel::kNote, "USB",
             "root may open every device; other users need the udev rule",
             "osteon doctor --install-udev"}};
  return {{FindingLevel::kNote, "USB", "no udev rule: only root may open haptic devices",
           "sudo osteon doctor --install-udev, then plug the device in again"}};
}

Finding install_udev_rule(const fs::path& folder) {
  const auto data = find_data_dir();
  if (!data) return {FindingLevel::kBad, "USB", data.error().message(), data.error().todo};
  const fs::path file = folder / kUdevFile;
  const auto rules = udev_rules(known_usb_devices(*data / "assets" / "devices"));
  if (const auto written = write_file_atomic(file, rules); !written)
    return {FindingLevel::kBad, "USB", written.error().message(), "Run it as root, with sudo"};
  Finding f{FindingLevel::kGood, "USB", "installed " + file.string(), ""};
  const bool live = folder == kUdevFolder;
  if (live && std::system("udevadm control --reload && udevadm trigger --subsystem-match=usb") == 0)
    f.text += "; plug the device in again";
  else
    f.todo = "udevadm control --reload, then plug the device in again";
  return f;
}

UdevRule udev_rule(const fs::path& folder) {
  UdevRule rule;
  if (const auto data = find_data_dir())
    rule.text = udev_rules(known_usb_devices(*data / "assets" / "devices"));
  rule.installed = !installed_rule(folder).empty();
  rule.may_install = ::access(folder.c_str(), W_OK) == 0;
  return rule;
}

}  // namespace osteon
