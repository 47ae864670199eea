#include "gl/gl_objects.h"

#include <vector>

#include "osteon/base/file.h"

namespace osteon {

void delete_buffer(GLuint name) { glDeleteBuffers(1, &name); }
void delete_vertex_array(GLuint name) { glDeleteVertexArrays(1, &name); }
void delete_texture(GLuint name) { glDeleteTextures(1, &name); }
void delete_renderbuffer(GLuint name) { glDeleteRenderbuffers(1, &name); }
void delete_framebuffer(GLuint name) { glDeleteFramebuffers(1, &name); }
void delete_program(GLuint name) { glDeleteProgram(name); }

namespace {

void delete_shader(GLuint name) { glDeleteShader(name); }
using GlShader = GlName<delete_shader>;

template <class Name, class Generate>
Name generated(Generate generate) {
  GLuint name = 0;
  generate(1, &name);
  return Name(name);
}

std::string shader_log(GLuint shader) {
  GLint length = 0;
  glGetShaderiv(shader, GL_INFO_LOG_LENGTH, &length);
  std::vector<char> text(static_cast<std::size_t>(length) + 1, '\0');
  glGetShaderInfoLog(shader, length, nullptr, text.data());
  return text.data();
}

std::string program_log(GLuint program) {
  GLint length = 0;
  glGetProgramiv(program, GL_INFO_LOG_LENGTH, &length);
  std::vector<char> text(static_cast<std::size_t>(length) + 1, '\0');
  glGetProgramInfoLog(program, length, nullptr, text.data());
  return text.data();
}

constexpr std::uint64_t kLargestShader = 1 << 20;
constexpr const char* kReinstall = "install Osteon's shaders folder again";

Result<GlShader> compile(GLenum stage, const std::filesystem::path& dir, const std::string& file,
                         const std::string& defines = {}, bool changed = false) {
  const auto shared = read_file(dir / "light.glsl", kLargestShader);
  if (!shared) return tl::unexpected(shared.error());
  const auto own = read_file(dir / file, kLargestShader);
  if (!own) return tl::unexpected(own.error());
  const auto more = changed ? read_file(dir / "changed.glsl", kLargestShader) : std::string();
  if (!more) return tl::unexpected(more.error());
  const std::string text = "#version 330 core\n" + defines + *shared + *more + "#line 1\n" + *own;
  GlShader shader(glCreateShader(stage));
  const char* source = text.c_str();
  glShaderSource(shader.get(), 1, &source, nullptr);
  glCompileShader(shader.get());
  GLint ok = GL_FALSE;
  glGetShaderiv(shader.get(), GL_COMPILE_STATUS, &ok);
  if (ok != GL_TRUE)
    return fail("a shader does not compile: " + shader_log(shader.get()), (dir / file).string(),
                kReinstall);
  return shader;
}

GLint location(GLuint program, const char* name) { return glGetUniformLocation(program, name); }

}  // namespace

GlBuffer make_buffer() { return generated<GlBuffer>(glGenBuffers); }
GlVertexArray make_vertex_array() { return generated<GlVertexArray>(glGenVertexArrays); }
GlTexture make_texture() { return generated<GlTexture>(glGenTextures); }
GlRenderbuffer make_renderbuffer() { return generated<GlRenderbuffer>(glGenRenderbuffers); }
GlFramebuffer make_framebuffer() { return generated<GlFramebuffer>(glGenFramebuffers); }

Result<Program> Program::load(const std::filesystem::path& shader_dir, const std::string& name) {
  return load(shader_dir, name, name);
}

Result<Program> Program::load(const std::filesystem::path& shader_dir, const std::string& vert,
                              const std::string& frag) {
  return link(shader_dir, vert, frag, {}, false);
}

Result<Program> Program::load_changed(const std::filesystem::path& shader_dir,
                                      const std::string& vert, const std::string& frag) {
  return link(shader_dir, vert, frag, {}, true);
}

Result<Program> Program::load_with(const std::filesystem::path& shader_dir, const std::string& vert,
                                   const std::string& frag, const std::string& defines,
                                   bool changed) {
  return link(shader_dir, vert, frag, defines, changed);
}

Result<Program> Program::link(const std::filesystem::path& shader_dir, const std::string& vert,
                              const std::string& frag, const std::string& defines, bool changed) {
  const auto vertex = compile(GL_VERTEX_SHADER, shader_dir, vert + ".vert", defines);
  if (!vertex) return tl::unexpected(vertex.error());
  const auto fragment = compile(GL_FRAGMENT_SHADER, shader_dir, frag + ".frag", defines, changed);
  if (!fragment) return tl::unexpected(fragment.error());
  Program program;
  program.name_ = GlProgramName(glCreateProgram());
  const GLuint id = program.name_.get();
  glAttachShader(id, vertex->get());
  glAttachShader(id, fragment->get());
  glBindAttribLocation(id, 0, "a_position");
  glBindAttribLocation(id, 1, "a_normal");
  glBindAttribLocation(id, 2, "a_shade");
  glLinkProgram(id);
  GLint ok = GL_FALSE;
  glGetProgramiv(id, GL_LINK_STATUS, &ok);
  if (ok != GL_TRUE)
    return fail("shaders do not fit together: " + program_log(id),
                (shader_dir / (vert + ".vert, " + frag + ".frag")).string(), kReinstall);
  return program;
}

void Program::set(const char* name, int value) const {
  glUniform1i(location(name_.get(), name), value);
}
void Program::set(const char* name, float value) const {
  glUniform1f(location(name_.get(), name), value);
}
void Program::set(const char* name, const Eigen::Vector2f& value) const {
  glUniform2fv(location(name_.get(), name), 1, value.data());
}
void Program::set(const char* name, const Eigen::Vector3f& value) const {
  glUniform3fv(location(name_.get(), name), 1, value.data());
}
void Program::set(const char* name, const Eigen::Vector4f& value) const {
  glUniform4fv(location(name_.get(), name), 1, value.data());
}
void Program::set(const char* name, const Eigen::Matrix4f& value) const {
  glUniformMatrix4fv(location(name_.get(), name), 1, GL_FALSE, value.data());
}

LateProgram::LateProgram(std::filesystem::path shader_dir, std::string vert, std::string frag,
                         std::string defines, bool changed)
    : shader_dir_(std::move(shader_dir)),
      vert_(std::move(vert)),
      frag_(std::move(frag)),
      defines_(std::move(defines)),
      changed_(changed) {}

Result<void> LateProgram::check() const {
  for (const std::string& file : {vert_ + ".vert", frag_ + ".frag"})
    if (const auto text = read_file(shader_dir_ / file, kLargestShader); !text)
      return tl::unexpected(text.error());
  return {};
}

const Program* LateProgram::get() const {
  if (!asked_) {
    asked_ = true;
    auto made = Program::load_with(shader_dir_, vert_, frag_, defines_, changed_);
    if (made) program_.emplace(std::move(*made));
  }
  return program_ ? &*program_ : nullptr;
}

}  // namespace osteon
