#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace volumen {

/// Remembers which of a folder and its parents are missing, and removes them at the end of its life if they
/// are there then and empty.
class MadeFolder {
 public:
  explicit MadeFolder(const std::string& folder);
  MadeFolder(const MadeFolder&) = delete;
  MadeFolder& operator=(const MadeFolder&) = delete;
  ~MadeFolder();

 private:
  std::vector<std::filesystem::path> missing_;  // inner ones first
};

}  // namespace volumen
