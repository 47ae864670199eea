#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <string>
#include <utility>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/mesh/soft_selection.h"
#include "osteon/mesh/tri_mesh.h"

namespace osteon {

/// What is wrong with a surface after a change.
struct EditFindings {
  std::vector<std::uint32_t> turned;  ///< triangles that lost their area or now face the other way
  std::vector<std::pair<std::uint32_t, std::uint32_t>> crossings;  ///< see self_crossing.h
  bool sound() const { return turned.empty() && crossings.empty(); }
  /// "3 triangles are turned over, 12 pairs of triangles cross", or "sound".
  std::string summary() const;
};

/// Editing of a surface by hand (vKASS, section 3.2): a vertex is grabbed and dragged, its
/// neighbours follow by the weights of a soft selection, and each drag that is committed can be
/// undone and redone. Triangles stay; only vertices move.
///
/// History is bounded by memory: when the steps that can be undone hold more than `history_bytes`,
/// the oldest is forgotten. A step takes about 52 bytes for each vertex that it moved, so that the
/// default holds a hundred thousand steps of fifty vertices.
class MeshEdit {
 public:
  static constexpr std::size_t kHistoryBytes = 256u << 20;

  /// Fails on a mesh without triangles, with a coordinate that is not finite or a triangle that
  /// names no vertex.
  static Result<MeshEdit> begin(TriMesh mesh, std::size_t history_bytes = kHistoryBytes);

  /// The surface as it now stands, with the drag under way.
  const TriMesh& mesh() const { return mesh_; }
  std::uint32_t nearest_vertex(const Vec3& p) const;

  /// Starts a drag. Fails on a vertex that does not exist and on a radius that is not positive;
  /// a drag under way is committed first.
  Result<void> grab(std::uint32_t vertex, const SoftSelection& selection);
  bool is_grabbed() const { return grabbed_; }
  std::uint32_t grabbed_vertex() const { return selected_.empty() ? 0 : selected_.front().vertex; }
  /// Where the grabbed vertex was before the drag.
  Vec3 grabbed_at() const { return before_.empty() ? Vec3(Vec3::Zero()) : before_.front(); }
  Vec3 displacement() const { return displacement_; }
  /// The vertices of the drag under way and their weights.
  const std::vector<SoftWeight>& selected() const { return selected_; }

  /// Places the grabbed vertex `displacement_m` from where it was, and the others by their weights.
  /// One that is not finite is passed over.
  void drag(const Vec3& displacement_m);
  /// Another fall-off for the drag under way.
  Result<void> select(const SoftSelection& selection);
  /// Ends the drag: one step of history, unless nothing moved. Says what is wrong with what moved;
  /// it stays as it is all the same, and may be undone.
  EditFindings commit();
  /// Ends the drag and puts everything back.
  void cancel();

  /// False when there is nothing to undo or redo. A drag under way is cancelled first.
  bool undo();
  bool redo();
  std::size_t undo_steps() const { return undo_.size(); }
  std::size_t redo_steps() const { return redo_.size(); }
  std::size_t forgotten_steps() const { return forgotten_; }
  /// True when the surface is not what it was at the begin or at the last `mark_saved`.
  bool is_changed() const;
  void mark_saved();

  /// Triangles turned over by the drag under way: quick enough for every frame.
  std::vector<std::uint32_t> turned_now() const;
  /// Of the whole surface as it stands: every pair of triangles that cross.
  EditFindings check() const;

 private:
  struct Step {
    std::vector<std::uint32_t> vertex;
    std::vector<Vec3> before, after;
    std::uint64_t number = 0;
    std::size_t bytes() const;
  };
  MeshEdit(TriMesh mesh, std::size_t history_bytes);
  void put_back();
  void let_go();
  std::uint64_t now_at() const { return undo_.empty() ? forgotten_at_ : undo_.back().number; }
  void remember(Step step);
  std::vector<std::uint32_t> touched_triangles() const;

  TriMesh mesh_;
  SurfaceWalk walk_;
  std::size_t history_bytes_;

  bool grabbed_ = false;
  Vec3 displacement_ = Vec3::Zero();
  std::vector<SoftWeight> selected_;
  std::vector<Vec3> before_;  ///< of the selected

  std::deque<Step> undo_;
  std::vector<Step> redo_;
  std::size_t held_bytes_ = 0;
  std::size_t forgotten_ = 0;
  std::uint64_t steps_made_ = 0;
  std::uint64_t forgotten_at_ = 0;  ///< number of the last step forgotten; 0: none
  std::uint64_t saved_at_ = 0;      ///< number of the step after which it was saved; 0: none
};

}  // namespace osteon
