#include "gl/gpu_mesh.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <cstddef>

namespace osteon {

struct GpuMesh::Vertex {
  std::array<float, 3> position;
  std::array<float, 3> normal;
  ShadedMesh::Shade shade;
};

namespace {

const void* offset(std::size_t bytes) { return reinterpret_cast<const void*>(bytes); }

template <class T>
void upload(GLenum target, const GlBuffer& buffer, const std::vector<T>& data) {
  glBindBuffer(target, buffer.get());
  glBufferData(target, static_cast<GLsizeiptr>(data.size() * sizeof(T)), data.data(),
               GL_STATIC_DRAW);
}

}  // namespace

void GpuMesh::describe_vertices() {
  constexpr GLsizei stride = sizeof(Vertex);
  glEnableVertexAttribArray(0);
  glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, stride, offset(offsetof(Vertex, position)));
  glEnableVertexAttribArray(1);
  glVertexAttribPointer(1, 3, GL_FLOAT, GL_FALSE, stride, offset(offsetof(Vertex, normal)));
  glEnableVertexAttribArray(2);
  glVertexAttribPointer(2, 4, GL_UNSIGNED_BYTE, GL_TRUE, stride, offset(offsetof(Vertex, shade)));
}

GpuMesh::GpuMesh(const ShadedMesh& mesh) : GpuMesh(mesh, mesh.triangles) {}

GpuMesh::GpuMesh(const ShadedMesh& mesh, const std::vector<Triangle>& triangles) {
  if (triangles.empty()) return;
  std::vector<unsigned int> sorted;
  for (const Triangle& t : triangles) sorted.insert(sorted.end(), t.begin(), t.end());
  meshopt_spatialSortTriangles(sorted.data(), sorted.data(), sorted.size(),
                               mesh.positions.front().data(), mesh.positions.size(),
                               sizeof(mesh.positions.front()));
  constexpr std::uint32_t kUnused = 0xffffffffu;
  std::vector<std::uint32_t> place(mesh.positions.size(), kUnused);
  std::vector<Vertex> vertices;
  std::vector<std::uint32_t> indices;
  for (const unsigned int v : sorted) {
    if (place[v] == kUnused) {
      place[v] = static_cast<std::uint32_t>(vertices.size());
      vertices.push_back({mesh.positions[v], mesh.normals[v], mesh.shades[v]});
    }
    indices.push_back(place[v]);
  }
  make_chunks(vertices, indices);
  fill(vertices, indices);
}

GpuMesh GpuMesh::lines(std::span<const std::array<float, 3>> ends) {
  GpuMesh out;
  if (ends.empty()) return out;
  std::vector<Vertex> vertices;
  std::vector<std::uint32_t> indices;
  for (const auto& p : ends) {
    indices.push_back(static_cast<std::uint32_t>(vertices.size()));
    vertices.push_back({p, {0, 0, 1}, {255, 128, 128, 0}});
  }
  out.mode_ = GL_LINES;
  out.fill(vertices, indices);
  return out;
}

void GpuMesh::fill(const std::vector<Vertex>& vertices, const std::vector<std::uint32_t>& indices) {
  count_ = static_cast<GLsizei>(indices.size());
  array_ = make_vertex_array();
  vertices_ = make_buffer();
  indices_ = make_buffer();
  glBindVertexArray(array_.get());
  upload(GL_ARRAY_BUFFER, vertices_, vertices);
  upload(GL_ELEMENT_ARRAY_BUFFER, indices_, indices);
  describe_vertices();
  glBindVertexArray(0);
}

void GpuMesh::make_chunks(const std::vector<Vertex>& vertices,
                          const std::vector<std::uint32_t>& indices) {
  constexpr std::size_t kIndices = 3 * 96;
  for (std::size_t begin = 0; begin < indices.size(); begin += kIndices) {
    const std::size_t end = std::min(begin + kIndices, indices.size());
    Aabb box;
    const auto point = [&](std::size_t k) {
      const auto& p = vertices[indices[k]].position;
      return Eigen::Vector3f(p[0], p[1], p[2]).cast<double>().eval();
    };
    for (std::size_t k = begin; k < end; ++k) box.include(point(k));
    Chunk chunk{box.center(), 0, static_cast<GLsizei>(end - begin),
                offset(begin * sizeof(std::uint32_t))};
    for (std::size_t k = begin; k < end; ++k)
      chunk.radius = std::max(chunk.radius, (point(k) - chunk.center).norm());
    chunks_.push_back(chunk);
  }
}

GpuMesh::Stretches GpuMesh::stretches(const std::function<bool(const Chunk&)>& wanted) const {
  Stretches out;
  bool last_wanted = false;
  for (const Chunk& chunk : chunks_) {
    const bool now = wanted(chunk);
    if (now && last_wanted) {
      out.counts.back() += chunk.count;
    } else if (now) {
      out.counts.push_back(chunk.count);
      out.firsts.push_back(chunk.first);
    }
    last_wanted = now;
  }
  return out;
}

void GpuMesh::draw(const Stretches& stretches) const {
  if (stretches.empty()) return;
  glBindVertexArray(array_.get());
  glMultiDrawElements(mode_, stretches.counts.data(), GL_UNSIGNED_INT, stretches.firsts.data(),
                      static_cast<GLsizei>(stretches.counts.size()));
  glBindVertexArray(0);
}

void GpuMesh::draw(const std::function<bool(const Chunk&)>& wanted) const {
  draw(stretches(wanted));
}

void GpuMesh::draw() const {
  if (count_ == 0) return;
  glBindVertexArray(array_.get());
  glDrawElements(mode_, count_, GL_UNSIGNED_INT, nullptr);
  glBindVertexArray(0);
}

}  // namespace osteon
