#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <string>

namespace volumen {

/// A file that could not be read. `reason` includes its name: "F: compressed with bzip2, ...".
struct Refused {
  std::string path, reason;
  bool again = false;  ///< true if the machine failed, not the file, so that another try is worthwhile
  bool operator==(const Refused&) const = default;
};

/// A file of a series that could not be read, or a neighbouring file that does not say which series it
/// belongs to.
struct Unread : Refused {
  bool beside = false;  ///< true if its header could not be read, so that it may belong to another series
  std::optional<glm::dvec3> position;  ///< position of its slice, mm (LPS); empty if unknown
  bool operator==(const Unread&) const = default;
};

}  // namespace volumen
