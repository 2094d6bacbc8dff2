#include "io/archive/receive_archive.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmnet/dul.h>
#include <netdb.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <list>
#include <memory>
#include <mutex>
#include <new>
#include <string_view>
#include <system_error>
#include <thread>

#include "io/archive/incoming_association.h"
#include "io/archive/network_use.h"
#include "io/archive/tls_layer.h"
#include "io/files/private_folder.h"

namespace volumen {

namespace {

constexpr int mostWaiting = 64;  // connections besides open associations: each is ended after some seconds
constexpr int glanceMs = 50;     // between looks at `cancel`

// Returns why a port cannot be listened at.
Error cannotListen(const Listening& listening, int error) {
  const std::string port = "Port " + std::to_string(listening.port);
  if (error == EADDRINUSE)
    return {port + " of " + listening.address +
            " is in use: another program, or another volumen, listens there. End it, or choose another "
            "\"port\"."};
  if (error == EACCES)
    return {port + " needs rights that this program does not have: choose a \"port\" from 1024 on."};
  if (error == EADDRNOTAVAIL)
    return {listening.address +
            " is no address of this machine: correct \"address\" (0.0.0.0 or ::: all of its addresses)."};
  return {port + " of " + listening.address + " cannot be listened at: " + std::strerror(error) + "."};
}

// A peer that reaches an IPv6 socket by IPv4 has an address such as "::ffff:10.0.0.7".
std::string addressText(const sockaddr_storage& from, socklen_t size) {
  constexpr std::string_view mapped = "::ffff:";
  char text[NI_MAXHOST] = "";
  ::getnameinfo(reinterpret_cast<const sockaddr*>(&from), size, text, sizeof text, nullptr, 0,
                NI_NUMERICHOST);
  const std::string address = text;
  const bool isMapped = address.starts_with(mapped) && address.find('.') != std::string::npos;
  return isMapped ? address.substr(mapped.size()) : address;
}

class Listener {
 public:
  Listener(const Listening& listening, const std::string& folder, const ReceiveEvents& events,
           const CancelToken& cancel)
      : events_(events),
        reception_{listening, cancel, [this](const Received& one) { onStored(one); },
                   ReceivedFiles(folder, events.wants), nullptr} {}
  ~Listener() {
    if (socket_ >= 0) ::close(socket_);
  }
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;

  Status open() {
    const Listening& listening = reception_.listening;
    if (listening.tls) {
      auto layer = tlsLayer(*listening.tls, NET_ACCEPTOR);
      if (!layer) return layer.error();
      tls_ = std::move(*layer);
      reception_.tls = tls_.get();
    }
    addrinfo hints{}, *at = nullptr;
    hints.ai_flags = AI_NUMERICHOST | AI_NUMERICSERV | AI_PASSIVE;
    hints.ai_socktype = SOCK_STREAM;
    if (::getaddrinfo(listening.address.c_str(), std::to_string(listening.port).c_str(), &hints, &at) != 0)
      return cannotListen(listening, EADDRNOTAVAIL);
    const int yes = 1;
    socket_ = ::socket(at->ai_family, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    const bool isOpen =
        socket_ >= 0 && ::setsockopt(socket_, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes) == 0 &&
        ::bind(socket_, at->ai_addr, at->ai_addrlen) == 0 && ::listen(socket_, mostWaiting) == 0;
    const int error = errno;
    ::freeaddrinfo(at);
    return isOpen ? Status() : cannotListen(listening, error);
  }

  ReceiveReport run() {
    if (events_.onListening) events_.onListening();
    while (!reception_.cancel.cancelled()) {
      forgetEnded();
      const bool isFull = int(connections_.size()) >= reception_.listening.mostAssociations + mostWaiting;
      pollfd ready{isFull ? -1 : socket_, POLLIN, 0};
      if (::poll(&ready, 1, glanceMs) > 0) accept();
    }
    for (Connection& one : connections_) one.thread.join();
    return report_;
  }

 private:
  struct Connection {
    std::thread thread;
    std::atomic<bool> hasEnded{false};
  };

  // Each connection has a thread of its own from here on. DCMTK alone would read the peer's request in the
  // thread that accepts connections: a peer that says nothing would keep all others waiting.
  void accept() {
    sockaddr_storage from{};
    socklen_t size = sizeof from;
    const int socket = ::accept4(socket_, reinterpret_cast<sockaddr*>(&from), &size, SOCK_CLOEXEC);
    if (socket < 0) {
      // A lack of descriptors passes when connections end.
      if (errno == EMFILE || errno == ENFILE)
        std::this_thread::sleep_for(std::chrono::milliseconds(glanceMs));
      return;
    }
    const timeval limit{2, 0};  // for a peer that does not read our answers
    ::setsockopt(socket, SOL_SOCKET, SO_SNDTIMEO, &limit, sizeof limit);
    Connection& one = connections_.emplace_back();
    try {
      one.thread = std::thread([this, &one, socket, peer = addressText(from, size)] {
        serve(socket, peer);
        one.hasEnded = true;
      });
    } catch (const std::system_error&) {
      // The system starts no more threads: the peer sees a closed connection and may try again.
      connections_.pop_back();
      ::close(socket);
    }
  }

  void serve(int socket, const std::string& address) {
    try {
      if (const auto one = serveConnection(reception_, socket, address)) onEnded(*one);
    } catch (const std::bad_alloc&) {
      onEnded(
          {.callingAe = "A peer", .address = address, .problem = "was cut off: there is too little memory"});
    }
  }

  void forgetEnded() {
    connections_.remove_if([](Connection& one) {
      if (!one.hasEnded) return false;
      one.thread.join();
      return true;
    });
  }

  void onStored(const Received& one) {
    const std::scoped_lock telling(mutex_);
    if (events_.onStored) events_.onStored(one);
  }
  void onEnded(const ReceivedAssociation& one) {
    const std::scoped_lock telling(mutex_);
    ++report_.associations;
    report_.stored += one.stored, report_.alreadyHere += one.alreadyHere, report_.refused += one.refused;
    if (events_.onEnded) events_.onEnded(one);
  }

  const ReceiveEvents& events_;
  std::unique_ptr<DcmTLSTransportLayer> tls_;
  Reception reception_;
  int socket_ = -1;
  std::list<Connection> connections_;
  std::mutex mutex_;  // guards report_ and calls of events_
  ReceiveReport report_;
};

}  // namespace

Result<ReceiveReport> receiveInstances(const Listening& listening, const std::string& folder,
                                       const ReceiveEvents& events, const CancelToken& cancel) {
  const NetworkUse use;
  dcmDisableGethostbyaddr.set(OFTrue);  // a name server that is slow would keep all peers waiting
  if (Status s = makePrivateFolder(folder); !s) return s.error();
  Listener listener(listening, folder, events, cancel);
  if (Status s = listener.open(); !s) return s.error();
  return listener.run();
}

}  // namespace volumen
