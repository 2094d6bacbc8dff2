#pragma once

#include <QDir>
#include <QProcess>
#include <memory>
#include <utility>

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

/// Waits until the only session that is kept was written that many times more.
inline bool isKeptAgain(int times) {
  const auto now = [] {
    const QStringList names = keptSessions();
    return names.size() == 1 ? contentsOf(QDir(Autosave::folder()).filePath(names[0])) : QByteArray();
  };
  for (int n = 0; n < times; ++n)
    if (!QTest::qWaitFor([&now, last = now()] { return now() != last; }, longest)) return false;
  return true;
}

/// Writes a file of a workspace.
inline void noteState(const QDir& folder, int number, const Workspace& workspace) {
  QFile file(folder.filePath(QStringLiteral("%1").arg(number, 6, 10, QLatin1Char('0'))));
  if (file.open(QIODevice::WriteOnly)) file.write(sessionTextOf(workspace).toUtf8());
}

/// What noteState() wrote: those of a folder that are whole, in the order of their numbers.
inline QStringList notedStates(const QDir& folder) {
  QStringList notes;
  for (const QString& name : folder.entryList(QDir::Files, QDir::Name)) {
    const QByteArray text = contentsOf(folder.filePath(name));
    if (text.endsWith("}\n")) notes.append(QString::fromUtf8(text));
  }
  return notes;
}

/// Waits while a window that notes its states goes on, until what it keeps is at least as new as the states
/// that were noted at first; how many those were, 0 where nothing is kept any more. A keeping that waits for
/// the end of a drag does not come to this.
inline qsizetype statesKeptOnTheWay(const QDir& notes) {
  const qsizetype noted = notedStates(notes).size();
  // Of three writings the first may be under way, the second have begun in the moment of the count.
  return isKeptAgain(3) ? noted : 0;
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
