#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "osteon/mesh/distance.h"
#include "osteon/scene/case.h"
#include "osteon/scene/inside.h"
#include "osteon/scene/state.h"

namespace osteon {

/// Which named structures the tips of the hands' instruments are in: soft parts that are not felt,
/// and bones that instruments remove. What is felt keeps a tip out, and has events of its own for
/// what cuts, holds or pierces it; cartilage counts as the surface of its bone. A structure is its
/// closed mesh at rest, moved with its bones: a hole that was cut into it belongs to it.
///
/// The tip is the origin of the tool's frame. It has entered once it is kIn_m under the surface,
/// and left once it has been outside for kOutSteps; so a tip that lies on a surface tells nothing.
///
/// Immutable once its structures are added. A look allocates nothing.
class StructureWatch {
 public:
  static constexpr double kIn_m = 1e-4;
  /// Steps of physics between two looks: a tip passes 1 mm of tissue unseen only above 0.25 m/s.
  static constexpr std::uint64_t kEvery = 2;
  static constexpr std::uint64_t kOutSteps = 25;

  explicit StructureWatch(const Case& the_case);
  /// Soft parts with a closed mesh but cartilage and `felt`, indices in Case::softs.
  void add_softs(const Case& the_case, std::span<const std::uint32_t> felt);
  void add_bone(const Case& the_case, std::uint32_t bone);
  std::size_t count() const { return structures_.size(); }

  /// `list`: as the last step left it. `step`: of `bones`.
  void look(const ToolState& tool, const BoneSnapshot& bones, InsideList& list) const;

 private:
  struct Structure {
    SubjectKind kind = SubjectKind::kNothing;
    std::uint32_t subject = 0;
    std::vector<std::size_t> rides_on;
    Vec3 middle_W = Vec3::Zero();  ///< of a soft part, at rest
    Aabb box;                      ///< of the mesh, in its own frame
    std::unique_ptr<const MeshDistance> surface;
  };
  void add(Structure structure, const TriMesh& mesh);
  double depth_m(const Structure& structure, const Vec3& p_W, const BoneSnapshot& bones) const;

  std::vector<Pose> rest_X_WB_;
  std::vector<Structure> structures_;
};

/// Tells what a hand enters and leaves, when it consumes another list than before. `told`: the list
/// of the last time; becomes `now`.
template <class Tell>
void tell_changes(const InsideList& now, InsideList& told, Tell&& tell) {
  const auto holds = [](const InsideList& list, const Inside& one) {
    for (const Inside& other : list)
      if (other.kind == one.kind && other.subject == one.subject &&
          other.first_step == one.first_step)
        return true;
    return false;
  };
  for (const Inside& one : told)
    if (one.kind != SubjectKind::kNothing && !holds(now, one)) tell(EventKind::kStructureLeft, one);
  for (const Inside& one : now)
    if (one.kind != SubjectKind::kNothing && !holds(told, one))
      tell(EventKind::kStructureEntered, one);
  told = now;
}

}  // namespace osteon
