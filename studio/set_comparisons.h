#pragma once

#include <list>
#include <memory>
#include <mutex>
#include <string>

#include "calibrate/compared/compared_sets.h"
#include "studio/picture_folder.h"

namespace repose::studio {

/// Sets of heaps compared as by `repose compare`: files that the user chose in the studio's folder,
/// and folders in it. Some results are kept for their figures. Thread-safe. All members throw
/// base::InputError for an unknown name or number.
class SetComparisons {
 public:
  explicit SetComparisons(const PictureFolder& pictures) : pictures_(pictures) {}

  /// `folders` within the studio's that contain heaps [{`folder`, `kind`, `heaps`}], and the
  /// default `margin_deg`.
  Json folders() const;

  /// @param asked  `first` and `second`, each {`folder`} or {`files`}, and `margin_deg`
  /// @returns `number`, the `comparison` as in `repose compare --json`, `has_figure`, `notes`, and
  ///   the equivalent `command`
  Json compare(const Json& asked);
  /// As drawn by `repose compare --overlay`, as PNG.
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
