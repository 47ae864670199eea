#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "contact_field.h"
#include "nearest_point.h"
#include "osteon/base/types.h"

namespace osteon {

/// The bones near the tool that are felt as distance fields, in one tick. A field's plane holds
/// close to the place where it was found only. So the proxy's way is looked at as well (sphere
/// tracing, Hart 1996), and in a hollow a pair keeps some planes of places that it came from: a
/// god-object on an implicit surface (Salisbury and Tarr, "Haptic rendering of surfaces defined by
/// implicit functions", 1997).
class FieldWalls {
 public:
  static constexpr std::size_t kPlanesEach = 3;
  static constexpr std::size_t kMostPlanes = 24;
  /// Looks at carved bones after which a tick ends its search: the proxy stays where it has come
  /// to, and goes on in the next. The way to there was looked at, so this costs time alone.
  static constexpr std::uint32_t kMostLooks = 100;

  explicit FieldWalls(const ContactField& field) : field_(field) {}

  /// Forgets all planes and takes the fields of `near`.
  void start(const CandidateList& near);
  /// Finds the planes of the fields that come near the tool at a pose. Older ones stay where bone
  /// reaches over the newer one. False when a field could not be asked, or too many are near.
  bool look(std::span<const Pose> X_WB, const Pose& X_WT);
  /// The same a little further on, where the last way was blocked: there the bone in the way is
  /// nearest, though at the way's end a wall beside it may be as near.
  bool look_ahead(std::span<const Pose> X_WB, const Quat& q_WT) {
    return look(X_WB, {blocked_.p_W, q_WT});
  }
  /// Whether bone ended the last way.
  bool is_blocked() const { return blocked_.by != kNoPair; }
  std::uint32_t blocked_by() const { return blocked_.by; }
  /// The place of the bone that ended the last way. False: none did, or it could not be asked.
  bool blocking(std::span<const Pose> X_WB, const Quat& q_WT, PartingPlane& out);
  /// Whether the tool has its skin's room to every field.
  bool clear(std::span<const Pose> X_WB, const Pose& X_WT);
  /// Whether this tick has looked as often as it may.
  bool spent() const { return looks_.asked >= kMostLooks; }
  /// The last free place on the straight way: `to` unless bone is in between. What was overlapped
  /// before may stay so, but no deeper. Looked at every 50 um and closer: a bone bends by less than
  /// 3 um into such a stretch at the sharpest edge that a field's cells can hold. Where the tick
  /// has looked as often as it may, a place before that.
  Vec3 way(std::span<const Pose> X_WB, const Quat& q_WT, const Vec3& from_W, const Vec3& to_W);

  std::uint32_t count() const { return count_; }
  std::uint32_t pair(std::uint32_t i) const { return walls_[i].pair; }
  const PartingPlane& plane(std::uint32_t i) const { return walls_[i].plane; }
  void raise(std::span<const Pose> X_WB, const Quat& q_WT, std::span<FreeHalfSpace> out) const;

 private:
  static constexpr std::uint32_t kNoPair = 0xffffffffu;
  struct Wall {
    std::uint32_t pair = 0;
    PartingPlane plane;
  };
  const Pose& bone_pose(std::uint32_t pair, std::span<const Pose> X_WB) const {
    return X_WB[field_.pairs()[pair].bone];
  }
  std::span<const std::uint32_t> fields() const { return {fields_.data(), field_count_}; }
  struct Nearest {
    double gap = std::numeric_limits<double>::infinity();
    std::uint32_t pair = kNoPair;
  };
  /// Where the least gap was found last: the same place is often asked for again.
  struct Known {
    bool set = false;
    Pose X_WT;
    std::array<Pose, kMaxFields> X_WB;  ///< of each field
    Nearest found;
  };
  /// What this tick has found of a field: its gap, or a bound below it.
  struct Seen {
    Pose X_BT;
    double gap = -std::numeric_limits<double>::infinity();
    LowPlaces places;  ///< of a box
  };
  struct Blocked {
    std::uint32_t by = kNoPair;
    Vec3 p_W = Vec3::Zero();  ///< of the tool: the first place found without room
  };

  /// Of a gap below `low_m` a bound below that may be told; it is not kept then.
  Nearest nearest(std::span<const Pose> X_WB, const Pose& X_WT,
                  double low_m = -std::numeric_limits<double>::infinity());
  bool knows(std::span<const Pose> X_WB, const Pose& X_WT) const;
  void keep(std::span<const Pose> X_WB, const Pose& X_WT, const Nearest& found);
  bool is_carved() const { return looks_.asked > 0; }
  /// By how much any point of the tool has moved beside a field's bone since it was asked, at most.
  double moved_m(std::size_t field, const Pose& X_BT) const;
  /// A field's gap is no less than this after such a way, by what this tick has found of it; minus
  /// infinity where it has found nothing.
  double least_gap(std::size_t field, double moved_m) const;
  void note_gap(std::size_t field, const Pose& X_BT, double gap) {
    seen_[field].X_BT = X_BT;
    seen_[field].gap = gap;
  }
  /// Takes a plane that is nearer to the tool than the bone is back to its gap.
  void lay_back(std::uint32_t pair, const Pose& X_WB, const Pose& X_WT, PartingPlane& plane) const;
  bool has_wall(std::uint32_t pair) const;
  bool still_right(const Wall& wall, const PartingPlane& now, const Pose& X_WB,
                   const Pose& X_WT) const;

  const ContactField& field_;
  std::array<std::uint32_t, kMaxFields> fields_{};
  std::uint32_t field_count_ = 0;
  std::array<Wall, kMostPlanes> walls_{};
  std::array<Wall, kMostPlanes> next_{};  ///< for look
  std::uint32_t count_ = 0;
  MetBefore before_;
  std::array<Seen, kMaxFields> seen_;  ///< of each field
  ContactField::Looks looks_;          ///< of this tick
  Known known_;
  Blocked blocked_;  ///< of the last way
};

}  // namespace osteon
