#include "osteon/mesh/mesh_edit.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "osteon/mesh/self_crossing.h"

namespace osteon {
namespace {

std::string counted(std::size_t count, const std::string& one, const std::string& many) {
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

Vec3 area_vector(const Vec3& a, const Vec3& b, const Vec3& c) { return (b - a).cross(c - a); }

}  // namespace

std::string EditFindings::summary() const {
  if (sound()) return "sound";
  std::string text;
  if (!turned.empty())
    text = counted(turned.size(), "triangle is inverted", "triangles are inverted");
  if (crossings.empty()) return text;
  return text + (text.empty() ? "" : ", ") +
         counted(crossings.size(), "pair of triangles crosses", "pairs of triangles cross");
}

std::size_t MeshEdit::Step::bytes() const {
  return sizeof(Step) + vertex.size() * (sizeof(std::uint32_t) + 2 * sizeof(Vec3));
}

MeshEdit::MeshEdit(TriMesh mesh, std::size_t history_bytes)
    : mesh_(std::move(mesh)), walk_(mesh_), history_bytes_(history_bytes) {}

Result<MeshEdit> MeshEdit::begin(TriMesh mesh, std::size_t history_bytes) {
  const std::string where = "mesh editing";
  if (mesh.triangles.empty())
    return fail("the surface has no triangles", where, "Choose another one");
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (const std::uint32_t v : mesh.triangles[t])
      if (v >= mesh.vertices.size())
        return fail("triangle " + std::to_string(t) + " refers to a vertex that does not exist",
                    where, "Export the surface again");
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
    if (!is_finite(mesh.vertices[v]))
      return fail("vertex " + std::to_string(v) + " is not a finite number", where,
                  "Export the surface again");
  return MeshEdit(std::move(mesh), history_bytes);
}

std::uint32_t MeshEdit::nearest_vertex(const Vec3& p) const {
  std::uint32_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::uint32_t v = 0; v < mesh_.vertices.size(); ++v) {
    const double squared = (mesh_.vertices[v] - p).squaredNorm();
    if (squared >= least) continue;
    least = squared;
    best = v;
  }
  return best;
}

Result<void> MeshEdit::grab(std::uint32_t vertex, const SoftSelection& selection) {
  if (vertex >= mesh_.vertices.size())
    return fail("there is no vertex " + std::to_string(vertex), "mesh editing");
  if (!(selection.radius_m > 0) || !std::isfinite(selection.radius_m))
    return fail("the radius must be a positive length", "mesh editing");
  if (grabbed_) commit();
  grabbed_ = true;
  displacement_.setZero();
  selected_ = walk_.select(mesh_, vertex, selection);
  before_.clear();
  for (const SoftWeight& s : selected_) before_.push_back(mesh_.vertices[s.vertex]);
  return {};
}

void MeshEdit::put_back() {
  for (std::size_t i = 0; i < selected_.size(); ++i)
    mesh_.vertices[selected_[i].vertex] = before_[i];
}

void MeshEdit::drag(const Vec3& displacement_m) {
  if (!grabbed_ || !is_finite(displacement_m)) return;
  displacement_ = displacement_m;
  for (std::size_t i = 0; i < selected_.size(); ++i)
    mesh_.vertices[selected_[i].vertex] = before_[i] + selected_[i].weight * displacement_m;
}

Result<void> MeshEdit::select(const SoftSelection& selection) {
  if (!grabbed_) return fail("nothing is grabbed", "mesh editing", "Grab a vertex first");
  const Vec3 displacement = displacement_;
  const std::uint32_t vertex = grabbed_vertex();
  put_back();
  displacement_.setZero();
  // The drag under way holds nothing now, so that grabbing anew commits nothing.
  if (auto fine = grab(vertex, selection); !fine) {
    drag(displacement);
    return fine;
  }
  drag(displacement);
  return {};
}

std::vector<std::uint32_t> MeshEdit::touched_triangles() const {
  std::vector<std::uint32_t> touched;
  for (const SoftWeight& s : selected_)
    for (std::uint32_t i = walk_.first()[s.vertex]; i < walk_.first()[s.vertex + 1]; ++i)
      touched.push_back(walk_.triangle()[i]);
  std::sort(touched.begin(), touched.end());
  touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
  return touched;
}

std::vector<std::uint32_t> MeshEdit::turned_now() const {
  std::vector<std::uint32_t> turned;
  if (!grabbed_) return turned;
  std::vector<std::pair<std::uint32_t, Vec3>> old;
  for (std::size_t i = 0; i < selected_.size(); ++i)
    old.emplace_back(selected_[i].vertex, before_[i]);
  const auto by_vertex = [](const auto& a, const auto& b) { return a.first < b.first; };
  std::sort(old.begin(), old.end(), by_vertex);
  const auto place_before = [&](std::uint32_t v) {
    const auto at = std::lower_bound(old.begin(), old.end(), std::pair(v, Vec3()), by_vertex);
    return at != old.end() && at->first == v ? at->second : mesh_.vertices[v];
  };
  for (const std::uint32_t t : touched_triangles()) {
    const Triangle& c = mesh_.triangles[t];
    const Vec3 was = area_vector(place_before(c[0]), place_before(c[1]), place_before(c[2]));
    const Vec3 is = area_vector(mesh_.vertices[c[0]], mesh_.vertices[c[1]], mesh_.vertices[c[2]]);
    // What had no area before cannot lose it.
    if (was.squaredNorm() > 0 && !(was.dot(is) > 0)) turned.push_back(t);
  }
  return turned;
}

EditFindings MeshEdit::commit() {
  EditFindings findings;
  if (!grabbed_) return findings;
  if (!displacement_.isZero(0)) {
    findings.turned = turned_now();
    std::vector<bool> marked(mesh_.triangles.size(), false);
    for (const std::uint32_t t : touched_triangles()) marked[t] = true;
    findings.crossings = self_crossings(mesh_, marked);
    Step step;
    step.before = before_;
    for (const SoftWeight& s : selected_) {
      step.vertex.push_back(s.vertex);
      step.after.push_back(mesh_.vertices[s.vertex]);
    }
    remember(std::move(step));
  }
  let_go();
  return findings;
}

void MeshEdit::let_go() {
  grabbed_ = false;
  selected_.clear();
  before_.clear();
  displacement_.setZero();
}

void MeshEdit::remember(Step step) {
  for (const Step& redone : redo_) held_bytes_ -= redone.bytes();
  redo_.clear();
  step.number = ++steps_made_;
  held_bytes_ += step.bytes();
  undo_.push_back(std::move(step));
  while (held_bytes_ > history_bytes_ && undo_.size() > 1) {
    held_bytes_ -= undo_.front().bytes();
    forgotten_at_ = undo_.front().number;
    undo_.pop_front();
    ++forgotten_;
  }
}

void MeshEdit::cancel() {
  if (!grabbed_) return;
  put_back();
  let_go();
}

bool MeshEdit::undo() {
  cancel();
  if (undo_.empty()) return false;
  Step step = std::move(undo_.back());
  undo_.pop_back();
  for (std::size_t i = 0; i < step.vertex.size(); ++i)
    mesh_.vertices[step.vertex[i]] = step.before[i];
  redo_.push_back(std::move(step));
  return true;
}

bool MeshEdit::redo() {
  cancel();
  if (redo_.empty()) return false;
  Step step = std::move(redo_.back());
  redo_.pop_back();
  for (std::size_t i = 0; i < step.vertex.size(); ++i)
    mesh_.vertices[step.vertex[i]] = step.after[i];
  undo_.push_back(std::move(step));
  return true;
}

bool MeshEdit::is_changed() const {
  if (grabbed_ && !displacement_.isZero(0)) return true;
  return now_at() != saved_at_;
}

void MeshEdit::mark_saved() { saved_at_ = now_at(); }

EditFindings MeshEdit::check() const {
  EditFindings findings;
  findings.turned = turned_now();
  findings.crossings = self_crossings(mesh_);
  return findings;
}

}  // namespace osteon
