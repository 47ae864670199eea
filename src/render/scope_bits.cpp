#include "scope_bits.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace osteon {
namespace {

constexpr double kLeast_m = 1e-5, kMost_m = 0.01;
constexpr double kFlakeWide = 0.6;  // of its length

struct BitVertex {
  std::array<float, 3> center, offset;  // view space
  std::array<float, 4> look;            // place in the square, -1 to 1; 0 bubble, 1 flake; shape
};

void add_square(const WaterBit& bit, const Vec3& center_C, const Vec3& right_C, const Vec3& up_C,
                std::vector<BitVertex>& out) {
  constexpr std::array<std::array<int, 2>, 6> kCorners = {
      {{-1, -1}, {1, -1}, {1, 1}, {-1, -1}, {1, 1}, {-1, 1}}};
  for (const auto& [x, y] : kCorners) {
    const Eigen::Vector3f c = center_C.cast<float>();
    const Eigen::Vector3f d = (x * right_C + y * up_C).cast<float>();
    const float kind = bit.is == WaterBit::Is::kFlake ? 1.0f : 0.0f;
    out.push_back(
        {{c.x(), c.y(), c.z()},
         {d.x(), d.y(), d.z()},
         {static_cast<float>(x), static_cast<float>(y), kind, static_cast<float>(bit.shape)}});
  }
}

/// A bubble's square faces the eye, a flake's lies as the flake does.
void add_bit(const WaterBit& bit, const Pose& X_CW, std::vector<BitVertex>& out) {
  const Vec3 center_C = X_CW * bit.p_W;
  if (bit.is == WaterBit::Is::kFlake) {
    const Quat turn_C = X_CW.q * bit.turn;
    return add_square(bit, center_C, bit.radius_m * (turn_C * Vec3::UnitX()),
                      kFlakeWide * bit.radius_m * (turn_C * Vec3::UnitY()), out);
  }
  const Vec3 back = -center_C.normalized();
  const Vec3 right = Vec3::UnitY().cross(back).normalized();
  add_square(bit, center_C, bit.radius_m * right, bit.radius_m * back.cross(right), out);
}

const void* offset_of(std::size_t bytes) { return reinterpret_cast<const void*>(bytes); }

}  // namespace

Result<ScopeBits> ScopeBits::load(const std::filesystem::path& shaders) {
  ScopeBits out;
  out.program_ = {shaders, "water_bit", "water_bit"};
  if (const auto there = out.program_.check(); !there) return tl::unexpected(there.error());
  out.array_ = make_vertex_array();
  out.vertices_ = make_buffer();
  constexpr GLsizei stride = sizeof(BitVertex);
  glBindVertexArray(out.array_.get());
  glBindBuffer(GL_ARRAY_BUFFER, out.vertices_.get());
  for (const GLuint k : {0u, 1u, 2u}) glEnableVertexAttribArray(k);
  glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, stride, offset_of(offsetof(BitVertex, center)));
  glVertexAttribPointer(1, 3, GL_FLOAT, GL_FALSE, stride, offset_of(offsetof(BitVertex, offset)));
  glVertexAttribPointer(2, 4, GL_FLOAT, GL_FALSE, stride, offset_of(offsetof(BitVertex, look)));
  glBindVertexArray(0);
  return out;
}

bool ScopeBits::ready_one() const {
  if (program_.ready()) return false;
  (void)program_.get();
  return true;
}

void ScopeBits::set(std::span<const WaterBit> bits) {
  bits_.clear();
  for (const WaterBit& bit : bits)
    if (bits_.size() < kMostWaterBits && is_finite(bit.p_W) && bit.turn.coeffs().allFinite() &&
        bit.radius_m >= kLeast_m && bit.radius_m <= kMost_m && std::isfinite(bit.shape))
      bits_.push_back(bit);
}

void ScopeBits::paint_some(WaterBit::Is is, const Pose& X_CW) const {
  std::vector<WaterBit> some;
  for (const WaterBit& bit : bits_)
    if (bit.is == is && (X_CW * bit.p_W).z() < -bit.radius_m) some.push_back(bit);
  if (some.empty()) return;
  // The farthest first: what is seen through shows what lies behind.
  std::stable_sort(some.begin(), some.end(), [&](const WaterBit& a, const WaterBit& b) {
    return (X_CW * a.p_W).squaredNorm() > (X_CW * b.p_W).squaredNorm();
  });
  std::vector<BitVertex> vertices;
  for (const WaterBit& bit : some) add_bit(bit, X_CW, vertices);
  glBindVertexArray(array_.get());
  glBindBuffer(GL_ARRAY_BUFFER, vertices_.get());
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertices.size() * sizeof(BitVertex)),
               vertices.data(), GL_STREAM_DRAW);
  glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(vertices.size()));
  glBindVertexArray(0);
}

void ScopeBits::paint(const Pose& X_CW, const Eigen::Matrix4f& clip_from_view) const {
  const Program* const program = bits_.empty() ? nullptr : program_.get();
  if (!program) return;
  program->use();
  program->set("u_clip_from_view", clip_from_view);
  paint_some(WaterBit::Is::kFlake, X_CW);
  glDepthMask(GL_FALSE);
  glEnable(GL_BLEND);
  glBlendFuncSeparate(GL_ONE, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);
  paint_some(WaterBit::Is::kBubble, X_CW);
  glDisable(GL_BLEND);
  glDepthMask(GL_TRUE);
}

}  // namespace osteon
