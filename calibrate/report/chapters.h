#pragma once

#include <vector>

#include "calibrate/report/document.h"
#include "calibrate/report/heap_chapter.h"
#include "calibrate/report/study_folder.h"

/// The chapters of a study's report. Each shows what the folder has of its subject; one with
/// nothing to show has no blocks.
namespace repose::calibrate::report {

/// Coefficients, intervals, verdicts, and both heaps.
Chapter answer_chapter(const StudyFolder& study, const HeapPictures& pictures);
/// What bench and simulation gave.
Chapter agreement_chapter(const StudyFolder& study);
/// Each observable along each coefficient.
Chapter curves_chapter(const StudyFolder& study);
/// Each observable over pairs of coefficients, with the line on which it has the measured value.
Chapter surfaces_chapter(const StudyFolder& study);
/// Profile likelihoods, sets that fit as well, correlations.
Chapter knowledge_chapter(const StudyFolder& study);
/// Polynomials through the runs, with their analysis of variance.
Chapter statistics_chapter(const StudyFolder& study);
/// The blocks of one regression, as `repose regress --json` has it.
void add_regression(const JsonView& regression, const std::string& of, std::vector<Block>& blocks);
/// How the fit went, round by round, and how well its surrogates know the simulation.
Chapter convergence_chapter(const StudyFolder& study);
Chapter methods_chapter(const StudyFolder& study);
/// What the numbers do not say.
Chapter limits_chapter(const StudyFolder& study);
Chapter provenance_chapter(const StudyFolder& study);

/// A photograph beside the simulated heap, as far as there are any.
PictureRow heaps_side_by_side(const HeapPictures& pictures);

/// Of a study made the published way: answer, sweeps, heaps, surface.
std::vector<Chapter> paper_chapters(const StudyFolder& study, const HeapPictures& pictures);

/// Of a study that has no result yet: what there is, and how to go on.
std::vector<Chapter> unfinished_chapters(const StudyFolder& study);

/// The runs of an observable's experiment over each coefficient that differs between them.
std::vector<Chart> run_charts(const StudyFolder& study, const MeasuredNumber& measured);

}  // namespace repose::calibrate::report
