#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "osteon/tissue/sheet_work.h"

namespace osteon {

/// The lips of a sheet's cuts and how they give way to forces in its plane: to each newton on each
/// of their vertices, all others. What holds a cut open is solved with these alone.
class SheetLips {
 public:
  static constexpr std::size_t kMost = 96;  ///< of their vertices; cuts beyond are not held open

  /// One of the two sides of a cut edge. `out`, of each end: unit, from the groove into the skin,
  /// the mean of the sides that meet there.
  struct Side {
    std::array<std::uint32_t, 2> lip{};
    std::array<SheetPoint, 2> out{};
  };
  struct Edge {
    SheetPoint a = SheetPoint::Zero(), way = SheetPoint::Zero();  ///< before it opened
    std::array<Side, 2> sides;  ///< their ends in the order of the edge
    std::uint32_t slit = 0;     ///< edges that hang together are one
  };
  struct End {
    std::uint32_t lip = 0;
    SheetPoint at = SheetPoint::Zero();   ///< before the slit opened
    SheetPoint out = SheetPoint::Zero();  ///< unit, along the slit, out of it
    std::uint32_t slit = 0;
  };

  std::span<const Edge> edges() const { return edges_; }
  std::span<const End> ends() const { return ends_; }
  std::size_t count() const { return copy_.size(); }
  std::uint32_t copy(std::size_t lip) const { return copy_[lip]; }
  /// Where tension has left it: what is pushed moves from there.
  const SheetPoint& rest(std::size_t lip) const { return rest_[lip]; }
  /// m for each newton.
  Eigen::Matrix2d yields(std::size_t lip, std::size_t pushed) const;

 private:
  friend class LipWork;
  std::vector<std::uint32_t> copy_;
  std::vector<SheetPoint> rest_;
  std::vector<Edge> edges_;
  std::vector<End> ends_;
  std::vector<double> yields_;  ///< of each pushed lip, along x and y: the ways of all
};

/// Makes them from a sheet's balance in pieces: one solution a call.
class LipWork {
 public:
  explicit LipWork(std::shared_ptr<const SheetYield> yields);
  /// True: it is done, and `take` gives it.
  bool step();
  std::unique_ptr<const SheetLips> take() { return std::move(out_); }

 private:
  std::shared_ptr<const SheetYield> from_;
  std::unique_ptr<SheetLips> out_ = std::make_unique<SheetLips>();
  SheetScratch scratch_;
  std::vector<SheetPoint> ways_;
  std::size_t done_ = 0;
};

/// What stands in a groove, cut by the plane of the skin.
struct LipDisc {
  SheetPoint at = SheetPoint::Zero();
  double radius_m = 0;
  std::uint32_t hand = 0;
};

/// A disc on a lip: between two of its vertices, or at the end of a slit.
struct LipPush {
  std::array<std::uint32_t, 2> lip{};
  std::array<double, 2> share{};
  SheetPoint out = SheetPoint::Zero();  ///< unit: so the lip is pushed
  double deep_m = 0;                    ///< by so much the disc stands over the lip at rest
  double force_n = 0;
  double moved_m = 0;                  ///< how far the lip goes, along `out`
  SheetPoint at = SheetPoint::Zero();  ///< before the slit opened
  std::uint32_t hand = 0;
};
struct LipPushes {
  static constexpr std::size_t kMost = 48;
  std::uint32_t count = 0;
  std::array<LipPush, kMost> all{};
  std::span<const LipPush> list() const { return {all.data(), count}; }
};

/// The balance of the lips about the discs: each is pushed as far as a disc stands over it, less
/// what its own skin yields there, and no disc pulls. Allocates nothing; of more contacts than
/// there is room for the first count.
void press_lips(const SheetLips& lips, std::span<const LipDisc> discs, double surface_n_per_m,
                LipPushes& out);

/// How far a lip goes at a place between two of its vertices, under all those pushes.
SheetPoint lip_way(const SheetLips& lips, const LipPushes& pushes, std::size_t lip);

}  // namespace osteon
