#pragma once

#include <atomic>
#include <functional>

#include "calibrate/run/budget_times.h"

/// How much of a study fits into the available minutes.
///
/// The clock is used once, before the first run: how long a run of each experiment takes here. From
/// that a budget in seconds of the program's own measure is made, which includes every phase (Phase
/// in study_estimate.h), and saved in the study's folder. From then on estimates decide, not the
/// clock: an interrupted study continues with the same plan, and ends with the same bytes as an
/// uninterrupted one, with other programs running beside it and with any number of threads. A run
/// cut short by the clock, or one more because the machine was idle, could not be reproduced. The
/// price is that it ends some minutes before or after the time, and that a study begun anew on a
/// faster machine has more runs.
namespace repose::calibrate {

/// The largest budget expected to end within these minutes on these cores, including all phases:
/// checks get at most half of the work, and as many fresh runs as that allows.
/// @param spent_s  seconds already used of these minutes
/// @throws base::InputError  not even the smallest fit ends within them: says what would be needed
Budget budget_within(double minutes, const Problem& problem, const Pace& pace, int cores,
                     double spent_s = 0);

/// The same for a study prepared with any budget: the one saved in its folder for the same study,
/// settings and minutes, otherwise one from a pace timed now.
/// @throws dem::Interrupted  `is_interrupted` became true.
Budget budget_of_minutes(double minutes, const PreparedStudy& study,
                         const std::atomic<bool>& is_interrupted,
                         const std::function<void(std::size_t done, std::size_t of)>& timed = {});

}  // namespace repose::calibrate
