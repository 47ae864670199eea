#include "loops/path_player.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "loops/path_hand.h"

namespace osteon {
namespace {

constexpr double kShareOfWorkspace = 0.9;  // the hand overshoots a little
constexpr double kAtStart_m = 0.001;

DeviceMapping mapping_of(const ProbePath& path, const Vec3& workspace_m) {
  DeviceMapping mapping;
  mapping.X_WV.q = path.samples.front().X_WD.q;
  const Quat q_VW = mapping.X_WV.q.conjugate();
  Aabb box_V;
  for (const PathSample& s : path.samples) box_V.include(q_VW * s.X_WD.p);
  mapping.X_WV.p = mapping.X_WV.q * box_V.center();
  for (int i = 0; i < 3; ++i)
    if (workspace_m[i] > 0)
      mapping.scale =
          std::max(mapping.scale, box_V.extent()[i] / (kShareOfWorkspace * workspace_m[i]));
  return mapping;
}

bool is_a_pose(const DeviceSample& sample) {
  return sample.connected && sample.calibrated && sample.refusal == ForceOff::kNone;
}

}  // namespace

PathPlayer::PathPlayer(std::unique_ptr<HapticDevice> device, EmulatedUser& user, ProbePath path)
    : device_(std::move(device)),
      user_(user),
      path_(closed_path(std::move(path))),
      mapping_(mapping_of(path_, device_->info().workspace_m)),
      period_s_(1 / device_->info().rate_hz) {}

Result<std::unique_ptr<PathPlayer>> PathPlayer::make(std::unique_ptr<HapticDevice> device,
                                                     ProbePath path) {
  auto* user = dynamic_cast<EmulatedUser*>(device.get());
  if (!user)
    return fail("this device is held by a real hand and cannot play a path", device->info().name,
                "Choose a virtual device");
  std::unique_ptr<PathPlayer> player(new PathPlayer(std::move(device), *user, std::move(path)));
  if (auto ok = player->go_to_start(); !ok) return tl::unexpected(ok.error());
  return player;
}

Result<void> PathPlayer::go_to_start() {
  constexpr int kMostReads = 3000;
  constexpr int kStill = 50;
  int still = 0;
  for (int i = 0; i < kMostReads && still < kStill; ++i) {
    const DeviceSample sample = read_at_start();
    const Vec3 away = sample.X_VD.p - path_.samples.front().X_WD.p;
    const bool there = is_a_pose(sample) && away.norm() < kAtStart_m * mapping_.scale;
    still = there ? still + 1 : 0;
  }
  if (still == kStill) return {};
  return fail("the emulated hand does not reach the path's start", info().name,
              "Choose another device or path");
}

DeviceSample PathPlayer::to_world(const DeviceSample& sample_V) const {
  DeviceSample sample = sample_V;
  sample.X_VD = mapping_.to_world(sample_V.X_VD);
  sample.v_V = mapping_.X_WV.q * (mapping_.scale * sample_V.v_V);
  sample.w_V = mapping_.X_WV.q * sample_V.w_V;
  return sample;
}

DeviceSample PathPlayer::read_at_start() {
  user_.set_target(mapping_.to_device(path_.samples.front().X_WD), Vec3::Zero(), 0);
  return to_world(device_->read());
}

DeviceSample PathPlayer::read() {
  const double start_s = path_.samples.front().time_s;
  const double length_s = std::max(period_s_, path_.samples.back().time_s - start_s);
  const double t = start_s + std::fmod(static_cast<double>(ticks_++) * period_s_, length_s);
  const PathSample wanted = path_.at(t);
  const Pose now_VD = mapping_.to_device(wanted.X_WD);
  const Pose next_VD = mapping_.to_device(path_.at(t + period_s_).X_WD);
  user_.set_target(now_VD, (next_VD.p - now_VD.p) / period_s_, wanted.button ? 1u : 0u);
  return to_world(device_->read());
}

void PathPlayer::write_force(const Vec3& force_W) {
  device_->write_force(mapping_.force_to_device(force_W));
}

}  // namespace osteon
