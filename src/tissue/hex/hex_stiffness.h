#pragma once

#include <Eigen/Core>

namespace osteon {

/// Stiffness of a trilinear cube of edge 1 and Young's modulus 1, by eight points of integration.
/// Corners x fastest, three axes each. A cube of edge h and modulus E has E h times as much.
Eigen::Matrix<double, 24, 24> unit_cube_stiffness(double poisson);

}  // namespace osteon
