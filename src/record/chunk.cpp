#include "chunk.h"

#include <zstd.h>

#include <bit>
#include <cassert>
#include <limits>

#include "osteon/base/hash.h"

namespace osteon {
namespace {

// Packs 250 ticks in about a millisecond; higher levels gain next to nothing.
constexpr int kZstdLevel = 3;
constexpr std::size_t kWordBytes = 8;

// Writes a field as a word.
struct ToWord {
  std::uint64_t* word;
  bool ok = true;
  void operator()(double value) { *word++ = std::bit_cast<std::uint64_t>(value); }
  void operator()(std::uint64_t value) { *word++ = value; }
  void operator()(std::uint32_t value) { *word++ = value; }
  void operator()(std::uint8_t value) { *word++ = value; }
  void operator()(CommandKind kind) { *word++ = static_cast<std::uint32_t>(kind); }
  void operator()(EventKind kind) { *word++ = static_cast<std::uint16_t>(kind); }
  void operator()(SubjectKind kind) { *word++ = static_cast<std::uint8_t>(kind); }
};

// Reads a field from a word; `ok` becomes false when it cannot hold the word.
struct FromWord {
  const std::uint64_t* word;
  bool ok = true;
  void operator()(double& value) { value = std::bit_cast<double>(*word++); }
  void operator()(std::uint64_t& value) { value = *word++; }
  void operator()(std::uint32_t& value) {
    ok = ok && *word <= std::numeric_limits<std::uint32_t>::max();
    value = static_cast<std::uint32_t>(*word++);
  }
  void operator()(std::uint8_t& value) {
    ok = ok && *word <= 0xff;
    value = static_cast<std::uint8_t>(*word++);
  }
  // A later version may have more kinds.
  void operator()(EventKind& kind) {
    ok = ok && *word <= 0xffff;
    kind = static_cast<EventKind>(*word++);
  }
  void operator()(SubjectKind& kind) {
    ok = ok && *word <= 0xff;
    kind = static_cast<SubjectKind>(*word++);
  }
  void operator()(CommandKind& kind) {
    ok = ok && *word <= static_cast<std::uint32_t>(kLastCommandKind);
    kind = static_cast<CommandKind>(*word++);
  }
};

template <class Vector, class Visit>
void visit_vec3(Vector& v, Visit& visit) {
  for (int i = 0; i < 3; ++i) visit(v[i]);
}

// The order of the fields in the file: one place for both directions. Appending or moving a field
// is a new version of the format.
template <class Record, class Visit>
void visit_tick(Record& r, Visit& visit) {
  visit_vec3(r.input.X_WD.p, visit);
  visit(r.input.X_WD.q.w());
  visit(r.input.X_WD.q.x());
  visit(r.input.X_WD.q.y());
  visit(r.input.X_WD.q.z());
  visit_vec3(r.input.v_W, visit);
  visit_vec3(r.input.w_W, visit);
  visit(r.input.buttons);
  visit(r.bone_step);
  for (auto& tick : r.other_ticks) visit(tick);
  visit(r.command.kind);
  visit(r.command.value);
  visit_vec3(r.force_W, visit);
  visit_vec3(r.p_WP, visit);
  visit(r.status);
  visit(r.state_hash);
}

template <class Record, class Visit>
void visit_step(Record& r, Visit& visit) {
  for (auto& tick : r.tool_ticks) visit(tick);
  visit(r.command.kind);
  visit(r.command.value);
}

template <class Record, class Visit>
void visit_event(Record& r, Visit& visit) {
  visit(r.tick);
  visit(r.kind);
  visit(r.hand);
  visit(r.subject_kind);
  visit(r.subject);
  visit_vec3(r.p_W, visit);
  for (auto& value : r.values) visit(value);
}

// What encode and decode need to know of a kind of record.
template <class Record>
struct Layout;

template <>
struct Layout<TickRecord> {
  static constexpr std::size_t kWords = 25 + kMaxHands;
  template <class Record, class Visit>
  static void visit(Record& r, Visit& v) {
    visit_tick(r, v);
  }
  static void number(TickRecord& r, std::uint64_t n) { r.tick = n; }
};

template <>
struct Layout<StepRecord> {
  static constexpr std::size_t kWords = 2 + kMaxHands;
  template <class Record, class Visit>
  static void visit(Record& r, Visit& v) {
    visit_step(r, v);
  }
  static void number(StepRecord& r, std::uint64_t n) { r.step = n; }
};

template <>
struct Layout<Event> {
  static constexpr std::size_t kWords = 11;
  template <class Record, class Visit>
  static void visit(Record& r, Visit& v) {
    visit_event(r, v);
  }
  static void number(Event&, std::uint64_t) {}
};

template <class Record>
std::vector<std::uint64_t> to_words(std::span<const Record> records) {
  std::vector<std::uint64_t> words(records.size() * Layout<Record>::kWords);
  ToWord visit{words.data()};
  for (const Record& record : records) Layout<Record>::visit(record, visit);
  assert(visit.word == words.data() + words.size());
  return words;
}

// Byte `b` of record `i`'s field `f` goes to [f][b][i], after the xor with record i - 1.
std::string shuffle(const std::vector<std::uint64_t>& words, std::size_t fields) {
  const std::size_t count = words.size() / fields;
  std::string bytes(words.size() * kWordBytes, '\0');
  for (std::size_t f = 0; f < fields; ++f) {
    char* column = bytes.data() + f * count * kWordBytes;
    std::uint64_t before = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint64_t word = words[i * fields + f];
      const std::uint64_t delta = word ^ before;
      before = word;
      for (std::size_t b = 0; b < kWordBytes; ++b)
        column[b * count + i] = static_cast<char>((delta >> (8 * b)) & 0xff);
    }
  }
  return bytes;
}

std::vector<std::uint64_t> unshuffle(std::string_view bytes, std::size_t fields) {
  const std::size_t count = bytes.size() / (fields * kWordBytes);
  std::vector<std::uint64_t> words(fields * count);
  for (std::size_t f = 0; f < fields; ++f) {
    const char* column = bytes.data() + f * count * kWordBytes;
    std::uint64_t word = 0;
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t b = 0; b < kWordBytes; ++b)
        word ^= std::uint64_t{static_cast<unsigned char>(column[b * count + i])} << (8 * b);
      words[i * fields + f] = word;
    }
  }
  return words;
}

std::string compress(const std::string& bytes) {
  std::string frame(ZSTD_compressBound(bytes.size()), '\0');
  const std::size_t size =
      ZSTD_compress(frame.data(), frame.size(), bytes.data(), bytes.size(), kZstdLevel);
  assert(!ZSTD_isError(size));  // cannot happen: the output has room for the worst case
  frame.resize(size);
  return frame;
}

Result<std::string> decompress(std::string_view frame, std::size_t wanted) {
  if (ZSTD_getFrameContentSize(frame.data(), frame.size()) != wanted)
    return fail("the size of the data does not match the count of records");
  std::string bytes(wanted, '\0');
  const std::size_t size = ZSTD_decompress(bytes.data(), bytes.size(), frame.data(), frame.size());
  if (ZSTD_isError(size) || size != wanted) return fail("the data do not decompress");
  return bytes;
}

template <class Record>
std::string encode(std::span<const Record> records) {
  return compress(shuffle(to_words(records), Layout<Record>::kWords));
}

template <class Record>
Result<void> decode(std::string_view frame, std::uint64_t first, std::size_t count,
                    std::vector<Record>& records) {
  constexpr std::size_t kFields = Layout<Record>::kWords;
  if (count == 0 || count > kChunkRecords) return fail("a chunk holds 1 to 250 records");
  const auto bytes = decompress(frame, count * kFields * kWordBytes);
  if (!bytes) return tl::unexpected(bytes.error());
  const std::vector<std::uint64_t> words = unshuffle(*bytes, kFields);
  FromWord visit{words.data()};
  for (std::size_t i = 0; i < count; ++i) {
    Record record;
    Layout<Record>::visit(record, visit);
    Layout<Record>::number(record, first + i);
    records.push_back(record);
  }
  if (!visit.ok) return fail("a field has an impossible value");
  return {};
}

}  // namespace

std::string encode_chunk(std::span<const TickRecord> ticks) { return encode(ticks); }
std::string encode_chunk(std::span<const StepRecord> steps) { return encode(steps); }
std::string encode_chunk(std::span<const Event> events) { return encode(events); }

Result<void> decode_chunk(std::string_view frame, std::uint64_t first, std::size_t count,
                          std::vector<TickRecord>& ticks) {
  return decode(frame, first, count, ticks);
}

Result<void> decode_chunk(std::string_view frame, std::uint64_t first, std::size_t count,
                          std::vector<StepRecord>& steps) {
  return decode(frame, first, count, steps);
}

Result<void> decode_chunk(std::string_view frame, std::uint64_t first, std::size_t count,
                          std::vector<Event>& events) {
  return decode(frame, first, count, events);
}

std::string pack_bytes(const std::string& bytes) { return compress(bytes); }

Result<std::string> unpack_bytes(std::string_view frame, std::size_t most) {
  const unsigned long long size = ZSTD_getFrameContentSize(frame.data(), frame.size());
  if (size > most) return fail("a stored state has an impossible size");
  return decompress(frame, static_cast<std::size_t>(size));
}

std::uint64_t chunk_checksum(std::string_view frame, std::uint64_t first, std::uint64_t count) {
  Hasher hasher;
  hasher.add(first);
  hasher.add(count);
  hasher.add(frame);
  return hasher.value();
}

}  // namespace osteon
