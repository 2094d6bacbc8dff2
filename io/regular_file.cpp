#include "io/regular_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "io/worker/serve.h"

namespace volumen {

namespace {

bool isFull(int error) { return error == EMFILE || error == ENFILE; }

// Retries for a while, as other threads may close their files.
int openWhenThereIsRoom(const std::string& path) {
  constexpr int patienceMs = 2000, lookMs = 5;
  int fd = -1;
  for (int ms = 0; ms < patienceMs; ms += lookMs) {
    fd = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY);
    if (fd >= 0 || !isFull(errno)) break;
    ::usleep(1000 * lookMs);
  }
  return fd;
}

}  // namespace

Result<RegularFile> RegularFile::open(const std::string& path) {
  if (worker::inside()) {
    Result<worker::OpenedFile> opened = worker::openInside(path);
    if (!opened) return opened.error();
    return RegularFile(opened->file.release(), opened->size);
  }
  const int fd = openWhenThereIsRoom(path);
  if (fd < 0 && isFull(errno)) return Error{tooManyOpen};
  if (fd < 0) return Error{errno == ENOENT ? "no such file" : std::strerror(errno)};
  RegularFile file(fd, 0);
  struct stat status {};
  if (::fstat(fd, &status) != 0) return Error{std::strerror(errno)};
  if (S_ISDIR(status.st_mode)) return Error{"it is a folder"};
  if (!S_ISREG(status.st_mode)) return Error{"not a regular file"};
  file.size_ = std::uint64_t(status.st_size);
  return file;
}

RegularFile::~RegularFile() {
  if (fd_ >= 0) ::close(fd_);
}

Result<std::size_t> RegularFile::readAt(std::uint64_t offset, void* to, std::size_t count) const {
  std::size_t done = 0;
  while (done < count) {
    const ssize_t n = ::pread(fd_, static_cast<char*>(to) + done, count - done, off_t(offset + done));
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return Error{std::strerror(errno)};
    if (n == 0) break;
    done += std::size_t(n);
  }
  return done;
}

Status RegularFile::readAll(std::uint64_t offset, std::span<std::uint8_t> out) const {
  const Result<std::size_t> got = readAt(offset, out.data(), out.size());
  if (!got) return got.error();
  if (*got < out.size()) return Error{"the file became shorter while it was read"};
  return {};
}

Result<std::vector<std::uint8_t>> RegularFile::read(std::uint64_t offset, std::uint64_t length) const {
  if (offset > size_ || length > size_ - offset) return Error{"the file is cut off"};
  std::vector<std::uint8_t> bytes(length);
  if (Status s = readAll(offset, bytes); !s) return s.error();
  return bytes;
}

Status RegularFile::readUpTo(std::vector<std::uint8_t>& bytes, std::uint64_t length) const {
  const std::size_t have = bytes.size();
  if (have >= std::min(length, size_)) return {};
  bytes.resize(std::min(length, size_));
  return readAll(have, std::span(bytes).subspan(have));
}

Result<std::string> wholeText(const std::string& path, std::uint64_t mostBytes, const char* what) {
  const auto file = RegularFile::open(path);
  if (!file) return Error{path + " cannot be read: " + file.message() + "."};
  if (file->size() > mostBytes) return Error{path + " is too large for " + what + "."};
  const auto bytes = file->read(0, file->size());
  if (!bytes) return Error{path + " cannot be read: " + bytes.message() + "."};
  return std::string(bytes->begin(), bytes->end());
}

std::string fileName(const std::string& path) { return path.substr(path.find_last_of('/') + 1); }

}  // namespace volumen
