#pragma once

#include <string>
#include <utility>
#include <vector>

#include "base/input_error.h"
#include "calibrate/export/export.h"
#include "calibrate/export/facts.h"

namespace repose::calibrate {

/// The conversion of each coefficient that the study's experiments need: walls first.
std::vector<Conversion> conversions_of(const ExportFacts& facts, ExportTarget target);

/// The exported value of one coefficient: `conversions` as above. NaN for a pair that is not
/// needed.
double exported(const std::vector<Conversion>& conversions, const std::string& coefficient);

/// The target's coefficient at two values of ours, the smaller first.
std::pair<double, double> exported_bounds(const ExportFacts& facts, ExportTarget target,
                                          const Conversion& conversion,
                                          std::pair<double, double> ours);

/// The name of a pair: "grain with wall" for "contact.particle_wall.restitution".
std::string pair_text(const std::string& coefficient);

/// Reasons why conversions cannot be written, a line each; empty: none.
std::vector<base::Fault> refusals(const ExportFacts& facts, const ExportRequest& request,
                                  const std::vector<Conversion>& conversions);

}  // namespace repose::calibrate
