#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>

#include "osteon/scene/build_case.h"
#include "osteon/session/session.h"

namespace osteon::testing {

/// Half of a box's size along each axis.
inline const Vec3 kBoxHalf(0.010, 0.008, 0.006);

inline TriMesh box_mesh(const Vec3& half) {
  TriMesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.vertices.push_back({(i & 1) ? half.x() : -half.x(), (i & 2) ? half.y() : -half.y(),
                             (i & 4) ? half.z() : -half.z()});
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

/// Two boxes side by side, `gap` apart along x; their tops lie at z = 6 mm.
inline std::shared_ptr<const Case> two_box_case(double gap = 0.004) {
  CaseDef def;
  def.name = "two boxes";
  for (int i = 0; i < 2; ++i) {
    BoneDef bone;
    bone.name = i == 0 ? "left" : "right";
    bone.X_WB.p = {i * (2 * kBoxHalf.x() + gap), 0, 0};
    bone.mesh = box_mesh(kBoxHalf);
    def.bones.push_back(bone);
  }
  auto built = build_case(std::move(def));
  if (!built) return nullptr;
  return std::make_shared<const Case>(std::move(*built));
}

/// The hand at tick `n`: comes down on the first box, presses 2 to 3 mm into it while it slides to
/// the second, and leaves. Every 701st sample is a fault of the device.
inline ToolInput hand_at(std::uint64_t n) {
  const double t = static_cast<double>(n) * 0.001;
  const double slide = std::min(1.0, std::max(0.0, (t - 0.3) / 2.0));
  const double down = std::min(1.0, t / 0.2) - std::min(1.0, std::max(0.0, (t - 2.6) / 0.2));
  ToolInput input;
  input.X_WD.p = {-0.005 + 0.034 * slide, 0.002 * std::sin(9 * t),
                  0.012 - 0.0085 * down + 0.0005 * std::sin(25 * t)};
  input.X_WD.q = Quat(1, 0.1 * std::sin(3 * t), 0.05, 0).normalized();
  input.v_W = {0.017 * (slide > 0 && slide < 1 ? 1.0 : 0.0), 0.018 * std::cos(9 * t), 0};
  input.buttons = n % 500 < 250 ? 1u : 0u;
  if (n % 701 == 0) input.X_WD.p.y() = std::nan("");
  return input;
}

/// What a user changes on the way.
inline Command command_at(std::uint64_t n) {
  switch (n) {
    case 401:
      return {CommandKind::kSetStiffness, 1200};
    case 777:
      return {CommandKind::kHoldBones, 1};
    case 1003:
      return {CommandKind::kHoldBones, 0};
    case 1101:
      return {CommandKind::kGrab, 150};
    case 1157:
      return {CommandKind::kGrab, 0};
    case 1300:
      return {CommandKind::kSetFrictionScale, 0.5};
    case 1500:
      return {CommandKind::kForceOff, 1};
    case 1600:
      return {CommandKind::kForceOff, 0};
    case 1700:
      return {CommandKind::kSetStiffness, -5};  // refused
    default:
      return {};
  }
}

inline SessionSettings moving_bones() {
  SessionSettings settings;
  settings.seed = 42;
  settings.physics.hold_bones = false;
  return settings;
}

/// A session in one thread, as a recording.
inline Recording record_one_thread(const std::shared_ptr<const Case>& the_case,
                                   const SessionSettings& settings, std::uint64_t ticks,
                                   std::uint64_t* final_hash = nullptr) {
  Session session(the_case, settings);
  Recording recording;
  recording.header = recording_header(*the_case, settings, "test", "0");
  for (std::uint64_t n = 1; n <= ticks; ++n) {
    (void)session.tick(hand_at(n), command_at(n));
    recording.ticks.push_back(session.last_tick_record());
    if (session.last_steps() > 0) recording.steps.push_back(session.last_step_record());
  }
  recording.complete = true;
  if (final_hash) *final_hash = session.state_hash();
  return recording;
}

/// Versions of a state's bytes before 36 had room for 8 bands: takes the words of the others out of
/// `bytes`, which are those of `saved` up to there. Something must be soft.
inline void erase_more_bands(std::string& bytes, const SessionState& saved) {
  constexpr std::size_t kBefore = 8, kWord = 8, kOfBand = 2, kOfTouch = 6;
  const std::string all = to_bytes(saved);
  const auto first_word = [&](const auto& change) {
    SessionState other = saved;
    change(other.world.softs);
    const std::string changed = to_bytes(other);
    const auto differ = std::mismatch(all.begin(), all.end(), changed.begin()).first;
    return static_cast<std::size_t>(differ - all.begin()) / kWord * kWord;
  };
  for (std::size_t h = kMaxHands; h-- > 0;)
    bytes.erase(first_word([&](SoftState& s) { s.hands[h].touches[kBefore].on = true; }),
                (kMaxBands - kBefore) * kOfTouch * kWord);
  // Of a band the word that it is torn stands before the one that it is lost.
  bytes.erase(first_word([](SoftState& s) { s.bands[kBefore].lost = true; }) - kWord,
              (kMaxBands - kBefore) * kOfBand * kWord);
}

}  // namespace osteon::testing
