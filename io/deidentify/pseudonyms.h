#pragma once

#include <string>

#include "viewer/volume/result.h"

namespace volumen {

/// Makes new UIDs and names from old ones and a secret key (HMAC-SHA256). Equal ones stay equal across files
/// and runs. Without the key nobody can link new ones to old ones.
class Pseudonyms {
 public:
  /// `faceless` gives other UIDs, for copies whose faces are removed.
  explicit Pseudonyms(std::string key, bool faceless = false) : key_(std::move(key)), faceless_(faceless) {}

  /// Returns the new UID of an instance, series, study, frame of reference and so on. UIDs of the standard
  /// (1.2.840.10008) are returned unchanged.
  std::string uid(const std::string& old) const;
  /// Returns a pseudonym of ten letters and digits.
  std::string name(const std::string& old) const;
  const std::string& key() const { return key_; }

 private:
  std::string key_;
  bool faceless_;
};

/// Returns the path of the file with the user's secret key. The file may not exist yet.
std::string userPseudonymKeyFile();

/// Returns the user's secret key. The first call makes its file, among the settings and readable only by the
/// user. Returns an Error if the file can be neither read nor made.
Result<std::string> userPseudonymKey();

/// Returns the bytes of a key file. Returns an Error if the file cannot be read or has fewer than 16 bytes.
Result<std::string> pseudonymKeyIn(const std::string& path);

}  // namespace volumen
