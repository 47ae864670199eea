#include "io/scene_import.h"

#include <assimp/BaseImporter.h>
#include <assimp/scene.h>

#include <assimp/Importer.hpp>
#include <cstdint>
#include <exception>
#include <fstream>
#include <set>
#include <system_error>
#include <utility>

namespace osteon {
namespace {

constexpr int kDeepestNode = 256;
constexpr std::size_t kGlbHead = 20;  // bytes: the file's head and that of its first chunk
constexpr std::size_t kMostVertices = 100'000'000;

// Assimp would also try its fifty other readers on bytes that it does not know: keep one.
void keep_reader_of(Assimp::Importer& importer, const std::string& extension) {
  for (std::size_t i = importer.GetImporterCount(); i-- > 0;) {
    Assimp::BaseImporter* reader = importer.GetImporter(i);
    std::set<std::string> extensions;
    reader->GetExtensionList(extensions);
    if (extensions.count(extension)) continue;
    importer.UnregisterLoader(reader);
    delete reader;  // unregistered readers belong to the caller
  }
}

std::uint64_t word_at(std::string_view bytes, std::size_t at) {
  std::uint64_t word = 0;
  for (std::size_t i = 0; i < 4; ++i)
    word |= static_cast<std::uint64_t>(static_cast<unsigned char>(bytes[at + i])) << (8 * i);
  return word;
}

// Assimp makes room for what the head of a binary glTF promises, be it gigabytes, before it looks
// how long the file is. `head` is the file's begin (glTF 2.0 specification, section 4.4).
Result<void> check_glb(std::string_view head, std::uint64_t size, const std::string& where) {
  const std::string todo = "Copy or export the file again, as binary glTF 2.0";
  if (head.size() < kGlbHead || head.substr(0, 4) != "glTF")
    return fail("is not a binary glTF file", where, todo);
  const std::uint64_t version = word_at(head, 4);
  if (version != 2)
    return fail("is of glTF version " + std::to_string(version) + ", which is not supported", where,
                todo);
  const std::uint64_t length = word_at(head, 8), first_chunk = word_at(head, 12);
  if (length > size || first_chunk > size - kGlbHead)
    return fail(
        "is truncated: its header declares more than its " + std::to_string(size) + " bytes", where,
        todo);
  return {};
}

// Joins the meshes of a tree of nodes in the root's frame.
class Joiner {
 public:
  explicit Joiner(const aiScene& scene) : scene_(scene) {}

  bool join(const aiNode& node, const aiMatrix4x4& parent, int depth) {
    if (depth > kDeepestNode) return false;
    const aiMatrix4x4 X = parent * node.mTransformation;
    for (unsigned i = 0; i < node.mNumMeshes; ++i)
      if (!add(*scene_.mMeshes[node.mMeshes[i]], X)) return false;
    for (unsigned i = 0; i < node.mNumChildren; ++i)
      if (!join(*node.mChildren[i], X, depth + 1)) return false;
    return true;
  }

  TriMesh take() { return std::move(mesh_); }

 private:
  bool add(const aiMesh& part, const aiMatrix4x4& X) {
    if (mesh_.vertices.size() + part.mNumVertices > kMostVertices) return false;
    const auto first = static_cast<std::uint32_t>(mesh_.vertices.size());
    for (unsigned v = 0; v < part.mNumVertices; ++v) {
      const aiVector3D p = X * part.mVertices[v];
      mesh_.vertices.emplace_back(p.x, p.y, p.z);
    }
    const bool mirrored = X.Determinant() < 0;  // a mirrored part would be inside out
    for (unsigned f = 0; f < part.mNumFaces; ++f) {
      const aiFace& face = part.mFaces[f];
      for (unsigned k = 0; k < face.mNumIndices; ++k)
        if (face.mIndices[k] >= part.mNumVertices) return false;
      if (face.mNumIndices != 3) continue;  // points and lines; glTF has no polygons
      Triangle t{first + face.mIndices[0], first + face.mIndices[1], first + face.mIndices[2]};
      if (mirrored) std::swap(t[1], t[2]);
      mesh_.triangles.push_back(t);
    }
    return true;
  }

  const aiScene& scene_;
  TriMesh mesh_;
};

Result<TriMesh> join_scene(const aiScene* scene, const Assimp::Importer& importer,
                           const std::string& where) {
  if (!scene || !scene->mRootNode || (scene->mFlags & AI_SCENE_FLAGS_INCOMPLETE)) {
    const std::string why = importer.GetErrorString();
    return fail("cannot be read as a mesh" + (why.empty() ? "" : " (" + why + ")"), where,
                "Copy or export the file again");
  }
  Joiner joiner(*scene);
  if (!joiner.join(*scene->mRootNode, aiMatrix4x4(), 0))
    return fail("is broken, too large or too deeply nested", where, "Export one plain mesh");
  return joiner.take();
}

template <class Read>
Result<TriMesh> import_with(const std::string& extension, const std::string& where, Read read) {
  try {
    Assimp::Importer importer;
    keep_reader_of(importer, extension);
    return join_scene(read(importer), importer, where);
  } catch (const std::exception& e) {
    return fail(std::string("cannot be read as a mesh (") + e.what() + ")", where,
                "Copy or export the file again");
  }
}

}  // namespace

Result<TriMesh> import_scene(std::string_view bytes, const std::string& extension,
                             const std::string& where) {
  if (extension == "glb")
    if (const auto checked = check_glb(bytes, bytes.size(), where); !checked)
      return tl::unexpected(checked.error());
  return import_with(extension, where, [&](Assimp::Importer& importer) {
    return importer.ReadFileFromMemory(bytes.data(), bytes.size(), 0, extension.c_str());
  });
}

Result<TriMesh> import_scene_file(const std::filesystem::path& path, const std::string& extension) {
  if (extension == "glb") {
    std::string head(kGlbHead, '\0');
    std::ifstream file(path, std::ios::binary);
    file.read(head.data(), static_cast<std::streamsize>(head.size()));
    head.resize(static_cast<std::size_t>(file.gcount()));
    std::error_code ec;
    const std::uintmax_t size = std::filesystem::file_size(path, ec);
    if (const auto checked = check_glb(head, ec ? 0 : size, path.string()); !checked)
      return tl::unexpected(checked.error());
  }
  return import_with(extension, path.string(), [&](Assimp::Importer& importer) {
    return importer.ReadFile(path.string(), 0);
  });
}

}  // namespace osteon
