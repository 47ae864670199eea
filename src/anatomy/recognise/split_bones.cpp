#include "recognise/split_bones.h"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "bone/largest_piece.h"
#include "finding/displace.h"
#include "osteon/mesh/distance.h"

namespace osteon {
namespace {

Vec3 middle_of(const TriMesh& mesh) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& v : mesh.vertices) sum += v;
  return sum / static_cast<double>(mesh.vertices.size());
}

TriMesh placed(const GeneratedBone& bone) {
  TriMesh mesh_W = bone.mesh;
  for (Vec3& v : mesh_W.vertices) v = bone.X_WB * v;
  return mesh_W;
}

/// One bone's split, on the grown anatomy.
class Splitter {
 public:
  Splitter(const BoneSplit& split, std::string name, GeneratedAnatomy& grown)
      : split_(split), name_(std::move(name)), grown_(grown) {}

  Result<void> run(const std::optional<Pose>& moved) {
    const auto bone = std::find_if(grown_.bones.begin(), grown_.bones.end(),
                                   [&](const GeneratedBone& b) { return b.name == name_; });
    const std::size_t count = split_.fragments.size();
    const auto pieces = largest_pieces(bone->mesh, count);
    if (pieces.size() < count) return fail("was not separated");
    std::vector<std::optional<GeneratedBone>> fragments(count);
    for (const std::uint32_t piece : pieces) {
      GeneratedBone fragment = *bone;
      fragment.mesh = take_pieces(bone->mesh, {piece});
      auto& slot = fragments[nearest_name(bone->X_WB * middle_of(fragment.mesh), moved)];
      if (slot) return fail("two of its fragments match the same name");
      slot = std::move(fragment);
    }
    for (std::size_t i = 0; i < count; ++i) {
      fragments[i]->name = split_.fragments[i].name;
      surfaces_.emplace_back(placed(*fragments[i]));
    }
    auto at = grown_.bones.erase(bone);
    for (auto& fragment : fragments) at = std::next(grown_.bones.insert(at, std::move(*fragment)));
    split_softs();
    return {};
  }

 private:
  std::size_t nearest_name(const Vec3& p_W, const std::optional<Pose>& moved) const {
    std::size_t best = 0;
    double least = 1e300;
    for (std::size_t i = 0; i < split_.fragments.size(); ++i) {
      const Vec3& near = split_.fragments[i].near.p_W;
      const double away = (p_W - (moved ? Vec3(*moved * near) : near)).norm();
      if (away < least) best = i;
      least = std::min(least, away);
    }
    return best;
  }

  std::size_t nearest_fragment(const Vec3& p_W) const {
    std::size_t best = 0;
    double least = 1e300;
    for (std::size_t i = 0; i < surfaces_.size(); ++i) {
      const double away = surfaces_[i].closest(p_W).signed_distance;
      if (away < least) best = i;
      least = std::min(least, away);
    }
    return best;
  }

  const std::string& name_of(std::size_t fragment) const { return split_.fragments[fragment].name; }

  void split_softs() {
    std::vector<GeneratedSoft> softs;
    for (GeneratedSoft& soft : grown_.softs) {
      const auto at = std::find(soft.bones.begin(), soft.bones.end(), name_);
      if (at == soft.bones.end()) {
        softs.push_back(std::move(soft));
      } else if (soft.kind == "cartilage") {
        for (GeneratedSoft& part : split_layer(soft)) softs.push_back(std::move(part));
      } else {
        rebind(soft);
        softs.push_back(std::move(soft));
      }
    }
    grown_.softs = std::move(softs);
  }

  /// "scaphoid_cartilage" becomes "scaphoid_distal_cartilage".
  std::string name_of_layer(const std::string& soft, std::size_t fragment) const {
    if (soft.starts_with(name_)) return name_of(fragment) + soft.substr(name_.size());
    return name_of(fragment) + "_" + soft;
  }

  std::vector<GeneratedSoft> split_layer(const GeneratedSoft& soft) const {
    std::vector<std::vector<std::uint32_t>> pieces(surfaces_.size());
    for (const std::uint32_t piece : largest_pieces(soft.mesh_W, soft.mesh_W.vertices.size()))
      pieces[nearest_fragment(soft.mesh_W.vertices[piece])].push_back(piece);
    std::vector<GeneratedSoft> parts;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      if (pieces[i].empty()) continue;
      GeneratedSoft part = soft;
      part.name = name_of_layer(soft.name, i);
      part.mesh_W = take_pieces(soft.mesh_W, pieces[i]);
      part.bones = {name_of(i)};
      parts.push_back(std::move(part));
    }
    return parts;
  }

  /// A band holds on to the fragment that lies nearest; what fills a space moves with both.
  void rebind(GeneratedSoft& soft) const {
    std::vector<std::string> bones;
    const auto add = [&](const std::string& name) {
      if (std::find(bones.begin(), bones.end(), name) == bones.end()) bones.push_back(name);
    };
    for (GeneratedAttachment& attachment : soft.attachments)
      if (attachment.bone == name_) {
        attachment.bone = name_of(nearest_fragment(attachment.p_W));
        add(attachment.bone);
      }
    for (const std::string& bone : soft.bones)
      if (bone != name_) add(bone);
    if (soft.attachments.empty())
      for (const BoneSplit::Fragment& fragment : split_.fragments) add(fragment.name);
    soft.bones = std::move(bones);
  }

  const BoneSplit& split_;
  std::string name_;
  GeneratedAnatomy& grown_;
  std::vector<MeshDistance> surfaces_;  ///< of the fragments, in World
};

}  // namespace

Result<void> split_bones(const AnatomyDescription& anatomy, const std::string& file,
                         GeneratedAnatomy& grown) {
  for (const BoneSplit& split : anatomy.splits) {
    const std::string& name = anatomy.bones[split.bone].name;
    Splitter splitter(split, name, grown);
    if (auto ok = splitter.run(displacement_of(anatomy, split.bone)); !ok)
      return fail(ok.error().what, file + ": bone '" + name + "'",
                  "Choose a smaller cell, or values closer to the means");
  }
  return {};
}

}  // namespace osteon
