#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>

namespace volumen {

/// True if two files hold the same bytes; empty if one of them cannot be read.
std::optional<bool> haveSameBytes(const std::string& a, const std::string& b);

/// Tells which files are copies of others. Each pair of files is read once.
class FileCopies {
 public:
  /// Returns whether two files are one, or hold the same bytes.
  bool areAlike(const std::string& a, const std::string& b);

 private:
  std::map<std::pair<std::string, std::string>, bool> compared_;
};

}  // namespace volumen
