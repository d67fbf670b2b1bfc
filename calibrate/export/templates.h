#pragma once

#include <string_view>

/// The files of calibrate/export/templates, built into the program (cmake/embed.cmake).
namespace repose::calibrate::templates {

/// By its name in calibrate/: "export/templates/liggghts/drop.lig".
/// @throws std::out_of_range  there is no file of that name.
std::string_view embedded_file(std::string_view name);

}  // namespace repose::calibrate::templates
