#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>

#include "cases/make_patient.h"
#include "checkup/checkup.h"
#include "osteon/mesh/tri_mesh.h"
#include "osteon/render/prepare.h"
#include "osteon/scene/case.h"
#include "osteon/scene/case_notes.h"
#include "osteon/scene/path.h"
#include "ui/side_job.h"
#include "window/jobs/load_job.h"

namespace osteon {

/// What the window does beside its picture: each function gives the work of a SideJob.

/// Works out how far what is felt is from what is seen (prepare_felt). `prepared` comes from
/// prepare_case(the_case).
SideJob<PreparedCase>::Work measure_felt(std::shared_ptr<const Case> the_case,
                                         PreparedCase prepared);

/// Works out the light between the bones (prepare_case). Other threads go first.
SideJob<PreparedCase>::Work light_case(std::shared_ptr<const Case> the_case);

/// The case as it was asked for, when what is felt of it has been made.
struct FinerCase {
  std::shared_ptr<const Case> the_case;
  std::string source;
  ProbePath demo;
  PreparedCarving carving;
  RunSofts softs;
};
/// Makes what is felt of a case that was opened at once, and what it is carved with by the
/// instruments of its tray (`wanted`: as prepare_tray takes them). Other threads go first. What of
/// it gives way (`softs`: names) is made anew as well. `carve`: how bone is removed.
SideJob<FinerCase>::Work refine_case(std::string spec, std::vector<std::string> wanted,
                                     std::vector<std::string> softs, CarveSettings carve);

struct SavedPatient {
  std::filesystem::path folder;
  MadePatient made;
};
/// Grows and saves a patient. Stopped, it leaves nothing.
SideJob<SavedPatient>::Work save_patient(PatientOrder order, std::filesystem::path out);

/// Saves an edited bone as a new case and gives its folder: a built-in case is grown anew for it,
/// which takes seconds.
SideJob<std::filesystem::path>::Work save_edit(std::string case_spec, std::string bone_name,
                                               TriMesh mesh_B, std::filesystem::path out);

/// Saves the case with notes as a new case and gives its folder, as save_edit does.
SideJob<std::filesystem::path>::Work save_notes_as_case(std::string case_spec, CaseNotes notes,
                                                        std::filesystem::path out);

struct CheckupOutcome {
  CheckupReport report;
  /// Holds the device that was lent, still open; who does not move it out closes it.
  std::shared_ptr<CheckupOrder> order;
};
/// A check-up. Cancelled, it ends within some ticks, with the device at zero force, and tells what
/// it has found so far.
SideJob<CheckupOutcome>::Work check_up(CheckupOrder order, std::span<const Driver> table);

}  // namespace osteon
