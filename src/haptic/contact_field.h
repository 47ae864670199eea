#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "met_before.h"
#include "nearest_point.h"
#include "osteon/collide/broad_phase.h"
#include "osteon/collide/lp_contact.h"
#include "osteon/collide/primitive_contact.h"
#include "osteon/haptic/haptic_state.h"
#include "osteon/scene/case.h"
#include "osteon/scene/tool.h"
#include "tool_vicinity.h"

namespace osteon {

/// The proxy keeps this distance to every bone, so that rounding cannot carry it in, m.
inline constexpr double kSkin = 1e-6;

/// And this to a bone felt as a field, whose planes hold close by only, m.
inline constexpr double kFieldSkin = 5e-6;

/// Most pairs of pieces that one tick looks at, and of fields.
inline constexpr std::size_t kMaxCandidates = 64;
inline constexpr std::size_t kMaxFields = 32;

/// One piece of a bone beside one part of the tool; of a bone felt as a field: the whole bone.
struct PiecePair {
  std::uint32_t bone = 0;
  std::uint32_t piece = 0;
  std::uint32_t tool_piece = 0;
  bool field = false;
};

/// Where the tool is when its surroundings are looked up, and how far it may go from there.
struct ToolReach {
  Pose X_WT;
  double reach_m = 0;   ///< of its origin
  double turn_rad = 0;  ///< of its turn
};

/// Candidates of one tick.
struct CandidateList {
  std::array<std::uint32_t, kMaxCandidates> pair{};
  std::uint32_t count = 0;
  std::array<std::uint32_t, kMaxFields> field{};
  std::uint32_t field_count = 0;
};

/// All pairs of one case and one tool, and the queries on them. Immutable; allocates in its
/// constructor only.
class ContactField {
 public:
  ContactField(const Case& the_case, const Tool& tool);

  /// What was cut out of each bone, by its number; null: nothing, ever. Asked in each query, and
  /// must outlive this. Of bones felt as fields alone.
  void set_cuts(std::span<const CutField* const> by_bone);
  bool can_be_cut() const;
  /// The hole that leads the tool: its bone is felt as the hole's end alone, since a tool that
  /// fills its hole lies all along its axis equally far from the wall, and a distance there says
  /// nothing of a direction. Null: none. Asked in each query.
  void set_guide(const ToolGuide* guide) { guide_ = guide && guide->in_hole ? guide : nullptr; }

  std::span<const PiecePair> pairs() const { return pairs_; }
  /// Of the tool about its origin, m.
  double tool_radius() const { return tool_radius_; }
  const Bone& bone(std::uint32_t index) const { return case_.bones[index]; }

  /// Whether all of the tool is felt, not its tip alone.
  bool whole() const { return !tool_.parts.empty(); }

  /// For `collect`, to keep from tick to tick. This must outlive it.
  ToolVicinity vicinity() const;

  /// Pairs that may touch while the tool is within `reach`, with each bone anywhere between its two
  /// poses, in the order of pairs(). False when there are more than the list holds.
  bool collect(const ToolReach& reach, std::span<const Pose> before_WB,
               std::span<const Pose> now_WB, ToolVicinity& around, CandidateList& out) const;

  /// Counts looks at carved bones: each costs so much that a tick has only so many.
  struct Looks {
    std::uint32_t asked = 0;
    MetBefore* before = nullptr;  ///< null: nothing is kept
  };

  /// Parts one pair at a pose. False when the contact programme could not be solved and
  /// the line between their middles does not part them either.
  bool separate(std::uint32_t pair, const Pose& X_WB, const Pose& X_WT, LpBasis& basis,
                PartingPlane& out) const;
  /// Of a gap wider than this, m, only a bound is asked for: no tick goes so far.
  static constexpr double kFarGap_m = 0.003;

  /// Where a gap must be exact: of a wider one a bound above `far_m` may be told, of a narrower
  /// one a bound below `low_m`.
  struct Wanted {
    double far_m = kFarGap_m;
    double low_m = -std::numeric_limits<double>::infinity();
    LowPlaces* places = nullptr;  ///< of this tick and pair; null: none are kept
  };

  /// The same of a pair of a field, whose looks are counted.
  bool separate_field(std::uint32_t pair, const Pose& X_BT, Looks& looks, const Wanted& wanted,
                      PartingPlane& out) const;

  /// Gap of a pair of a field, m: what `separate` finds, without a plane. Not a number when
  /// unknown.
  double gap(std::uint32_t pair, const Pose& X_BT, Looks& looks, const Wanted& wanted) const;

  /// Where the tool's origin may be when the tool is turned as q_WT: beyond the separation's plane
  /// by its skin. Any x in it keeps a pair of convex pieces apart, wherever it is; of a field only
  /// near the place where the plane was found.
  FreeHalfSpace half_space(std::uint32_t pair, const PartingPlane& s, const Pose& X_WB,
                           const Quat& q_WT) const;

  /// The same of a pair of pieces for a tool however turned: n is that of `half_space`, c no less.
  FreeHalfSpace outer_half_space(std::uint32_t pair, const PartingPlane& s, const Pose& X_WB) const;

 private:
  static constexpr std::uint32_t kAllParts = 0xffffffffu;

  void measure_tool();
  void cut_into_stretches();
  void add_pieces(std::uint32_t bone);
  void add_field(std::uint32_t bone);
  std::size_t parts_beside(bool field) const;
  bool add_found(const PieceRef& found, std::uint32_t part, CandidateList& out) const;
  bool guess(const PiecePair& ids, const Pose& X_BT, PartingPlane& out) const;
  bool separate_part(const PiecePair& ids, const Pose& X_BT, LpBasis& basis,
                     PartingPlane& out) const;
  PrimitiveContact meet_field(std::uint32_t pair, const Pose& X_BT, Looks& looks,
                              const Wanted& wanted) const;
  PrimitiveContact ask_field(const PiecePair& ids, const Pose& X_BT, Looks& looks,
                             const Wanted& wanted) const;
  PrimitiveContact meet_hole_end(const PiecePair& ids, const Pose& X_BT) const;
  PrimitiveContact corrected(PrimitiveContact found, const FieldView& fine) const;
  double support_against(const PiecePair& ids, const Vec3& n_T) const;
  Vec3 middle_of(const PiecePair& ids) const;

  const Case& case_;
  const Tool& tool_;
  std::vector<Primitive> to_field_;  ///< the tool to a field, in Tool
  std::vector<ToolStretch> stretches_;
  std::vector<double> piece_radius_;  ///< of the tool's pieces about its origin, m
  /// Of each bone felt as a field: of a wide band, for what is thicker than the fine one's.
  std::vector<std::shared_ptr<const DistanceField>> wide_;
  std::vector<const CutField*> cuts_;  ///< of each bone
  std::uint64_t cuts_given_ = 0;       ///< how often set_cuts was called
  const ToolGuide* guide_ = nullptr;
  BroadPhase broad_phase_;
  std::vector<PiecePair> pairs_;           ///< bone by bone, piece by piece
  std::vector<std::uint32_t> first_pair_;  ///< of each bone
  double tool_radius_ = 0;                 ///< about the tool's origin, m
};

}  // namespace osteon
