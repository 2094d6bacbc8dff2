#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <string>

namespace volumen {

/// A file that could not be read; the reason stands behind its name: "F: compressed with bzip2, ...".
struct Refused {
  std::string path, reason;
  bool again = false;  ///< what failed was the machine, not the file: it is worth another try
  bool operator==(const Refused&) const = default;
};

/// A file of a series that could not be read, or one beside its files that does not say whose it is.
struct Unread : Refused {
  bool beside = false;                 ///< its header could not be read: it may be of another series
  std::optional<glm::dvec3> position;  ///< of its slice, mm (LPS); empty: not known
  bool operator==(const Unread&) const = default;
};

}  // namespace volumen
