#include "exercises/seat_files.h"

#include <algorithm>
#include <cstdlib>

#include "cases/xdg.h"
#include "osteon/procedure/course.h"

namespace osteon {
namespace {

namespace fs = std::filesystem;

const Scenario* named(const std::vector<Scenario>& scenarios, const std::string& name) {
  const auto it = std::find_if(scenarios.begin(), scenarios.end(),
                               [&](const Scenario& scenario) { return scenario.name == name; });
  return it == scenarios.end() ? nullptr : &*it;
}

std::vector<fs::path> own_scenario_files() {
  std::vector<fs::path> files;
  std::error_code ec;
  for (const auto& entry : fs::directory_iterator(own_scenarios_folder(), ec))
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

fs::path own_scenarios_folder() { return data_home_dir() / "scenarios"; }

fs::path own_standard_file(const std::string& scenario) {
  return data_home_dir() / "standards" / (scenario + ".toml");
}

fs::path course_file() {
  const char* given = std::getenv("OSTEON_COURSE");
  return given && *given ? fs::path(given) : data_home_dir() / "course.toml";
}

Result<ExerciseList> all_exercises() {
  auto shipped = shipped_scenarios();
  if (!shipped) return tl::unexpected(shipped.error());
  ExerciseList list;
  list.scenarios = std::move(*shipped);
  for (const fs::path& file : own_scenario_files()) {
    auto own = load_scenario(file);
    if (!own)
      list.faults.push_back(own.error());
    else if (named(list.scenarios, own->name))
      list.faults.push_back({"there is another exercise with the name '" + own->name + "'",
                             file.string(), "Give it a name of its own"});
    else
      list.scenarios.push_back(std::move(*own));
  }
  list.seeds.resize(list.scenarios.size());
  return list;
}

Result<ExerciseList> set_exercises() {
  auto all = all_exercises();
  std::error_code ec;
  if (!all || !fs::exists(course_file(), ec)) return all;
  const auto course = load_course(course_file());
  if (!course) {
    all->faults.push_back(course.error());
    return all;
  }
  ExerciseList set;
  set.title = course->title;
  set.faults = std::move(all->faults);
  for (const CourseUnit& unit : course->units) {
    const Scenario* const scenario = named(all->scenarios, unit.exercise);
    if (!scenario) {
      set.faults.push_back({"there is no exercise '" + unit.exercise + "'", course_file().string(),
                            "See: osteon scenario list"});
      continue;
    }
    set.scenarios.push_back(*scenario);
    set.seeds.push_back(unit.seed);
  }
  return set;
}

Result<std::optional<Standard>> standard_in_use(const std::string& scenario) {
  const fs::path own = own_standard_file(scenario);
  std::error_code ec;
  if (!fs::exists(own, ec)) return shipped_standard(scenario);
  auto standard = load_standard(own);
  if (!standard) return tl::unexpected(standard.error());
  if (standard->scenario != scenario)
    return fail("is a standard of '" + standard->scenario + "'", own.string(),
                "Remove it, or set one for '" + scenario + "'");
  return std::optional<Standard>(std::move(*standard));
}

}  // namespace osteon
