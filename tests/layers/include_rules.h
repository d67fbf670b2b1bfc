#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

/// Which file may include which: the arrows between the rooms of the code, read from the sources.
namespace repose::layers {

/// Rooms (folders such as "vision/measure") and the rooms or whole modules ("vision") that each may
/// include besides itself.
using Rooms = std::map<std::string, std::vector<std::string>>;

/// Reads lines such as "vision/measure: base vision/picture", as cmake/rooms.cmake writes them.
Rooms rooms_in(const std::string& text);

/// One line for each room that the arrows lead back to, and for each arrow that goes up from one
/// module to another: "ROOM: ... Rule: ... Fix: ...".
std::vector<std::string> broken_room_rules(const Rooms& rooms);

/// One line for each include that breaks a rule: "FILE:LINE: includes X. Rule: ... Fix: ...".
///
/// @param root            the repository's top folder; modules that are not there are skipped
/// @param public_headers  installed headers, relative to root ("vision/picture/picture.h")
std::vector<std::string> broken_include_rules(const std::filesystem::path& root, const Rooms& rooms,
                                              const std::set<std::string>& public_headers);

}  // namespace repose::layers
