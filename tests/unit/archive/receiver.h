#pragma once

#include <signal.h>
#include <sys/resource.h>

#include <QJsonArray>
#include <QTcpSocket>
#include <QTemporaryDir>
#include <memory>
#include <optional>

#include "tests/unit/archive/running_archive.h"

namespace volumen::tests {

/// `volumen archive receive` while it runs, and its peers.
class Receiver {
 public:
  /// `fields` are further ones of "listen": R"(, "ae": "X")". `mostBytes`: largest file that it may write, if
  /// not 0.
  explicit Receiver(const QByteArray& fields = {}, rlim_t mostBytes = 0);

  /// Start it and wait until it listens. It receives into output(), or into index().
  bool start(const QStringList& more = {});
  bool startIntoIndex();
  /// Ends it by Ctrl-C. Returns its output.
  QByteArray interrupted() { return endsBy(SIGINT) ? program_->outcome().out : "it ends in another way"; }
  /// Sends a signal. Returns whether it ends by that.
  bool endsBy(int signal) { return program_->endsBy(signal); }

  int port() const { return port_; }
  QString output() const { return folder_.filePath(QStringLiteral("received")); }
  QString index() const { return folder_.filePath(QStringLiteral("index")); }
  /// Returns the files that it received into output(), complete or not.
  QStringList files() const;
  /// Returns the studies in index().
  QJsonArray studies() const;

  /// Returns the arguments for a program of DCMTK that calls it; `options` may name another called AE title.
  QStringList call(const QStringList& options = {}) const;
  /// Run a program of DCMTK against it. Return its exit status; -1 if it does not end by itself.
  int send(const QStringList& files, const QStringList& options = {}) const;
  int echo(const QStringList& options = {}) const;
  /// Returns a connection over which these bytes were sent.
  std::unique_ptr<QTcpSocket> connection(const QByteArray& bytes = {}) const;

 private:
  bool startInto(const QString& option, const QString& folder, const QStringList& more);

  QTemporaryDir folder_;
  std::optional<RunningArchive> program_;
  const int port_;
  const rlim_t mostBytes_;
};

/// Waits until a peer has closed a connection. Returns whether it does so within some seconds.
bool isClosed(QTcpSocket& socket);

/// Writes an image, without a UID where that is empty. Returns its path.
QString writeImage(const QString& path, const char* study, const char* instance,
                   const char* patient = "DOE^JANE", int side = 4);

}  // namespace volumen::tests
