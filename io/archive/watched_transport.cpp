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
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "io/archive/pdu_reader.h"

namespace volumen {

namespace {

constexpr int watchGlanceMs = 50;  // between looks at the watch

class WatchedConnection : public DcmTransportConnection {
 public:
  WatchedConnection(DcmNativeSocketType socket, std::unique_ptr<DcmTransportConnection> inner, Watch& watch)
      : DcmTransportConnection(socket), inner_(std::move(inner)), watch_(watch) {}

  ssize_t read(void* to, size_t count) override {
    const ssize_t some = isBroken_ ? -1 : pdus_.read(to, count);
    return some < 0 ? ended() : some;
  }
  ssize_t write(void* from, size_t count) override {
    // DCMTK sets its own choice after connecting.
    const int yes = 1;
    const bool isFirst = !std::exchange(sent_, true);
    if (isFirst) setsockopt(getSocket(), IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
    const ssize_t some = wait(POLLOUT, watch_.silence) ? inner_->write(from, count) : ended();
    if (!isFirst || some == ssize_t(count)) return some;
    // DCMTK would keep the memory of this PDU. The next read fails instead.
    isBroken_ = true;
    return ssize_t(count);
  }
  OFBool networkDataAvailable(int timeout) override {
    return pdus_.hasBytes() || wait(POLLIN, std::min(std::chrono::seconds(timeout), watch_.silence));
  }
  OFCondition clientSideHandshake() override {
    OFCondition done = handshake([this] { return inner_->clientSideHandshake(); });
    if (done.bad() || watch_.pin.empty()) return done;
    const QByteArray certificate = peerCertificateHash();
    if (certificate == QByteArray::fromHex(QByteArray::fromStdString(watch_.pin))) return done;
    watch_.otherCertificate = certificate.toHex().toStdString();
    return makeOFCondition(0, 1, OF_error, "another certificate than the pinned one");
  }
  OFCondition serverSideHandshake() override {
    return handshake([this] { return inner_->serverSideHandshake(); });
  }
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
      watch_.wasCancelled = watch_.cancel.cancelled();
      if (watch_.wasCancelled) return false;
      // TLS may hold data that have left the socket.
      if (event == POLLIN && !inner_->isTransparentConnection() && inner_->networkDataAvailable(0))
        return true;
      pollfd ready{getSocket(), event, 0};
      const auto left =
          std::chrono::duration_cast<std::chrono::milliseconds>(end - Watch::Clock::now()).count();
      if (left <= 0) break;
      const int some = poll(&ready, 1, int(std::min<long long>(left, watchGlanceMs)));
      if (some > 0) return true;
      if (some < 0 && errno != EINTR) return false;
    }
    watch_.wasSilent = watch_.wasSilent || most == watch_.silence || Watch::Clock::now() >= watch_.end;
    return false;
  }

  ssize_t receive(void* to, size_t count) {
    const int yes = 1;
    ssize_t some = -1;
    do {
      if (!wait(POLLIN, watch_.silence)) return ended();
      // Most peers wait with the last bytes of a message until what came before is acknowledged (Nagle's
      // algorithm). The system would do that after 40 ms, and returns to it after a few messages.
      setsockopt(getSocket(), IPPROTO_TCP, TCP_QUICKACK, &yes, sizeof yes);
      errno = 0;
      some = inner_->read(to, count);
    } while (some < 0 && errno == EAGAIN);  // a part of what TLS decrypts as one
    if (some > 0 && std::uint64_t(some) > watch_.bytesLeft) {
      watch_.sentTooMuch = true;
      return ended();
    }
    if (some > 0) watch_.bytesLeft -= std::uint64_t(some);
    return some;
  }

  // OpenSSL reads the socket itself: another thread closes it when the time for the handshake is over.
  OFCondition handshake(const std::function<OFCondition()>& shake) {
    if (inner_->isTransparentConnection()) return shake();
    std::mutex mutex;
    std::condition_variable_any ended;
    std::jthread guard([&, end = Watch::Clock::now() + watch_.silence](const std::stop_token& done) {
      std::unique_lock lock(mutex);
      while (!done.stop_requested()) {
        watch_.wasSilent = Watch::Clock::now() >= end;
        if (watch_.wasSilent || watch_.cancel.cancelled()) {
          ::shutdown(getSocket(), SHUT_RDWR);
          return;
        }
        ended.wait_for(lock, done, std::chrono::milliseconds(watchGlanceMs), [] { return false; });
      }
    });
    const OFCondition done = shake();
    guard.request_stop();
    guard.join();
    // From now on it waits no longer than we do.
    const timeval limit{0, watchGlanceMs * 1000};
    ::setsockopt(getSocket(), SOL_SOCKET, SO_RCVTIMEO, &limit, sizeof limit);
    return done;
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
  PduReader pdus_{[this](void* to, size_t count) { return receive(to, count); }};
  bool sent_ = false, isBroken_ = false;
};

}  // namespace

DcmTransportConnection* WatchedTransport::createConnection(DcmNativeSocketType socket, OFBool secure) {
  std::unique_ptr<DcmTransportConnection> inner(inner_.createConnection(socket, secure));
  return inner ? new WatchedConnection(socket, std::move(inner), watch_) : nullptr;
}

}  // namespace volumen
