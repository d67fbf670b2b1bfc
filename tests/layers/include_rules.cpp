#include "tests/layers/include_rules.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <optional>
#include <regex>
#include <sstream>
#include <stdexcept>
#include <string_view>

namespace repose::layers {
namespace {

namespace fs = std::filesystem;

/// From the lowest to the highest: each may use those before it, but vision and dem not each other.
constexpr std::array<std::string_view, 8> kModules = {"base",      "vision", "dem",    "render",
                                                      "calibrate", "facade", "studio", "cli"};

/// Libraries that users of an installed header need not have.
constexpr std::array<std::string_view, 12> kHiddenLibraries = {
    "opencv2/",  "ceres/", "tbb/",          "assimp/", "toml++/",    "pugixml",
    "nlohmann/", "GL/",    "meshoptimizer", "gif_lib", "ctemplate/", "cairo"};

struct Include {
  int line = 0;
  bool quoted = false;  ///< "x", not <x>
  std::string path;
};

bool starts_with_any(std::string_view path, const auto& beginnings) {
  return std::any_of(beginnings.begin(), beginnings.end(),
                     [&](std::string_view beginning) { return path.starts_with(beginning); });
}

std::string_view module_of(std::string_view path) { return path.substr(0, path.find('/')); }

std::size_t height_of(std::string_view module) {
  return static_cast<std::size_t>(std::find(kModules.begin(), kModules.end(), module) -
                                  kModules.begin());
}

bool is_project_path(std::string_view path) {
  return path.find('/') != std::string_view::npos &&
         (module_of(path) == "tests" || height_of(module_of(path)) < kModules.size());
}

/// The innermost room that a file lies in; empty when it lies in none.
std::string room_of(const Rooms& rooms, const std::string& path) {
  for (fs::path folder = fs::path(path).parent_path(); !folder.empty();
       folder = folder.parent_path()) {
    if (rooms.contains(folder.generic_string())) return folder.generic_string();
  }
  return {};
}

bool may_use(const Rooms& rooms, const std::string& room, const std::string& other) {
  const auto entry = rooms.find(room);
  if (room == other) return true;
  return entry != rooms.end() &&
         std::any_of(entry->second.begin(), entry->second.end(), [&](const std::string& used) {
           const bool is_whole_module = used == module_of(used) && used != module_of(room);
           return used == other || (is_whole_module && module_of(other) == used);
         });
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

/// The rule that an include in any file of a room breaks.
std::optional<std::string> broken_file_rule(const Rooms& rooms, const std::string& room,
                                            const Include& include) {
  if (include.path == "opencv2/opencv.hpp") {
    return "name the parts of OpenCV that are used. Fix: <opencv2/core.hpp>, ...";
  }
  if (include.quoted && !is_project_path(include.path)) {
    return "quoted includes start at the repository's top. Fix: \"" + room + '/' + include.path +
           "\", or <> for a library";
  }
  if (!is_project_path(include.path)) return std::nullopt;
  const std::string other = room_of(rooms, include.path);
  if (!other.empty() && may_use(rooms, room, other)) return std::nullopt;
  return room + " may not use " + (other.empty() ? include.path : other) +
         ". Fix: move what is shared to a room below, pass it in from above, or name the room in "
         "USES of " +
         std::string(module_of(room)) + "/CMakeLists.txt";
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

/// The rooms that a room's arrows lead to, directly or by others.
std::set<std::string> below(const Rooms& rooms, const std::string& room) {
  std::set<std::string> found;
  std::vector<std::string> open = {room};
  while (!open.empty()) {
    const std::string next = open.back();
    open.pop_back();
    for (const auto& [other, uses] : rooms) {
      if (other != next && may_use(rooms, next, other) && found.insert(other).second) {
        open.push_back(other);
      }
    }
  }
  return found;
}

bool is_upward(std::string_view from, std::string_view to) {
  const bool are_neighbours = from == "dem" && to == "vision";
  return height_of(to) > height_of(from) || are_neighbours;
}

}  // namespace

Rooms rooms_in(const std::string& text) {
  Rooms rooms;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t colon = line.find(':');
    if (colon == std::string::npos) continue;
    std::vector<std::string>& uses = rooms[line.substr(0, colon)];
    std::istringstream words(line.substr(colon + 1));
    for (std::string word; words >> word;) uses.push_back(word);
  }
  return rooms;
}

std::vector<std::string> broken_room_rules(const Rooms& rooms) {
  std::vector<std::string> errors;
  for (const auto& [room, uses] : rooms) {
    for (const std::string& used : uses) {
      if (is_upward(module_of(room), module_of(used))) {
        errors.push_back(room + ": uses " + used + ". Rule: modules use those below them. Fix: " +
                         "move what is shared down, or pass it in from above.");
      }
    }
    if (below(rooms, room).contains(room)) {
      errors.push_back(room + ": its arrows lead back to it. Rule: rooms stand on each other " +
                       "without circles. Fix: move what both need to a room below.");
    }
  }
  return errors;
}

std::vector<std::string> broken_include_rules(const fs::path& root, const Rooms& rooms,
                                              const std::set<std::string>& public_headers) {
  std::vector<std::string> errors;
  for (const std::string_view module : kModules) {
    if (!fs::exists(root / module)) continue;
    for (const fs::path& file : sources_in(root / module)) {
      const std::string name = file.lexically_relative(root).generic_string();
      std::string room = room_of(rooms, name);
      if (room.empty()) room = module;
      for (const Include& include : includes_of(file)) {
        // What stands at a module's top without being a room puts the module together.
        const bool is_free = !rooms.contains(room) && is_project_path(include.path) &&
                             module_of(include.path) != "tests" &&
                             !is_upward(module, module_of(include.path));
        std::optional<std::string> rule;
        if (!is_free) rule = broken_file_rule(rooms, room, include);
        if (!rule && public_headers.contains(name)) {
          rule = broken_header_rule(public_headers, include);
        }
        if (rule) {
          errors.push_back(name + ':' + std::to_string(include.line) + ": includes " +
                           include.path + ". Rule: " + *rule + '.');
        }
      }
    }
  }
  return errors;
}

}  // namespace repose::layers
