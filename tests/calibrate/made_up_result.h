#pragma once

#include <variant>

#include "calibrate/result/result.h"

// Small results of both methods, with every field that a result can have.
namespace repose::calibrate::test {

/// A drop that determines restitution but not sliding friction.
StudyResult joint_result();

/// One sweep of four levels, solved at 2, and a surface over two factors.
StudyResult published_result();

/// The joint method's result, for tests to modify.
inline JointResult& joint_in(StudyResult& result) { return std::get<JointResult>(result.found); }

}  // namespace repose::calibrate::test
