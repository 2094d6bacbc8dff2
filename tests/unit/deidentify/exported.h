#pragma once

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <QString>
#include <QTemporaryDir>
#include <memory>

#include "tests/fixtures/program.h"

namespace volumen::tests {

/// A data set read by DCMTK, with its file; null if it cannot be read.
std::unique_ptr<DcmFileFormat> readWithDcmtk(const QString& path);

/// Returns all values of an attribute of the data set as text.
std::string textOf(DcmItem& item, const DcmTagKey& tag);

/// Returns the paths of all .dcm files below a folder, sorted.
QStringList copiesIn(const QString& folder);

/// Calls visit(element, enclosing sequences) for all elements at all depths, sequences included.
void forAllElements(DcmItem& item, const std::function<void(DcmElement&)>& visit);

/// Runs of `volumen export --deidentify` with a key of their own.
class Exported {
 public:
  Exported();
  /// Exports into a new folder.
  Outcome run(const QString& path, const QStringList& options = {});
  /// The folder of the last run, and the only copy in it, null if there is not exactly one.
  QString folder() const { return folder_; }
  std::unique_ptr<DcmFileFormat> only() const;
  /// The new UID, computed here.
  std::string uid(const std::string& old) const;
  QString pathOf(const char* name) const { return dir_.filePath(QString::fromLatin1(name)); }

 private:
  QTemporaryDir dir_;
  QString folder_;
  int runs_ = 0;
};

}  // namespace volumen::tests
