#pragma once

#include <functional>
#include <span>
#include <vector>

#include "gl/gl_objects.h"
#include "osteon/render/prepare.h"

namespace osteon {

/// Vertices and indices on the graphics card; empty draws nothing.
class GpuMesh {
 public:
  GpuMesh() = default;
  /// Triangles with smooth normals and baked shades.
  explicit GpuMesh(const ShadedMesh& mesh);

  /// One of the mesh's coarser levels, with no more vertices than it needs.
  GpuMesh(const ShadedMesh& mesh, const std::vector<Triangle>& triangles);

  /// Ends two by two.
  static GpuMesh lines(std::span<const std::array<float, 3>> ends);

  /// Neighbouring triangles.
  struct Chunk {
    Vec3 center = Vec3::Zero();  ///< of a ball around them
    double radius = 0;
    GLsizei count = 0;
    const void* first = nullptr;
  };
  /// Chunks that follow on each other are drawn as one.
  struct Stretches {
    std::vector<GLsizei> counts;
    std::vector<const void*> firsts;
    bool empty() const { return counts.empty(); }
  };

  bool empty() const { return count_ == 0; }
  void draw() const;
  const std::vector<Chunk>& chunks() const { return chunks_; }
  Stretches stretches(const std::function<bool(const Chunk&)>& wanted) const;
  void draw(const Stretches& stretches) const;
  /// Only the chunks that are wanted.
  void draw(const std::function<bool(const Chunk&)>& wanted) const;

 private:
  struct Vertex;
  void fill(const std::vector<Vertex>& vertices, const std::vector<std::uint32_t>& indices);
  void make_chunks(const std::vector<Vertex>& vertices, const std::vector<std::uint32_t>& indices);
  static void describe_vertices();

  GlVertexArray array_;
  GlBuffer vertices_, indices_;
  GLenum mode_ = GL_TRIANGLES;
  GLsizei count_ = 0;
  std::vector<Chunk> chunks_;
};

}  // namespace osteon
