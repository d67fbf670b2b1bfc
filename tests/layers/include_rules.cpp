#include "tests/layers/include_rules.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <optional>
#include <regex>
#include <stdexcept>
#include <string_view>

namespace repose::layers {
namespace {

namespace fs = std::filesystem;

/// What a module may include besides itself: whole folders ("dem/") or single headers.
struct Module {
  std::string_view folder;
  std::vector<std::string_view> may_include;
  std::string_view rule;
};

const std::array<Module, 6> kModules = {{
    {"io/", {}, "io stands alone"},
    {"vision/", {"io/"}, "vision may use io"},
    {"dem/", {"io/"}, "dem may use io"},
    {"render/", {"io/", "dem/", "vision/picture.h"}, "render may use io, dem and vision/picture.h"},
    {"calibrate/",
     {"io/", "vision/", "dem/", "render/"},
     "calibrate may use io, vision, dem and render"},
    {"cli/",
     {"io/", "vision/", "dem/", "render/", "calibrate/"},
     "cli may use every module, no tests"},
}};

/// Libraries that users of an installed header need not have.
constexpr std::array<std::string_view, 11> kHiddenLibraries = {
    "opencv2/",  "ceres/", "tbb/",          "assimp/", "toml++/",   "pugixml",
    "nlohmann/", "GL/",    "meshoptimizer", "gif_lib", "ctemplate/"};

struct Include {
  int line = 0;
  bool quoted = false;  ///< "x", not <x>
  std::string path;
};

bool starts_with_any(std::string_view path, const auto& beginnings) {
  return std::any_of(beginnings.begin(), beginnings.end(),
                     [&](std::string_view beginning) { return path.starts_with(beginning); });
}

bool is_project_path(std::string_view path) {
  return path.starts_with("tests/") ||
         std::any_of(kModules.begin(), kModules.end(),
                     [&](const Module& module) { return path.starts_with(module.folder); });
}

std::vector<Include> includes_of(const fs::path& file) {
  static const std::regex pattern(R"(^\s*#\s*include\s*([<"])([^>"]+)[>"])");
  std::ifstream stream(file);
  if (!stream) throw std::invalid_argument(file.string() + ": cannot be read");
  std::vector<Include> includes;
  std::string text;
  for (int line = 1; std::getline(stream, text); ++line) {
    std::smatch match;
    if (std::regex_search(text, match, pattern)) {
      includes.push_back({line, match.str(1) == "\"", match.str(2)});
    }
  }
  return includes;
}

std::vector<fs::path> sources_in(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
    const fs::path ending = entry.path().extension();
    if (ending == ".h" || ending == ".cpp") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// The rule that an include in any file of a module breaks.
std::optional<std::string> broken_module_rule(const Module& module, const Include& include) {
  if (include.path == "opencv2/opencv.hpp") {
    return "name the parts of OpenCV that are used. Fix: <opencv2/core.hpp>, ...";
  }
  if (include.quoted && !is_project_path(include.path)) {
    return "quoted includes start at the repository's top. Fix: \"" + std::string(module.folder) +
           include.path + "\", or <> for a library";
  }
  if (is_project_path(include.path) && !include.path.starts_with(module.folder) &&
      !starts_with_any(include.path, module.may_include)) {
    return std::string(module.rule) +
           ". Fix: move what is shared to a module below, or pass it in from above";
  }
  return std::nullopt;
}

/// The rule that an include in an installed header breaks.
std::optional<std::string> broken_header_rule(const std::set<std::string>& public_headers,
                                              const Include& include) {
  if (starts_with_any(include.path, kHiddenLibraries)) {
    return "users of a public header need not have this library. Fix: include it in the .cpp";
  }
  if (is_project_path(include.path) && !public_headers.contains(include.path)) {
    return "public headers include public headers only. Fix: include it in the .cpp, or install it";
  }
  return std::nullopt;
}

}  // namespace

std::vector<std::string> broken_include_rules(const fs::path& root,
                                              const std::set<std::string>& public_headers) {
  std::vector<std::string> faults;
  for (const Module& module : kModules) {
    if (!fs::exists(root / module.folder)) continue;
    for (const fs::path& file : sources_in(root / module.folder)) {
      const std::string name = file.lexically_relative(root).generic_string();
      for (const Include& include : includes_of(file)) {
        std::optional<std::string> rule = broken_module_rule(module, include);
        if (!rule && public_headers.contains(name)) {
          rule = broken_header_rule(public_headers, include);
        }
        if (rule) {
          faults.push_back(name + ':' + std::to_string(include.line) + ": includes " +
                           include.path + ". Rule: " + *rule + '.');
        }
      }
    }
  }
  return faults;
}

}  // namespace repose::layers
