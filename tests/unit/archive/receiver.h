#pragma once

#include <signal.h>
#include <sys/resource.h>

#include <QTcpSocket>
#include <QTemporaryDir>
#include <memory>
#include <optional>

#include "tests/unit/archive/running_archive.h"

namespace volumen::tests {

/// Runs a program of DCMTK. Returns its exit status.
int statusOfPeer(const QString& program, const QStringList& arguments);

/// `volumen archive receive` while it runs.
class Receiver {
 public:
  /// `fields` are further ones of "listen". `mostBytes`: largest file that it may write, if not 0.
  explicit Receiver(const QByteArray& fields = {}, rlim_t mostBytes = 0);

  /// Starts it with a folder or an index and waits until it listens.
  bool start(const QStringList& more = {});
  int port() const { return port_; }
  QString output() const { return folder_.filePath(QStringLiteral("received")); }
  /// Returns all that is in its folder, also what is not complete.
  QStringList files() const;
  /// Sends files by storescu.
  int send(const QStringList& files, const QStringList& options = {}) const {
    return statusOfPeer(QStringLiteral("storescu"), options + address() + files);
  }
  int echo(const QStringList& options = {}) const {
    return statusOfPeer(QStringLiteral("echoscu"), options + address());
  }
  /// Returns the arguments of DCMTK's programs that name it.
  QStringList address() const;
  /// Returns a connection over which bytes were sent.
  std::unique_ptr<QTcpSocket> connection(const QByteArray& bytes) const;
  /// Ends it by Ctrl-C. Returns its output; empty if it ends in another way.
  QByteArray interrupted() { return program_->endsBy(SIGINT) ? program_->outcome().out : QByteArray(); }
  /// Ends it at once. Returns whether it did.
  bool killed() { return program_->endsBy(SIGKILL); }

 private:
  QTemporaryDir folder_;
  std::optional<RunningArchive> program_;
  const int port_;
  const rlim_t mostBytes_;
};

/// Writes an image, without a UID where that is empty. Returns its path.
QString writeImage(const QString& path, const char* study, const char* instance,
                   const char* patient = "DOE^JANE", int side = 4);

}  // namespace volumen::tests
