#pragma once

#include <string>

#include "osteon/render/renderer.h"
#include "osteon/scene/case.h"
#include "ui/app_settings.h"

namespace osteon {

/// What the user changed of a case's looks comes back with the case. `source`: as open_case takes
/// it.
void recall_looks(const AppSettings& settings, const std::string& source, const Case& the_case,
                  ViewState& view);
/// Only what the user changed, so that better defaults reach the rest.
void remember_looks(AppSettings& settings, const std::string& source, const Case& the_case,
                    const ViewState& view);

/// Light and what is shown beside bones: the same for all cases.
void recall_light(const AppSettings& settings, ViewState& view);
void remember_light(AppSettings& settings, const ViewState& view);

}  // namespace osteon
