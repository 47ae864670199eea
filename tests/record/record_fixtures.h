#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <bit>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>

#include "osteon/base/random.h"
#include "osteon/record/recording.h"

namespace osteon::testing {

/// A folder of its own, removed at the end.
class TempFolder {
 public:
  TempFolder() {
    static int made = 0;
    path_ = std::filesystem::path(::testing::TempDir()) /
            ("osteon_record_" + std::to_string(getpid()) + "_" + std::to_string(made++));
    std::filesystem::create_directories(path_);
  }
  ~TempFolder() {
    std::error_code ignored;
    std::filesystem::permissions(path_, std::filesystem::perms::owner_all, ignored);
    std::filesystem::remove_all(path_, ignored);
  }
  std::filesystem::path operator/(const char* name) const { return path_ / name; }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

inline Vec3 random_vec3(Random& random) {
  const double x = random.uniform(-1, 1);
  const double y = random.uniform(-1, 1);
  const double z = random.uniform(-1, 1);
  return {x, y, z};
}

/// A tick that is a function of its number. Every 97th has an input that is not finite, with a
/// payload in the NaN: a fault that a recording must keep to the bit.
inline TickRecord tick_record(std::uint64_t n) {
  Random random(n);
  TickRecord r;
  r.tick = n;
  r.input.X_WD = {random_vec3(random), random.rotation()};
  r.input.v_W = random_vec3(random);
  r.input.w_W = random_vec3(random);
  if (n % 97 == 0) {
    r.input.v_W.x() = std::bit_cast<double>(0x7ff0000000000001ull + n);  // signalling
    r.input.w_W.y() = -std::numeric_limits<double>::infinity();
    r.input.X_WD.q.w() = -0.0;
  }
  r.input.buttons = static_cast<std::uint32_t>(random.next());
  r.bone_step = (n - 1) / 2;
  if (n % 50 == 0) r.command = {CommandKind::kSetStiffness, random.uniform(100, 3000)};
  r.force_W = random_vec3(random);
  r.p_WP = random_vec3(random);
  r.status = static_cast<std::uint32_t>(n % 128);
  r.state_hash = n % kHashInterval == 0 ? random.next() : 0;
  return r;
}

/// The step that tick 2 n leads to.
inline StepRecord step_record(std::uint64_t n) {
  StepRecord r;
  r.step = n;
  r.tool_ticks[0] = 2 * n;
  if (n % 31 == 0) r.command = {CommandKind::kHoldBones, double(n % 2)};
  return r;
}

inline RecordingHeader header() {
  return {"wrist \xc3\xa9",
          "builtin:wrist",
          0xfedcba9876543210ull,
          0xffffffffffffffffull,
          R"({"a": 1})",
          "0.1.0",
          "/cases/wrist",
          1,
          0x8000000000000001ull,
          7,
          R"({"bones": ["lunate"]})"};
}

inline void expect_bits(double a, double b) {
  EXPECT_EQ(std::bit_cast<std::uint64_t>(a), std::bit_cast<std::uint64_t>(b));
}
inline void expect_bits(const Vec3& a, const Vec3& b) {
  for (int i = 0; i < 3; ++i) expect_bits(a[i], b[i]);
}

inline void expect_same(const Command& a, const Command& b) {
  EXPECT_EQ(a.kind, b.kind);
  expect_bits(a.value, b.value);
}

/// Compares bits, not values: NaN equals NaN and 0 differs from -0.
inline void expect_same(const TickRecord& a, const TickRecord& b) {
  EXPECT_EQ(a.tick, b.tick);
  expect_bits(a.input.X_WD.p, b.input.X_WD.p);
  for (int i = 0; i < 4; ++i) expect_bits(a.input.X_WD.q.coeffs()[i], b.input.X_WD.q.coeffs()[i]);
  expect_bits(a.input.v_W, b.input.v_W);
  expect_bits(a.input.w_W, b.input.w_W);
  EXPECT_EQ(a.input.buttons, b.input.buttons);
  EXPECT_EQ(a.bone_step, b.bone_step);
  expect_same(a.command, b.command);
  expect_bits(a.force_W, b.force_W);
  expect_bits(a.p_WP, b.p_WP);
  EXPECT_EQ(a.status, b.status);
  EXPECT_EQ(a.state_hash, b.state_hash);
}

inline void expect_same(const StepRecord& a, const StepRecord& b) {
  EXPECT_EQ(a.step, b.step);
  EXPECT_EQ(a.tool_ticks[0], b.tool_ticks[0]);
  expect_same(a.command, b.command);
}

/// Adds tick `n`, and the step that is due after it, as a session in one thread does.
inline Result<void> add_tick(RecordingWriter& writer, std::uint64_t n) {
  if (const auto done = writer.add(tick_record(n)); !done) return done;
  return n % 2 == 0 ? writer.add(step_record(n / 2)) : Result<void>{};
}

/// Writes ticks 1 to `ticks` and finishes when asked to.
inline void write_recording(const std::filesystem::path& file, std::uint64_t ticks,
                            bool finish = true, const RecordingHeader& of = header()) {
  auto writer = RecordingWriter::create(file, of);
  ASSERT_TRUE(writer) << writer.error().message();
  for (std::uint64_t n = 1; n <= ticks; ++n) {
    const auto done = add_tick(*writer, n);
    ASSERT_TRUE(done) << done.error().message();
  }
  if (!finish) return;
  const auto done = writer->finish();
  ASSERT_TRUE(done) << done.error().message();
}

/// All that a recording holds is what was written, from the first on.
inline void expect_prefix(const Recording& recording) {
  for (std::size_t i = 0; i < recording.ticks.size(); ++i) {
    expect_same(recording.ticks[i], tick_record(i + 1));
    if (::testing::Test::HasFailure()) return;
  }
  for (std::size_t i = 0; i < recording.steps.size(); ++i) {
    expect_same(recording.steps[i], step_record(i + 1));
    if (::testing::Test::HasFailure()) return;
  }
}

}  // namespace osteon::testing
