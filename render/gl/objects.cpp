#include "render/gl/objects.h"

#include <numeric>
#include <stdexcept>

namespace repose::render::gl {
namespace {

constexpr std::size_t kFloat = sizeof(float);

std::string log_of(const Functions& gl, GLuint id, bool is_program) {
  std::string log(4096, '\0');
  GLsizei length = 0;
  (is_program ? gl.GetProgramInfoLog : gl.GetShaderInfoLog)(id, static_cast<GLsizei>(log.size()),
                                                            &length, log.data());
  log.resize(static_cast<std::size_t>(length));
  return log;
}

GLuint compiled(const Functions& gl, GLenum kind, const std::string& source) {
  const GLuint id = gl.CreateShader(kind);
  const char* text = source.c_str();
  gl.ShaderSource(id, 1, &text, nullptr);
  gl.CompileShader(id);
  GLint is_good = GL_FALSE;
  gl.GetShaderiv(id, GL_COMPILE_STATUS, &is_good);
  if (is_good == GL_FALSE) {
    const std::string log = log_of(gl, id, false);
    gl.DeleteShader(id);
    throw std::runtime_error("render: a shader does not compile: " + log);
  }
  return id;
}

struct Layout {
  GLint internal;
  GLenum format;
  GLenum type;
};

Layout layout_of(PixelFormat format) {
  switch (format) {
    case PixelFormat::grey8:
      return {GL_R8, GL_RED, GL_UNSIGNED_BYTE};
    case PixelFormat::half_rgba:
      return {GL_RGBA16F, GL_RGBA, GL_FLOAT};
    case PixelFormat::float_rgba:
      return {GL_RGBA32F, GL_RGBA, GL_FLOAT};
    case PixelFormat::depth:
    case PixelFormat::shadow:
      break;
  }
  return {GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, GL_FLOAT};
}

/// Sets attributes `first`, ... of the bound buffer, with `parts` floats each.
void lay_out(const Functions& gl, GLuint first, const std::vector<int>& parts, GLuint divisor) {
  const int floats = std::accumulate(parts.begin(), parts.end(), 0);
  std::size_t offset = 0;
  for (const int part : parts) {
    gl.EnableVertexAttribArray(first);
    gl.VertexAttribPointer(
        first, part, GL_FLOAT, GL_FALSE, static_cast<GLsizei>(floats * static_cast<int>(kFloat)),
        // NOLINTNEXTLINE(performance-no-int-to-ptr): OpenGL takes offsets as pointers
        reinterpret_cast<const void*>(offset));
    gl.VertexAttribDivisor(first, divisor);
    offset += static_cast<std::size_t>(part) * kFloat;
    ++first;
  }
}

}  // namespace

Program::Program(const Functions& gl, const std::string& vertex, const std::string& fragment,
                 const std::vector<const char*>& attributes)
    : gl_(gl), id_(gl.CreateProgram()) {
  for (const auto& [kind, source] :
       {std::pair{GL_VERTEX_SHADER, &vertex}, std::pair{GL_FRAGMENT_SHADER, &fragment}}) {
    const GLuint shader = compiled(gl, static_cast<GLenum>(kind), *source);
    gl.AttachShader(id_, shader);
    gl.DeleteShader(shader);
  }
  for (std::size_t k = 0; k < attributes.size(); ++k) {
    gl.BindAttribLocation(id_, static_cast<GLuint>(k), attributes[k]);
  }
  gl.LinkProgram(id_);
  GLint is_good = GL_FALSE;
  gl.GetProgramiv(id_, GL_LINK_STATUS, &is_good);
  if (is_good == GL_FALSE) {
    throw std::runtime_error("render: shaders do not link: " + log_of(gl, id_, true));
  }
}

void Program::set(const char* name, const std::array<double, 2>& v) const {
  gl_.Uniform2f(at(name), static_cast<float>(v[0]), static_cast<float>(v[1]));
}

void Program::set(const char* name, const std::array<double, 3>& v) const {
  gl_.Uniform3f(at(name), static_cast<float>(v[0]), static_cast<float>(v[1]),
                static_cast<float>(v[2]));
}

void Program::set(const char* name, const std::array<double, 4>& v) const {
  gl_.Uniform4f(at(name), static_cast<float>(v[0]), static_cast<float>(v[1]),
                static_cast<float>(v[2]), static_cast<float>(v[3]));
}

void Program::set(const char* name, const std::array<double, 9>& rows) const {
  std::array<float, 9> floats{};
  for (std::size_t k = 0; k < 9; ++k) floats[k] = static_cast<float>(rows[k]);
  gl_.UniformMatrix3fv(at(name), 1, GL_TRUE, floats.data());
}

Texture::Texture(const Functions& gl, PixelFormat format, int width, int height)
    : gl_(gl), width_(width), height_(height) {
  gl.GenTextures(1, &id_);
  gl.BindTexture(GL_TEXTURE_2D, id_);
  const Layout layout = layout_of(format);
  gl.TexImage2D(GL_TEXTURE_2D, 0, layout.internal, width, height, 0, layout.format, layout.type,
                nullptr);
  const GLint filter = format == PixelFormat::shadow ? GL_LINEAR : GL_NEAREST;
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filter);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  if (format == PixelFormat::shadow) {
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
  }
  if (gl.GetError() != GL_NO_ERROR) {
    gl.DeleteTextures(1, &id_);
    throw std::runtime_error("render: the driver has no memory for " + std::to_string(width) +
                             " x " + std::to_string(height) + " pixels. Fix: a smaller picture.");
  }
}

void Texture::bind(int unit) const {
  gl_.ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
  gl_.BindTexture(GL_TEXTURE_2D, id_);
}

Target::Target(const Functions& gl, const Texture* colour, const Texture* depth)
    : gl_(gl),
      width_((colour != nullptr ? colour : depth)->width()),
      height_((colour != nullptr ? colour : depth)->height()) {
  gl.GenFramebuffers(1, &id_);
  gl.BindFramebuffer(GL_FRAMEBUFFER, id_);
  if (colour != nullptr) {
    gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, colour->id(), 0);
  }
  if (depth != nullptr) {
    gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth->id(), 0);
  }
  const GLenum drawn = colour != nullptr ? GL_COLOR_ATTACHMENT0 : GL_NONE;
  gl.DrawBuffer(drawn);
  gl.ReadBuffer(drawn);
  if (gl.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    gl.DeleteFramebuffers(1, &id_);
    throw std::runtime_error("render: the driver cannot draw to such a texture");
  }
}

void Target::use() const {
  gl_.BindFramebuffer(GL_FRAMEBUFFER, id_);
  gl_.Viewport(0, 0, width_, height_);
}

Shape::Shape(const Functions& gl, std::span<const float> vertices,
             std::span<const std::uint32_t> corners, const std::vector<int>& parts)
    : gl_(gl),
      vertex_attributes_(static_cast<GLuint>(parts.size())),
      corner_count_(corners.size()) {
  gl.GenVertexArrays(1, &array_);
  gl.GenBuffers(3, buffers_.data());
  gl.BindVertexArray(array_);
  gl.BindBuffer(GL_ARRAY_BUFFER, buffers_[0]);
  gl.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertices.size_bytes()), vertices.data(),
                GL_STATIC_DRAW);
  lay_out(gl, 0, parts, 0);
  gl.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffers_[1]);
  gl.BufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(corners.size_bytes()),
                corners.data(), GL_STATIC_DRAW);
}

Shape::~Shape() {
  gl_.DeleteVertexArrays(1, &array_);
  gl_.DeleteBuffers(3, buffers_.data());
}

void Shape::draw() const {
  gl_.BindVertexArray(array_);
  gl_.DrawElementsInstanced(GL_TRIANGLES, static_cast<GLsizei>(corner_count_), GL_UNSIGNED_INT,
                            nullptr, 1);
}

void Shape::draw(std::span<const float> instances, const std::vector<int>& parts) const {
  const auto floats = static_cast<std::size_t>(std::accumulate(parts.begin(), parts.end(), 0));
  if (floats == 0 || instances.empty() || corner_count_ == 0) return;
  gl_.BindVertexArray(array_);
  gl_.BindBuffer(GL_ARRAY_BUFFER, buffers_[2]);
  gl_.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(instances.size_bytes()), instances.data(),
                 GL_STREAM_DRAW);
  lay_out(gl_, vertex_attributes_, parts, 1);
  gl_.DrawElementsInstanced(GL_TRIANGLES, static_cast<GLsizei>(corner_count_), GL_UNSIGNED_INT,
                            nullptr, static_cast<GLsizei>(instances.size() / floats));
}

}  // namespace repose::render::gl
