#pragma once

#include <array>
#include <cstddef>
#include <filesystem>

#include "gl/gl_objects.h"
#include "osteon/base/result.h"
#include "surface/tissue_part.h"

namespace osteon {

/// The programs that paint a scope's flat picture: one for each kind of tissue, compiled when it is
/// first drawn. All with the context current.
class ScopePrograms {
 public:
  static Result<ScopePrograms> load(const std::filesystem::path& shaders);

  /// `depth_alone`: it writes no light.
  const Program& of(const TissuePart& part, bool depth_alone) const {
    if (depth_alone) return depth_;
    if (part.pattern == TissuePattern::kBone) return bone_;
    return or_bone(tissues_[static_cast<std::size_t>(part.pattern)]);
  }
  const Program& depth() const { return depth_; }
  /// Of bone or cartilage of which stretches are left out.
  const Program& changed(const TissuePart& part) const {
    return or_bone(part.pattern == TissuePattern::kCartilage ? changed_cartilage_ : changed_bone_);
  }
  /// Compiles one of those that no picture has asked for yet; false: there is none.
  bool ready_one() const;
  /// Over the whole viewport, behind all that is drawn: no light.
  void paint_nothing() const;
  /// The program draws that part from then on.
  static void begin(const Program& program, const TissuePart& part,
                    const Eigen::Matrix4f& clip_from_view, const Pose& X_CM);

 private:
  const Program& or_bone(const LateProgram& program) const {
    const Program* const made = program.get();
    return made ? *made : bone_;
  }
  static constexpr std::size_t kPatterns = static_cast<std::size_t>(TissuePattern::kDisc) + 1;
  Program bone_;                                ///< and in place of what does not compile
  std::array<LateProgram, kPatterns> tissues_;  ///< by TissuePattern
  LateProgram changed_bone_, changed_cartilage_;
  Program depth_, nothing_;
  GlVertexArray no_vertices_;
};

}  // namespace osteon
