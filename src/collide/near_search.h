#pragma once

#include "block_scan.h"
#include "osteon/collide/near_list.h"

namespace osteon {

/// most_exceeded, by the listed planes alone where those serve. A list that does not is dropped.
Excess most_exceeded(const ConvexBody& body, const Vec3& u, double floor, NearList& near);

/// support, likewise.
double support(const ConvexBody& body, const Vec3& n, NearList& near);

/// Lists the planes near the most exceeded one anew where there is no list. No plane is exceeded by
/// more than `level`. Costs about as much as a search, so worth it where the next one will be like
/// this.
void list_planes(const ConvexBody& body, const Vec3& u, double level, NearList& near);

/// Lists the vertices near the highest one, `top`, anew where there is no list.
void list_vertices(const ConvexBody& body, const Vec3& n, double top, NearList& near);

}  // namespace osteon
