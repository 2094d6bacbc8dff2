#pragma once

#include <QDir>
#include <QFile>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QMap>
#include <QProcess>
#include <QTemporaryDir>
#include <QTest>

#include "tests/fixtures/program.h"

// Lists of work for `volumen batch`, and what it says.

namespace volumen::tests {

/// Skips a test that limits the memory of pieces: AddressSanitizer reserves far more.
#ifdef __SANITIZE_ADDRESS__
#define NEED_LIMITED_MEMORY() QSKIP("AddressSanitizer reserves more memory than any limit leaves")
#else
#define NEED_LIMITED_MEMORY()
#endif

inline const QString smallHead = QStringLiteral("phantom:ct-head:32");

inline QJsonObject piece(const QString& command, const QString& output, QJsonObject options = {}) {
  options[QStringLiteral("command")] = command;
  if (!options.contains(QStringLiteral("path"))) options[QStringLiteral("path")] = smallHead;
  options[QStringLiteral("output")] = output;
  return options;
}

inline QJsonObject smallPicture(const QString& output, const QString& path = smallHead) {
  return piece(QStringLiteral("render"), output,
               {{QStringLiteral("path"), path}, {QStringLiteral("size"), QStringLiteral("32x32")}});
}

inline QByteArray listOf(const QList<QJsonObject>& pieces) {
  QByteArray list;
  for (const QJsonObject& one : pieces) list += QJsonDocument(one).toJson(QJsonDocument::Compact) + '\n';
  return list;
}

// Returns how the pieces ended, by line.
inline QMap<int, QString> endsIn(const QByteArray& out) {
  QMap<int, QString> ends;
  for (const QByteArray& line : out.trimmed().split('\n')) {
    const QJsonObject one = QJsonDocument::fromJson(line).object();
    if (!one.isEmpty()) ends[one[QStringLiteral("line")].toInt()] = one[QStringLiteral("end")].toString();
  }
  return ends;
}

inline QJsonObject lineIn(const QByteArray& out, int line) {
  for (const QByteArray& text : out.split('\n'))
    if (const QJsonObject one = QJsonDocument::fromJson(text).object(); one[QStringLiteral("line")] == line)
      return one;
  return {};
}

inline QMap<int, QString> all(int count, const QString& end) {
  QMap<int, QString> ends;
  for (int line = 1; line <= count; ++line) ends[line] = end;
  return ends;
}

// Returns the processes that a process has forked.
inline QList<pid_t> childrenOf(qint64 pid) {
  QList<pid_t> children;
  const QString file = QStringLiteral("/proc/%1/task/%1/children").arg(pid);
  for (const QByteArray& child : contentsOf(file).split(' '))
    if (!child.trimmed().isEmpty()) children << child.toInt();
  return children;
}

/// A folder with a list of work in the file "jobs".
class BatchFolder {
 public:
  QString at(const QString& name) const { return folder_.filePath(name); }
  QByteArray contents(const QString& name) const { return contentsOf(at(name)); }
  void write(const QString& name, const QByteArray& bytes) const {
    QFile file(at(name));
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write(bytes);
  }
  Outcome batch(const QStringList& options = {}) const {
    return runProgramIn(folder_.path(),
                        QStringList{QStringLiteral("batch"), QStringLiteral("jobs")} + options);
  }
  void start(QProcess& process) const {
    process.setWorkingDirectory(folder_.path());
    process.start(QStringLiteral(VOLUMEN_PROGRAM), {QStringLiteral("batch"), QStringLiteral("jobs")});
    QVERIFY(process.waitForStarted());
  }
  QStringList files() const {
    return QDir(folder_.path()).entryList(QDir::AllEntries | QDir::Hidden | QDir::NoDotAndDotDot, QDir::Name);
  }

 private:
  QTemporaryDir folder_;
};

}  // namespace volumen::tests
