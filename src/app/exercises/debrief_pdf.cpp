#include <algorithm>
#include <charconv>

#include "exercises/debrief.h"
#include "osteon/results/pdf.h"

namespace osteon {
namespace {

std::string page_number_text(double value, int digits) {
  char text[64];
  const auto end =
      std::to_chars(text, text + sizeof text, value, std::chars_format::fixed, digits).ptr;
  return std::string(text, end);
}

void print_verdict(const Debrief& debrief, PdfPages& pages) {
  const Outcome& outcome = *debrief.outcome;
  std::string score = "no score: there is no standard";
  if (outcome.score)
    score = "score " + page_number_text(outcome.score->value, 1) + ", 95 % interval " +
            page_number_text(outcome.score->lo, 1) + " to " +
            page_number_text(outcome.score->hi, 1) +
            " (100: the experts' mean; 10 points: one standard deviation), standard " +
            std::to_string(outcome.standard_version);
  pages.line("Verdict: " + std::string(to_text(outcome.verdict)));
  pages.line(score);
}

void print_timeline(const Debrief& debrief, PdfPages& pages) {
  pages.heading("Stages and errors");
  pages.row({"what", "", "at, s", "hand", "where"}, true);
  for (const Outcome::Stage& stage : debrief.outcome->stages)
    pages.row({"stage", stage.name,
               stage.completed_s ? page_number_text(*stage.completed_s, 1) : "not completed", "",
               ""});
  for (const Outcome::Error& error : debrief.outcome->errors)
    pages.row({std::string(to_text(error.severity)) + " error", error.name,
               page_number_text(error.at_s, 1), std::to_string(error.hand), error.subject});
  if (debrief.outcome->errors.empty()) pages.line("No errors.");
  for (const ScenarioError& known : debrief.scenario->errors)
    for (const Outcome::Error& error : debrief.outcome->errors)
      if (error.name == known.name) {
        pages.line(known.title + ": " + known.consequence);
        break;
      }
}

void print_findings(const Debrief& debrief, PdfPages& pages) {
  if (debrief.outcome->findings.empty()) return;
  pages.heading("What was found");
  pages.row({"finding", "stated", "is", "", ""}, true);
  for (const GradedFinding& graded : debrief.outcome->findings)
    pages.row({graded.title, graded.stated.empty() ? "nothing" : graded.stated, graded.truth,
               graded.right() ? "right" : "wrong", ""});
}

std::vector<double> moments(const Debrief& debrief) {
  std::vector<double> marks;
  if (!debrief.outcome) return marks;
  for (const Outcome::Stage& stage : debrief.outcome->stages)
    if (stage.completed_s) marks.push_back(*stage.completed_s);
  for (const Outcome::Error& error : debrief.outcome->errors) marks.push_back(error.at_s);
  return marks;
}

void print_force(const Debrief& debrief, const HandTrace& hand, PdfPages& pages) {
  if (hand.time_s.empty()) return;
  PdfPages::Curve force;
  force.title = "Force over time" + (hand.name.empty() ? "" : ", hand " + hand.name) +
                "; lines: completed stages and errors";
  force.x_unit = "s";
  force.y_unit = "N";
  force.x = hand.time_s;
  force.y = hand.force_n;
  force.marks = moments(debrief);
  pages.curve(force, 45);
}

void print_way(const HandTrace& hand, const std::vector<Vec3>& expert_W, Eigen::Index down,
               const char* seen, PdfPages& pages) {
  if (hand.tip_W.empty()) return;
  PdfPages::Curve way;
  way.title = std::string("Path of the tip seen from ") + seen +
              (hand.name.empty() ? "" : ", hand " + hand.name) +
              (expert_W.empty() ? "" : "; orange: the expert's");
  way.x_unit = way.y_unit = "mm";
  way.from_zero = false;
  way.equal_scales = true;
  for (const Vec3& p_W : hand.tip_W) {
    way.x.push_back(p_W.x() * 1000);
    way.y.push_back(p_W[down] * 1000);
  }
  for (const Vec3& p_W : expert_W) {
    way.beside_x.push_back(p_W.x() * 1000);
    way.beside_y.push_back(p_W[down] * 1000);
  }
  pages.curve(way, 70);
}

void print_structures(const HandTrace& hand, PdfPages& pages) {
  pages.heading("Forces by structure" + (hand.name.empty() ? "" : ", hand " + hand.name));
  if (hand.touched.empty()) return pages.line("Nothing was touched.");
  pages.row({"structure", "peak, N", "mean, N", "time, s", "deepest, mm"}, true);
  for (const BoneReport& bone : hand.touched)
    pages.row({bone.name, page_number_text(bone.peak_force_n, 2),
               page_number_text(bone.mean_force_n, 2), page_number_text(bone.contact_time_s, 1),
               page_number_text(bone.deepest_mm, 2)});
}

// A spot is about 0.5 mm wide.
void print_damage(const Debrief& debrief, PdfPages& pages) {
  constexpr double kSpot_mm2 = 0.25;
  pages.heading("Loads on the surfaces");
  bool any = false;
  for (std::size_t b = 0; b < debrief.damage.size(); ++b) {
    double force_n = 0, scratch_nmm = 0, heat_c = 0, touched = 0;
    for (const DamageSpot& spot : debrief.damage[b]) {
      force_n = std::max(force_n, spot.force_n);
      scratch_nmm += spot.scratch_nmm;
      heat_c = std::max(heat_c, spot.heat_c);
      touched += spot.force_n > 0 ? 1 : 0;
    }
    if (!(touched > 0) && !(heat_c > 0)) continue;
    if (!any)
      pages.row({"structure", "peak, N", "scratches, N mm", "touched, mm2", "heat, C"}, true);
    any = true;
    pages.row({debrief.the_case->bones[b].name, page_number_text(force_n, 2),
               page_number_text(scratch_nmm, 1), page_number_text(kSpot_mm2 * touched, 1),
               heat_c > 0 ? page_number_text(heat_c, 1) : "-"});
  }
  if (!any) pages.line("Nothing was touched.");
}

void print_metrics(const Debrief& debrief, PdfPages& pages) {
  pages.heading("Metrics");
  pages.row({"metric", "value", "aim", "source"}, true);
  for (const auto& [name, value] : debrief.outcome->metrics) {
    std::string aim, source;
    for (const ScenarioMetric& metric : debrief.scenario->metrics)
      if (metric.name == name) {
        aim = page_number_text(metric.threshold, 1) + " " + metric.unit;
        source = metric.source;
      }
    pages.row({name, page_number_text(value, 2), aim, source});
  }
}

}  // namespace

Result<void> save_debrief(const Debrief& debrief, const std::filesystem::path& file,
                          std::span<const DebriefPicture> pictures) {
  PdfPages pages;
  pages.heading("Debrief: " + (debrief.scenario ? debrief.scenario->title : debrief.case_name));
  pages.line("Case " + debrief.case_name + ", " + page_number_text(debrief.duration_s, 1) + " s" +
             (debrief.surgeon.empty() ? "" : ", played by " + debrief.surgeon));
  if (!debrief.identical)
    pages.line("The replay on this computer differs from the recording: judge with care.");
  if (debrief.guided_s > 0)
    pages.line("The device led the hand along an expert's path for " +
               page_number_text(debrief.guided_s, 1) + " s.");
  if (debrief.outcome) {
    print_verdict(debrief, pages);
    print_timeline(debrief, pages);
    print_findings(debrief, pages);
  } else {
    pages.line("The recording contains no exercise, so nothing is judged.");
  }
  for (const HandTrace& hand : debrief.hands) print_force(debrief, hand, pages);
  for (const HandTrace& hand : debrief.hands) print_structures(hand, pages);
  if (debrief.outcome) print_metrics(debrief, pages);
  print_damage(debrief, pages);
  for (const DebriefPicture& picture : pictures)
    pages.picture(picture.title, picture.image.rgb, picture.image.width, picture.image.height, 150);
  for (std::size_t h = 0; h < debrief.hands.size(); ++h) {
    const auto expert_W = h < debrief.expert.size() ? debrief.expert[h] : std::vector<Vec3>();
    print_way(debrief.hands[h], expert_W, 1, "above", pages);
    print_way(debrief.hands[h], expert_W, 2, "the side", pages);
  }
  return pages.save(file);
}

}  // namespace osteon
