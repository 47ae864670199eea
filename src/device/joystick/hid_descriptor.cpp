#include "hid_descriptor.h"

#include <algorithm>
#include <string>

namespace osteon {
namespace {

constexpr std::size_t kMostBytes = 4096;
constexpr std::size_t kMostFields = 1024;
constexpr std::size_t kMostUsages = 256;
constexpr std::uint32_t kMostReportBits = 8 * 512;
constexpr std::size_t kMostPushed = 8;

struct Globals {
  std::uint32_t page = 0;
  std::int64_t logical_min = 0;
  std::int64_t logical_max = 0;
  std::uint32_t max_raw = 0;  // of logical_max, before it is known whether it has a sign
  std::uint32_t size = 0;
  std::uint32_t count = 0;
  std::uint8_t id = 0;
};

// Runs of usages as the local items give them.
struct UsageRun {
  std::uint32_t first = 0;
  std::uint32_t last = 0;
};

struct Locals {
  std::vector<UsageRun> runs;
  std::uint32_t minimum = 0;
  bool has_minimum = false;

  // Usage of the i-th variable; the last one repeats.
  std::uint32_t at(std::size_t i) const {
    for (const UsageRun& r : runs) {
      const std::size_t n = r.last - r.first + 1;
      if (i < n) return r.first + static_cast<std::uint32_t>(i);
      i -= n;
    }
    return runs.empty() ? 0 : runs.back().last;
  }
};

class Parser {
 public:
  explicit Parser(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  Result<HidReports> run() {
    if (bytes_.size() > kMostBytes) return bad("the report descriptor is longer than 4096 bytes");
    while (at_ < bytes_.size())
      if (auto ok = item(); !ok) return tl::unexpected(ok.error());
    if (depth_ != 0) return bad("a collection is not closed");
    if (out_.fields.empty()) return bad("the report descriptor holds no field");
    return std::move(out_);
  }

 private:
  tl::unexpected<Error> bad(const std::string& what) const {
    return fail(what, "HID report descriptor, byte " + std::to_string(start_),
                "The device's firmware is at fault");
  }

  Result<void> item() {
    start_ = at_;
    const std::uint8_t prefix = bytes_[at_++];
    if (prefix == 0xFE) return skip_long_item();
    const std::size_t size = (prefix & 3) == 3 ? 4 : prefix & 3;
    if (at_ + size > bytes_.size()) return bad("an item is cut short");
    std::uint32_t data = 0;
    for (std::size_t i = 0; i < size; ++i) data |= std::uint32_t{bytes_[at_ + i]} << (8 * i);
    at_ += size;
    const int tag = prefix >> 4;
    switch ((prefix >> 2) & 3) {
      case 0:
        return main_item(tag, data);
      case 1:
        return global_item(tag, data, size);
      case 2:
        return local_item(tag, data, size);
      default:
        return bad("an item is of the reserved type");
    }
  }

  Result<void> skip_long_item() {
    if (at_ + 2 > bytes_.size() || at_ + 2 + bytes_[at_] > bytes_.size())
      return bad("a long item is cut short");
    at_ += 2 + std::size_t{bytes_[at_]};
    return {};
  }

  static std::int64_t sign_extended(std::uint32_t data, std::size_t size) {
    if (size == 1) return static_cast<std::int8_t>(data);
    if (size == 2) return static_cast<std::int16_t>(data);
    return static_cast<std::int32_t>(data);
  }

  Result<void> main_item(int tag, std::uint32_t data) {
    Result<void> ok;
    if (tag == 0x8) ok = add_fields(HidReport::kInput, data);
    if (tag == 0x9) ok = add_fields(HidReport::kOutput, data);
    if (tag == 0xB) ok = add_fields(HidReport::kFeature, data);
    if (tag == 0xA) ok = open_collection();
    if (tag == 0xC) ok = close_collection();
    locals_ = {};
    return ok;
  }

  Result<void> open_collection() {
    if (depth_ == collections_.size()) return bad("collections are nested too deeply");
    collections_[depth_++] = locals_.at(0);
    return {};
  }

  Result<void> close_collection() {
    if (depth_ == 0) return bad("a collection is closed that was not open");
    --depth_;
    return {};
  }

  Result<void> global_item(int tag, std::uint32_t data, std::size_t size) {
    switch (tag) {
      case 0x0:
        globals_.page = data & 0xFFFF;
        break;
      case 0x1:
        globals_.logical_min = sign_extended(data, size);
        break;
      case 0x2:
        globals_.logical_max = sign_extended(data, size);
        globals_.max_raw = data;
        break;
      case 0x7:
        globals_.size = data;
        break;
      case 0x8:
        return set_id(data);
      case 0x9:
        globals_.count = data;
        break;
      case 0xA:
        if (pushed_.size() == kMostPushed) return bad("too many states are pushed");
        pushed_.push_back(globals_);
        break;
      case 0xB:
        if (pushed_.empty()) return bad("a state is popped that was not pushed");
        globals_ = pushed_.back();
        pushed_.pop_back();
        break;
      default:  // physical range and units: the profile states them
        break;
    }
    return {};
  }

  Result<void> set_id(std::uint32_t data) {
    if (data == 0 || data > 255) return bad("a report ID is not within 1 to 255");
    if (!out_.uses_ids && !out_.fields.empty()) return bad("a report ID comes after fields");
    out_.uses_ids = true;
    globals_.id = static_cast<std::uint8_t>(data);
    return {};
  }

  Result<void> local_item(int tag, std::uint32_t data, std::size_t size) {
    const std::uint32_t usage = size == 4 ? data : (globals_.page << 16) | data;
    if (tag == 0x0) return add_usages(usage, usage);
    if (tag == 0x1) {
      locals_.minimum = usage;
      locals_.has_minimum = true;
    }
    if (tag == 0x2) {
      if (!locals_.has_minimum) return bad("a usage maximum comes without its minimum");
      locals_.has_minimum = false;
      return add_usages(locals_.minimum, usage);
    }
    return {};
  }

  Result<void> add_usages(std::uint32_t first, std::uint32_t last) {
    if (last < first || last - first >= kMostUsages) return bad("a range of usages makes no sense");
    if (locals_.runs.size() == kMostUsages) return bad("an item has too many usages");
    locals_.runs.push_back({first, last});
    return {};
  }

  Result<void> add_fields(HidReport report, std::uint32_t flags) {
    std::uint32_t& cursor = out_.bits[static_cast<std::size_t>(report)][globals_.id];
    if (globals_.size > kMostReportBits || globals_.count > kMostReportBits)
      return bad("a report is too long");
    const std::uint32_t total = globals_.size * globals_.count;  // at most 2^24
    if (cursor == 0 && out_.uses_ids) cursor = 8;
    const std::uint32_t start = cursor;
    if (total > kMostReportBits || start + total > kMostReportBits)
      return bad("a report is too long");
    cursor += total;
    const bool is_constant = (flags & 1) != 0;
    if (is_constant || locals_.runs.empty() || total == 0) return {};
    if (globals_.size > 32) return bad("a field is wider than 32 bits");
    return (flags & 2) != 0 ? add_variables(report, start) : add_arrays(report, start);
  }

  HidField field_at(HidReport report, std::uint32_t bit_offset) const {
    HidField f;
    f.report = report;
    f.report_id = globals_.id;
    f.bit_offset = bit_offset;
    f.bits = globals_.size;
    f.logical_min = globals_.logical_min;
    // A maximum has a sign only when the minimum is below zero.
    f.logical_max = globals_.logical_min < 0 ? globals_.logical_max : globals_.max_raw;
    f.collections = collections_;
    f.depth = depth_;
    return f;
  }

  Result<void> add(const HidField& field) {
    if (out_.fields.size() == kMostFields) return bad("the reports have too many fields");
    if (field.logical_max < field.logical_min) return bad("a field's range is empty");
    out_.fields.push_back(field);
    return {};
  }

  Result<void> add_variables(HidReport report, std::uint32_t start) {
    for (std::uint32_t i = 0; i < globals_.count; ++i) {
      HidField f = field_at(report, start + i * globals_.size);
      f.usage = f.last_usage = locals_.at(i);
      if (auto ok = add(f); !ok) return ok;
    }
    return {};
  }

  // One field an element and run of usages: only usages in a row can be named by number.
  Result<void> add_arrays(HidReport report, std::uint32_t start) {
    for (std::uint32_t i = 0; i < globals_.count; ++i) {
      std::int64_t value = globals_.logical_min;
      for (const UsageRun& run : locals_.runs) {
        HidField f = field_at(report, start + i * globals_.size);
        f.is_array = true;
        f.usage = run.first;
        f.last_usage = run.last;
        f.logical_min = value;
        value += run.last - run.first + 1;
        if (f.logical_min > f.logical_max) break;  // more usages than values
        if (auto ok = add(f); !ok) return ok;
      }
    }
    return {};
  }

  std::span<const std::uint8_t> bytes_;
  std::size_t at_ = 0;
  std::size_t start_ = 0;  // of the item being read
  Globals globals_;
  Locals locals_;
  std::vector<Globals> pushed_;
  std::array<std::uint32_t, 8> collections_{};
  std::size_t depth_ = 0;
  HidReports out_;
};

}  // namespace

Result<HidReports> parse_hid_descriptor(std::span<const std::uint8_t> descriptor) {
  return Parser(descriptor).run();
}

bool HidField::inside(std::uint32_t collection) const {
  const auto end = collections.begin() + static_cast<std::ptrdiff_t>(depth);
  return std::find(collections.begin(), end, collection) != end;
}

const HidField* HidReports::find(HidReport report, std::uint32_t collection,
                                 std::uint32_t usage) const {
  for (const HidField& f : fields)
    if (f.report == report && f.inside(collection) && usage >= f.usage && usage <= f.last_usage)
      return &f;
  return nullptr;
}

std::size_t HidReports::bytes(HidReport report, std::uint8_t id) const {
  return (bits[static_cast<std::size_t>(report)][id] + 7) / 8;
}

std::int64_t read_field(std::span<const std::uint8_t> report, const HidField& field) {
  if (field.bits == 0 || field.bits > 32 || field.bit_offset + field.bits > 8 * report.size())
    return 0;
  std::uint64_t value = 0;
  for (std::uint32_t i = 0; i < field.bits; ++i) {
    const std::uint32_t bit = field.bit_offset + i;
    value |= std::uint64_t{(report[bit / 8] >> (bit % 8)) & 1u} << i;
  }
  const bool negative = field.logical_min < 0 && ((value >> (field.bits - 1)) & 1) != 0;
  if (negative) value |= ~std::uint64_t{0} << field.bits;
  return static_cast<std::int64_t>(value);
}

void write_field(std::span<std::uint8_t> report, const HidField& field, std::int64_t value) {
  if (field.bits == 0 || field.bits > 32 || field.bit_offset + field.bits > 8 * report.size())
    return;
  for (std::uint32_t i = 0; i < field.bits; ++i) {
    const std::uint32_t bit = field.bit_offset + i;
    const auto mask = static_cast<std::uint8_t>(1u << (bit % 8));
    std::uint8_t& byte = report[bit / 8];
    const bool on = ((static_cast<std::uint64_t>(value) >> i) & 1) != 0;
    byte = static_cast<std::uint8_t>(on ? byte | mask : byte & ~mask);
  }
}

std::int64_t array_value(const HidField& field, std::uint32_t usage) {
  return field.logical_min + static_cast<std::int64_t>(usage - field.usage);
}

}  // namespace osteon
