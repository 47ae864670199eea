#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "osteon/session/cuts_feed.h"
#include "runs/pictures/carved_picture.h"

namespace osteon {

/// How the bones of a repeated recording were carved, by time: what a picture at any moment of it
/// shows. Of a block that goes on changing it keeps a state every tenth of a second.
class CutHistory {
 public:
  /// In the order of time.
  void add(const CutsPatch& patch, double time_s);
  bool empty() const { return kept_.empty(); }

  /// Brings the picture to a moment, from the moment `place` that it shows (0: nothing yet), and
  /// returns the new place.
  std::size_t show(double time_s, std::size_t place, CarvedPicture& picture) const;

 private:
  struct Kept {
    double time_s = 0;
    CutsPatch patch;
  };
  struct Warmed {
    double time_s = 0;
    HeatPulse pulse;
  };
  std::vector<Kept> kept_;
  std::vector<Warmed> heat_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> newest_;  ///< of a bone's block
};

}  // namespace osteon
