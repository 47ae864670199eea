#pragma once

#include <string>
#include <vector>

#include "osteon/physics/knee_laxity.h"

namespace osteon {

/// A test with what it found, and what the same knee gives with every ligament whole.
struct LaxityReport {
  LaxityTestRow test;
  KneeLaxity found;
  double whole_anterior_m = 0;
};

/// Of `osteon case laxity`: of one test an object, of several the list "tests".
std::string laxity_json(const std::string& case_name, const std::string& side,
                        const std::vector<LaxityReport>& reports);
std::string laxity_text(const std::vector<LaxityReport>& reports);

/// How far two knees go under one load, whole and without the anterior cruciate ligament.
struct LaxityBeside {
  std::string knee;
  double whole_m = 0, without_acl_m = 0;
};
std::string beside_json(const LaxityTestRow& test, const std::vector<LaxityBeside>& knees);
std::string beside_text(const LaxityTestRow& test, const std::vector<LaxityBeside>& knees);

/// Of `osteon case isometry`.
std::string isometry_json(const std::vector<LineLength>& lengths);
std::string isometry_text(const std::vector<LineLength>& lengths);

}  // namespace osteon
