#include "runs/reports/carving_report.h"

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "osteon/physics/joint_water.h"
#include "osteon/scene/event.h"

namespace osteon {
namespace {

using OrderedJson = nlohmann::ordered_json;

bool of_carving(const Event& event) {
  const int code = static_cast<int>(event.kind);
  return code >= 200 && code < 300;
}

OrderedJson event_json(const Event& event, const CarvingReport& report) {
  const EventKindRow* row = find_event_kind(event.kind);
  OrderedJson out{{"time_s", static_cast<double>(event.tick) * report.tick_s},
                  {"kind", row ? std::string(row->name) : "unknown"},
                  {"hand", event.hand}};
  if (event.subject < report.bones.size()) out["bone"] = report.bones[event.subject];
  for (std::size_t v = 0; row && v < row->value_names.size(); ++v)
    if (!row->value_names[v].empty()) out[std::string(row->value_names[v])] = event.values[v];
  return out;
}

OrderedJson loose_json(const CarvingReport& report) {
  OrderedJson out = OrderedJson::array();
  for (const CarvingReport::Loose& piece : report.loose) {
    const Vec3 mm = 1000 * piece.p_W;
    out.push_back({{"bone", report.bones[piece.bone]},
                   {"volume_mm3", 1e9 * piece.volume_m3},
                   {"mass_mg", 1e6 * piece.mass_kg},
                   {"at_mm", {mm.x(), mm.y(), mm.z()}},
                   {"held", piece.held}});
  }
  return out;
}

std::vector<CarvingReport::Loose> loose_in(const Session& session) {
  std::vector<CarvingReport::Loose> out;
  const std::vector<Bone>& bones = session.the_case().bones;
  for (const FallenPiece& piece : session.carving()->pieces()) {
    const std::uint32_t b = piece.shape->grid().bone;
    out.push_back({b, piece.shape->volume_m3(), session.carving()->mass_kg(piece, bones[b].mass_kg),
                   piece.X_WB * piece.shape->middle_B(), piece.is == FallenPiece::Is::kHeld});
  }
  return out;
}

ByTissue sum_of(const std::vector<ByTissue>& all) {
  ByTissue sum{};
  for (const ByTissue& one : all)
    for (std::size_t t = 0; t < kBoneTissues; ++t) sum[t] += one[t];
  return sum;
}

}  // namespace

OrderedJson to_json(const CarvingReport& report) {
  const ByTissue removed = sum_of(report.removed_m3);
  OrderedJson out;
  out["removed_mm3"] = 1e9 * total(removed);
  out["removed_by_tissue_mm3"] = OrderedJson::object();
  for (std::size_t t = 0; t < kBoneTissues; ++t)
    out["removed_by_tissue_mm3"][std::string(to_text(static_cast<BoneTissue>(t)))] =
        1e9 * removed[t];
  out["removed_by_bone_mm3"] = OrderedJson::object();
  for (std::size_t b = 0; b < report.bones.size(); ++b)
    if (total(report.removed_m3[b]) > 0)
      out["removed_by_bone_mm3"][report.bones[b]] = 1e9 * total(report.removed_m3[b]);
  out["dust_mm3"] = 1e9 * report.dust_m3;
  out["pieces_mm3"] = OrderedJson::array();
  for (const double piece : report.pieces_m3) out["pieces_mm3"].push_back(1e9 * piece);
  out["loose"] = loose_json(report);
  out["most_thrust_n"] = report.most_thrust_n;
  out["most_torque_nmm"] = 1000 * report.most_torque_nm;
  out["heat"] = {{"hottest_c", report.hottest_c},
                 {"necrosis_47c_60s_mm3", 1e9 * report.necrosis_m3[0]},
                 {"necrosis_50c_30s_mm3", 1e9 * report.necrosis_m3[1]},
                 {"water_ml", 1e6 * report.water_m3}};
  out["heat"]["by_bone"] = OrderedJson::object();
  for (std::size_t b = 0; b < std::min(report.bones.size(), report.necrosis_by_bone_m3.size()); ++b)
    if (total(report.removed_m3[b]) > 0)
      out["heat"]["by_bone"][report.bones[b]] = {
          {"necrosis_47c_60s_mm3", 1e9 * report.necrosis_by_bone_m3[b][0]},
          {"necrosis_50c_30s_mm3", 1e9 * report.necrosis_by_bone_m3[b][1]}};
  out["events"] = OrderedJson::array();
  for (const Event& event : report.events) out["events"].push_back(event_json(event, report));
  return out;
}

std::string to_text(const CarvingReport& report) {
  const ByTissue removed = sum_of(report.removed_m3);
  char line[160];
  std::snprintf(line, sizeof line, "removed        %.2f mm^3 of bone\n", 1e9 * total(removed));
  std::string text = line;
  for (std::size_t t = 0; t < kBoneTissues; ++t) {
    if (!(removed[t] > 0)) continue;
    std::snprintf(line, sizeof line, "  %-16s %.2f mm^3\n",
                  std::string(to_text(static_cast<BoneTissue>(t))).c_str(), 1e9 * removed[t]);
    text += line;
  }
  std::snprintf(line, sizeof line,
                "most thrust    %.1f N on the drill, torque %.1f N mm\n"
                "hottest        %.1f C, dead bone %.2f mm^3\n",
                report.most_thrust_n, 1000 * report.most_torque_nm, report.hottest_c,
                1e9 * std::max(report.necrosis_m3[0], report.necrosis_m3[1]));
  text += line;
  for (const Event& event : report.events) {
    const EventKindRow* row = find_event_kind(event.kind);
    if (!row || event.subject >= report.bones.size()) continue;
    std::snprintf(line, sizeof line, "  %8.3f s  %s %s\n",
                  static_cast<double>(event.tick) * report.tick_s, std::string(row->text).c_str(),
                  report.bones[event.subject].c_str());
    text += line;
  }
  return text;
}

void CarvingWatch::see(const Session& session) {
  const Carving* carving = session.carving();
  if (!carving) return;
  for (std::size_t h = 0; h < session.hands(); ++h)
    for (const Event& event : session.last_events(h))
      if (of_carving(event)) report_.events.push_back(event);
  if (session.last_steps() == 0) return;
  for (const Carving::Fallen& fallen : carving->fallen()) {
    if (fallen.dust)
      report_.dust_m3 += fallen.volume_m3;
    else
      report_.pieces_m3.push_back(fallen.volume_m3);
  }
  for (std::size_t h = 0; h < session.hands(); ++h) {
    report_.most_thrust_n = std::max(report_.most_thrust_n, carving->readout(h).thrust_n);
    report_.most_torque_nm = std::max(report_.most_torque_nm, carving->readout(h).torque_nm);
  }
  heat_.see(session);
}

void SessionHeat::see(const Session& session) {
  const Carving* const carving = session.carving();
  const BoneSnapshot& bones = session.bones();
  if (!carving || bones.step == step_ || bones.step == 0) return;
  step_ = bones.step;
  if (!pulses_) {
    pulses_.emplace(carving->setup(), filled_joint(session.the_case()));
    heat_.emplace(carving->setup().table.heat, carving->setup().table.water);
  }
  const double step_s = bones.time_s / static_cast<double>(bones.step);
  pulses_->add(*carving, bones, session.last_step_record().command, step_s);
  while (const HeatPulse* const pulse = pulses_->due()) {
    heat_->take(*pulse, [&](std::uint32_t bone) { return carving->field(bone); });
    water_m3_ += pulse->dt_s * pulse->flow_m3_s;
    pulses_->pop();
  }
}

std::optional<CarvingReport> CarvingWatch::finish(const Session& session) const {
  const Carving* carving = session.carving();
  if (!carving) return std::nullopt;
  CarvingReport report = report_;
  report.loose = loose_in(session);
  for (std::size_t b = 0; b < session.the_case().bones.size(); ++b) {
    report.bones.push_back(session.the_case().bones[b].name);
    const CarvedField* field = carving->field(b);
    report.removed_m3.push_back(field ? removed_volume(*field) : ByTissue{});
  }
  report.water_m3 = heat_.water_m3();
  if (!heat_.bones()) return report;
  report.hottest_c = heat_.bones()->hottest_c();
  report.necrosis_by_bone_m3.resize(report.bones.size());
  for (std::size_t r = 0; r < 2; ++r) {
    report.necrosis_m3[r] = heat_.bones()->necrosis_m3(r);
    for (std::uint32_t b = 0; b < report.bones.size(); ++b)
      if (const BoneHeat* const bone = heat_.bones()->bone(b))
        report.necrosis_by_bone_m3[b][r] = bone->necrosis_m3(r);
  }
  return report;
}

}  // namespace osteon
