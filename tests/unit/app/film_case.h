#pragma once

#include <QTemporaryDir>

#include "tests/fixtures/program.h"

namespace volumen::tests {

/// A folder for films and what they are compared with.
struct FilmFolder {
  QTemporaryDir folder;

  QString at(const QString& name) const { return folder.filePath(name); }
  /// Runs a command on a path. Blanks separate the options.
  Outcome run(const QString& command, const QString& path, const QString& options,
              const QString& output) const {
    return runProgram(QStringList{command, path, QStringLiteral("-o"), output} +
                      options.split(QLatin1Char(' '), Qt::SkipEmptyParts));
  }
};

}  // namespace volumen::tests
