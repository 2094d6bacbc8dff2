#include "tests/unit/archive/running_archive.h"

#include <signal.h>

#include <QElapsedTimer>

namespace volumen::tests {

RunningArchive::RunningArchive(const QStringList& words, const std::function<void()>& before) {
  if (before) process_.setChildProcessModifier(before);
  process_.start(QStringLiteral(VOLUMEN_PROGRAM), QStringList{QStringLiteral("archive")} + words);
}

RunningArchive::~RunningArchive() {
  process_.kill();
  process_.waitForFinished();
}

bool RunningArchive::says(const QByteArray& words) {
  QElapsedTimer since;
  for (since.start(); !err_.contains(words) && since.elapsed() < 20000;) {
    if (!process_.waitForReadyRead(50) && process_.state() == QProcess::NotRunning) return false;
    err_ += process_.readAllStandardError();
  }
  return err_.contains(words);
}

bool RunningArchive::endsBy(int signal) {
  if (process_.waitForStarted()) ::kill(pid_t(process_.processId()), signal);
  return hasEnded() && process_.exitStatus() == QProcess::CrashExit && process_.exitCode() == signal;
}

Outcome RunningArchive::outcome() {
  const bool isExit = hasEnded() && process_.exitStatus() == QProcess::NormalExit;
  return {isExit ? process_.exitCode() : -1, process_.readAllStandardOutput(),
          err_ + process_.readAllStandardError()};
}

bool RunningArchive::hasEnded() {
  return process_.state() == QProcess::NotRunning || process_.waitForFinished(60000);
}

}  // namespace volumen::tests
