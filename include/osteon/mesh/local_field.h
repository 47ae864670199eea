#pragma once

#include <memory>

#include "osteon/base/types.h"

namespace osteon {

/// A scalar field, negative inside, that can be looked at more closely: of many parts only a few
/// decide its value in a small place.
class LocalField {
 public:
  virtual ~LocalField() = default;

  virtual double at(const Vec3& p) const = 0;

  /// What is known of the points that are at most some radius from a centre.
  struct Near {
    int sign = 0;  ///< of all their values: 1 or -1; 0: not known
    /// There, the same values bit by bit, sooner. None: this field is as quick as can be.
    std::unique_ptr<const LocalField> field = {};
  };
  virtual Near near(const Vec3& center, double radius) const = 0;
};

}  // namespace osteon
