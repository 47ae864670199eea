#include "scope_programs.h"

#include <algorithm>
#include <string>
#include <utility>

#include "gl/frame.h"

namespace osteon {
namespace {

/// A quarter of how the part's own colour, in linear light (gamma 2), differs from grey.
Eigen::Vector3f tint_of(const TissuePart& part) {
  constexpr float kShare = 0.25f, kDarkest = 0.05f;
  const Eigen::Array3f linear = Eigen::Array3f(part.tint[0], part.tint[1], part.tint[2]).square();
  return 1 - kShare + kShare * linear / std::max(linear.mean(), kDarkest);
}

}  // namespace

Result<ScopePrograms> ScopePrograms::load(const std::filesystem::path& shaders) {
  ScopePrograms out;
  const auto kind = [](std::size_t k) { return "#define KIND " + std::to_string(k) + "\n"; };
  auto bone = Program::load_with(shaders, "tissue", "tissue", kind(0));
  if (!bone) return tl::unexpected(bone.error());
  out.bone_ = std::move(*bone);
  for (std::size_t k = 0; k < kPatterns; ++k)
    out.tissues_[k] = LateProgram(shaders, "tissue", "tissue", kind(k));
  out.changed_bone_ = LateProgram(shaders, "tissue", "tissue", kind(0), true);
  out.changed_cartilage_ = LateProgram(shaders, "tissue", "tissue", kind(1), true);
  auto depth = Program::load(shaders, "tissue", "depth");
  if (!depth) return tl::unexpected(depth.error());
  out.depth_ = std::move(*depth);
  auto nothing = Program::load(shaders, "screen", "nothing");
  if (!nothing) return tl::unexpected(nothing.error());
  out.nothing_ = std::move(*nothing);
  out.no_vertices_ = make_vertex_array();
  return out;
}

bool ScopePrograms::ready_one() const {
  for (const LateProgram* late : {&changed_bone_, &changed_cartilage_}) {
    if (late->ready()) continue;
    (void)late->get();
    return true;
  }
  return false;
}

void ScopePrograms::paint_nothing() const {
  constexpr float kFarthest = 1;  // clip z
  nothing_.use();
  nothing_.set("u_screen_depth", kFarthest);
  glBindVertexArray(no_vertices_.get());
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glBindVertexArray(0);
}

void ScopePrograms::begin(const Program& program, const TissuePart& part,
                          const Eigen::Matrix4f& clip_from_view, const Pose& X_CM) {
  program.use();
  program.set("u_clip_from_view", clip_from_view);
  program.set("u_light", 1.0f);
  program.set("u_view_from_model", to_matrix(X_CM));
  program.set("u_tint", tint_of(part));
  program.set("u_fibre", part.fibre);
  program.set("u_fineness", part.fineness);
  program.set("u_center", part.center);
  program.set("u_to_end", part.to_end);
  program.set("u_to_side", part.to_side);
}

}  // namespace osteon
