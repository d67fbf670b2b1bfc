#include "base/memory.h"

#include <new>
#include <string_view>

#include <fmt/format.h>

namespace repose::base {

bool is_out_of_memory(const std::exception& error) {
  return dynamic_cast<const std::bad_alloc*>(&error) != nullptr ||
         std::string_view(error.what()).find("Insufficient memory") != std::string_view::npos;
}

std::string no_memory(const std::string& what, const std::string& fix) {
  return fmt::format(
      "{}: not enough memory. Fix: {}, or a machine (or a ulimit -v) with more "
      "memory.",
      what, fix);
}

}  // namespace repose::base
