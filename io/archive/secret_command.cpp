#include "io/archive/secret_command.h"

#include <signal.h>
#include <unistd.h>

#include <QElapsedTimer>
#include <QProcess>

namespace volumen {

Result<std::string> outputOf(const std::string& command, const CancelToken& cancel) {
  constexpr int mostMs = 30000, lookEveryMs = 20;
  constexpr qint64 mostBytes = 64 << 10;
  QProcess shell;
  shell.setProcessChannelMode(QProcess::ForwardedErrorChannel);
  shell.setStandardInputFile(QProcess::nullDevice());
  shell.setChildProcessModifier([] { ::setpgid(0, 0); });
  shell.start(QStringLiteral("/bin/sh"), {QStringLiteral("-c"), QString::fromStdString(command)});
  QElapsedTimer time;
  time.start();
  while (shell.state() != QProcess::NotRunning && !shell.waitForFinished(lookEveryMs)) {
    const bool isLate = time.elapsed() > mostMs || shell.bytesAvailable() > mostBytes;
    if (!isLate && !cancel.cancelled()) continue;
    ::kill(-pid_t(shell.processId()), SIGKILL);  // and what it started
    shell.waitForFinished();
    if (cancel.cancelled()) return Error{"was cancelled."};
    return Error{"does not end: it must print one line."};
  }
  if (shell.exitStatus() != QProcess::NormalExit || shell.exitCode() != 0)
    return Error{"fails with status " + std::to_string(shell.exitCode()) + "."};
  const QByteArray printed = shell.readAllStandardOutput().trimmed();
  if (printed.isEmpty() || printed.contains('\n')) return Error{"must print one line."};
  return printed.toStdString();
}

}  // namespace volumen
