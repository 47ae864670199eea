#pragma once

#include <memory>

#include "osteon/base/random.h"
#include "usb/usb_transport.h"

namespace osteon {

enum class UsbSpeed : std::uint8_t { kFull, kHigh };

/// A device on the emulated bus, to the byte: what its firmware answers to each transaction, and
/// what it does as time goes on. Whatever moves it (motors, a hand) belongs to it.
class EmulatedUsbDevice {
 public:
  virtual ~EmulatedUsbDevice() = default;
  virtual UsbEntry entry() const = 0;
  virtual UsbSpeed speed() const { return UsbSpeed::kFull; }
  /// Its interface has that OUT endpoint.
  virtual bool has_out_endpoint(std::uint8_t) const { return true; }
  /// A control transfer: `out` came with it, or `in` (with `in_size` bytes) is the answer, never
  /// more than the set-up asks for. False: STALL.
  virtual bool control(const UsbSetup& setup, std::span<const std::uint8_t> out,
                       std::span<std::uint8_t> in, std::size_t& in_size) = 0;
  /// One packet for an OUT endpoint.
  virtual void take_out(std::uint8_t endpoint, std::span<const std::uint8_t> bytes) = 0;
  /// One packet of an IN endpoint: its size; 0: nothing to say now (NAK).
  virtual std::size_t give_in(std::uint8_t endpoint, std::span<std::uint8_t> packet) = 0;
  /// Firmware and mechanics go on to `now_ns`; called in steps of at most a frame.
  virtual void advance(std::int64_t now_ns) = 0;
  /// It was unplugged. A device with power of its own goes on to be advanced.
  virtual void disconnected() {}
};

/// What goes wrong with one device from now on. Counts run down as they happen.
struct UsbFaults {
  std::int64_t silent_until_ns = 0;  ///< answers nothing (NAK), neither way
  std::int64_t in_late_ns = 0;       ///< its packets reach the host so much later
  int garbage_in = 0;                ///< next IN packets hold random bytes
  int short_in = 0;                  ///< next IN packets lose their second half
  int short_out = 0;                 ///< next OUT packets are taken but for their second half
  bool stall_in = false;             ///< STALL on the IN endpoint until `restart`
  bool stall_out = false;
  bool stall_control = false;
};

/// An emulated bus with a virtual clock: time passes in `advance` and while a caller waits.
/// Transactions happen in frames (1 ms; 125 us for devices of high speed), one an endpoint and
/// frame: a control transfer, OUT, then the device itself, then IN. Nothing is allocated once all
/// links are open. Must outlive its links.
class EmulatedUsbBus : public UsbBus {
 public:
  EmulatedUsbBus();
  ~EmulatedUsbBus() override;
  /// Plugs a device in and returns its port.
  std::string attach(std::shared_ptr<EmulatedUsbDevice> device);
  void detach(const std::string& port);
  /// Faults of the device at that port, to be set at will.
  UsbFaults& faults(const std::string& port);
  /// From now on opening fails as without permission.
  void forbid(const std::string& port);

  std::int64_t now_ns() const;
  void advance(std::int64_t ns);

  std::vector<UsbEntry> list(std::uint16_t vendor, std::uint16_t product) override;
  Result<std::unique_ptr<UsbLink>> open(const UsbEntry& entry, const UsbChannel& channel) override;
  UsbChanges changes() override { return changes_; }

  static constexpr std::int64_t kMicroframe_ns = 125'000;

 private:
  friend class EmulatedUsbLink;
  struct Port;
  Port* find(const std::string& port);
  void microframe();

  std::vector<std::unique_ptr<Port>> ports_;
  UsbChanges changes_;
  std::int64_t now_ns_ = 0;     ///< a whole number of microframes
  std::int64_t wanted_ns_ = 0;  ///< sum of what was asked for
};

}  // namespace osteon
