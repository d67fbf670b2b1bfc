#pragma once

#include "base/input_error.h"
#include "calibrate/export/export.h"
#include "calibrate/result/result.h"
#include "calibrate/run/run_study.h"
#include "calibrate/statistics/bench/bench.h"
#include "calibrate/study/study_problem.h"
#include "dem/study/study.h"

/// Contact coefficients from bench readings: numbers, sheets, photographs and films that a study
/// file names. Link repose::calibrate.
///
///     #include <iostream>
///     #include <repose/calibrate.h>
///
///     int main(int, char* arguments[]) {
///       const auto result = repose::run_study({.study = arguments[1], .folder = "calibration"});
///       const auto& joint = std::get<repose::JointResult>(result.value().found);
///       for (const repose::ResultParameter& found : joint.parameters) {
///         std::cout << found.name << ' ' << found.value << ": " << found.interval.low << " to "
///                   << found.interval.high << ", " << name_of(found.verdict) << '\n';
///       }
///     }
///
/// The folder then holds what `repose report`, `repose export` and read_result() read.
namespace repose {

using base::InputError;

// The whole of `repose calibrate`. A study that was interrupted goes on from its folder.
using calibrate::Budget;
using calibrate::budget_named;
using calibrate::run_study;
using calibrate::StudyProgress;
using calibrate::StudyRequest;
using calibrate::StudyWatch;

// What was found.
using calibrate::AgreementVerdict;
using calibrate::JointResult;
using calibrate::PublishedResult;
using calibrate::read_result;
using calibrate::ResultObservable;
using calibrate::ResultParameter;
using calibrate::StudyResult;
using calibrate::Verdict;

// Coefficients from bench readings alone, without a simulation.
using calibrate::pendulum_restitution_of;
using calibrate::restitution_of;
using calibrate::rolling_friction_of;
using calibrate::sliding_friction_of;

// Input decks for other programs.
using calibrate::export_study;
using calibrate::export_target_named;
using calibrate::export_targets;
using calibrate::ExportRequest;
using calibrate::ExportTarget;
using calibrate::write_export;

}  // namespace repose
