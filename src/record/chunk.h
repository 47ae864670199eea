#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/record/recording.h"

namespace osteon {

/// Most records in one chunk: 0.25 s of haptic ticks.
inline constexpr std::size_t kChunkRecords = 250;

/// Consecutive records as a zstd frame. Inside, every field is one little-endian 64-bit word; the
/// words stand field by field, each xor-ed with that of the record before, and each field's bytes
/// are grouped by significance: what hardly changes becomes runs of zeros. Bits survive exactly,
/// those of a NaN too. The records' own numbers are not in it: they follow from the first's.
std::string encode_chunk(std::span<const TickRecord> ticks);
std::string encode_chunk(std::span<const StepRecord> steps);
std::string encode_chunk(std::span<const Event> events);

/// Appends `count` records, numbered from `first`. Refuses a frame whose stated size is not that of
/// `count` records before it decompresses anything.
Result<void> decode_chunk(std::string_view frame, std::uint64_t first, std::size_t count,
                          std::vector<TickRecord>& ticks);
Result<void> decode_chunk(std::string_view frame, std::uint64_t first, std::size_t count,
                          std::vector<StepRecord>& steps);

Result<void> decode_chunk(std::string_view frame, std::uint64_t first, std::size_t count,
                          std::vector<Event>& events);

/// Bytes as a zstd frame, and back; refuses more than `most`.
std::string pack_bytes(const std::string& bytes);
Result<std::string> unpack_bytes(std::string_view frame, std::size_t most);

/// Over the frame and the numbers that say where it belongs.
std::uint64_t chunk_checksum(std::string_view frame, std::uint64_t first, std::uint64_t count);

}  // namespace osteon
