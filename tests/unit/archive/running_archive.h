#pragma once

#include <QProcess>
#include <QStringList>

#include "tests/fixtures/program.h"

namespace volumen::tests {

/// `volumen archive` while it runs.
class RunningArchive {
 public:
  /// `before` runs in its process before it begins, and may only call the system.
  explicit RunningArchive(const QStringList& words, const std::function<void()>& before = {});
  ~RunningArchive();

  /// Waits until it writes these words to stderr. Returns whether it does before it ends.
  bool says(const QByteArray& words);
  /// Sends a signal and waits for the end. Returns whether that was by this signal.
  bool endsBy(int signal);
  /// Waits for its end. Returns the exit status (-1: none) and what it wrote.
  Outcome outcome();

 private:
  bool hasEnded();

  QProcess process_;
  QByteArray err_;
};

}  // namespace volumen::tests
