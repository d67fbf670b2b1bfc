#pragma once

#include <list>
#include <memory>
#include <mutex>
#include <string>

#include "calibrate/compared/compared_sets.h"
#include "studio/picture_folder.h"

namespace repose::studio {

/// Sets of heaps compared as `repose compare` compares them: files of the studio's folder that a
/// person has chosen, and folders in it. Some of them are kept, for their figures. Several threads
/// may ask at once.
/// All of it throws base::InputError for a name or a number that is not there.
class SetComparisons {
 public:
  explicit SetComparisons(const PictureFolder& pictures) : pictures_(pictures) {}

  /// `folders` within the studio's that hold heaps [{`folder`, `kind`, `heaps`}], and `margin_deg`.
  Json folders() const;

  /// @param asked  `first` and `second`, each {`folder`} or {`files`}, and `margin_deg`
  /// @returns `number`, the `comparison` as `repose compare --json` has it, `has_figure`, `notes`,
  ///   and the `command` that does the same
  Json compare(const Json& asked);
  /// As `repose compare --overlay` draws it, as PNG.
  PictureFolder::Bytes figure(int number, int width_px) const;
  std::string json(int number) const;

 private:
  struct Kept {
    int number = 0;
    calibrate::ComparedSets compared;
  };

  calibrate::HeapSource source_of(const Json& asked, const char* set) const;
  std::shared_ptr<const Kept> kept(int number) const;

  const PictureFolder& pictures_;
  mutable std::mutex mutex_;
  int last_number_ = 0;
  std::list<std::shared_ptr<const Kept>> kept_;
};

}  // namespace repose::studio
