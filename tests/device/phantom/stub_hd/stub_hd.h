#pragma once

#include <cstdint>

/// The tests' side of the stub libHD.so. Two arms, each held by an emulated hand; a virtual clock
/// that only `stub_hd_step` moves. Found by dlsym beside the library's own calls.
struct StubArm {
  // What the hand and the world do; set by the test.
  double wanted_p_mm[3];
  double wanted_q[4];  ///< w, x, y, z
  double wanted_v_mm_per_s[3];
  double hand_mass_kg, grip_n_per_m, grip_n_s_per_m;
  int buttons;
  bool switch_held;
  bool inkwell;  ///< the switch that feels the stylus there
  bool plugged;
  bool frozen;   ///< the arm's state is not read anew: BeginFrame leaves the last one
  int garbage;   ///< 0 none, 1 not a number, 2 a matrix that is no rotation, 3 far away
  double speed;  ///< not 0: the velocity told, mm/s along x
  double temperature;
  unsigned calibration;       ///< what hdCheckCalibration tells
  unsigned after_update;      ///< what it tells after hdUpdateCalibration
  unsigned raise;             ///< an error put on the stack by the next BeginFrame; then 0
  unsigned refuse_init;       ///< an error with which hdInitDevice fails; 0: it works
  bool force_off_on_error;    ///< as the library does after a force error
  bool quiet;                 ///< knows none of the questions about itself
  unsigned calibration_style; /* bits */
  int output_dof;             ///< 6: the stylus' rotations have motors

  // What it is; set before it is opened.
  const char* model;
  double max_force_n, max_continuous_n, max_stiffness_n_per_mm;
  double encoder_mm;  ///< steps in which a position is told; 0: exact
  double dac_n;       ///< steps in which a force is put out; 0: exact

  // What happened; read by the test.
  double motor_n[3];  ///< what the motors push with now
  double peak_motor_n;
  double motor_nmm[3];  ///< what they turn with now
  double peak_motor_nmm;
  double p_mm[3];  ///< where the arm truly is
  std::uint64_t frames, updates, inits, disables;
  std::uint64_t zero_frames;  ///< in a row, to the last one, that asked for no force
  bool open, force_output, in_frame;
};

extern "C" {
/// The arm of that config name; null when there is none.
StubArm* stub_hd_arm(const char* name);
/// Everything as when the library was loaded, the clock included.
void stub_hd_reset();
/// So many servo passes of 1 ms.
void stub_hd_step(int passes);
/// Moves the clock and the hands without a servo pass: the loop is late.
void stub_hd_stall(int ms);
/// Where the hand on an arm wants it, while a thread of the stub's own steps it: mm, w x y z, mm/s.
void stub_hd_want(StubArm* arm, const double* p_mm, const double* q, const double* v_mm_per_s);
/// The same for its plug.
void stub_hd_plug(StubArm* arm, bool plugged);
std::int64_t stub_hd_now_ns();
bool stub_hd_scheduler_runs();
/// Calls that broke the library's rules: frames not paired, devices not open, and such.
std::uint64_t stub_hd_misuses();
}
