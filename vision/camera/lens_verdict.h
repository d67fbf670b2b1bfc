#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "vision/camera/lens_fit.h"

/// What is wrong with the fit of a lens, and what to do about it.
namespace repose::vision {

/// Why pictures of several sizes cannot be fitted together; empty: they have one size.
std::string sizes_differ(const std::vector<BoardPicture>& pictures,
                         const std::vector<std::size_t>& used);

/// Why the fit cannot be used; none: it can.
std::vector<std::string> reasons_against(const LensFit& fit,
                                         const std::vector<BoardPicture>& pictures);

/// Adds what a person must look at.
void warn_of_lens(LensFit& fit, const std::vector<BoardPicture>& pictures);

}  // namespace repose::vision
