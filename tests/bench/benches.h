#pragma once

#include <CLI/CLI.hpp>

namespace repose::bench {

/// Each adds the command of the same name, with its options.
void add_against_liggghts(CLI::App& bench);
void add_board_accuracy(CLI::App& bench);
void add_draw_heap(CLI::App& bench);
void add_film_accuracy(CLI::App& bench);
void add_heap_agreement(CLI::App& bench);
void add_heap_fidelity(CLI::App& bench);
void add_photo_accuracy(CLI::App& bench);
void add_recovery(CLI::App& bench);
void add_scan_accuracy(CLI::App& bench);
void add_soak(CLI::App& bench);
void add_track_accuracy(CLI::App& bench);

}  // namespace repose::bench
