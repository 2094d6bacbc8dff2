#pragma once

#include <string>

#include "viewer/volume/result.h"

namespace volumen {

/// Makes new UIDs and names that follow from old ones and a secret key (HMAC-SHA256): equal ones stay equal
/// across files and runs, and without the key nobody can tell which was which.
class Pseudonyms {
 public:
  /// With `faceless`, UIDs are others: those of copies whose faces are taken away.
  explicit Pseudonyms(std::string key, bool faceless = false) : key_(std::move(key)), faceless_(faceless) {}

  /// Returns the new UID for an instance, series, study, frame of reference and so on. Those of the standard
  /// (1.2.840.10008) stay.
  std::string uid(const std::string& old) const;
  /// Returns a name of ten letters and digits.
  std::string name(const std::string& old) const;
  const std::string& key() const { return key_; }

 private:
  std::string key_;
  bool faceless_;
};

/// Returns the path of the file with the user's secret key, which may not be there yet.
std::string userPseudonymKeyFile();

/// Returns the user's secret key. Its file is among the settings and readable by the user alone; the first
/// call makes it. The Error: the file can be neither read nor made.
Result<std::string> userPseudonymKey();

/// Returns the bytes of a key file. The Error: it cannot be read or has fewer than 16 bytes.
Result<std::string> pseudonymKeyIn(const std::string& path);

}  // namespace volumen
