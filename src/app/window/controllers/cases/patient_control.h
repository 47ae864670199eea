#pragma once

#include <memory>
#include <string>

#include "window/controllers/cases/case_control.h"
#include "window/patient_model.h"

namespace osteon {

/// A patient is made.
class PatientControl {
 public:
  PatientControl(WindowHost& host, CaseControl& cases) : host_(host), cases_(cases) {}
  void close() { open_ = false; }
  void toggle();
  void apply(const PatientRequests& requests);
  void poll();
  PatientModel model() const;

 private:
  void choose(PatientOrder order);

  WindowHost& host_;
  CaseControl& cases_;
  bool open_ = false;
  PatientOrder order_;
  PatientChoices choices_;  ///< of its anatomy; empty until first needed
  std::string problem_;
  std::unique_ptr<SideJob<SavedPatient>> job_;  ///< while one is made
};

}  // namespace osteon
