#pragma once

#include <libusb.h>

#include <array>

#include "out_slots.h"
#include "packet_ring.h"

namespace osteon {

UsbError to_usb_error(libusb_transfer_status status);
UsbError to_usb_error(int code);

/// A transfer with its buffer.
template <std::size_t kBytes>
struct LibusbPipe {
  LibusbPipe() : transfer(libusb_alloc_transfer(0)) {}
  ~LibusbPipe() { libusb_free_transfer(transfer); }
  LibusbPipe(const LibusbPipe&) = delete;
  LibusbPipe& operator=(const LibusbPipe&) = delete;
  libusb_transfer* transfer;
  std::array<std::uint8_t, kBytes> buffer{};
  bool in_flight = false;
};

/// An OUT transfer: by an endpoint, or as SET_REPORT with its set-up in front.
struct LibusbOutPipe : LibusbPipe<UsbLink::kPacketBytes + LIBUSB_CONTROL_SETUP_SIZE> {
  std::size_t slot = 0;
  std::int64_t since_ns = 0;
  bool cancelled = false;
};

/// The transfers of one link and the state that libusb's callbacks write to. It outlives the link
/// if transfers refuse to end. `handle` and `channel` are set before the first transfer.
struct LibusbIo {
  libusb_device_handle* handle = nullptr;
  UsbChannel channel;
  bool out_by_control = false;
  std::size_t out_pipes = 1;  ///< in use

  std::array<LibusbPipe<UsbLink::kPacketBytes>, 2> in;
  std::array<LibusbOutPipe, UsbLink::kMostInFlight> out;
  LibusbPipe<UsbLink::kControlBytes + LIBUSB_CONTROL_SETUP_SIZE> control;
  PacketRing ring;
  OutSlots slots;
  UsbError control_error = UsbError::kNone;
  std::size_t control_bytes = 0;
  UsbError in_error = UsbError::kNone;
  UsbError out_error = UsbError::kNone;
  UsbCounters counters;
  int ended = 0;  // set by every callback: libusb's `completed`
  bool gone = false;
  bool closing = false;

  bool out_busy() const;
  bool busy() const;
  /// Fills the transfers of both endpoints; the types are libusb's.
  void prepare(unsigned char in_type, unsigned char out_type);
  void start_reading();
  /// Starts OUT transfers while there are free ones and values that wait.
  void send();
  /// A stalled device must not get an old force first when it wakes.
  void cancel_old_out();
  bool start_control(const UsbSetup& setup, std::span<const std::uint8_t> bytes, double timeout_s);
  void cancel_all();
};

}  // namespace osteon
