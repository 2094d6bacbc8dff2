#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace volumen {

/// Remembers which of a folder and its parents are missing when it is made. Its destructor removes those of
/// them that exist then and are empty.
class MadeFolder {
 public:
  explicit MadeFolder(const std::string& folder);
  MadeFolder(const MadeFolder&) = delete;
  MadeFolder& operator=(const MadeFolder&) = delete;
  ~MadeFolder();

 private:
  std::vector<std::filesystem::path> missing_;  // innermost first
};

}  // namespace volumen
