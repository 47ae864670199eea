#include "osteon/mesh/mesh_io.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "mesh/shapes.h"
#include "osteon/base/file.h"
#include "osteon/mesh/measure.h"

namespace osteon {
namespace {

namespace fs = std::filesystem;
using test::cube;

Result<TriMesh> load_text(const std::string& bytes, const std::string& extension,
                          double metres_per_unit = 1) {
  return load_mesh_from_memory(bytes, extension, metres_per_unit, "test." + extension);
}

std::string stl_bytes(const TriMesh& mesh, const std::string& test_name) {
  const fs::path file = test::fresh_folder(test_name) / "mesh.stl";
  EXPECT_TRUE(save_stl(mesh, file, 1).has_value());
  return *read_file(file);
}

std::string ascii_cube() {
  std::string text = "solid a cube of edge 1\n";
  const TriMesh m = cube();
  for (const Triangle& t : m.triangles) {
    text += "  facet normal 0 0 0\n    outer loop\n";
    for (const std::uint32_t v : t) {
      text += "      vertex";
      for (int i = 0; i < 3; ++i) text.append(" ").append(std::to_string(m.vertices[v][i]));
      text += "\n";
    }
    text += "    endloop\n  endfacet\n";
  }
  return text + "endsolid a cube of edge 1\n";
}

TEST(MeshIo, RefusesWhatIsNotThere) {
  const auto missing = load_mesh("/nowhere/bone.stl", 1);
  ASSERT_FALSE(missing);
  EXPECT_NE(missing.error().message().find("bone.stl"), std::string::npos);
  EXPECT_FALSE(load_mesh("/nowhere", 1));
  EXPECT_FALSE(load_mesh(test::fresh_folder("io_dir.stl"), 1));
}

TEST(MeshIo, RefusesUnknownFormats) {
  const fs::path file = test::fresh_folder("io_unknown") / "bone.step";
  ASSERT_TRUE(write_file_atomic(file, "ISO-10303-21;"));
  const auto result = load_mesh(file, 1);
  ASSERT_FALSE(result);
  EXPECT_NE(result.error().todo.find("STL"), std::string::npos);
}

TEST(MeshIo, RefusesBadUnits) {
  const std::string bytes = stl_bytes(cube(), "io_unit");
  for (const double unit : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()})
    EXPECT_FALSE(load_text(bytes, "stl", unit)) << unit;
}

TEST(MeshIo, RefusesEmptyFilesOfEveryFormat) {
  for (const char* extension : {"stl", "obj", "ply", "gltf", "glb"})
    EXPECT_FALSE(load_text("", extension)) << extension;
}

TEST(MeshIo, RefusesTruncatedBinaryStlAtEveryLength) {
  const std::string bytes = stl_bytes(cube(), "io_truncated");
  ASSERT_EQ(bytes.size(), 84u + 12 * 50);
  for (std::size_t size = 0; size < bytes.size(); ++size)
    ASSERT_FALSE(load_text(bytes.substr(0, size), "stl")) << size;
  EXPECT_TRUE(load_text(bytes, "stl"));
}

TEST(MeshIo, RefusesTruncatedAsciiStl) {
  const std::string text = ascii_cube();
  const std::size_t closing = text.rfind("endsolid");
  for (std::size_t size = 0; size < closing + 8; ++size)
    ASSERT_FALSE(load_text(text.substr(0, size), "stl")) << size;
  EXPECT_TRUE(load_text(text, "stl"));
}

TEST(MeshIo, RefusesADeclaredCountBeyondTheFile) {
  std::string bytes = stl_bytes(cube(), "io_count");
  std::memset(bytes.data() + 80, 0xff, 4);
  const auto result = load_text(bytes, "stl");
  ASSERT_FALSE(result);
  EXPECT_NE(result.error().what.find("truncated"), std::string::npos);
}

TEST(MeshIo, RefusesNotFiniteAndAbsurdCoordinates) {
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity(), 1e9}) {
    TriMesh m = cube();
    m.vertices[5].y() = bad;
    EXPECT_FALSE(load_text(stl_bytes(m, "io_finite"), "stl")) << bad;
  }
}

TEST(MeshIo, RefusesAMeshWithoutTriangles) {
  EXPECT_FALSE(load_text(stl_bytes(TriMesh{}, "io_none"), "stl"));
  EXPECT_FALSE(load_text("solid empty\nendsolid empty\n", "stl"));
  EXPECT_FALSE(load_text("v 0 0 0\nv 1 0 0\nv 0 1 0\n", "obj"));
}

TEST(MeshIo, BinaryStlRoundTripsToTheSameBytes) {
  const TriMesh m = test::sphere(0.0123, 9, Vec3(0.1, -0.2, 0.3));
  const fs::path dir = test::fresh_folder("io_round");
  for (const double unit : {1.0, 0.01, 0.001}) {
    ASSERT_TRUE(save_stl(m, dir / "a.stl", unit));
    const auto once = load_mesh(dir / "a.stl", unit);
    ASSERT_TRUE(once);
    EXPECT_EQ(once->triangles.size(), m.triangles.size());
    EXPECT_NEAR(volume(*once), volume(m), 1e-6 * volume(m));
    ASSERT_TRUE(save_stl(*once, dir / "b.stl", unit));
    const auto twice = load_mesh(dir / "b.stl", unit);
    ASSERT_TRUE(twice);
    EXPECT_TRUE(*read_file(dir / "a.stl") == *read_file(dir / "b.stl")) << unit;
    EXPECT_TRUE(once->vertices == twice->vertices);
  }
}

TEST(MeshIo, ABinaryFileThatBeginsWithSolidIsBinary) {
  std::string bytes = stl_bytes(cube(), "io_solid");
  std::memcpy(bytes.data(), "solid x ", 8);
  const auto result = load_text(bytes, "stl");
  ASSERT_TRUE(result);
  EXPECT_NEAR(volume(*result), 1, 1e-6);
}

TEST(MeshIo, ReadsAsciiStlInItsUnit) {
  const auto result = load_text(ascii_cube(), "stl", 0.001);
  ASSERT_TRUE(result) << result.error().message();
  EXPECT_EQ(result->triangles.size(), 12u);
  EXPECT_NEAR(volume(*result), 1e-9, 1e-15);
}

TEST(MeshIo, ErrorsInAsciiStlNameTheLine) {
  std::string text = ascii_cube();
  text.replace(text.find("vertex"), 6, "vortex");
  const auto result = load_text(text, "stl");
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().where, "test.stl:4");
}

TEST(MeshIo, ReadsObjWithQuads) {
  const std::string text =
      "# a cube\no cube\n"
      "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
      "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 3 4 8 7\nf 1 5 8 4\nf 2 3 7 6\n";
  const auto result = load_text(text, "obj", 0.01);
  ASSERT_TRUE(result) << result.error().message();
  EXPECT_EQ(result->triangles.size(), 12u);
  EXPECT_NEAR(volume(*result), 1e-6, 1e-12);
}

TEST(MeshIo, RefusesObjFacesWithoutVertices) {
  EXPECT_FALSE(load_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n", "obj"));
}

const std::string kPlyHead =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
    "property float z\nelement face 4\nproperty list uchar int vertex_indices\nend_header\n";
const std::string kPlyVertices = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n";
const std::string kPlyFaces = "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";

TEST(MeshIo, ReadsAsciiPly) {
  const auto result = load_text(kPlyHead + kPlyVertices + kPlyFaces, "ply");
  ASSERT_TRUE(result) << result.error().message();
  EXPECT_EQ(result->triangles.size(), 4u);
  EXPECT_NEAR(volume(*result), 1.0 / 6, 1e-6);
}

// At every length: what is lost is an error, never a smaller bone. A last number may lose its last
// digits and the last line break without a trace.
TEST(MeshIo, RefusesTruncatedPly) {
  const std::string text = kPlyHead + kPlyVertices + kPlyFaces;
  for (std::size_t size = 0; size + 1 < text.size(); ++size)
    ASSERT_FALSE(load_text(text.substr(0, size), "ply")) << text.substr(0, size);
  EXPECT_TRUE(load_text(text, "ply"));
}

std::string binary_ply(bool big_endian) {
  std::string text = "ply\nformat binary_";
  text += big_endian ? "big" : "little";
  text +=
      "_endian 1.0\ncomment made by hand\nelement face 4\n"
      "property list uchar ushort vertex_index\nproperty uchar quality\nelement vertex 4\n"
      "property double x\nproperty uchar red\nproperty double y\nproperty float z\n"
      "end_header\n";
  const auto put = [&](const auto value) {
    std::string bytes(sizeof value, 0);
    std::memcpy(bytes.data(), &value, sizeof value);
    if (big_endian) std::reverse(bytes.begin(), bytes.end());
    text += bytes;
  };
  const std::uint16_t faces[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  for (const auto& face : faces) {
    put(std::uint8_t{3});
    for (const std::uint16_t v : face) put(v);
    put(std::uint8_t{200});
  }
  const double corners[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (const auto& c : corners) {
    put(c[0]);
    put(std::uint8_t{7});
    put(c[1]);
    put(static_cast<float>(c[2]));
  }
  return text;
}

TEST(MeshIo, ReadsBinaryPlyOfBothByteOrders) {
  for (const bool big_endian : {false, true}) {
    const std::string bytes = binary_ply(big_endian);
    const auto result = load_text(bytes, "ply");
    ASSERT_TRUE(result) << result.error().message();
    EXPECT_NEAR(volume(*result), 1.0 / 6, 1e-12);
    for (std::size_t size = 0; size < bytes.size(); ++size)
      ASSERT_FALSE(load_text(bytes.substr(0, size), "ply")) << size;
  }
}

TEST(MeshIo, RefusesBrokenPly) {
  const std::string vertices =
      "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
  const std::string face = "element face 1\nproperty list uchar int vertex_indices\n";
  const std::string data = "end_header\n0 0 0\n1 0 0\n0 1 0\n";
  const std::string head = "ply\nformat ascii 1.0\n";
  ASSERT_TRUE(load_text(head + vertices + face + data + "3 0 1 2\n", "ply"));
  for (const std::string& text : {
           "ply\n" + vertices + face + data + "3 0 1 2\n",
           "ply\nformat ascii 2.0\n" + vertices + face + data + "3 0 1 2\n",
           head + "element vertex 3\nproperty float x\n" + face + "end_header\n0\n1\n2\n3 0 1 2\n",
           head + vertices + face + data + "3 0 1 3\n",
           head + vertices + face + data + "3 0 1 -1\n",
           head + vertices + face + data + "3 0 1 1.5\n",
           head + vertices + face + data + "2 0 1\n",
           head + vertices + face + data + "-3 0 1 2\n",
           head + vertices + face + data + "4294967295 0 1 2\n",
           head + vertices + face + data + "3 0 1 x\n",
           head + vertices + "element face 99999999999\n" + data,
           head + vertices + "property list x int y\n" + data,
           head + "property float x\n" + vertices + data,
       })
    EXPECT_FALSE(load_text(text, "ply")) << text;
}

TEST(MeshIo, RefusesBrokenObj) {
  const std::string vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  for (const char* rest : {"f 1 2", "f 1 2 x", "f 0 1 2", "f 1 2 -4", "f 1 2 3.5", "v 1 2",
                           "v 1 2 nan3", "w 1 2 3", "f 1 2 99999999999999999999"}) {
    const auto result = load_text(vertices + "f 1 2 3\n" + rest, "obj");
    ASSERT_FALSE(result) << rest;
    EXPECT_EQ(result.error().where, "test.obj:5") << rest;
  }
  EXPECT_FALSE(load_text(vertices + "v nan 0 0\nf 1 2 3\n", "obj"));
}

TEST(MeshIo, ReadsObjIndicesOfEveryKind) {
  const auto result = load_text(
      "mtllib none.mtl\r\nv 0 0 0 1\r\nv 1 0 0 0.5 0.5 0.5\r\nvt 0 0\r\nvn 0 0 1\r\nv 0 1 0\r\n"
      "usemtl bone\r\ns off\r\nf -3/1 -2//1 -1/1/1\r\n# the end",
      "obj");
  ASSERT_TRUE(result) << result.error().message();
  EXPECT_TRUE((result->triangles == std::vector<Triangle>{{0, 1, 2}}));
}

TEST(MeshIo, CutsConcavePolygonsInsideTheirRim) {
  // An arrow head: the fan from its first corner would leave it.
  const auto result = load_text("v 0 0 0\nv 4 3 0\nv 0 1 0\nv -4 3 0\nf 2 3 4 1\n", "obj");
  ASSERT_TRUE(result);
  EXPECT_EQ(result->triangles.size(), 2u);
  EXPECT_NEAR(area(*result), 4, 1e-9);
}

// One triangle, held by a node that moves, scales and mirrors it.
std::string gltf(const std::string& node) {
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[)" + node +
         R"(],"meshes":[{"primitives":[{"attributes":{"POSITION":0},"mode":4}]}],)"
         R"("accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3",)"
         R"("min":[0,0,0],"max":[1,1,0]}],)"
         R"("bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":36}],"buffers":[{)"
         R"("byteLength":36,"uri":"data:application/octet-stream;base64,)"
         R"(AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})";
}

TEST(MeshIo, AppliesTheTransformsOfGltfNodes) {
  const auto result = load_text(
      gltf(R"({"children":[1],"translation":[10,0,0]},{"mesh":0,"scale":[2,2,2]})"), "gltf");
  ASSERT_TRUE(result) << result.error().message();
  const Aabb box = bounds(*result);
  EXPECT_LT((box.lo - Vec3(10, 0, 0)).norm(), 1e-6);
  EXPECT_LT((box.hi - Vec3(12, 2, 0)).norm(), 1e-6);
}

TEST(MeshIo, AMirroredPartKeepsItsOutside) {
  const auto plain = load_text(gltf(R"({"mesh":0})"), "gltf");
  const auto mirrored = load_text(gltf(R"({"mesh":0,"scale":[1,1,-1]})"), "gltf");
  ASSERT_TRUE(plain && mirrored);
  // z is mirrored, so the normal that was +z must be -z.
  const auto normal = [](const TriMesh& m) {
    const Triangle& t = m.triangles[0];
    const Vec3& a = m.vertices[t[0]];
    return (m.vertices[t[1]] - a).cross(m.vertices[t[2]] - a).eval();
  };
  EXPECT_GT(normal(*plain).z(), 0);
  EXPECT_LT(normal(*mirrored).z(), 0);
}

TEST(MeshIo, ReadsAGltfFileWithABufferBesideIt) {
  const fs::path dir = test::fresh_folder("io_gltf");
  std::string text = gltf(R"({"mesh":0})");
  const std::size_t from = text.find("data:");
  text.replace(from, text.find('"', from) - from, "part.bin");
  const float corners[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  std::string buffer(sizeof corners, '\0');
  std::memcpy(buffer.data(), corners, sizeof corners);
  ASSERT_TRUE(write_file_atomic(dir / "part.bin", buffer));
  ASSERT_TRUE(write_file_atomic(dir / "part.gltf", text));
  const auto result = load_mesh(dir / "part.gltf", 1);
  ASSERT_TRUE(result) << result.error().message();
  EXPECT_NEAR(area(*result), 0.5, 1e-6);
}

TEST(MeshIo, NoiseIsRefusedOrHarmless) {
  for (const char* extension : {"stl", "obj", "ply", "gltf", "glb"}) {
    const auto result = load_text(std::string(500, '\x5a'), extension);
    EXPECT_FALSE(result) << extension;
  }
}

// A head that promises gigabytes must not get room for them.
TEST(MeshIo, ABinaryGltfOfAnotherVersionOrCutShortIsRefusedByItsHead) {
  const auto glb = [](char version, char length, std::string tail) {
    std::string bytes("glTF\0\0\0\0\0\0\0\0\0\0\0\0JSON", 20);
    bytes[4] = version;
    bytes[8] = length;
    bytes.replace(12, tail.size(), tail);
    return load_mesh_from_memory(bytes, "glb", 1, "bone.glb");
  };
  const auto old = glb(1, 20, "\xff\xff\xff\xff");
  ASSERT_FALSE(old);
  EXPECT_NE(old.error().what.find("version 1"), std::string::npos) << old.error().what;
  const auto chunk = glb(2, 20, "\xff\xff\xff\xff");
  ASSERT_FALSE(chunk);
  EXPECT_NE(chunk.error().what.find("is truncated"), std::string::npos) << chunk.error().what;
  const auto whole = glb(2, 21, "");
  ASSERT_FALSE(whole);
  EXPECT_NE(whole.error().what.find("is truncated"), std::string::npos) << whole.error().what;
  EXPECT_FALSE(load_mesh_from_memory("glTF", "glb", 1, "bone.glb"));
}

}  // namespace
}  // namespace osteon
