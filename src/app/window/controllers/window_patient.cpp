#include <utility>

#include "cases/xdg.h"
#include "window/window_app.h"

namespace osteon {
namespace {

std::string stem_of(const PatientOrder& order) {
  return order.anatomy + (order.seed ? "-" + std::to_string(*order.seed) : "");
}

}  // namespace

// The tables are read when the panel first needs them.
void WindowApp::choose_patient(PatientOrder order) {
  const bool other = order.anatomy != patient_order_.anatomy || patient_choices_.parameters.empty();
  if (other) {
    order.set.clear();
    order.findings.clear();
    auto choices = patient_choices(order.anatomy);
    if (!choices) return note(ToastKind::kError, choices.error().message());
    patient_choices_ = std::move(*choices);
  }
  patient_order_ = std::move(order);
  patient_problem_.clear();
}

void WindowApp::apply_patient(const PatientRequests& requests) {
  if (requests.toggle) {
    patient_open_ = !patient_open_;
    if (patient_open_ && patient_choices_.parameters.empty()) choose_patient(patient_order_);
  }
  if (requests.order) choose_patient(*requests.order);
  if (requests.stop && patient_job_) patient_job_->cancel();
  if (!requests.make || patient_job_) return;
  patient_problem_.clear();
  patient_job_ = std::make_unique<SideJob<SavedPatient>>(save_patient(
      patient_order_, dated_file(data_home_dir() / "cases", stem_of(patient_order_), "")));
}

void WindowApp::poll_patient() {
  if (!patient_job_ || !patient_job_->done()) return;
  const bool stopped = patient_job_->cancelled();
  const Result<SavedPatient> saved = patient_job_->take();
  patient_job_.reset();
  if (!saved) {
    if (!stopped) patient_problem_ = saved.error().message();
    return;
  }
  note(ToastKind::kInfo, "Saved as " + saved->folder.string());
  patient_open_ = false;
  open({saved->folder.string(), {}, nullptr});
}

PatientModel WindowApp::patient_model() const {
  PatientModel model;
  model.open = patient_open_;
  model.making = patient_job_ != nullptr;
  if (patient_job_) model.fraction = patient_job_->progress().fraction;
  model.parameters = patient_choices_.parameters;
  model.findings = patient_choices_.findings;
  model.order = patient_order_;
  model.problem = patient_problem_;
  return model;
}

}  // namespace osteon
