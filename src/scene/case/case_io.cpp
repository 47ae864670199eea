#include "osteon/scene/case_io.h"

#include <algorithm>
#include <set>
#include <system_error>
#include <utility>

#include "numbers.h"
#include "osteon/base/file.h"
#include "osteon/mesh/mesh_io.h"
#include "osteon/mesh/repair.h"

namespace osteon {
namespace fs = std::filesystem;
namespace {

constexpr std::uint64_t kTomlLimitBytes = 4u << 20;

// A link could still lead out of the folder.
Result<fs::path> resolve_inside(const fs::path& folder, const std::string& file) {
  std::error_code ec;
  const fs::path path = folder / file;
  const fs::path real = fs::canonical(path, ec);
  if (ec) return fail("cannot be found", path.string(), "Restore the mesh file");
  const fs::path root = fs::canonical(folder, ec);
  const auto differ = std::mismatch(root.begin(), root.end(), real.begin(), real.end());
  if (ec || differ.first != root.end())
    return fail("points outside the case's folder", path.string(), "Copy the mesh into the folder");
  return path;
}

Result<TriMesh> load_part_mesh(const fs::path& folder, const std::string& file,
                               double metres_per_unit) {
  const auto path = resolve_inside(folder, file);
  if (!path) return tl::unexpected(path.error());
  auto mesh = load_mesh(*path, metres_per_unit);
  if (mesh) weld_vertices(*mesh, 0);
  return mesh;
}

// Letters, digits, - and _ only, and not yet used (some file systems know no upper case).
std::string mesh_file_name(const std::string& part_name, std::set<std::string>& used) {
  std::string stem;
  for (const char c : part_name) {
    const bool upper = c >= 'A' && c <= 'Z';
    const bool plain = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-';
    stem += upper ? static_cast<char>(c - 'A' + 'a') : (plain ? c : '_');
  }
  std::string name = stem;
  for (int n = 2; !used.insert(name).second; ++n) name = stem + "_" + std::to_string(n);
  return name + ".stl";
}

std::string quoted(const std::string& text) {
  static constexpr char kHex[] = "0123456789abcdef";
  std::string out = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      out.append({'\\', c});
    } else if (byte < 0x20 || byte == 0x7f) {
      out.append("\\u00").append({kHex[byte >> 4], kHex[byte & 15]});
    } else {
      out += c;
    }
  }
  return out + "\"";
}

std::string bracketed(std::initializer_list<double> values) {
  std::string out = "[";
  for (const double value : values) {
    if (out.size() > 1) out += ", ";
    out += format_number(value);
  }
  return out + "]";
}

std::string bracketed(const Vec3& v) { return bracketed({v.x(), v.y(), v.z()}); }

std::string bone_text(const BoneDef& bone, const std::string& mesh_file) {
  const Quat& q = bone.X_WB.q;
  const Material& m = bone.material;
  return "\n[[bones]]\nname = " + quoted(bone.name) + "\nfma_id = " + std::to_string(bone.fma_id) +
         "\nmesh = " + quoted(mesh_file) + "\nposition_m = " + bracketed(bone.X_WB.p) +
         "\nrotation_wxyz = " + bracketed({q.w(), q.x(), q.y(), q.z()}) +
         "\nfelt = " + quoted(std::string(to_text(bone.felt))) +
         (bone.beside ? "\nbeside = true" : "") +
         "\ndensity_kg_per_m3 = " + format_number(bone.density_kg_per_m3) +
         "\nmaterial = { stiffness_n_per_m = " + format_number(m.stiffness_n_per_m) +
         ", static_friction = " + format_number(m.static_friction) +
         ", dynamic_friction = " + format_number(m.dynamic_friction) + " }\n";
}

std::string listed(const std::vector<std::string>& texts) {
  std::string out;
  for (const std::string& text : texts) out += (out.empty() ? "" : ", ") + quoted(text);
  return "[" + out + "]";
}

std::string soft_text(const SoftDef& soft, const std::string& mesh_file) {
  std::string text =
      "\n[[soft]]\nname = " + quoted(soft.name) + "\nfma_id = " + std::to_string(soft.fma_id) +
      "\ntissue = " + quoted(soft.tissue) + "\nkind = " + quoted(soft.kind) +
      "\nmesh = " + quoted(mesh_file) + "\nthickness_m = " + format_number(soft.thickness_m) +
      "\nbones = " + listed(soft.bones) + "\n";
  for (const AttachmentDef& attachment : soft.attachments)
    text += "[[soft.attachments]]\nname = " + quoted(attachment.name) +
            "\nbone = " + quoted(attachment.bone) + "\nposition_m = " + bracketed(attachment.p_W) +
            "\n";
  return text;
}

std::string joint_text(const JointDef& joint) {
  std::string text = "\n[[joints]]\nname = " + quoted(joint.name) +
                     "\nfixed = " + quoted(joint.fixed) +
                     "\nat_deg = " + format_number(joint.at_deg) + "\n";
  for (const JointDef::Moved& moved : joint.bones) {
    text += "[[joints.moved]]\nbone = " + quoted(moved.bone) +
            "\nfirst_deg = " + format_number(moved.X_FB.first) +
            "\nstep_deg = " + format_number(moved.X_FB.step) + "\nposes = [\n";
    for (const Pose& X : moved.X_FB.poses)
      text +=
          "  " + bracketed({X.p.x(), X.p.y(), X.p.z(), X.q.w(), X.q.x(), X.q.y(), X.q.z()}) + ",\n";
    text += "]\n";
  }
  return text;
}

std::string recipe_text(const CaseRecipe& recipe) {
  std::string text = "\n[recipe]\nanatomy = " + quoted(recipe.anatomy) + "\n";
  if (recipe.seed) text += "seed = " + quoted(std::to_string(*recipe.seed)) + "\n";
  text += "side = " + quoted(recipe.side) + "\n";
  for (const auto& [name, value] : recipe.set)
    text += "[[recipe.set]]\nname = " + quoted(name) + "\nvalue = " + format_number(value) + "\n";
  for (const auto& [name, grade] : recipe.findings)
    text += "[[recipe.findings]]\nname = " + quoted(name) + "\ngrade = " + quoted(grade) + "\n";
  return text;
}

/// Files of the meshes in the order of bones and soft parts.
struct MeshFiles {
  std::vector<std::string> bones, softs;
};

std::string case_text(const CaseDef& def, const MeshFiles& files) {
  std::string text =
      "# Osteon case. Lengths in metres; the meshes of bones are in the frame of their "
      "bone,\n# those of soft parts in World.\n";
  text += "format = 1\nname = " + quoted(def.name) + "\nside = " + quoted(def.side) +
          "\nmesh_unit = \"m\"\n";
  for (std::size_t i = 0; i < def.bones.size(); ++i)
    text += bone_text(def.bones[i], files.bones[i]);
  for (std::size_t i = 0; i < def.softs.size(); ++i)
    text += soft_text(def.softs[i], files.softs[i]);
  for (const Landmark& landmark : def.landmarks) {
    text += "\n[[landmarks]]\nname = " + quoted(landmark.name) +
            "\nposition_m = " + bracketed(landmark.p_W) + "\n";
    if (!landmark.inwards_W.isZero(0)) text += "inwards = " + bracketed(landmark.inwards_W) + "\n";
    if (!landmark.bone.empty()) text += "bone = " + quoted(landmark.bone) + "\n";
  }
  for (const CaseFinding& finding : def.findings)
    text += "\n[[findings]]\nname = " + quoted(finding.name) +
            "\ngrade = " + quoted(finding.grade) + "\nmeaning = " + quoted(finding.meaning) + "\n";
  for (const JointDef& joint : def.joints) text += joint_text(joint);
  if (def.recipe) text += recipe_text(*def.recipe);
  return text;
}

Result<void> make_empty_folder(const fs::path& folder) {
  std::error_code ec;
  fs::create_directories(folder, ec);
  if (ec || !fs::is_directory(folder, ec))
    return fail("cannot be made (" + ec.message() + ")", folder.string(), "Choose another folder");
  if (!fs::is_empty(folder, ec) || ec)
    return fail("is not empty", folder.string(), "Choose a new or empty folder");
  return {};
}

}  // namespace

Result<CaseDef> load_case(const fs::path& folder) {
  const fs::path file = folder / "case.toml";
  std::error_code ec;
  if (!fs::exists(folder, ec))
    return fail("there is no such case folder", folder.string(),
                "Name the folder that holds case.toml");
  if (!fs::is_directory(folder, ec))
    return fail("is not a case folder", folder.string(), "Name the folder that holds case.toml");
  const auto text = read_file(file, kTomlLimitBytes);
  if (!text) return tl::unexpected(text.error());
  auto parsed = parse_case_toml(*text, file.string());
  if (!parsed) return tl::unexpected(parsed.error());
  for (std::size_t i = 0; i < parsed->def.bones.size(); ++i) {
    auto mesh = load_part_mesh(folder, parsed->mesh_files[i], parsed->metres_per_unit);
    if (!mesh) return tl::unexpected(mesh.error());
    parsed->def.bones[i].mesh = std::move(*mesh);
  }
  for (std::size_t i = 0; i < parsed->def.softs.size(); ++i) {
    auto mesh = load_part_mesh(folder, parsed->soft_files[i], parsed->metres_per_unit);
    if (!mesh) return tl::unexpected(mesh.error());
    parsed->def.softs[i].mesh_W = std::move(*mesh);
  }
  return std::move(parsed->def);
}

Result<void> save_case(const CaseDef& def, const fs::path& folder) {
  MeshFiles files;
  std::set<std::string> used;
  for (const BoneDef& bone : def.bones) files.bones.push_back(mesh_file_name(bone.name, used));
  for (const SoftDef& soft : def.softs) files.softs.push_back(mesh_file_name(soft.name, used));
  const std::string text = case_text(def, files);
  // What could not be read again is not written.
  const auto readable = parse_case_toml(text, "case '" + def.name + "'");
  if (!readable) return tl::unexpected(readable.error());
  if (auto made = make_empty_folder(folder); !made) return made;
  for (std::size_t i = 0; i < def.bones.size(); ++i)
    if (auto saved = save_stl(def.bones[i].mesh, folder / files.bones[i], 1); !saved) return saved;
  for (std::size_t i = 0; i < def.softs.size(); ++i)
    if (auto saved = save_stl(def.softs[i].mesh_W, folder / files.softs[i], 1); !saved)
      return saved;
  return write_file_atomic(folder / "case.toml", text);
}

}  // namespace osteon
