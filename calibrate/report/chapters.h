#pragma once

#include <vector>

#include "calibrate/report/document.h"
#include "calibrate/report/heap_chapter.h"
#include "calibrate/report/reported_study.h"

/// The chapters of a study's report. A chapter with nothing to show has no blocks.
namespace repose::calibrate::report {

/// The findings in sentences, equally good parameter sets, coefficients, and both heaps.
Chapter answer_chapter(const JointResult& joint, const HeapPictures& pictures);
/// The coefficients if the readings' scatter differed from what was assumed.
void add_assumed_scatter(const JointResult& joint, std::vector<Block>& blocks);
/// What was done on the bench and in the simulations.
Chapter protocol_chapter(const ReportedStudy& study);
/// What was measured, and what the rows of a run table are.
Chapter table_chapter(const StudyResult& result);
/// Results of bench and simulation.
Chapter agreement_chapter(const JointResult& joint);
/// The effect of stiffer grains and more spheres; and its tables, with all digits.
void add_stiffness_and_shape(const JointResult& joint, Chapter& chapter);
void add_stiffness_and_shape_tables(const JointResult& joint, Chapter& chapter);
/// The effect of inputs held fixed, compared with the intervals.
Chapter assumed_chapter(const JointResult& joint);
/// The details behind the agreement: what the fit had expected, and how readings scatter.
Chapter checks_chapter(const JointResult& joint);
/// For each coefficient, the experiment that identifies it best.
Chapter sensitivity_chapter(const ReportedStudy& study, const JointResult& joint);
/// All other response curves.
Chapter curves_chapter(const ReportedStudy& study, const JointResult& joint);
/// Each observable over pairs of coefficients, with the line where it equals the measured value.
Chapter surfaces_chapter(const ReportedStudy& study, const JointResult& joint);
/// The coefficients in numbers, profile likelihoods, correlations, and what would narrow the
/// intervals.
Chapter knowledge_chapter(const JointResult& joint);
/// Polynomials through the runs, with their analysis of variance.
Chapter statistics_chapter(const JointResult& joint);
/// The blocks of one regression.
void add_regression(const SurfaceSummary& regression, const std::string& of,
                    std::vector<Block>& blocks);
/// The progress of the fit, round by round, and how well its surrogates predict the simulation.
Chapter convergence_chapter(const JointResult& joint);
Chapter methods_chapter(const ReportedStudy& study, const StudyResult& result);
/// What the numbers do not say.
Chapter limits_chapter(const StudyResult& result);
Chapter provenance_chapter(const ReportedStudy& study);

/// A photograph beside the simulated heap, if available.
PictureRow heaps_side_by_side(const HeapPictures& pictures);

/// For a study calibrated by the published method: answer, sweeps, heaps, surface.
std::vector<Chapter> paper_chapters(const PublishedResult& published, const HeapPictures& pictures);

/// For a study without a result yet: what there is, and how to continue.
std::vector<Chapter> unfinished_chapters(const ReportedStudy& study);

/// The runs of an observable's experiment, plotted over each coefficient that varies among them.
std::vector<Chart> run_charts(const ReportedStudy& study, const MeasuredNumber& measured);

}  // namespace repose::calibrate::report
