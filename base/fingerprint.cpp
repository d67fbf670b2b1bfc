#include "base/fingerprint.h"

#include <boost/uuid/name_generator_sha1.hpp>
#include <boost/uuid/uuid_io.hpp>

namespace repose::base {

std::string fingerprint(const std::vector<std::string>& texts) {
  std::string all;
  for (const std::string& text : texts) all += std::to_string(text.size()) + ':' + text;
  return to_string(boost::uuids::name_generator_sha1(boost::uuids::ns::oid())(all));
}

}  // namespace repose::base
