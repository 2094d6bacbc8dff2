#pragma once

#include <optional>

#include "io/archive/archives.h"
#include "ui/exports/file_offers.h"

namespace volumen {

/// Where files go.
struct ExportTarget {
  std::optional<Archive> archive{};  ///< empty: the folder
  QString folder{};
  bool deidentified = false;  ///< without the patient's identity (PS3.15 E)
  bool faceless = false;      ///< then without the faces of heads of CT and MR, too
};

/// How an export ended.
struct HandedOver {
  QString sentence;
  QStringList details{};  ///< one line each: what was left out and why, and what to look at
};

/// Sends files to an archive, or copies them into a folder: one as NAME.dcm, several as a new folder NAME,
/// which appears complete. Names that are taken get a number. The Error: nothing left.
Result<HandedOver> handOver(const LeavingFiles& leaving, const QString& name, const ExportTarget& target,
                            const Job& job);

}  // namespace volumen
