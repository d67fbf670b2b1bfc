#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "render/gl/functions.h"

/// OpenGL objects, each owned by an object here. The context that created them must be current when
/// they are destroyed.
namespace repose::render::gl {

/// A vertex and a fragment shader, linked.
class Program {
 public:
  /// The k-th name is that of vertex attribute k.
  /// @throws std::runtime_error  with the driver's message if it does not compile.
  Program(const Functions& gl, const std::string& vertex, const std::string& fragment,
          const std::vector<const char*>& attributes);
  ~Program() { gl_.DeleteProgram(id_); }
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;
  Program(Program&&) = delete;
  Program& operator=(Program&&) = delete;

  void use() const { gl_.UseProgram(id_); }
  // The program must be in use. Uniforms that the shader does not use are ignored.
  void set(const char* name, int value) const { gl_.Uniform1i(at(name), value); }
  void set(const char* name, double value) const {
    gl_.Uniform1f(at(name), static_cast<float>(value));
  }
  void set(const char* name, const std::array<double, 2>& v) const;
  void set(const char* name, const std::array<double, 3>& v) const;
  void set(const char* name, const std::array<double, 4>& v) const;
  /// The matrix in row-major order.
  void set(const char* name, const std::array<double, 9>& rows) const;

 private:
  GLint at(const char* name) const { return gl_.GetUniformLocation(id_, name); }

  const Functions& gl_;
  GLuint id_;
};

enum class PixelFormat { grey8, half_rgba, float_rgba, depth, shadow };

/// Can be drawn to, and read in a shader.
class Texture {
 public:
  /// @throws std::runtime_error  the driver has no memory for it.
  Texture(const Functions& gl, PixelFormat format, int width, int height);
  ~Texture() { gl_.DeleteTextures(1, &id_); }
  Texture(const Texture&) = delete;
  Texture& operator=(const Texture&) = delete;
  Texture(Texture&&) = delete;
  Texture& operator=(Texture&&) = delete;

  /// Binds it to texture unit `unit`.
  void bind(int unit) const;
  GLuint id() const { return id_; }
  int width() const { return width_; }
  int height() const { return height_; }

 private:
  const Functions& gl_;
  GLuint id_ = 0;
  int width_, height_;
};

/// Textures that are drawn to together (a framebuffer object).
class Target {
 public:
  /// Either may be null.
  /// @throws std::runtime_error  the driver cannot draw to them.
  Target(const Functions& gl, const Texture* colour, const Texture* depth);
  ~Target() { gl_.DeleteFramebuffers(1, &id_); }
  Target(const Target&) = delete;
  Target& operator=(const Target&) = delete;
  Target(Target&&) = delete;
  Target& operator=(Target&&) = delete;

  /// All drawing goes here, with the viewport set to its full size.
  void use() const;

 private:
  const Functions& gl_;
  GLuint id_ = 0;
  int width_, height_;
};

/// Triangles with any number of floats per vertex, drawn once, or once per instance.
class Shape {
 public:
  /// @param parts  how many floats each attribute has, in the order of the program's attributes.
  Shape(const Functions& gl, std::span<const float> vertices,
        std::span<const std::uint32_t> corners, const std::vector<int>& parts);
  ~Shape();
  Shape(const Shape&) = delete;
  Shape& operator=(const Shape&) = delete;
  Shape(Shape&&) = delete;
  Shape& operator=(Shape&&) = delete;

  std::size_t triangles() const { return corner_count_ / 3; }

  void draw() const;
  /// @param instances  floats of all instances; their attributes follow those of the vertices,
  /// `parts` as in the constructor.
  void draw(std::span<const float> instances, const std::vector<int>& parts) const;

 private:
  const Functions& gl_;
  GLuint array_ = 0;
  std::array<GLuint, 3> buffers_{};  ///< vertices, corners, instances
  GLuint vertex_attributes_ = 0;
  std::size_t corner_count_ = 0;
};

}  // namespace repose::render::gl
