#include "calibrate/start/new_study.h"

#include <cerrno>
#include <cstdlib>
#include <system_error>

#include <fmt/format.h>

#include "base/atomic_file.h"
#include "base/csv.h"
#include "base/input_error.h"

namespace repose::calibrate {

namespace {

// Bounds without a source are wide on purpose: they cover dry grain, seeds, nuts and beads on
// smooth plates, and a fit narrows them. Reviews with many values: Boac, Casada, Maghirang, Harner
// (2010), Trans. ASABE 53(4), 1201-1216 (grains and oilseeds); Horabik, Molenda (2016), Biosystems
// Engineering 147, 206-225 (agricultural materials).
constexpr ContactBounds kAnyWall{
    .restitution = {.05, .9}, .sliding_friction = {.05, .9}, .rolling_friction = {.002, .25}};
constexpr ContactBounds kAnyGrain{
    .restitution = {.05, .9}, .sliding_friction = {.05, .9}, .rolling_friction = {0, .3}};

// Around the best-fitting values there: restitution .6, sliding friction .45 between soybeans and
// .30 on steel, rolling friction .05. Their shear modulus of 1 MPa was softened on purpose.
constexpr std::string_view kBoac =
    "Boac et al. (2010), Trans. ASABE 53(4), 1201-1216: wide about their best values, restitution "
    "0.6, sliding friction 0.45 between grains and 0.30 on steel, rolling friction 0.05";
constexpr ContactBounds kSoybeanWall{
    .restitution = {.3, .9}, .sliding_friction = {.1, .6}, .rolling_friction = {.005, .2}};
constexpr ContactBounds kSoybeanGrain{
    .restitution = {.3, .9}, .sliding_friction = {.1, .8}, .rolling_friction = {0, .2}};

// The bounds of samples/hazelnut/study.toml, around its published values.
constexpr std::string_view kHazelnut =
    "the hazelnut study among the samples of repose: wide about published values on steel";
constexpr ContactBounds kHazelnutWall{
    .restitution = {.05, .9}, .sliding_friction = {.1, .8}, .rolling_friction = {.005, .2}};
constexpr ContactBounds kHazelnutGrain{
    .restitution = {.05, .9}, .sliding_friction = {.05, .8}, .rolling_friction = {0, .3}};

// Spheres of soda-lime glass: restitution .97, friction .09 between them.
constexpr std::string_view kFoerster =
    "Foerster et al. (1994), Physics of Fluids 6(3), 1108-1115: wide about their glass spheres, "
    "restitution 0.97, friction 0.09";
constexpr ContactBounds kGlassWall{
    .restitution = {.6, .99}, .sliding_friction = {.05, .5}, .rolling_friction = {0, .1}};
constexpr ContactBounds kGlassGrain{
    .restitution = {.8, .99}, .sliding_friction = {.03, .4}, .rolling_friction = {0, .1}};

// Sizes and materials are typical round numbers.
constexpr std::array kGrains{
    GrainKind{"soybean",
              "soybeans",
              {7.6, 6.9, 6.2},
              1200,
              1e8,
              .25,
              kSoybeanWall,
              kSoybeanGrain,
              {217, 196, 143},
              kBoac},
    GrainKind{"maize",
              "maize kernels",
              {11.5, 8.3, 4.5},
              1250,
              2e8,
              .3,
              kAnyWall,
              kAnyGrain,
              {224, 168, 58},
              ""},
    GrainKind{"wheat",
              "wheat grains",
              {6.5, 3.3, 2.9},
              1350,
              2e8,
              .3,
              kAnyWall,
              kAnyGrain,
              {201, 154, 92},
              ""},
    GrainKind{"rice",
              "rice grains",
              {6.5, 2.4, 2.0},
              1400,
              3e8,
              .25,
              kAnyWall,
              kAnyGrain,
              {232, 224, 204},
              ""},
    GrainKind{"hazelnut",
              "hazelnuts",
              {22.5, 18.2, 17.5},
              850,
              1.25e9,
              .38,
              kHazelnutWall,
              kHazelnutGrain,
              {143, 97, 61},
              kHazelnut},
    GrainKind{
        "pea", "peas", {7.6, 7.2, 6.9}, 1300, 2e8, .3, kAnyWall, kAnyGrain, {150, 170, 90}, ""},
    GrainKind{
        "rapeseed", "rapeseeds", {2, 2, 2}, 1100, 1e8, .3, kAnyWall, kAnyGrain, {58, 44, 38}, ""},
    GrainKind{"glass",
              "glass beads",
              {4, 4, 4},
              2500,
              6.5e10,
              .22,
              kGlassWall,
              kGlassGrain,
              {200, 212, 216},
              kFoerster},
    GrainKind{
        "other", "grains", {8, 7, 6}, 1200, 2e8, .3, kAnyWall, kAnyGrain, {176, 152, 118}, ""}};

constexpr std::array kPlates{
    PlateKind{"acrylic", 1190, 3e9, .37},    PlateKind{"steel", 7850, 2.1e11, .3},
    PlateKind{"aluminium", 2700, 7e10, .33}, PlateKind{"glass", 2500, 7e10, .22},
    PlateKind{"pvc", 1400, 3e9, .38},        PlateKind{"wood", 650, 1e10, .35},
    PlateKind{"rubber", 1200, 1e7, .49}};

}  // namespace

std::span<const GrainKind> grain_kinds() { return kGrains; }
std::span<const PlateKind> plate_kinds() { return kPlates; }

namespace {

namespace fs = std::filesystem;

/// A folder that the destructor deletes unless it was renamed to its final name.
class TemporaryFolder {
 public:
  explicit TemporaryFolder(const fs::path& folder) : folder_(folder) {
    std::string name = (base::folder_of(folder) / ".repose-new-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) {
      const std::error_code error(errno, std::generic_category());
      base::refuse(folder, fmt::format("cannot be created ({})", error.message()),
                   "choose a writable place.");
    }
    path_ = name;
    fs::permissions(path_,
                    fs::perms::group_read | fs::perms::group_exec | fs::perms::others_read |
                        fs::perms::others_exec,
                    fs::perm_options::add);
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    if (!is_done_) fs::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  TemporaryFolder(TemporaryFolder&&) = delete;
  TemporaryFolder& operator=(TemporaryFolder&&) = delete;

  const fs::path& path() const { return path_; }
  void put_in_place() {
    fs::rename(path_, folder_);
    path_ = folder_;
  }
  void keep() { is_done_ = true; }

 private:
  fs::path folder_;
  fs::path path_;
  bool is_done_ = false;
};

}  // namespace

fs::path sheet_folder_of(const fs::path& file) { return file.parent_path() / file.stem(); }

void check_new_places(const fs::path& file) {
  base::Faults errors;
  std::error_code ignored;
  for (const fs::path& place : {file, sheet_folder_of(file)}) {
    errors.require(!fs::exists(fs::symlink_status(place, ignored)),
                   {.where = place.string(),
                    .value = "already exists, and nothing is overwritten",
                    .fix = "choose another name for the study, or move it away."});
  }
  errors.require(fs::is_directory(base::folder_of(file), ignored),
                 {.where = file.string(),
                  .value = fmt::format("there is no folder {}", base::folder_of(file).string()),
                  .fix = "make it, or correct the name."});
  errors.throw_if_any();
}

void write_new_study(const NewStudy& study, const fs::path& file) {
  check_new_places(file);
  const fs::path folder = sheet_folder_of(file);
  TemporaryFolder sheets(folder);
  for (const NewSheet& sheet : sheets_of(study)) {
    base::write_whole_file(sheets.path() / sheet.name, base::csv_row(sheet.columns));
  }
  base::check_can_write(file);
  sheets.put_in_place();
  base::write_whole_file(file, study_text(study, folder.filename().string()));
  sheets.keep();
}

}  // namespace repose::calibrate
