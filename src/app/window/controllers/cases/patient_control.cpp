#include "window/controllers/cases/patient_control.h"

#include <utility>

#include "cases/xdg.h"

namespace osteon {
namespace {

std::string stem_of(const PatientOrder& order) {
  return order.anatomy + (order.seed ? "-" + std::to_string(*order.seed) : "");
}

}  // namespace

// The tables are read when the panel first needs them.
void PatientControl::choose(PatientOrder order) {
  const bool other = order.anatomy != order_.anatomy || choices_.parameters.empty();
  if (other) {
    order.set.clear();
    order.findings.clear();
    auto choices = patient_choices(order.anatomy);
    if (!choices) return host_.note(ToastKind::kError, choices.error().message());
    choices_ = std::move(*choices);
  }
  order_ = std::move(order);
  problem_.clear();
}

void PatientControl::toggle() {
  open_ = !open_;
  if (open_ && choices_.parameters.empty()) choose(order_);
}

void PatientControl::apply(const PatientRequests& requests) {
  if (requests.toggle) toggle();
  if (requests.order) choose(*requests.order);
  if (requests.stop && job_) job_->cancel();
  if (!requests.make || job_) return;
  problem_.clear();
  job_ = std::make_unique<SideJob<SavedPatient>>(
      save_patient(order_, dated_file(data_home_dir() / "cases", stem_of(order_), "")));
}

void PatientControl::poll() {
  if (!job_ || !job_->done()) return;
  const bool stopped = job_->cancelled();
  const Result<SavedPatient> saved = job_->take();
  job_.reset();
  if (!saved) {
    if (!stopped) problem_ = saved.error().message();
    return;
  }
  host_.note(ToastKind::kInfo, "Saved as " + saved->folder.string());
  open_ = false;
  cases_.open({saved->folder.string(), {}, nullptr});
}

PatientModel PatientControl::model() const {
  PatientModel model;
  model.open = open_;
  model.making = job_ != nullptr;
  if (job_) model.fraction = job_->progress().fraction;
  model.parameters = choices_.parameters;
  model.findings = choices_.findings;
  model.order = order_;
  model.problem = problem_;
  return model;
}

}  // namespace osteon
