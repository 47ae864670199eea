#include "osteon/tissue/solid_state.h"

#include <algorithm>
#include <cmath>

#include "osteon/base/hash.h"

namespace osteon {
namespace {

bool all_finite(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(), [](double x) { return std::isfinite(x); });
}

bool all_finite(const SolidState::Field& field) {
  return std::all_of(field.begin(), field.end(), [](const auto& v) { return all_finite(v); });
}

void add(Hasher& hash, const std::vector<double>& values) {
  hash.add(static_cast<std::uint64_t>(values.size()));
  hash.bytes(values.data(), values.size() * sizeof(double));
}

}  // namespace

SolidState state_at_rest(std::size_t slots, bool accelerations) {
  SolidState state;
  for (std::size_t k = 0; k < 3; ++k) {
    state.moved_m[k].assign(slots, 0.0);
    state.velocity_m_per_s[k].assign(slots, 0.0);
    if (accelerations) state.acceleration_m_per_s2[k].assign(slots, 0.0);
  }
  return state;
}

std::uint64_t hash_of(const SolidState& state) {
  Hasher hash;
  for (const auto* field : {&state.moved_m, &state.velocity_m_per_s, &state.acceleration_m_per_s2})
    for (const auto& values : *field) add(hash, values);
  add(hash, state.lost_pa);
  hash.add(state.tick);
  return hash.value();
}

bool is_finite(const SolidState& state) {
  return all_finite(state.moved_m) && all_finite(state.velocity_m_per_s) &&
         all_finite(state.acceleration_m_per_s2) && all_finite(state.lost_pa);
}

double kinetic_j(const SolidState& state, const std::vector<double>& mass_kg) {
  double sum = 0;
  for (const auto& v : state.velocity_m_per_s)
    for (std::size_t s = 0; s < v.size(); ++s) sum += 0.5 * mass_kg[s] * v[s] * v[s];
  return sum;
}

}  // namespace osteon
