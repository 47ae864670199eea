#include "window/controllers/views/moving_detail.h"

namespace osteon {

void MovingDetail::took(double picture_s) {
  slow_ = picture_s > kLongest_s ? slow_ + 1 : 0;
  quick_ = picture_s < kShortest_s ? quick_ + 1 : 0;
  if (slow_ >= kInARow && step_ + 1 < kShares.size()) {
    ++step_;
    slow_ = 0;
  }
  if (quick_ >= kInARow && step_ > 0) {
    --step_;
    quick_ = 0;
  }
}

}  // namespace osteon
