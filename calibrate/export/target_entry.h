#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "calibrate/export/export.h"
#include "calibrate/export/facts.h"
#include "calibrate/export/rolling.h"
#include "dem/experiment/experiment_table.h"

namespace repose::calibrate {

using Conversions = std::vector<Conversion>;

/// Another program's counterpart of a restitution.
struct RestitutionCounterpart {
  std::string name = {};  ///< what it calls it
  double value = 0;       ///< there
  Fidelity fidelity = Fidelity::exact;
  std::string law = {};     ///< definition
  std::string limits = {};  ///< what does not carry over
};

/// Everything about a program that studies are exported to. NAME.cpp has its decks and
/// NAME_target(); templates/NAME has the templates they are filled into, and limits.txt,
/// running.txt and heap_back.txt; its line is in export_targets().
struct TargetEntry {
  std::string_view name;        ///< on the command line and in folders
  std::string_view summary;     ///< what is written for it
  bool has_tables;              ///< instead of decks, valid for all experiments and sizes
  bool takes_incline_material;  ///< a roll's incline may be of another material than its flat
  /// Its name as its makers write it, and the version that the decks are for.
  std::string (*program)(dem::RollingModel model);
  RestitutionCounterpart (*restitution)(double ours);
  std::string_view heap_file;                           ///< with a heap's spheres: heap_back.txt
  std::string_view heap_unit;                           ///< its unit; empty: stated in the file
  std::string_view sliding_name;                        ///< what it calls sliding friction
  std::string_view sliding_limits;                      ///< what does not carry over
  std::string_view rolling_name;                        ///< what it calls rolling friction
  std::string (*rolling_law)(dem::RollingModel model);  ///< and its definition, as a sentence
  /// For models with rolling friction.
  RollingConversion (*rolling)(dem::RollingModel model, Partner partner,
                               const dem::ClumpShape& grain);
  /// Whether it has a deck for an experiment with this protocol. Each has been run: see
  /// tests/peers.
  bool (*has_deck)(const dem::Protocol& protocol);
  /// All files but README.txt.
  std::vector<ExportedFile> (*files)(const ExportFacts& facts, const Conversions& conversions);
};

/// Whether the protocol is that of one of these experiments.
template <typename... Kinds>
bool is_one_of(const dem::Protocol& protocol) {
  return ((&dem::entry_of(protocol) == dem::experiment_of<Kinds>()) || ...);
}

}  // namespace repose::calibrate
