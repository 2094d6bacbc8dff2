#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace volumen::worker {

/// A file descriptor that is closed.
class Descriptor {
 public:
  Descriptor() = default;
  explicit Descriptor(int fd) : fd_(fd) {}
  Descriptor(Descriptor&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(fd_, other.fd_);
    return *this;
  }
  ~Descriptor();
  int get() const { return fd_; }
  int release() { return std::exchange(fd_, -1); }
  explicit operator bool() const { return fd_ >= 0; }

 private:
  int fd_ = -1;
};

/// What a message is about, and what its two numbers and its text mean.
enum class Topic : std::uint32_t {
  fork,   ///< to the zygote, with a socket and a buffer; 1: prepared for all; answer: process id
  end,    ///< to the zygote: process id, and for how many ms it may end by itself; answer when it is reaped:
          ///< its status as wait() gives it, and 1 where it ended by itself
  ready,  ///< from a worker or the zygote: it waits for its first order
  run,    ///< to a worker: address of what is to be run, size of the request; text: the request, else with it
  more,   ///< to a worker: it may use one more slot
  opened,    ///< to a worker: the size of a file, with its descriptor; without one text says why not
  resolved,  ///< to a worker: 1 and a path, or 0 and why not
  piece,     ///< from a worker: bytes in the next slot; 1: the last
  open,      ///< from a worker: text is a path
  resolve    ///< from a worker: text is the path of a header, NUL, and the name that it refers to
};

/// What goes through a socket: whole, or not at all.
struct Message {
  Topic topic = Topic::fork;
  std::uint64_t first = 0, second = 0;
  std::string text;  ///< at most mostText bytes
  std::vector<Descriptor> files;
};

inline constexpr std::size_t mostText = 48 << 10, mostDescriptors = 33;

/// How a transfer ended.
enum class Transfer { done, later, broken };

/// Sends a message; its descriptors stay open here. `later`: the socket is full (only where `wait` is
/// false).
Transfer sendMessage(int socket, const Message& message, bool wait);

/// Receives a message. `later`: none is there (only where `wait` is false); `broken`: the other side is
/// gone, or what came is no message.
Transfer receiveMessage(int socket, Message& message, bool wait);

}  // namespace volumen::worker
