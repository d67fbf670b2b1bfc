#pragma once

#include <memory>

#include "render/gl/functions.h"

namespace repose::render::gl {

/// OpenGL 3.3 core, drawn by the processor into memory: no window, no screen, no graphics card.
///
/// The one place that knows which library does it: OSMesa (context.cpp), or EGL where there is no
/// OSMesa (context_egl.cpp).
class Context {
 public:
  /// @throws std::runtime_error  the driver gives no such context.
  Context();
  ~Context();
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;
  Context(Context&&) = delete;
  Context& operator=(Context&&) = delete;

  /// What the calling thread draws goes here from now on. A context belongs to one thread at a
  /// time.
  const Functions& use();
  /// The calling thread draws nowhere.
  void release();

 private:
  struct Library;
  std::unique_ptr<Library> library_;
  Functions functions_;
};

}  // namespace repose::render::gl
