#include "io/archive/watched_transport.h"

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/time.h>

#include <QByteArray>
#include <QCryptographicHash>
#include <algorithm>
#include <cerrno>
#include <memory>
#include <vector>

namespace volumen {

namespace {

class WatchedConnection : public DcmTransportConnection {
 public:
  WatchedConnection(DcmNativeSocketType socket, std::unique_ptr<DcmTransportConnection> inner, Watch& watch)
      : DcmTransportConnection(socket), inner_(std::move(inner)), watch_(watch) {}

  ssize_t read(void* to, size_t count) override {
    if (!wait(POLLIN, watch_.silence)) return ended();
    const ssize_t some = inner_->read(to, count);
    if (some > 0 && std::uint64_t(some) > watch_.bytesLeft) {
      watch_.sentTooMuch = true;
      return ended();
    }
    if (some > 0) watch_.bytesLeft -= std::uint64_t(some);
    return some;
  }
  ssize_t write(void* from, size_t count) override {
    // DCMTK sets its own choice after connecting.
    const int yes = 1;
    if (!sent_) setsockopt(getSocket(), IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
    sent_ = true;
    return wait(POLLOUT, watch_.silence) ? inner_->write(from, count) : ended();
  }
  OFBool networkDataAvailable(int timeout) override {
    return wait(POLLIN, std::min(std::chrono::seconds(timeout), watch_.silence));
  }
  OFCondition clientSideHandshake() override {
    // OpenSSL reads the socket itself.
    const timeval limit{watch_.silence.count(), 0};
    setsockopt(getSocket(), SOL_SOCKET, SO_RCVTIMEO, &limit, sizeof limit);
    const auto begin = Watch::Clock::now();
    OFCondition done = inner_->clientSideHandshake();
    if (done.bad() && Watch::Clock::now() - begin >= watch_.silence) watch_.wasSilent = true;
    if (done.bad() || watch_.pin.empty()) return done;
    const QByteArray certificate = peerCertificateHash();
    if (certificate == QByteArray::fromHex(QByteArray::fromStdString(watch_.pin))) return done;
    watch_.otherCertificate = certificate.toHex().toStdString();
    return makeOFCondition(0, 1, OF_error, "another certificate than the pinned one");
  }
  OFCondition serverSideHandshake() override { return inner_->serverSideHandshake(); }
  OFCondition renegotiate(const char* suite) override { return inner_->renegotiate(suite); }
  void close() override { inner_->close(); }
  void closeTransportConnection() override { inner_->closeTransportConnection(); }
  unsigned long getPeerCertificateLength() override { return inner_->getPeerCertificateLength(); }
  unsigned long getPeerCertificate(void* to, unsigned long length) override {
    return inner_->getPeerCertificate(to, length);
  }
  OFBool isTransparentConnection() override { return inner_->isTransparentConnection(); }
  OFString& dumpConnectionParameters(OFString& text) override {
    return inner_->dumpConnectionParameters(text);
  }

 private:
  // Waits until the socket is ready. Returns false after `most`, or if the watch ends it.
  bool wait(short event, std::chrono::seconds most) {
    const auto start = Watch::Clock::now();
    const auto end = std::min(start + most, watch_.end);
    for (;;) {
      if (watch_.cancel.cancelled()) return false;
      // TLS may hold data that have left the socket.
      if (event == POLLIN && !inner_->isTransparentConnection() && inner_->networkDataAvailable(0))
        return true;
      pollfd ready{getSocket(), event, 0};
      const auto left =
          std::chrono::duration_cast<std::chrono::milliseconds>(end - Watch::Clock::now()).count();
      if (left <= 0) break;
      const int some = poll(&ready, 1, int(std::min<long long>(left, 50)));
      if (some > 0) return true;
      if (some < 0 && errno != EINTR) return false;
    }
    watch_.wasSilent = watch_.wasSilent || most == watch_.silence || Watch::Clock::now() >= watch_.end;
    return false;
  }

  static ssize_t ended() {
    errno = ECONNRESET;
    return -1;
  }

  // Returns the SHA-256 of the peer's certificate; empty if it has none.
  QByteArray peerCertificateHash() {
    std::vector<char> der(inner_->getPeerCertificateLength());
    if (der.empty() || inner_->getPeerCertificate(der.data(), der.size()) != der.size()) return {};
    return QCryptographicHash::hash(QByteArray(der.data(), qsizetype(der.size())),
                                    QCryptographicHash::Sha256);
  }

  const std::unique_ptr<DcmTransportConnection> inner_;
  Watch& watch_;
  bool sent_ = false;
};

}  // namespace

DcmTransportConnection* WatchedTransport::createConnection(DcmNativeSocketType socket, OFBool secure) {
  std::unique_ptr<DcmTransportConnection> inner(inner_.createConnection(socket, secure));
  return inner ? new WatchedConnection(socket, std::move(inner), watch_) : nullptr;
}

}  // namespace volumen
