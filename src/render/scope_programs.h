#pragma once

#include <array>
#include <cstddef>
#include <filesystem>

#include "gl/gl_objects.h"
#include "osteon/base/result.h"
#include "surface/tissue_part.h"

namespace osteon {

/// The programs that paint a scope's flat picture: one for each kind of tissue. All with the
/// context current.
class ScopePrograms {
 public:
  static Result<ScopePrograms> load(const std::filesystem::path& shaders);

  /// `depth_alone`: it writes no light.
  const Program& of(const TissuePart& part, bool depth_alone) const {
    return depth_alone ? depth_ : tissues_[static_cast<std::size_t>(part.pattern)];
  }
  const Program& depth() const { return depth_; }
  /// Of bone or cartilage of which stretches are left out.
  const Program& changed(const TissuePart& part) const {
    return part.pattern == TissuePattern::kCartilage ? changed_cartilage_ : changed_bone_;
  }
  /// Over the whole viewport, behind all that is drawn: no light.
  void paint_nothing() const;
  /// The program draws that part from then on.
  static void begin(const Program& program, const TissuePart& part,
                    const Eigen::Matrix4f& clip_from_view, const Pose& X_CM);

 private:
  static constexpr std::size_t kPatterns = static_cast<std::size_t>(TissuePattern::kDisc) + 1;
  std::array<Program, kPatterns> tissues_;  ///< by TissuePattern
  Program depth_, changed_bone_, changed_cartilage_, nothing_;
  GlVertexArray no_vertices_;
};

}  // namespace osteon
