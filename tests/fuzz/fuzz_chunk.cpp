// Decodes bytes as a chunk of a recording: as a zstd frame, and as the raw words of one, so that
// the fuzzer need not find its way through the compression.
#include <zstd.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "../../src/record/chunk.h"

namespace {

void decode(std::string_view frame, std::size_t count) {
  std::vector<osteon::TickRecord> ticks;
  (void)osteon::decode_chunk(frame, 1, count, ticks);
  std::vector<osteon::StepRecord> steps;
  (void)osteon::decode_chunk(frame, 1, count, steps);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  decode(bytes, data[0]);
  std::string frame(ZSTD_compressBound(bytes.size()), '\0');
  frame.resize(ZSTD_compress(frame.data(), frame.size(), bytes.data(), bytes.size(), 1));
  decode(frame, bytes.size() / (25 * 8));
  decode(frame, bytes.size() / (3 * 8));
  return 0;
}
