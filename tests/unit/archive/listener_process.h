#pragma once

#include <QJsonArray>
#include <QProcess>
#include <QTcpSocket>
#include <QTemporaryDir>
#include <memory>
#include <optional>

namespace volumen::tests {

/// `volumen archive receive` while it runs, and its peers.
class ListenerProcess {
 public:
  /// `fields` are further ones of "listen": R"(, "ae": "X")".
  explicit ListenerProcess(const QByteArray& fields = {});
  ~ListenerProcess();

  /// Starts it and waits until it listens. It receives into output(), or into index().
  bool start(bool intoIndex = false);
  /// Ends it at once, as a crash or the system's lack of memory would (SIGKILL).
  void kill();
  /// Ends it by Ctrl-C. Returns its output; nothing if it ends in another way.
  std::optional<QByteArray> interrupted();

  int port() const { return port_; }
  QString output() const { return in("received"); }
  QString index() const { return in("index"); }
  /// Returns the files that it received into output(), complete or not.
  QStringList files() const;
  /// Returns the studies in index().
  QJsonArray studies() const;

  /// Runs a program of DCMTK against it. Returns its exit status; -1 if it does not end by itself.
  int statusOf(const QString& program, const QStringList& options = {}, const QStringList& files = {},
               const QString& host = QStringLiteral("127.0.0.1")) const;
  int send(const QStringList& files) const { return statusOf(QStringLiteral("storescu"), {}, files); }
  int echo() const { return statusOf(QStringLiteral("echoscu")); }
  /// Returns a connection over which these bytes were sent.
  std::unique_ptr<QTcpSocket> connection(const QByteArray& bytes = {}) const;

  /// Writes an image into a folder of the test. Returns its path.
  QString writeImage(const char* study, const char* instance) const;

 private:
  QString in(const char* name) const { return folder_.filePath(QLatin1String(name)); }

  QTemporaryDir folder_;
  QProcess process_;
  const int port_;
};

/// Waits until a peer has closed a connection. Returns whether it does so within some seconds.
bool isClosed(QTcpSocket& socket);

}  // namespace volumen::tests
