#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <span>
#include <string>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/atomic_file.h"
#include "base/memory.h"
#include "calibrate/particles/particle_columns.h"
#include "calibrate/particles/particles.h"

namespace repose::calibrate {
namespace {

namespace fs = std::filesystem;

/// A file format: how files begin, their endings, and their reader.
struct ParticleFormat {
  std::string_view name;
  std::array<std::string_view, 2> begins;  ///< empty: not used
  std::array<std::string_view, 5> endings;
  ParticleColumns (*read)(const std::string& file, std::string_view text,
                          const ParticleReading& reading);
};

/// The last one takes everything that the others do not.
constexpr std::array<ParticleFormat, 4> kFormats = {
    {{"LIGGGHTS or LAMMPS dump (text)",
      {"ITEM:", ""},
      {".dump", ".lammpstrj", ".liggghts", ".lammps", ""},
      columns_in_dump},
     {"legacy VTK", {"# vtk DataFile", ""}, {".vtk", "", "", "", ""}, columns_in_legacy_vtk},
     {".vtu or .vtp", {"<?xml", "<VTKFile"}, {".vtu", ".vtp", "", "", ""}, columns_in_xml_vtk},
     {"CSV or columns with a header, EDEM's export too",
      {"", ""},
      {".csv", ".txt", ".dat", ".tsv", ".xyzr"},
      columns_in_table}}};

bool is_any_of(std::string_view word, std::span<const std::string_view> words) {
  return !word.empty() && std::ranges::find(words, word) != words.end();
}

bool begins_as(std::string_view text, const ParticleFormat& format) {
  return std::ranges::any_of(format.begins, [&](std::string_view begin) {
    return !begin.empty() && text.starts_with(begin);
  });
}

}  // namespace

bool is_particle_file(const fs::path& file) {
  std::string ending = file.extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char letter) {
    return static_cast<char>(std::tolower(letter));
  });
  for (const ParticleFormat& format : kFormats) {
    if (is_any_of(ending, format.endings)) return true;
  }
  std::error_code ignored;
  if (!fs::is_regular_file(file, ignored)) return false;
  // Dumps may have any name: dump.120000.
  constexpr std::size_t kBeginning = 16;
  std::array<char, kBeginning> first{};
  std::ifstream stream(file, std::ios::binary);
  stream.read(first.data(), first.size());
  const std::string_view text(first.data(), static_cast<std::size_t>(stream.gcount()));
  return std::ranges::any_of(kFormats, [&](const ParticleFormat& format) {
    return begins_as(text, format) && format.read != columns_in_xml_vtk;
  });
}

std::string names_of_particle_files() {
  std::vector<std::string_view> names;
  for (const ParticleFormat& format : kFormats) names.push_back(format.name);
  return fmt::format("{}", fmt::join(names, ", "));
}

Particles read_particles(const fs::path& file, const ParticleReading& reading) {
  const std::string text = base::read_whole_file(file);
  const auto format = std::ranges::find_if(
      kFormats, [&](const ParticleFormat& one) { return begins_as(text, one); });
  const ParticleFormat& used = format == kFormats.end() ? kFormats.back() : *format;
  return particles_of(used.read(file.string(), text, reading), reading);
}

}  // namespace repose::calibrate
