#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

/// Which file may include which: the arrows between the modules, read from the sources.
namespace repose::layers {

/// One line for each include that breaks a rule: "FILE:LINE: includes X. Rule: ... Fix: ...".
///
/// @param root            the repository's top folder; module folders that are not there are
/// skipped
/// @param public_headers  installed headers, relative to root ("vision/picture.h")
std::vector<std::string> broken_include_rules(const std::filesystem::path& root,
                                              const std::set<std::string>& public_headers);

}  // namespace repose::layers
