#include "osteon/procedure/report.h"

#include <algorithm>
#include <cmath>

#include "path_units.h"

namespace osteon {
namespace {

constexpr double kReservedSeconds = 600;

double finite_or_zero(double value) { return std::isfinite(value) ? value : 0; }

double length(const std::vector<Vec3>& points) {
  double sum = 0;
  for (std::size_t i = 1; i < points.size(); ++i) sum += (points[i] - points[i - 1]).norm();
  return sum;
}

std::vector<double> speeds(const std::vector<Vec3>& points, double rate_hz) {
  std::vector<double> speed;
  speed.reserve(points.size());
  for (std::size_t i = 1; i < points.size(); ++i)
    speed.push_back((points[i] - points[i - 1]).norm() * rate_hz);
  return speed;
}

void set_times(const Percentiles& durations, double& p50_us, double& p99_us, double& p999_us,
               double& max_us) {
  constexpr double kUsPerNs = 1e-3;
  p50_us = durations.quantile_ns(0.50) * kUsPerNs;
  p99_us = durations.quantile_ns(0.99) * kUsPerNs;
  p999_us = durations.quantile_ns(0.999) * kUsPerNs;
  max_us = durations.max_ns() * kUsPerNs;
}

}  // namespace

ReportBuilder::ReportBuilder(const Case& the_case, double tick_s, std::span<const Portal> portals)
    : case_(&the_case),
      tick_s_(tick_s),
      stride_(static_cast<std::uint64_t>(std::max(1.0, std::round(1 / (kPathRateHz * tick_s))))),
      tallies_(the_case.bones.size()) {
  for (const Portal& portal : portals) {
    portals_.push_back({portal.name, 0, 0});
    to_make_.push_back(portal.made != kNotMade);
  }
  portal_ticks_.resize(portals_.size());
  events_.resize(event_table().size());
  path_100hz_.reserve(static_cast<std::size_t>(kReservedSeconds * kPathRateHz));
}

void ReportBuilder::add(const ToolState& tool) {
  add_contacts(tool);
  add_portal(tool.portal);
  add_position(tool.X_WP.p);
  ++ticks_;
}

void ReportBuilder::add_contacts(const ToolState& tool) {
  const std::size_t count = std::min<std::size_t>(tool.contact_count, kMaxContacts);
  for (std::size_t i = 0; i < count; ++i) {
    const BoneId bone = tool.contacts[i].bone;
    const auto same_bone = [&](const Contact& c) { return c.bone == bone; };
    const auto* begin = tool.contacts.data();
    // A bone is tallied once a tick, with its first contact.
    if (bone.index >= tallies_.size() || std::any_of(begin, begin + i, same_bone)) continue;
    Vec3 force_W = Vec3::Zero();
    double depth_m = 0;
    for (std::size_t j = i; j < count; ++j) {
      const Contact& contact = tool.contacts[j];
      if (contact.bone != bone) continue;
      if (is_finite(contact.force_on_tool_W)) force_W += contact.force_on_tool_W;
      depth_m = std::max(depth_m, finite_or_zero(contact.depth_m));
    }
    BoneTally& tally = tallies_[bone.index];
    if (tally.contact_ticks++ == 0) tally.first_s = tool.time_s;
    const double force_n = force_W.norm();
    tally.sum_n += force_n;
    tally.peak_n = std::max(tally.peak_n, force_n);
    tally.deepest_m = std::max(tally.deepest_m, depth_m);
  }
}

void ReportBuilder::add_portal(std::uint32_t portal) {
  const bool entered = portal != portal_;
  portal_ = portal;
  if (portal >= portals_.size()) return;
  portals_[portal].time_s = static_cast<double>(++portal_ticks_[portal]) * tick_s_;
  portals_[portal].times_entered += entered ? 1 : 0;
}

void ReportBuilder::add(const Event& event) {
  const auto table = event_table();
  if (const EventKindRow* row = find_event_kind(event.kind))
    ++events_[static_cast<std::size_t>(row - table.data())];
}

void ReportBuilder::add_position(const Vec3& p_WP) {
  if (is_finite(p_WP)) last_p_WP_ = p_WP;
  if (ticks_ % stride_ == 0) path_100hz_.push_back(last_p_WP_);
}

Report ReportBuilder::finish() const {
  Report report;
  report.case_name = case_->name;
  report.case_hash = case_->hash;
  report.ticks = ticks_;
  report.duration_s = static_cast<double>(ticks_) * tick_s_;
  for (std::size_t i = 0; i < tallies_.size(); ++i) {
    const BoneTally& tally = tallies_[i];
    const auto contact_ticks = static_cast<double>(tally.contact_ticks);
    report.bones.push_back({case_->bones[i].name, tally.first_s, contact_ticks * tick_s_,
                            tally.peak_n, contact_ticks > 0 ? tally.sum_n / contact_ticks : 0,
                            tally.deepest_m * 1000});
  }
  for (std::size_t i = 0; i < portals_.size(); ++i)
    if (!to_make_[i] || portals_[i].times_entered > 0) report.portals.push_back(portals_[i]);
  for (std::size_t i = 0; i < events_.size(); ++i)
    if (events_[i] > 0) report.events[std::string(event_table()[i].name)] = events_[i];
  const double rate_hz = 1 / (static_cast<double>(stride_) * tick_s_);
  report.path_length_mm = length(path_100hz_) * 1000;
  // The ticks after the last whole sample belong to the way, but not to an even sampling.
  if (!path_100hz_.empty())
    report.path_length_mm += (last_p_WP_ - path_100hz_.back()).norm() * 1000;
  report.smoothness_sparc = sparc(speeds(path_100hz_, rate_hz), rate_hz);
  return report;
}

void set_tick_times(Report& report, const Percentiles& durations) {
  set_times(durations, report.tick_p50_us, report.tick_p99_us, report.tick_p999_us,
            report.tick_max_us);
}

void set_step_times(Report& report, const Percentiles& durations) {
  set_times(durations, report.step_p50_us, report.step_p99_us, report.step_p999_us,
            report.step_max_us);
}

}  // namespace osteon
