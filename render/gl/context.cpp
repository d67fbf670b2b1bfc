#include "render/gl/context.h"

#include <array>
#include <stdexcept>
#include <string>

#include <GL/osmesa.h>

namespace repose::render::gl {
namespace {

/// Side of the buffer that OSMesa requires; everything is drawn to framebuffer objects instead.
constexpr int kSide = 16;

constexpr const char* kFix =
    ". Fix: install Mesa 20 or newer with its off-screen library, libosmesa6.";

template <typename Function>
void load(Function*& function, const char* name) {
  const OSMESAproc found = OSMesaGetProcAddress(name);
  if (found == nullptr) {
    throw std::runtime_error(std::string("render: the driver has no ") + name + kFix);
  }
  function = reinterpret_cast<Function*>(found);
}

}  // namespace

struct Context::Library {
  OSMesaContext context = nullptr;
  std::array<unsigned char, std::size_t{4} * kSide * kSide> pixels{};
};

Context::Context() : library_(std::make_unique<Library>()) {
  const std::array<int, 9> wishes = {OSMESA_FORMAT,
                                     OSMESA_RGBA,
                                     OSMESA_PROFILE,
                                     OSMESA_CORE_PROFILE,
                                     OSMESA_CONTEXT_MAJOR_VERSION,
                                     3,
                                     OSMESA_CONTEXT_MINOR_VERSION,
                                     3,
                                     0};
  library_->context = OSMesaCreateContextAttribs(wishes.data(), nullptr);
  if (library_->context == nullptr) {
    throw std::runtime_error(std::string("render: OSMesa gives no OpenGL 3.3 core context") + kFix);
  }
  try {
#define REPOSE_GL_LOAD(name, type) load(functions_.name, "gl" #name);
    REPOSE_GL_FUNCTIONS(REPOSE_GL_LOAD)
#undef REPOSE_GL_LOAD
  } catch (...) {
    OSMesaDestroyContext(library_->context);
    throw;
  }
}

Context::~Context() { OSMesaDestroyContext(library_->context); }

const Functions& Context::use() {
  if (OSMesaMakeCurrent(library_->context, library_->pixels.data(), GL_UNSIGNED_BYTE, kSide,
                        kSide) == GL_FALSE) {
    throw std::runtime_error(std::string("render: OSMesa's context cannot be used") + kFix);
  }
  return functions_;
}

void Context::release() { OSMesaMakeCurrent(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0); }

}  // namespace repose::render::gl
