#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace volumen::worker {

/// Owns a file descriptor and closes it.
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

/// The topic of a message, with the meaning of its two numbers and its text.
enum class Topic : std::uint32_t {
  /// Asks the zygote for a worker, with a socket and a buffer. First number: 1 if prepared for all.
  /// Answer: process id.
  fork,
  /// Asks the zygote to end a process: its id, and the ms in which it may end by itself. The answer comes
  /// once it is reaped: its status as wait() gives it, and 1 if it ended by itself.
  end,
  ready,  ///< a worker or the zygote waits for its first order
  /// Gives a worker a request: address of the handler, size of the request. Text: the request; a long one is
  /// the last file.
  run,
  more,      ///< tells a worker that it may use one more slot
  opened,    ///< gives a worker the size and descriptor of a file, or in text the reason why it has none
  resolved,  ///< gives a worker 1 and a path, or 0 and the reason
  piece,     ///< a worker's answer: number of bytes in the next slot; 1 if it is the last
  open,      ///< a worker asks for the file whose path is the text
  resolve    ///< a worker asks for a path: text is a header's path, NUL, and the name it refers to
};

/// A message that goes through a socket as a whole or not at all.
struct Message {
  Topic topic = Topic::fork;
  std::uint64_t first = 0, second = 0;
  std::string text;  ///< text of at most mostText bytes
  std::vector<Descriptor> files;
};

inline constexpr std::size_t mostText = 48 << 10, mostDescriptors = 33;

/// The outcome of a transfer.
enum class Transfer { done, later, broken };

/// Sends a message. Its descriptors stay open in this process. Returns `later` if the socket is full and
/// `wait` is false.
Transfer sendMessage(int socket, const Message& message, bool wait);

/// Receives a message. Returns `later` if no message is there and `wait` is false. Returns `broken` if the
/// other side is gone or sent something that is no message.
Transfer receiveMessage(int socket, Message& message, bool wait);

}  // namespace volumen::worker
