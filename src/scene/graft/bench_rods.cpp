#include "osteon/scene/bench_rods.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "graft_form.h"

namespace osteon {
namespace {

using Rod = BenchRod::Is;
using Rods = std::vector<BenchRod>;

// The form of the bench, m (assets/anatomy/graft_bench.toml): how deep a tendon lies below its
// block's surface, and where the table's is below the place at which a clamp takes a free end.
constexpr double kDeep_m = 0.008, kTableBelow_m = 0.012;
// How far the middle of what lies under the skin stands over it.
constexpr double kRidge_m = 0.0008;
constexpr double kMuscle_m = 0.030;                       // of the free end, that a blade scrapes
constexpr double kRow_m = 0.105, kBetweenRows_m = 0.012;  // of a tendon that is laid to and fro
constexpr double kBandLong_m = 0.010, kBandRadius_m = 0.0012, kBandGap_m = 0.004;
constexpr double kTail_m = 0.030;  // of thread, out of the strands
constexpr double kLip_m = 0.0026, kLipRadius_m = 0.0009, kInkRadius_m = 0.0007;
constexpr double kSlitRadius_m = 0.0024, kSlitOver_m = 0.0003;  // sunk but for so much
constexpr double kLoopHigh_m = 0.004, kLoopHalf_m = 0.014;      // of a tendon that was found
constexpr double kFromLine_m = 0.004;  // the graft begins so far after its line
constexpr int kRingPieces = 8;

const Vec3 kUp = Vec3::UnitZ();

double radius_of(double area_m2) { return std::sqrt(area_m2 / std::numbers::pi); }

// Unit, level, across `along` and away from `other`.
Vec3 outward(const Vec3& from, const Vec3& other, const Vec3& along) {
  const Vec3 across = kUp.cross(along);
  return (from - other).dot(across) < 0 ? Vec3(-across) : across;
}

void add_line(Rod is, std::span<const Vec3> points, double radius_m, Rods& out) {
  for (std::size_t i = 1; i < points.size(); ++i)
    out.push_back({is, points[i - 1], points[i], radius_m});
}

// A band leaves the tendon sideways; one that was cut has a gap.
void add_band(const Vec3& from, const Vec3& outward, bool cut, Rods& out) {
  const double half = 0.5 * (kBandLong_m - kBandGap_m);
  if (!cut) return out.push_back({Rod::kBand, from, from + kBandLong_m * outward, kBandRadius_m});
  out.push_back({Rod::kBand, from, from + half * outward, kBandRadius_m});
  out.push_back({Rod::kBand, from + (kBandLong_m - half) * outward, from + kBandLong_m * outward,
                 kBandRadius_m});
}

// Ink where the fascia is whole, two lips where it is open.
void add_fascia(const GraftBenchPlan& plan, const GraftBenchState& s, Rods& out) {
  if (!plan.is_covered()) return;
  const Vec3 step = (plan.fascia_to_W - plan.fascia_from_W) / kFasciaCells;
  const Vec3 lip = kLip_m * plan.fascia_across_W();
  for (std::uint32_t k = 0, from = 0; k < kFasciaCells; ++k) {
    const bool open = (s.slit >> k & 1u) != 0;
    const bool goes_on = k + 1 < kFasciaCells && ((s.slit >> (k + 1) & 1u) != 0) == open;
    if (goes_on) continue;
    const Vec3 a = plan.fascia_from_W + from * step, b = plan.fascia_from_W + (k + 1) * step;
    from = k + 1;
    if (!open) {
      out.push_back({Rod::kMark, a, b, kInkRadius_m});
      continue;
    }
    for (const double side : {-1.0, 1.0})
      out.push_back({Rod::kFascia, a + side * lip, b + side * lip, kLipRadius_m});
    const Vec3 sunk = (kSlitOver_m - kSlitRadius_m) * plan.fascia_up_W();
    out.push_back({Rod::kSlit, a + sunk, b + sunk, kSlitRadius_m});
  }
}

// A tendon that was found lies in a loop out of the slit; jaws that hold it lift it.
void add_loop(const GraftBenchPlan& plan, const GraftBenchState& s, std::size_t t, Rods& out) {
  if (!plan.is_covered()) return;
  double high = s.tendons[t].found ? kLoopHigh_m : 0;
  Vec3 top = found_at_W(plan, t);
  for (const BenchHand& hand : s.hands)
    if (hand.lifts == 1 + t && hand.front_m > high) {
      high = hand.front_m;
      top = hand.from_W;
    }
  if (!(high > 0)) return;
  const Vec3 along = kLoopHalf_m * plan.tendons[t].along_W;
  const Vec3 points[] = {top - along, Vec3(top + high * plan.fascia_up_W()), top + along};
  add_line(Rod::kTendon, points, radius_of(plan.tendons[t].measures.area_m2), out);
}

// In the thigh, from `from_m` on: its course shows through the skin, and what is freed lies open.
void add_in_thigh(const GraftBenchPlan& plan, std::size_t t, const TendonOnBench& is, double from_m,
                  Rods& out) {
  const GraftBenchPlan::Tendon& tendon = plan.tendons[t];
  const Vec3 way = outward(tendon.insertion_W, plan.tendons[1 - t].insertion_W, tendon.along_W);
  const double radius = radius_of(tendon.measures.area_m2);
  const auto at = [&](double s) -> Vec3 {
    return tendon.insertion_W + s * tendon.along_W + (kDeep_m + kRidge_m) * kUp;
  };
  const double freed = std::clamp(is.front_m, from_m, tendon.measures.length_m);
  if (!is.stripped && freed > from_m) out.push_back({Rod::kTendon, at(from_m), at(freed), radius});
  if (freed < tendon.measures.length_m)
    out.push_back({Rod::kUnderSkin, at(freed), at(tendon.measures.length_m), 0.6 * radius});
  for (std::uint32_t b = 0; b < tendon.measures.bands; ++b)
    if (tendon.measures.bands_m[b] >= from_m)
      add_band(at(tendon.measures.bands_m[b]), way, (is.bands_cut >> b & 1u) != 0, out);
}

// To and fro on the table, in rows that are joined by half circles.
class Laid {
 public:
  Laid(const Vec3& free, const Vec3& along, const Vec3& outward)
      : free_(free), along_(along), aside_(outward) {}
  // At `s` along it from the free end.
  Vec3 at(double s) const {
    const double row = std::floor(std::max(0.0, s) / kEach_m), in_row = s - row * kEach_m;
    const bool back = std::fmod(row, 2) != 0;
    const Vec3 begin = free_ + (back ? kRow_m : 0) * along_ + row * kBetweenRows_m * aside_;
    const Vec3 way = back ? Vec3(-along_) : along_;
    if (in_row <= kRow_m) return begin + in_row * way;
    const double angle = (in_row - kRow_m) / kTurn_m * std::numbers::pi;
    const double radius = 0.5 * kBetweenRows_m;
    return begin + (kRow_m + radius * std::sin(angle)) * way +
           radius * (1 - std::cos(angle)) * aside_;
  }
  // A row is one rod; a half circle is several.
  void add(Rod is, double from, double to, double radius_m, Rods& out) const {
    std::vector<Vec3> points{at(from)};
    for (double s = from; s < to;) {
      const double in_row = std::fmod(s, kEach_m), row = s - in_row;
      const bool straight = in_row < kRow_m - kLeast_m;
      s = std::min(to, straight ? row + kRow_m : s + kTurn_m / kTurnPieces);
      points.push_back(at(s));
    }
    add_line(is, points, radius_m, out);
  }

 private:
  static constexpr double kTurn_m = 0.5 * std::numbers::pi * kBetweenRows_m;
  static constexpr double kEach_m = kRow_m + kTurn_m, kLeast_m = 1e-6;
  static constexpr int kTurnPieces = 8;
  Vec3 free_, along_, aside_;
};

void add_stitches(const GraftBenchPlan& plan, std::size_t t, const TendonOnBench& is, double lift_m,
                  double radius, const Vec3& outward, Rods& out) {
  const Vec3 half = 1.25 * radius * outward;
  Vec3 last = Vec3::Zero();
  bool any = false;
  for (std::uint32_t k = 0; k < kMostStitches; ++k) {
    if ((is.stitches >> k & 1u) == 0) continue;
    const Vec3 at = stitch_W(plan, t, k) + (lift_m + 0.9 * radius) * kUp;
    out.push_back({Rod::kThread, at - half, at + half, kThreadRadius_m});
    if (any) out.push_back({Rod::kThread, last + half, at - half, kThreadRadius_m});
    last = at;
    any = true;
  }
}

void add_on_table(const GraftBenchPlan& plan, std::size_t t, const TendonOnBench& is,
                  double length_m, Rods& out) {
  const GraftBenchPlan::Tendon& tendon = plan.tendons[t];
  const Vec3 way = outward(tendon.free_W, plan.tendons[1 - t].free_W, tendon.lies_W);
  const double radius = radius_of(tendon.measures.area_m2), left = is.muscle_left();
  const double lift = radius - kTableBelow_m;
  const Laid laid(tendon.free_W + lift * kUp, tendon.lies_W, way);
  laid.add(Rod::kTendon, 0, length_m, radius, out);
  if (left > 0)
    laid.add(Rod::kMuscle, 0, std::min(kMuscle_m, length_m), (0.6 + 0.8 * left) * radius, out);
  add_stitches(plan, t, is, lift, radius, way, out);
}

// Strands side by side in a bundle along the graft's line, and folds at its begin.
struct Bundle {
  Vec3 begin, axis, across, up;
  double radius_m = 0, strand_m = 0;
  std::uint32_t strands = 1;
  Vec3 offset(std::uint32_t k) const {
    if (strands < 2) return Vec3::Zero();
    const double angle = 2 * std::numbers::pi * (k + 0.5) / strands;
    return (radius_m - strand_m) * (std::cos(angle) * across + std::sin(angle) * up);
  }
};

Bundle bundle_of(const GraftBenchPlan& plan, const Graft& graft) {
  Bundle out;
  out.axis = (plan.graft_to_W - plan.graft_from_W).normalized();
  out.across = kUp.cross(out.axis).normalized();
  out.up = out.axis.cross(out.across);
  out.begin = plan.graft_from_W + kFromLine_m * out.axis;
  out.radius_m = 0.5 * graft.diameter_m;
  out.strands = std::max(1u, graft.strands);
  out.strand_m = out.radius_m * std::sqrt(kBundleFilled / out.strands);
  return out;
}

void add_strands(const Bundle& is, double length_m, Rods& out) {
  constexpr int kBends = 4;
  for (std::uint32_t k = 0; k < is.strands; ++k) {
    const Vec3 from = is.begin + is.offset(k);
    out.push_back({Rod::kTendon, from, from + length_m * is.axis, is.strand_m});
    if (k % 2 != 0 || k + 1 == is.strands) continue;
    const Vec3 middle = 0.5 * (from + is.begin + is.offset(k + 1)), half = from - middle;
    std::vector<Vec3> fold;
    for (int i = 0; i <= kBends; ++i) {
      const double angle = std::numbers::pi * i / kBends;
      fold.push_back(middle + std::cos(angle) * half - half.norm() * std::sin(angle) * is.axis);
    }
    add_line(Rod::kTendon, fold, is.strand_m, out);
  }
}

// Thread round the strands' ends, and out of them.
void add_whipstitch(const Bundle& is, double length_m, std::uint32_t passes, Rods& out) {
  const Vec3 end = is.begin + length_m * is.axis;
  for (std::uint32_t k = 0; k < passes; ++k) {
    std::vector<Vec3> ring;
    for (int i = 0; i <= kRingPieces; ++i) {
      const double angle = 2 * std::numbers::pi * i / kRingPieces;
      const double back = 0.003 + kStitchApart_m * (k + static_cast<double>(i) / kRingPieces);
      ring.push_back(end - back * is.axis +
                     is.radius_m * (std::cos(angle) * is.across + std::sin(angle) * is.up));
    }
    add_line(Rod::kThread, ring, kThreadRadius_m, out);
  }
  if (passes == 0) return;
  for (const double side : {-0.5, 0.5}) {
    const Vec3 from = end + side * is.radius_m * is.across;
    out.push_back({Rod::kThread, from, from + kTail_m * (is.axis - 0.15 * is.up), kThreadRadius_m});
  }
}

void add_button(const Bundle& is, double loop_m, Rods& out) {
  if (!(loop_m > 0)) return;
  const Vec3 end = is.begin - loop_m * is.axis, half = 0.4 * is.radius_m * is.across;
  for (const double side : {-1.0, 1.0})
    out.push_back({Rod::kLoop, is.begin + side * half, end + 0.5 * side * half, kLoopRadius_m});
  out.push_back({Rod::kButton, end - kFlipRoom_m * is.across, end + kFlipRoom_m * is.across,
                 kButtonRadius_m});
}

bool hangs_in_knee(const BoneSnapshot& bones) {
  return bones.placing.on && bones.placing.phase >= PlacingPhase::kThreadOut;
}

}  // namespace

std::vector<BenchRod> bench_rods(const GraftBenchPlan& plan, const BoneSnapshot& bones) {
  const GraftBenchState& s = bones.bench;
  Rods out;
  if (!s.on) return out;
  add_fascia(plan, s, out);
  for (std::size_t t = 0; t < kGraftTendons; ++t) {
    const TendonOnBench& is = s.tendons[t];
    const auto got = harvested(plan, s, t);
    if (!got) add_in_thigh(plan, t, is, 0, out);
    if (!got) add_loop(plan, s, t, out);
    if (got && got->amputated) add_in_thigh(plan, t, is, got->length_m, out);
    if (got && is.folds == 0) add_on_table(plan, t, is, got->length_m, out);
  }
  const auto graft = graft_on(plan, s);
  if (!graft || hangs_in_knee(bones)) return out;
  const Bundle bundle = bundle_of(plan, *graft);
  add_strands(bundle, graft->length_m, out);
  add_whipstitch(bundle, graft->length_m, fewest_passes(s), out);
  add_button(bundle, s.loop_m, out);
  return out;
}

}  // namespace osteon
