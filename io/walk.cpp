#include "io/walk.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <set>

namespace volumen {
namespace {

/// Every file and folder once, whatever links lead to it.
class Visited {
 public:
  bool firstTime(const struct stat& s) { return seen_.emplace(s.st_dev, s.st_ino).second; }

 private:
  std::set<std::pair<dev_t, ino_t>> seen_;
};

/// The entries of a folder, sorted by name.
std::vector<std::string> entries(const std::string& folder, std::error_code& error) {
  std::vector<std::string> paths;
  std::filesystem::directory_iterator it(folder, error);
  for (const std::filesystem::directory_iterator end; !error && it != end; it.increment(error))
    paths.push_back(it->path().string());
  std::sort(paths.begin(), paths.end());
  return paths;
}

}  // namespace

Result<FoundFiles> findFiles(const std::string& path, const CancelToken& cancel) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0)
    return Error{"Cannot open " + path + ": " +
                 (errno == ENOENT ? "no such file or folder" : std::strerror(errno)) + "."};
  FoundFiles found;
  Visited visited;
  std::vector<std::string> open{path};  // last in, first out; filled in reverse so that names stay in order
  while (!open.empty() && !cancel.cancelled()) {
    const std::string at = std::move(open.back());
    open.pop_back();
    if (::stat(at.c_str(), &status) != 0) {
      found.unreadable.emplace_back(at, std::strerror(errno));
    } else if (S_ISREG(status.st_mode)) {
      if (visited.firstTime(status)) found.files.push_back(at);
    } else if (S_ISDIR(status.st_mode) && visited.firstTime(status)) {
      std::error_code error;
      const std::vector<std::string> inside = entries(at, error);
      if (error) found.unreadable.emplace_back(at, error.message());
      open.insert(open.end(), inside.rbegin(), inside.rend());
    }
  }
  return found;
}

Result<RegularFile> RegularFile::open(const std::string& path) {
  const int fd = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  if (fd < 0) return Error{std::strerror(errno)};
  RegularFile file(fd, 0);
  struct stat status {};
  if (::fstat(fd, &status) != 0) return Error{std::strerror(errno)};
  if (!S_ISREG(status.st_mode)) return Error{"not a regular file"};
  file.size_ = std::uint64_t(status.st_size);
  return file;
}

RegularFile::~RegularFile() {
  if (fd_ >= 0) ::close(fd_);
}

Status RegularFile::fill(std::uint64_t offset, std::span<std::uint8_t> out) const {
  std::size_t done = 0;
  while (done < out.size()) {
    const ssize_t n = ::pread(fd_, out.data() + done, out.size() - done, off_t(offset + done));
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return Error{std::strerror(errno)};
    if (n == 0) return Error{"the file became shorter while it was read"};
    done += std::size_t(n);
  }
  return {};
}

Result<std::vector<std::uint8_t>> RegularFile::read(std::uint64_t offset, std::uint64_t length) const {
  if (offset > size_ || length > size_ - offset) return Error{"the file is cut off"};
  std::vector<std::uint8_t> bytes(length);
  if (Status s = fill(offset, bytes); !s) return s.error();
  return bytes;
}

Status RegularFile::readUpTo(std::vector<std::uint8_t>& bytes, std::uint64_t length) const {
  const std::size_t have = bytes.size();
  if (have >= std::min(length, size_)) return {};
  bytes.resize(std::min(length, size_));
  return fill(have, std::span(bytes).subspan(have));
}

}  // namespace volumen
