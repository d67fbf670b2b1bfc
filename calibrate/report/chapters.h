#pragma once

#include <vector>

#include "calibrate/report/document.h"
#include "calibrate/report/heap_chapter.h"
#include "calibrate/report/reported_study.h"

/// The chapters of a study's report. One with nothing to show has no blocks.
namespace repose::calibrate::report {

/// What was found in sentences, equally good sets, coefficients, and both heaps.
Chapter answer_chapter(const JointResult& joint, const HeapPictures& pictures);
/// What coefficients would be if readings scattered otherwise than was assumed.
void add_assumed_scatter(const JointResult& joint, std::vector<Block>& blocks);
/// What was done on the bench and simulated.
Chapter protocol_chapter(const ReportedStudy& study);
/// What was measured, and what the rows of a table of runs are.
Chapter table_chapter(const StudyResult& result);
/// What bench and simulation gave.
Chapter agreement_chapter(const JointResult& joint);
/// What stiffer grains and more spheres change, and in all digits.
void add_stiffness_and_shape(const JointResult& joint, Chapter& chapter);
void add_stiffness_and_shape_tables(const JointResult& joint, Chapter& chapter);
/// What inputs held fixed move, beside the intervals.
Chapter assumed_chapter(const JointResult& joint);
/// How that was decided, in full: what the fit had expected, and how readings scatter.
Chapter checks_chapter(const JointResult& joint);
/// Along each coefficient the experiment that tells it best.
Chapter sensitivity_chapter(const ReportedStudy& study, const JointResult& joint);
/// All others.
Chapter curves_chapter(const ReportedStudy& study, const JointResult& joint);
/// Each observable over pairs of coefficients, with the line on which it has the measured value.
Chapter surfaces_chapter(const ReportedStudy& study, const JointResult& joint);
/// The coefficients in numbers, profile likelihoods, correlations, what would narrow them.
Chapter knowledge_chapter(const JointResult& joint);
/// Polynomials through the runs, with their analysis of variance.
Chapter statistics_chapter(const JointResult& joint);
/// The blocks of one regression.
void add_regression(const SurfaceSummary& regression, const std::string& of,
                    std::vector<Block>& blocks);
/// How the fit went, round by round, and how well its surrogates know the simulation.
Chapter convergence_chapter(const JointResult& joint);
Chapter methods_chapter(const ReportedStudy& study, const StudyResult& result);
/// What the numbers do not say.
Chapter limits_chapter(const StudyResult& result);
Chapter provenance_chapter(const ReportedStudy& study);

/// A photograph beside the simulated heap, as far as there are any.
PictureRow heaps_side_by_side(const HeapPictures& pictures);

/// Of a study made the published way: answer, sweeps, heaps, surface.
std::vector<Chapter> paper_chapters(const PublishedResult& published, const HeapPictures& pictures);

/// Of a study that has no result yet: what there is, and how to go on.
std::vector<Chapter> unfinished_chapters(const ReportedStudy& study);

/// The runs of an observable's experiment over each coefficient that differs between them.
std::vector<Chart> run_charts(const ReportedStudy& study, const MeasuredNumber& measured);

}  // namespace repose::calibrate::report
