#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "osteon/base/result.h"

namespace osteon {

/// How a transfer ended.
enum class UsbError : std::uint8_t {
  kNone,
  kStall,     ///< the endpoint answered STALL
  kTimeout,   ///< no answer in time
  kGone,      ///< unplugged
  kOverflow,  ///< more bytes than there was room for
  kShort,     ///< fewer bytes taken than were sent
  kOther      ///< refused by the system
};
const char* describe(UsbError error);

/// A device on the bus.
struct UsbEntry {
  std::uint16_t vendor = 0;
  std::uint16_t product = 0;
  std::string serial;          ///< empty: it has none, or it cannot be opened to ask
  std::string name;            ///< product string; empty as above
  std::string port;            ///< bus and ports: "1-2.3"; never empty
  std::string access_problem;  ///< why it cannot be opened; empty: it can
};

/// What a driver uses of a device: one interface with an IN and an OUT endpoint, interrupt or bulk
/// as the device's own descriptors say.
struct UsbChannel {
  std::uint8_t interface_number = 0;
  std::uint8_t in_endpoint = 0x81;
  std::uint8_t out_endpoint = 0x02;
  /// OUT packets are HID output reports, each with its id first: where the interface has no such
  /// OUT endpoint they go by SET_REPORT on the control endpoint (HID 1.11, 4.4 and 7.2.2).
  bool reports_by_control = false;
  std::size_t in_bytes = 64;       ///< largest packet; at most UsbLink::kPacketBytes
  double replace_after_s = 0.003;  ///< a pending OUT transfer this old gives way to a newer value
};

/// The eight bytes of a control transfer's set-up. Bit 7 of `request_type`: device to host.
struct UsbSetup {
  std::uint8_t request_type = 0;
  std::uint8_t request = 0;
  std::uint16_t value = 0;
  std::uint16_t index = 0;
  std::uint16_t length = 0;
  bool is_in() const { return (request_type & 0x80) != 0; }
};

/// SET_REPORT of an output report of `size` bytes whose id comes first.
UsbSetup set_output_report(std::uint8_t interface_number, std::uint8_t id, std::size_t size);

struct UsbControlResult {
  bool running = false;
  UsbError error = UsbError::kNone;
  std::span<const std::uint8_t> data;  ///< of the last IN transfer; valid until the next one starts
};

/// One packet that came in; valid until the next `poll`.
struct UsbPacket {
  std::span<const std::uint8_t> bytes;
  std::int64_t time_ns = 0;  ///< of its arrival, on the link's clock
};

struct UsbCounters {
  std::uint64_t in = 0;          ///< packets received
  std::uint64_t in_dropped = 0;  ///< overwritten before they were taken
  std::uint64_t out = 0;         ///< packets that the device took
  std::uint64_t replaced = 0;    ///< values that a newer one of their slot replaced
};

/// An open device. Used by one thread at a time. Everything is allocated when it opens: `poll`,
/// `next_in`, `put`, `send` and `start_control` allocate nothing and never wait. Errors of the
/// endpoints latch: after one the endpoint is used no more until `restart`.
class UsbLink {
 public:
  static constexpr std::size_t kPacketBytes = 512;
  static constexpr std::size_t kSlots = 4;
  static constexpr std::size_t kMostInFlight = 3;
  static constexpr std::size_t kControlBytes = 4096;
  static constexpr std::size_t kQueuedPackets = 16;

  virtual ~UsbLink() = default;
  /// The link's clock: monotonic, or that of the emulation.
  virtual std::int64_t now_ns() const = 0;
  /// Takes in what has ended. Two IN transfers stay in flight.
  virtual void poll() = 0;
  /// Next packet, in order of arrival; false when there is none. The oldest are dropped when nobody
  /// takes them.
  virtual bool next_in(UsbPacket& packet) = 0;
  /// Lays `bytes` (up to kPacketBytes) out for the OUT endpoint; they leave with `send` or `wait`.
  /// Last wins: a value of the same slot that has not left yet is replaced, never queued. `level`
  /// is what the value means, in a unit common to the slots (see `send`).
  virtual void put(std::size_t slot, std::span<const std::uint8_t> bytes, double level = 0) = 0;
  /// Starts as much of what waits as the bus has room for: one packet at full speed, kMostInFlight
  /// at high speed. The slot goes first whose level is farthest from what it last sent, and farther
  /// the longer it was passed over; the others wait for the next call, with newer values by then.
  /// False: gone, or latched.
  virtual bool send() = 0;
  /// Both for a single slot.
  bool write(std::size_t slot, std::span<const std::uint8_t> bytes) {
    put(slot, bytes);
    return send();
  }
  /// Nothing waits to be sent and nothing is in flight on the OUT endpoint.
  virtual bool out_idle() const = 0;
  /// Starts a control transfer (`out` for host to device); false while one runs, or when gone.
  virtual bool start_control(const UsbSetup& setup, std::span<const std::uint8_t> out,
                             double timeout_s = 0.1) = 0;
  virtual UsbControlResult control() const = 0;
  /// Starts what waits, then waits until something ends, or so long. Never in a tick: for opening,
  /// closing and set-up.
  virtual void wait(double limit_s) = 0;
  /// Clears halts and latched errors and starts to read again. May wait; never in a tick.
  virtual void restart() = 0;

  virtual bool gone() const = 0;
  virtual UsbError in_error() const = 0;
  virtual UsbError out_error() const = 0;
  virtual UsbCounters counters() const = 0;
};

/// Arrivals and departures since the bus was made.
struct UsbChanges {
  std::uint64_t arrived = 0;
  std::uint64_t left = 0;
};

/// Where devices are found: the system's USB, or an emulated one.
class UsbBus {
 public:
  virtual ~UsbBus() = default;
  /// Devices of that vendor and product (0: any); may wait (it asks them for their strings).
  virtual std::vector<UsbEntry> list(std::uint16_t vendor, std::uint16_t product) = 0;
  /// Opens an entry of `list`; takes it from the kernel's driver while open.
  virtual Result<std::unique_ptr<UsbLink>> open(const UsbEntry& entry,
                                                const UsbChannel& channel) = 0;
  /// Counts of hotplug; never waits.
  virtual UsbChanges changes() = 0;
};

/// Polls and waits until `done` or so long, for opening and closing; true: done.
template <class Done>
bool wait_until(UsbLink& link, double limit_s, Done done) {
  const std::int64_t end_ns = link.now_ns() + static_cast<std::int64_t>(limit_s * 1e9);
  while (!done() && !link.gone() && link.now_ns() < end_ns) {
    link.wait(0.001);
    link.poll();
  }
  return done();
}

/// Runs one control transfer to its end, for opening and closing.
UsbControlResult control_and_wait(UsbLink& link, const UsbSetup& setup,
                                  std::span<const std::uint8_t> out, double timeout_s = 0.1);

}  // namespace osteon
