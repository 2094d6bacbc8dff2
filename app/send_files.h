#pragma once

#include <QTemporaryDir>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "io/archive/send_archive.h"
#include "viewer/volume/cancel.h"
#include "viewer/volume/result.h"

namespace volumen {

/// Sends files to an archive, with progress on a terminal. The Error: nothing was sent, or there is nothing
/// to send; a sentence for the user.
Result<SendReport> sendFiles(const Archive& archive, const std::vector<std::string>& files,
                             const CancelToken& cancel);

/// Returns a report as JSON, and as a line for people.
nlohmann::ordered_json sentJson(const SendReport& report);
std::string sentText(const SendReport& report, const Archive& archive);

/// Writes to stderr why instances were not taken, and returns the exit status.
int tellSent(const SendReport& report, const CancelToken& cancel);

/// Where a command writes to: a path, or a temporary folder if its output is archive:NAME.
class OutputTarget {
 public:
  /// The Error: no archive of the user's list has this name, or the temporary folder cannot be made.
  static Result<OutputTarget> of(const std::string& output);

  /// Returns the file or folder to write.
  std::string path() const;
  /// Returns a text that names archive:NAME where it named the temporary folder or what is in it.
  std::string told(std::string text) const;
  /// Returns the archive to send to; null for a path.
  const Archive* archive() const { return archive_ ? &*archive_ : nullptr; }

 private:
  std::string output_;
  std::optional<Archive> archive_;
  std::unique_ptr<QTemporaryDir> folder_;  // removed with this object
};

}  // namespace volumen
