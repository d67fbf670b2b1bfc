// The context without OSMesa, which Mesa 25.1 and newer no longer have: surfaceless EGL on the
// software device rather than a graphics card, so that pictures are the same on all machines.
#include <array>
#include <stdexcept>
#include <string>
#include <type_traits>

#include <EGL/egl.h>
#include <EGL/eglext.h>

#include "render/gl/context.h"

namespace repose::render::gl {
namespace {

constexpr const char* kFix = ". Fix: install Mesa 20 or newer with EGL, libegl-mesa0.";

template <typename Function>
Function* function_named(const char* name) {
  auto* found = reinterpret_cast<Function*>(eglGetProcAddress(name));
  if (found == nullptr) {
    throw std::runtime_error(std::string("render: the driver has no ") + name + kFix);
  }
  return found;
}

bool is_software(EGLDeviceEXT device) {
  const auto query = function_named<std::remove_pointer_t<PFNEGLQUERYDEVICESTRINGEXTPROC>>(
      "eglQueryDeviceStringEXT");
  const char* extensions = query(device, EGL_EXTENSIONS);
  return extensions != nullptr &&
         std::string(extensions).find("EGL_MESA_device_software") != std::string::npos;
}

/// Shared by all contexts; EGL terminates it when the program ends.
EGLDisplay software_display() {
  constexpr EGLint kMaxDevices = 32;
  const auto query =
      function_named<std::remove_pointer_t<PFNEGLQUERYDEVICESEXTPROC>>("eglQueryDevicesEXT");
  std::array<EGLDeviceEXT, kMaxDevices> devices{};
  EGLint count = 0;
  query(kMaxDevices, devices.data(), &count);
  for (EGLint k = 0; k < count; ++k) {
    EGLDeviceEXT device = devices.at(static_cast<std::size_t>(k));
    if (!is_software(device)) continue;
    EGLDisplay display = eglGetPlatformDisplay(EGL_PLATFORM_DEVICE_EXT, device, nullptr);
    if (eglInitialize(display, nullptr, nullptr) == EGL_TRUE) return display;
  }
  throw std::runtime_error(std::string("render: EGL has no device that draws by itself") + kFix);
}

}  // namespace

struct Context::Library {
  EGLDisplay display = EGL_NO_DISPLAY;
  EGLContext context = EGL_NO_CONTEXT;
};

Context::Context() : library_(std::make_unique<Library>()) {
  static EGLDisplay display = software_display();
  library_->display = display;
  constexpr std::array<EGLint, 7> kWishes = {EGL_CONTEXT_MAJOR_VERSION,
                                             3,
                                             EGL_CONTEXT_MINOR_VERSION,
                                             3,
                                             EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                             EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                             EGL_NONE};
  eglBindAPI(EGL_OPENGL_API);
  library_->context = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, kWishes.data());
  if (library_->context == EGL_NO_CONTEXT) {
    throw std::runtime_error(std::string("render: EGL gives no OpenGL 3.3 core context") + kFix);
  }
  try {
#define REPOSE_GL_LOAD(name, type) \
  functions_.name = function_named<std::remove_pointer_t<type>>("gl" #name);
    REPOSE_GL_FUNCTIONS(REPOSE_GL_LOAD)
#undef REPOSE_GL_LOAD
  } catch (...) {
    eglDestroyContext(display, library_->context);
    throw;
  }
}

Context::~Context() { eglDestroyContext(library_->display, library_->context); }

const Functions& Context::use() {
  eglBindAPI(EGL_OPENGL_API);  // is per thread
  if (eglMakeCurrent(library_->display, EGL_NO_SURFACE, EGL_NO_SURFACE, library_->context) ==
      EGL_FALSE) {
    throw std::runtime_error(std::string("render: EGL's context cannot be used") + kFix);
  }
  return functions_;
}

void Context::release() {
  eglBindAPI(EGL_OPENGL_API);
  eglMakeCurrent(library_->display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
}

}  // namespace repose::render::gl
