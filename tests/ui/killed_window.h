#pragma once

#include <QDateTime>
#include <QDir>
#include <QProcess>
#include <memory>
#include <utility>
#include <vector>

#include "tests/fixtures/program.h"
#include "tests/ui/journey.h"
#include "ui/controller/autosave.h"
#include "ui/workspace/session_json.h"

namespace volumen::tests {

/// The sessions that are kept by Autosave.
inline QStringList keptSessions() {
  return QDir(Autosave::folder()).entryList({QStringLiteral("*.volumen")}, QDir::Files, QDir::Name);
}

inline bool areKept(int count) {
  return QTest::qWaitFor([&] { return keptSessions().size() == count; }, longest);
}

/// A workspace as a session file says it; labels of segments by their checksum.
inline QString sessionTextOf(const Workspace& workspace) {
  return QString::fromStdString(*sessionToJson(workspace, "/"));
}

/// Writes a file of some milliseconds since the epoch and the workspace then.
inline void noteState(const QDir& folder, int number, const Workspace& workspace) {
  QFile file(folder.filePath(QStringLiteral("%1").arg(number, 6, 10, QLatin1Char('0'))));
  if (file.open(QIODevice::WriteOnly))
    file.write(QByteArray::number(QDateTime::currentMSecsSinceEpoch()) + '\n' +
               sessionTextOf(workspace).toUtf8());
}

/// What noteState() wrote.
struct NotedState {
  qint64 at = 0;
  QString text;
};

/// Those of a folder that are whole, in the order of their numbers.
inline std::vector<NotedState> notedStates(const QDir& folder) {
  std::vector<NotedState> notes;
  for (const QString& name : folder.entryList(QDir::Files, QDir::Name)) {
    const QByteArray bytes = contentsOf(folder.filePath(name));
    const qsizetype line = bytes.indexOf('\n');
    if (line > 0 && bytes.endsWith("}\n"))
      notes.push_back({bytes.left(line).toLongLong(), QString::fromUtf8(bytes.mid(line + 1))});
  }
  return notes;
}

/// Starts a program, without a display, with the settings, caches and kept sessions of this one. What it
/// prints is lost, or in `output`.
inline std::unique_ptr<QProcess> startedProgram(const QString& program, const QStringList& arguments,
                                                const QList<std::pair<QString, QString>>& more = {},
                                                const QString& output = QProcess::nullDevice()) {
  auto process = std::make_unique<QProcess>();
  QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
  environment.insert(QStringLiteral("QT_QPA_PLATFORM"), QStringLiteral("offscreen"));
  environment.remove(QStringLiteral("DISPLAY"));  // else OpenGL is looked for there
  environment.insert(QStringLiteral("VOLUMEN_TEST_HOME"), qEnvironmentVariable("XDG_DATA_HOME"));
  for (const auto& [name, value] : more) environment.insert(name, value);
  process->setProcessEnvironment(environment);
  process->setProcessChannelMode(QProcess::ForwardedErrorChannel);
  process->setStandardOutputFile(output);
  process->start(program, arguments);
  return process;
}

/// Starts a function of a test class in this program again, as above.
inline std::unique_ptr<QProcess> startedTest(const char* test, const QString& function,
                                             QList<std::pair<QString, QString>> more,
                                             const QString& output = QProcess::nullDevice()) {
  more.append({QStringLiteral("VOLUMEN_ONLY"), QLatin1String(test)});
  return startedProgram(QCoreApplication::applicationFilePath(), {function}, more, output);
}

inline void killProgram(QProcess& process) {
  process.kill();  // SIGKILL
  process.waitForFinished();
}

}  // namespace volumen::tests
