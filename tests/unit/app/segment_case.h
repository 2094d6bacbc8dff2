#pragma once

#include <QDir>
#include <QFile>
#include <QJsonArray>
#include <QJsonObject>
#include <QMap>
#include <QTest>

#include "tests/fixtures/program.h"

namespace volumen::tests {

/// Runs `volumen segment ARGUMENTS`.
inline Outcome runSegment(const QStringList& arguments) {
  return runProgram(QStringList{QStringLiteral("segment")} + arguments);
}

/// Returns the only segment in output of --json, or an empty object if there are several.
inline QJsonObject only(const QJsonObject& all) {
  const QJsonArray segments = all[QStringLiteral("segments")].toArray();
  return segments.size() == 1 ? segments[0].toObject() : QJsonObject();
}

/// Splits text at spaces.
inline QStringList words(const char* text) { return QString::fromLatin1(text).split(QLatin1Char(' ')); }

/// Writes a file. The test fails if it cannot be written.
inline void writeBytes(const QString& path, const QByteArray& bytes) {
  QFile file(path);
  QVERIFY(file.open(QIODevice::WriteOnly) && file.write(bytes) == bytes.size());
}

/// Returns names and contents of the files in a folder.
inline QMap<QString, QByteArray> allFilesIn(const QString& folder) {
  QMap<QString, QByteArray> files;
  for (const QString& name : QDir(folder).entryList(QDir::Files | QDir::Hidden))
    files[name] = contentsOf(folder + QLatin1Char('/') + name);
  return files;
}

}  // namespace volumen::tests
