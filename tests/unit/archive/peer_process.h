#pragma once

#include <QProcess>
#include <QTcpSocket>
#include <QTemporaryDir>
#include <QThread>
#include <atomic>
#include <functional>

namespace volumen::tests {

/// Returns a port of this machine that is free.
int freePort();

/// Waits a few seconds until something listens at a port of this machine. Returns whether it does.
bool listensAt(int port);

/// An archive on this machine: DCMTK's dcmqrscp with the files that were added. Its AE title is ARCH.
class QrPeer {
 public:
  /// Returns whether its programs are installed.
  static bool isInstalled();
  QrPeer();
  ~QrPeer();

  void add(const QStringList& files);
  /// Starts it with more options. Returns whether it listens within a few seconds.
  bool start(const QStringList& options = {});
  int port() const { return port_; }
  /// Returns the port of this machine to which it sends for the AE title VOLUMEN.
  int ourPort() const { return ourPort_; }

 private:
  QTemporaryDir folder_;
  QProcess process_;
  const int port_, ourPort_;
};

/// A peer on this machine that stores what it gets: DCMTK's storescp, with options of it.
class StorePeer {
 public:
  explicit StorePeer(const QStringList& options = {});
  ~StorePeer();
  int port() const { return port_; }
  QString folder() const { return folder_.path(); }

  bool isListening = false;

 private:
  QTemporaryDir folder_;
  QProcess process_;
  const int port_;
};

/// A peer that is no archive: `answer` gets each connection, one after the other.
class FakePeer : public QThread {
 public:
  explicit FakePeer(std::function<void(QTcpSocket&)> answer);
  ~FakePeer() override;
  int port() const { return port_; }

 protected:
  void run() override;

 private:
  const std::function<void(QTcpSocket&)> answer_;
  const int port_;
  std::atomic<bool> listening_{false};
};

}  // namespace volumen::tests
