#pragma once

#include <memory>

#include "render/gl/functions.h"

namespace repose::render::gl {

/// OpenGL 3.3 core, rendered by the CPU into memory: no window, no screen, no graphics card.
///
/// The only place that knows which library does it: OSMesa (context.cpp), or EGL if there is no
/// OSMesa (context_egl.cpp).
class Context {
 public:
  /// @throws std::runtime_error  the driver provides no such context.
  Context();
  ~Context();
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;
  Context(Context&&) = delete;
  Context& operator=(Context&&) = delete;

  /// Makes the context current in the calling thread. It belongs to one thread at a time.
  const Functions& use();
  /// The calling thread has no current context afterwards.
  void release();

 private:
  struct Library;
  std::unique_ptr<Library> library_;
  Functions functions_;
};

}  // namespace repose::render::gl
