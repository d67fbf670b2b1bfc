#include <algorithm>
#include <sstream>
#include <stdexcept>
#include <string_view>

#include "calibrate/export/export.h"
#include "dem/experiment/experiment_table.h"
#include "dem/experiment/tilt.h"
#include "tests/dem/experiment_model.h"
#include "tests/fuzz/scratch_file.h"

namespace repose::fuzz {
namespace {

using calibrate::ExportedFile;

/// Letters that begin, end or run something in one of the languages of the decks.
constexpr std::string_view kActive = "\"'`\\$#&;:!|<>(){}[]*/=\r\t";

dem::Study study_called(const std::string& name) {
  dem::Study study;
  study.model = dem::test::sphere_bench();
  study.experiments[dem::experiment_of<dem::TiltProtocol>()].protocol = dem::TiltProtocol{};
  study.file = name;
  study.hash = name;
  study.model.grain_material.name = name;
  study.model.wall_material.name = name;
  return study;
}

std::vector<ExportedFile> decks_called(const std::string& name, calibrate::ExportTarget target) {
  const dem::Study study = study_called(name);
  return calibrate::export_study(
             study, study.model.grain,
             {{.name = "contact.particle_wall.restitution", .value = .5, .verdict = "v" + name}},
             {.target = target, .takes_approximate = true})
      .files;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// A line with a name in it has the active letters of the same line with a harmless name.
bool says_the_same(const std::string& line, const std::string& harmless) {
  return std::all_of(kActive.begin(), kActive.end(), [&](char letter) {
    return std::count(line.begin(), line.end(), letter) ==
           std::count(harmless.begin(), harmless.end(), letter);
  });
}

void require_same_deck(const ExportedFile& file, const ExportedFile& harmless) {
  const std::vector<std::string> lines = lines_of(file.text);
  const std::vector<std::string> expected = lines_of(harmless.text);
  if (file.name != harmless.name || lines.size() != expected.size() ||
      !std::equal(lines.begin(), lines.end(), expected.begin(), says_the_same)) {
    throw std::logic_error("a name changes what " + harmless.name + " does");
  }
}

}  // namespace

/// The bytes are the names of a study, its grain and its wall, and a verdict of its result.
void read_names(Bytes bytes) {
  for (const calibrate::ExportTarget target : calibrate::export_targets()) {
    const std::vector<ExportedFile> decks = decks_called(text_of(bytes), target);
    const std::vector<ExportedFile> harmless = decks_called("name", target);
    if (decks.size() != harmless.size()) throw std::logic_error("a name makes a file");
    for (std::size_t k = 0; k < decks.size(); ++k) require_same_deck(decks[k], harmless[k]);
  }
}

}  // namespace repose::fuzz
