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

/// Returns the sessions kept by Autosave.
inline QStringList keptSessions() {
  return QDir(Autosave::folder()).entryList({QStringLiteral("*.volumen")}, QDir::Files, QDir::Name);
}

inline bool areKept(int count) {
  return QTest::qWaitFor([&] { return keptSessions().size() == count; }, longest);
}

/// Returns a workspace as a session file stores it, with segment labels as checksums.
inline QString sessionTextOf(const Workspace& workspace) {
  return QString::fromStdString(*sessionToJson(workspace, "/"));
}

/// Waits until the only kept session was written `times` more times.
inline bool isKeptAgain(int times) {
  const auto now = [] {
    const QStringList names = keptSessions();
    return names.size() == 1 ? contentsOf(QDir(Autosave::folder()).filePath(names[0])) : QByteArray();
  };
  for (int n = 0; n < times; ++n)
    if (!QTest::qWaitFor([&now, last = now()] { return now() != last; }, longest)) return false;
  return true;
}

/// Writes a workspace to a numbered file.
inline void noteState(const QDir& folder, int number, const Workspace& workspace) {
  QFile file(folder.filePath(QStringLiteral("%1").arg(number, 6, 10, QLatin1Char('0'))));
  if (file.open(QIODevice::WriteOnly)) file.write(sessionTextOf(workspace).toUtf8());
}

/// Returns the complete notes of noteState() in a folder, in ascending order.
inline QStringList notedStates(const QDir& folder) {
  QStringList notes;
  for (const QString& name : folder.entryList(QDir::Files, QDir::Name)) {
    const QByteArray text = contentsOf(folder.filePath(name));
    if (text.endsWith("}\n")) notes.append(QString::fromUtf8(text));
  }
  return notes;
}

/// Waits, while a window notes its states, until the kept session is at least as new as the first notes.
/// Returns the number of those notes, or 0 if nothing is kept any more. Autosaving that waits for the end of
/// a drag fails here.
inline qsizetype statesKeptOnTheWay(const QDir& notes) {
  const qsizetype noted = notedStates(notes).size();
  // The first of three writes may be under way, and the second may have begun during the count.
  return isKeptAgain(3) ? noted : 0;
}

/// Starts a program without a display, with the settings, caches and kept sessions of this one. Its output is
/// discarded or goes to the file `output`.
inline std::unique_ptr<QProcess> startedProgram(const QString& program, const QStringList& arguments,
                                                const QList<std::pair<QString, QString>>& more = {},
                                                const QString& output = QProcess::nullDevice()) {
  auto process = std::make_unique<QProcess>();
  QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
  environment.insert(QStringLiteral("QT_QPA_PLATFORM"), QStringLiteral("offscreen"));
  environment.remove(QStringLiteral("DISPLAY"));  // otherwise OpenGL is looked for there
  environment.insert(QStringLiteral("VOLUMEN_TEST_HOME"), qEnvironmentVariable("XDG_DATA_HOME"));
  for (const auto& [name, value] : more) environment.insert(name, value);
  process->setProcessEnvironment(environment);
  process->setProcessChannelMode(QProcess::ForwardedErrorChannel);
  process->setStandardOutputFile(output);
  process->start(program, arguments);
  return process;
}

/// Starts a function of a test class in this program again, like startedProgram().
inline std::unique_ptr<QProcess> startedTest(const char* test, const QString& function,
                                             QList<std::pair<QString, QString>> more,
                                             const QString& output = QProcess::nullDevice()) {
  more.append({QStringLiteral("VOLUMEN_ONLY"), QLatin1String(test)});
  return startedProgram(QCoreApplication::applicationFilePath(), {function}, more, output);
}

inline void killProgram(QProcess& process) {
  process.kill();
  process.waitForFinished();
}

}  // namespace volumen::tests
