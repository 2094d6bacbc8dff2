#include "tests/unit/archive/peer_process.h"

#include <QElapsedTimer>
#include <QFile>
#include <QStandardPaths>
#include <QTcpServer>

namespace volumen::tests {

namespace {

constexpr const char* configuration = R"(NetworkType     = "tcp"
NetworkTCPPort  = %1
MaxPDUSize      = 131072
MaxAssociations = 16
HostTable BEGIN
me = (VOLUMEN, 127.0.0.1, %3)
HostTable END
VendorTable BEGIN
VendorTable END
AETable BEGIN
ARCH  %2  RW (200, 1024mb)  ANY
AETable END
)";

}  // namespace

bool listensAt(int port) {
  QElapsedTimer since;
  for (since.start(); since.elapsed() < 10000;) {
    QTcpSocket socket;
    socket.connectToHost(QStringLiteral("127.0.0.1"), quint16(port));
    if (socket.waitForConnected(200)) return true;
  }
  return false;
}

int freePort() {
  QTcpServer server;
  server.listen(QHostAddress::LocalHost);
  return server.serverPort();
}

bool QrPeer::isInstalled() { return !QStandardPaths::findExecutable(QStringLiteral("dcmqrscp")).isEmpty(); }

QrPeer::QrPeer() : port_(freePort()), ourPort_(freePort()) {}

QrPeer::~QrPeer() {
  process_.kill();
  process_.waitForFinished();
}

void QrPeer::add(const QStringList& files) {
  QProcess::execute(QStringLiteral("dcmqridx"), QStringList{folder_.path()} + files);
}

bool QrPeer::start(const QStringList& options) {
  const QString path = folder_.filePath(QStringLiteral("qr.cfg"));
  QFile file(path);
  if (!file.open(QIODevice::WriteOnly)) return false;
  file.write(QString::fromLatin1(configuration).arg(port_).arg(folder_.path()).arg(ourPort_).toUtf8());
  file.close();
  // Its warnings would fill a pipe that nobody reads.
  process_.setStandardOutputFile(QProcess::nullDevice());
  process_.setStandardErrorFile(QProcess::nullDevice());
  process_.start(QStringLiteral("dcmqrscp"),
                 QStringList{QStringLiteral("-c"), path, QStringLiteral("+xt")} + options);
  return listensAt(port_);
}

StorePeer::StorePeer(const QStringList& options) : port_(freePort()) {
  process_.setStandardOutputFile(QProcess::nullDevice());
  process_.setStandardErrorFile(QProcess::nullDevice());
  process_.start(QStringLiteral("storescp"),
                 options + QStringList{QStringLiteral("-od"), folder_.path(), QString::number(port_)});
  isListening = listensAt(port_);
}

StorePeer::~StorePeer() {
  process_.kill();
  process_.waitForFinished();
}

FakePeer::FakePeer(std::function<void(QTcpSocket&)> answer) : answer_(std::move(answer)), port_(freePort()) {
  start();
  while (!listening_) msleep(1);
}

FakePeer::~FakePeer() {
  requestInterruption();
  wait();
}

void FakePeer::run() {
  QTcpServer server;
  server.listen(QHostAddress::LocalHost, quint16(port_));
  listening_ = true;
  while (!isInterruptionRequested())
    if (server.hasPendingConnections() || server.waitForNewConnection(20))
      answer_(*server.nextPendingConnection());
}

}  // namespace volumen::tests
