// The bones of a LabelEdit: their names, and what is done to a bone as a whole.
#include <set>
#include <string>

#include "osteon/image/label_edit.h"

namespace osteon {
namespace {

constexpr std::size_t kMostLabels = 65535;

}  // namespace

std::string LabelEdit::unused_name() const {
  std::set<std::string> used;
  for (const auto& [label, bone] : bones_) used.insert(bone.name);
  for (int n = 1;; ++n) {
    std::string name = "bone_" + std::to_string(n);
    if (!used.count(name)) return name;
  }
}

Result<void> LabelEdit::check_label(std::uint16_t label) const {
  if (has(label)) return {};
  return fail("there is no such bone", "label " + std::to_string(label),
              "Choose one from the list");
}

Result<void> LabelEdit::check_name(const std::string& name, std::uint16_t label) const {
  if (name.empty()) return fail("a bone needs a name", {}, "Type one");
  for (const auto& [other, bone] : bones_)
    if (other != label && bone.name == name)
      return fail("a bone with this name exists", name, "Choose another name, or merge");
  return {};
}

Result<std::uint16_t> LabelEdit::add(const std::string& name) {
  const std::string wanted = name.empty() ? unused_name() : name;
  if (auto good = check_name(wanted, 0); !good) return tl::unexpected(good.error());
  std::size_t label = 1;
  while (label <= kMostLabels && has(static_cast<std::uint16_t>(label))) ++label;
  if (label > kMostLabels)
    return fail("there are 65 535 bones already", "the segmentation", "Remove or merge some");
  const bool own_step = !in_step_;
  if (own_step) begin_step("Add " + wanted);
  set_name(static_cast<std::uint16_t>(label), wanted);
  if (own_step) commit_step();
  return static_cast<std::uint16_t>(label);
}

Result<void> LabelEdit::rename(std::uint16_t label, const std::string& name) {
  if (auto good = check_label(label); !good) return good;
  if (auto good = check_name(name, label); !good) return good;
  if (bones_.at(label).name == name) return {};
  begin_step("Rename " + bones_.at(label).name);
  set_name(label, name);
  commit_step();
  return {};
}

void LabelEdit::relabel(std::uint16_t from, std::uint16_t into) {
  const EditedLabel bone = bones_.at(from);
  if (bone.voxels == 0) return;
  for (int k = bone.box.lo[2]; k < bone.box.hi[2]; ++k)
    for (int j = bone.box.lo[1]; j < bone.box.hi[1]; ++j)
      for (int i = bone.box.lo[0]; i < bone.box.hi[0];) {
        int end = i;
        while (end < bone.box.hi[0] && labels_.at(end, j, k) == from) ++end;
        if (end > i) set(labels_.frame.index(i, j, k), static_cast<std::size_t>(end - i), into);
        i = end + 1;
      }
}

Result<void> LabelEdit::remove(std::uint16_t label) {
  if (auto good = check_label(label); !good) return good;
  begin_step("Remove " + bones_.at(label).name);
  relabel(label, 0);
  set_name(label, {});
  commit_step();
  return {};
}

Result<void> LabelEdit::merge(std::uint16_t from, std::uint16_t into) {
  if (auto good = check_label(from); !good) return good;
  if (auto good = check_label(into); !good) return good;
  if (from == into)
    return fail("a bone cannot be merged with itself", bones_.at(from).name, "Choose another one");
  begin_step("Merge " + bones_.at(from).name + " into " + bones_.at(into).name);
  relabel(from, into);
  set_name(from, {});
  commit_step();
  return {};
}

Result<void> LabelEdit::check_labels(const LabelVolume& labels,
                                     const std::map<std::uint16_t, std::string>& names) const {
  if (labels.frame.size != labels_.frame.size || labels.values.size() != labels_.values.size())
    return fail("have a different size from the scan", "the labels", "Make them from this scan");
  std::set<std::string> used;
  for (const auto& [label, name] : names)
    if (label == 0 || name.empty() || !used.insert(name).second)
      return fail("is empty or used twice", "the name '" + name + "'",
                  "Give each bone its own name");
  std::uint16_t last = 0;
  for (const std::uint16_t label : labels.values) {
    if (label != last && label != 0 && !names.count(label))
      return fail("has no name", "label " + std::to_string(label), "Name each bone");
    last = label;
  }
  return {};
}

Result<void> LabelEdit::replace(const LabelVolume& labels,
                                const std::map<std::uint16_t, std::string>& names,
                                const std::string& what) {
  if (auto good = check_labels(labels, names); !good) return good;
  begin_step(what);
  for (const auto& [label, name] : names)
    if (!has(label)) set_name(label, name);
  for (std::size_t n = 0; n < labels.values.size();) {
    std::size_t end = n + 1;
    while (end < labels.values.size() && labels.values[end] == labels.values[n]) ++end;
    set(n, end - n, labels.values[n]);
    n = end;
  }
  std::vector<std::uint16_t> gone;
  for (const auto& [label, bone] : bones_)
    if (!names.count(label)) gone.push_back(label);
  for (const std::uint16_t label : gone) set_name(label, {});
  for (const auto& [label, name] : names)
    if (bones_.at(label).name != name) set_name(label, name);
  commit_step();
  return {};
}

}  // namespace osteon
