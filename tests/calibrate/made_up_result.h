#pragma once

#include <variant>

#include "calibrate/result/result.h"

// Small results of both methods, with every field that a result may have.
namespace repose::calibrate::test {

/// A drop that tells restitution and not sliding friction.
StudyResult joint_result();

/// One sweep of four levels, solved at 2, and a surface over two factors.
StudyResult published_result();

/// What the joint method found, to be changed.
inline JointResult& joint_in(StudyResult& result) { return std::get<JointResult>(result.found); }

}  // namespace repose::calibrate::test
