#include "osteon/image/components.h"

#include <algorithm>
#include <numeric>

#include "osteon/base/union_find.h"
#include "runs.h"

namespace osteon {
namespace {

struct Span {
  std::size_t begin, end;  ///< of the runs of one row
};

/// Joins the runs of two neighbouring rows that share an i.
void join_rows(const std::vector<Run>& runs, Span a, Span b, UnionFind& sets) {
  for (std::size_t x = a.begin, y = b.begin; x < a.end && y < b.end;) {
    if (runs[x].begin < runs[y].end && runs[y].begin < runs[x].end)
      sets.join(runs[x].part, runs[y].part);
    runs[x].end < runs[y].end ? ++x : ++y;
  }
}

void find_runs(const Mask& mask, std::uint8_t value, int j, int k, std::vector<Run>& runs,
               UnionFind& sets) {
  const int width = mask.frame.size[0];
  const std::uint8_t* row = mask.values.data() + mask.frame.index(0, j, k);
  for (int i = 0; i < width;) {
    while (i < width && row[i] != value) ++i;
    if (i == width) break;
    const int begin = i;
    while (i < width && row[i] == value) ++i;
    runs.push_back({begin, i, j, k, sets.add()});
  }
}

void include(RunPart& part, const Run& run, const GridFrame& frame) {
  const std::array<int, 3> lo = {run.begin, run.j, run.k}, hi = {run.end, run.j + 1, run.k + 1};
  if (part.voxels == 0) part.box = {lo, hi};
  for (std::size_t a = 0; a < 3; ++a) {
    part.box.lo[a] = std::min(part.box.lo[a], lo[a]);
    part.box.hi[a] = std::max(part.box.hi[a], hi[a]);
    if (lo[a] == 0 || hi[a] == frame.size[a]) part.touches_rim = true;
  }
  part.voxels += static_cast<std::size_t>(run.end - run.begin);
}

}  // namespace

Parts connected_parts(const Mask& mask, std::uint8_t value) {
  Parts out;
  UnionFind sets;
  const int rows = mask.frame.size[1], slices = mask.frame.size[2];
  std::vector<Span> last(static_cast<std::size_t>(rows), Span{0, 0});
  for (int k = 0; k < slices; ++k)
    for (int j = 0; j < rows; ++j) {
      const auto at = static_cast<std::size_t>(j);
      Span here{out.runs.size(), 0};
      find_runs(mask, value, j, k, out.runs, sets);
      here.end = out.runs.size();
      if (j > 0) join_rows(out.runs, last[at - 1], here, sets);
      if (k > 0) join_rows(out.runs, last[at], here, sets);
      last[at] = here;
    }
  std::vector<std::uint32_t> number(out.runs.size(), 0);
  for (Run& run : out.runs) {
    const std::uint32_t root = sets.find(run.part);
    if (root == run.part) {
      number[root] = static_cast<std::uint32_t>(out.parts.size());
      out.parts.emplace_back();
    }
    run.part = number[root];
    include(out.parts[run.part], run, mask.frame);
  }
  return out;
}

std::vector<Component> label_components(const Mask& mask, std::size_t smallest_voxels,
                                        LabelVolume& labels) {
  const Parts found = connected_parts(mask, 1);
  std::vector<std::uint32_t> order(found.parts.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return found.parts[a].voxels > found.parts[b].voxels;
  });
  std::vector<std::uint16_t> label_of(found.parts.size(), 0);
  std::vector<Component> components;
  for (const std::uint32_t p : order) {
    if (found.parts[p].voxels < smallest_voxels || components.size() == kMostComponents) break;
    label_of[p] = static_cast<std::uint16_t>(components.size() + 1);
    components.push_back({label_of[p], found.parts[p].voxels, found.parts[p].box});
  }
  labels.frame = mask.frame;
  labels.values.assign(mask.frame.count(), 0);
  for (const Run& run : found.runs)
    if (const std::uint16_t label = label_of[run.part])
      std::fill_n(labels.values.begin() +
                      static_cast<std::ptrdiff_t>(mask.frame.index(run.begin, run.j, run.k)),
                  run.end - run.begin, label);
  return components;
}

}  // namespace osteon
