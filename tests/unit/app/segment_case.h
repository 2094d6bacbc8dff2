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

/// The one segment in what --json told; empty where there are several.
inline QJsonObject only(const QJsonObject& all) {
  const QJsonArray segments = all[QStringLiteral("segments")].toArray();
  return segments.size() == 1 ? segments[0].toObject() : QJsonObject();
}

/// What stands between blanks.
inline QStringList words(const char* text) { return QString::fromLatin1(text).split(QLatin1Char(' ')); }

/// Writes a file; where it cannot be written the test fails.
inline void writeBytes(const QString& path, const QByteArray& bytes) {
  QFile file(path);
  QVERIFY(file.open(QIODevice::WriteOnly) && file.write(bytes) == bytes.size());
}

/// Names and contents of the files in a folder.
inline QMap<QString, QByteArray> allFilesIn(const QString& folder) {
  QMap<QString, QByteArray> files;
  for (const QString& name : QDir(folder).entryList(QDir::Files | QDir::Hidden))
    files[name] = contentsOf(folder + QLatin1Char('/') + name);
  return files;
}

}  // namespace volumen::tests
