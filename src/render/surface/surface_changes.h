#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

#include "osteon/base/types.h"
#include "osteon/render/prepare.h"

namespace osteon {

/// Which surfaces of a scene changed and where, for who keeps a picture of it: what was drawn at
/// one version differs from now within known boxes alone, or anywhere.
class SurfaceChanges {
 public:
  struct One {
    std::uint64_t version = 0;  ///< from which on it is so
    std::size_t model = 0;
    Aabb box_M;  ///< holds what was there and what is there now, in the model's frame
  };

  /// Grows with each change.
  std::uint64_t version() const { return version_; }
  /// Everything may look different.
  void anywhere();
  /// One model looks different within the box.
  void within(std::size_t model, const Aabb& box_M);

  /// False: since then anything may have changed.
  bool known_since(std::uint64_t version) const { return version >= anywhere_; }
  std::vector<One> since(std::uint64_t version) const;

 private:
  std::uint64_t version_ = 1, anywhere_ = 1;
  std::deque<One> last_;
};

/// Where two surfaces of one model look different: about their vertices and triangles that are not
/// the same in the same order. Empty where they are alike.
Aabb changed_box(const ShadedMesh& before, const ShadedMesh& now);

}  // namespace osteon
