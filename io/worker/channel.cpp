#include "io/worker/channel.h"

#include <sys/socket.h>
#include <sys/uio.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace volumen::worker {
namespace {

struct Head {
  Topic topic;
  std::uint32_t textBytes;
  std::uint64_t first, second;
};

struct Control {
  alignas(cmsghdr) char bytes[CMSG_SPACE(mostDescriptors * sizeof(int))];
};

Transfer failed() { return errno == EAGAIN || errno == EWOULDBLOCK ? Transfer::later : Transfer::broken; }

void takeDescriptors(msghdr& m, std::vector<Descriptor>& files) {
  for (cmsghdr* c = CMSG_FIRSTHDR(&m); c; c = CMSG_NXTHDR(&m, c)) {
    if (c->cmsg_level != SOL_SOCKET || c->cmsg_type != SCM_RIGHTS) continue;
    for (std::size_t n = 0; n < (c->cmsg_len - CMSG_LEN(0)) / sizeof(int); ++n) {
      int fd = -1;
      std::memcpy(&fd, CMSG_DATA(c) + n * sizeof fd, sizeof fd);
      files.emplace_back(fd);
    }
  }
}

}  // namespace

Descriptor::~Descriptor() {
  if (fd_ >= 0) ::close(fd_);
}

Transfer sendMessage(int socket, const Message& message, bool wait) {
  Head head{message.topic, std::uint32_t(message.text.size()), message.first, message.second};
  iovec parts[] = {{&head, sizeof head}, {const_cast<char*>(message.text.data()), message.text.size()}};
  msghdr m{};
  m.msg_iov = parts;
  m.msg_iovlen = message.text.empty() ? 1 : 2;
  Control control;
  if (const std::size_t count = message.files.size(); count > 0) {
    m.msg_control = control.bytes;
    m.msg_controllen = CMSG_SPACE(count * sizeof(int));
    cmsghdr* c = CMSG_FIRSTHDR(&m);
    *c = {CMSG_LEN(count * sizeof(int)), SOL_SOCKET, SCM_RIGHTS};
    for (std::size_t n = 0; n < count; ++n) {
      const int fd = message.files[n].get();
      std::memcpy(CMSG_DATA(c) + n * sizeof fd, &fd, sizeof fd);
    }
  }
  ssize_t sent = 0;
  do sent = ::sendmsg(socket, &m, MSG_NOSIGNAL | (wait ? 0 : MSG_DONTWAIT));
  while (sent < 0 && errno == EINTR);
  return sent < 0 ? failed() : Transfer::done;
}

Transfer receiveMessage(int socket, Message& message, bool wait) {
  Head head{};
  message.files.clear();
  char text[mostText];
  iovec parts[] = {{&head, sizeof head}, {text, sizeof text}};
  Control control;
  msghdr m{};
  m.msg_iov = parts;
  m.msg_iovlen = 2;
  m.msg_control = control.bytes;
  m.msg_controllen = sizeof control.bytes;
  ssize_t got = 0;
  do got = ::recvmsg(socket, &m, MSG_CMSG_CLOEXEC | (wait ? 0 : MSG_DONTWAIT));
  while (got < 0 && errno == EINTR);
  if (got < 0) return failed();
  takeDescriptors(m, message.files);
  const bool whole = (m.msg_flags & (MSG_TRUNC | MSG_CTRUNC)) == 0;
  if (!whole || got != ssize_t(sizeof head + head.textBytes)) return Transfer::broken;
  message.topic = head.topic;
  message.first = head.first;
  message.second = head.second;
  message.text.assign(text, head.textBytes);
  return Transfer::done;
}

}  // namespace volumen::worker
