#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

/// Each reader of files that come from elsewhere, as a function that takes any bytes. It must end
/// soon, with a value or with base::InputError; what else it throws or does is a fault.
namespace repose::fuzz {

using Bytes = std::span<const std::uint8_t>;

void read_study(Bytes bytes);
void read_table(Bytes bytes);
void read_clump(Bytes bytes);
void read_scan(Bytes bytes);  ///< the first byte says which format
void read_state(Bytes bytes);
void read_restart(Bytes bytes);
void read_result(Bytes bytes);
void read_picture(Bytes bytes);
void read_hints(Bytes bytes);
void read_camera(Bytes bytes);
void read_heap_scan(Bytes bytes);  ///< the first byte says which format
void read_particles(Bytes bytes);
void read_names(Bytes bytes);  ///< into the decks for other programs

struct Reader {
  std::string_view name;  ///< also of its folder in the corpus
  void (*read)(Bytes bytes);
};

inline constexpr std::array<Reader, 13> kReaders = {{{"study", read_study},
                                                     {"table", read_table},
                                                     {"clump", read_clump},
                                                     {"scan", read_scan},
                                                     {"state", read_state},
                                                     {"restart", read_restart},
                                                     {"result", read_result},
                                                     {"picture", read_picture},
                                                     {"hints", read_hints},
                                                     {"camera", read_camera},
                                                     {"heap_scan", read_heap_scan},
                                                     {"particles", read_particles},
                                                     {"names", read_names}}};

}  // namespace repose::fuzz
