#pragma once

#include <string>

/// GLSL sources of the photo style. The vertex sources follow lens_source().
namespace repose::render::shaders {

const std::string& body_vertex();
const std::string& body_fragment();
const std::string& room_vertex();
const std::string& room_fragment();
const std::string& shadow_vertex();
const std::string& shadow_fragment();
const std::string& add_vertex();
const std::string& add_fragment();

}  // namespace repose::render::shaders
