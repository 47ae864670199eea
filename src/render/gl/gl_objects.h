#pragma once

#include <epoxy/gl.h>

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "osteon/base/result.h"
#include "osteon/base/types.h"

namespace osteon {

/// Owner of one OpenGL name; `Delete` frees it.
template <void (*Delete)(GLuint)>
class GlName {
 public:
  GlName() = default;
  explicit GlName(GLuint name) : name_(name) {}
  GlName(GlName&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
  GlName& operator=(GlName&& other) noexcept {
    std::swap(name_, other.name_);
    return *this;
  }
  ~GlName() {
    if (name_ != 0) Delete(name_);
  }
  GLuint get() const { return name_; }

 private:
  GLuint name_ = 0;
};

void delete_buffer(GLuint name);
void delete_vertex_array(GLuint name);
void delete_texture(GLuint name);
void delete_renderbuffer(GLuint name);
void delete_framebuffer(GLuint name);
void delete_program(GLuint name);

using GlBuffer = GlName<delete_buffer>;
using GlVertexArray = GlName<delete_vertex_array>;
using GlTexture = GlName<delete_texture>;
using GlRenderbuffer = GlName<delete_renderbuffer>;
using GlFramebuffer = GlName<delete_framebuffer>;
using GlProgramName = GlName<delete_program>;

GlBuffer make_buffer();
GlVertexArray make_vertex_array();
GlTexture make_texture();
GlRenderbuffer make_renderbuffer();
GlFramebuffer make_framebuffer();

/// Linked vertex and fragment shader. The setters act on the program in use; a name that the
/// compiler dropped is ignored.
class Program {
 public:
  /// Reads <name>.vert and <name>.frag, each after the text of light.glsl. Attributes: 0
  /// a_position, 1 a_normal, 2 a_shade. Errors carry the compiler's words.
  static Result<Program> load(const std::filesystem::path& shader_dir, const std::string& name);
  /// As above with the vertex shader of another name.
  static Result<Program> load(const std::filesystem::path& shader_dir, const std::string& vert,
                              const std::string& frag);
  /// As above for a surface of which parts are left out (changed.glsl).
  static Result<Program> load_changed(const std::filesystem::path& shader_dir,
                                      const std::string& vert, const std::string& frag);
  /// As above, with lines of the preprocessor before both shaders' texts: a processor that
  /// draws works out both sides of every condition, so what a program never needs is better left
  /// out of it.
  static Result<Program> load_with(const std::filesystem::path& shader_dir, const std::string& vert,
                                   const std::string& frag, const std::string& defines,
                                   bool changed = false);

  void use() const { glUseProgram(name_.get()); }
  void set(const char* name, int value) const;
  void set(const char* name, float value) const;
  void set(const char* name, const Eigen::Vector2f& value) const;
  void set(const char* name, const Eigen::Vector3f& value) const;
  void set(const char* name, const Eigen::Vector4f& value) const;
  void set(const char* name, const Eigen::Matrix4f& value) const;

 private:
  static Result<Program> link(const std::filesystem::path& shader_dir, const std::string& vert,
                              const std::string& frag, const std::string& defines, bool changed);

  GlProgramName name_;
};

/// A program that is compiled when it is first asked for, with the context current.
class LateProgram {
 public:
  LateProgram() = default;
  /// As Program::load_with takes them.
  LateProgram(std::filesystem::path shader_dir, std::string vert, std::string frag,
              std::string defines = {}, bool changed = false);
  /// Whether its texts are there.
  Result<void> check() const;
  /// Null: it does not compile.
  const Program* get() const;
  /// True where it need not be compiled any more.
  bool ready() const { return asked_; }

 private:
  std::filesystem::path shader_dir_;
  std::string vert_, frag_, defines_;
  bool changed_ = false;
  mutable bool asked_ = false;
  mutable std::optional<Program> program_;
};

}  // namespace osteon
