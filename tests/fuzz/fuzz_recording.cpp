// Any bytes are a recording, an error, or nothing worse.
#include <cstddef>
#include <cstdint>
#include <span>

#include "osteon/record/recording.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  (void)osteon::load_recording_from_memory(std::as_bytes(std::span(data, size)));
  return 0;
}
