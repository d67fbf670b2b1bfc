#pragma once

#include <atomic>
#include <functional>

#include "calibrate/run/budget_times.h"

/// How much of a study fits into the minutes that somebody has.
///
/// The clock is asked once, before the first run: how long a run of each experiment takes here.
/// From that a budget in seconds of the program's own measure is made, in which every phase counts
/// (Phase in study_estimate.h), and kept in the study's folder. From then on estimates decide and
/// not the clock: an interrupted study goes on by the same plan, and ends with the same bytes as
/// one that never was, with other programs running beside it and with any number of threads. A run
/// that the clock cut short, or one more because the machine was idle, would be in nobody's power
/// to repeat. The price is that it ends some minutes before or after the time, and that a study
/// begun anew on a faster machine has more runs.
namespace repose::calibrate {

/// The largest budget that is foreseen to end within so many minutes on these cores, all its phases
/// included: checks get half of the work at most, and as many fresh runs as that allows.
/// @param spent_s  of the minutes, already
/// @throws base::InputError  not even the least fit ends within them: what would be needed
Budget budget_within(double minutes, const Problem& problem, const Pace& pace, int cores,
                     double spent_s = 0);

/// The same of a study that is prepared with any budget: the one that its folder has of the same
/// study, settings and minutes, else one by a pace that is timed now.
/// @throws dem::Interrupted  `is_interrupted` became true.
Budget budget_of_minutes(double minutes, const PreparedStudy& study,
                         const std::atomic<bool>& is_interrupted,
                         const std::function<void(std::size_t done, std::size_t of)>& timed = {});

}  // namespace repose::calibrate
