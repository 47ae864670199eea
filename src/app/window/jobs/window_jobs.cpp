#include "window/jobs/window_jobs.h"

#include <utility>

#include "cases/noted_case.h"
#include "cases/open_case.h"
#include "loops/realtime.h"
#include "runs/replays/demo_path.h"
#include "window/controllers/cases/bone_edit.h"

namespace osteon {
namespace {

// Thrown through work that knows no other way to be stopped.
struct StoppedWork {};

struct ClosesDevice {
  void operator()(CheckupOrder* order) const {
    if (order->device) order->device->close();
    delete order;
  }
};

}  // namespace

SideJob<PreparedCase>::Work measure_felt(std::shared_ptr<const Case> the_case,
                                         PreparedCase prepared) {
  return [the_case, prepared = std::move(prepared)](const Progress& tell) -> Result<PreparedCase> {
    PreparedCase out = prepared;
    bool whole = true;
    prepare_felt(*the_case, out, [&](double share) {
      return whole = goes_on(tell, "Measuring the felt surface", share);
    });
    if (!whole) return stopped();
    return out;
  };
}

SideJob<PreparedCase>::Work light_case(std::shared_ptr<const Case> the_case) {
  return [the_case](const Progress& tell) -> Result<PreparedCase> {
    take_late_turns();
    bool whole = true;
    PreparedCase out = prepare_case(*the_case, [&](double share) {
      return whole = goes_on(tell, "Computing soft shadows", share);
    });
    if (!whole) return stopped();
    return out;
  };
}

SideJob<FinerCase>::Work refine_case(std::string spec, std::vector<std::string> wanted,
                                     std::vector<std::string> softs, CarveSettings carve) {
  return [spec = std::move(spec), wanted = std::move(wanted), softs = std::move(softs),
          carve](const Progress& tell) -> Result<FinerCase> {
    take_late_turns();
    try {
      auto opened = open_case(spec, [&](const char* what, double share) {
        if (!goes_on(tell, what, share)) throw StoppedWork{};
      });
      if (!opened) return tl::unexpected(opened.error());
      FinerCase finer{*opened, spec, demo_path(**opened, spec), {}, {}};
      if (!has_field(**opened) && softs.empty()) return finer;
      const PreparedTray tray = prepare_tray(region_of(**opened), wanted);
      finer.softs = prepare_softs(**opened, tray.tray, softs).softs;
      finer.carving = prepare_carving(**opened, tray.tray, carve);
      return finer;
    } catch (const StoppedWork&) {
      return stopped();
    }
  };
}

SideJob<SavedPatient>::Work save_patient(PatientOrder order, std::filesystem::path out) {
  return [order = std::move(order), out](const Progress& tell) -> Result<SavedPatient> {
    try {
      auto made = make_patient(order, out, [&](double share) {
        if (!goes_on(tell, "Generating the bones", share)) throw StoppedWork{};
      });
      if (!made) return tl::unexpected(made.error());
      return SavedPatient{out, std::move(*made)};
    } catch (const StoppedWork&) {
      return stopped();
    }
  };
}

SideJob<std::filesystem::path>::Work save_edit(std::string case_spec, std::string bone_name,
                                               TriMesh mesh_B, std::filesystem::path out) {
  return [spec = std::move(case_spec), name = std::move(bone_name), mesh = std::move(mesh_B),
          out](const Progress&) -> Result<std::filesystem::path> {
    if (auto saved = save_edited_case(spec, name, mesh, out); !saved)
      return tl::unexpected(saved.error());
    return out;
  };
}

SideJob<std::filesystem::path>::Work save_notes_as_case(std::string case_spec, CaseNotes notes,
                                                        std::filesystem::path out) {
  return [spec = std::move(case_spec), notes = std::move(notes),
          out](const Progress&) -> Result<std::filesystem::path> {
    const auto def = open_case_def(spec);
    if (!def) return tl::unexpected(def.error());
    if (auto saved = save_noted_case(*def, notes, out); !saved)
      return tl::unexpected(saved.error());
    return out;
  };
}

SideJob<CheckupOutcome>::Work check_up(CheckupOrder order, std::span<const Driver> table) {
  const std::shared_ptr<CheckupOrder> held(new CheckupOrder(std::move(order)), ClosesDevice{});
  return [held, table](const Progress& tell) -> Result<CheckupOutcome> {
    const auto say = [&](const char* what, double share) { (void)goes_on(tell, what, share); };
    const auto cancelled = [&] { return !goes_on(tell, nullptr, 0); };
    return CheckupOutcome{run_checkup(*held, table, say, cancelled), held};
  };
}

}  // namespace osteon
