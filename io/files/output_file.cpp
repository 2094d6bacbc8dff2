#include "io/files/output_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>

#include "io/files/aside.h"

namespace volumen {

struct OutputFile::State {
  std::string path;
  std::string target;  // file to replace, after all links
  std::string aside;   // temporary file; empty: there is none
  int fd = -1;
  bool gzip = false;
  z_stream stream{};
  std::array<Bytef, 1 << 16> packed{};

  explicit State(const std::string& name) : path(name), target(endOfLinks(name)) {}
  ~State() {
    if (gzip) deflateEnd(&stream);
    if (fd >= 0) ::close(fd);
    if (!aside.empty()) ::unlink(aside.c_str());
  }
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  // Returns false and sets errno if not all bytes were written.
  bool put(const void* bytes, std::size_t count) const {
    const auto* next = static_cast<const char*>(bytes);
    while (count > 0) {
      const ssize_t n = ::write(fd, next, count);
      if (n < 0 && errno == EINTR) continue;
      if (n < 0) return false;
      next += n, count -= std::size_t(n);
    }
    return true;
  }
};

OutputFile::OutputFile(std::unique_ptr<State> state) : state_(std::move(state)) {}
OutputFile::OutputFile(OutputFile&&) noexcept = default;
OutputFile::~OutputFile() = default;

Status OutputFile::fail(const std::string& why) const {
  return Error{"Cannot write " + state_->path + ": " + why + "."};
}

namespace {

// Returns the reason why an existing file cannot be replaced; empty if it can.
std::string obstacle(const std::string& target) {
  struct stat there {};
  if (::lstat(target.c_str(), &there) != 0) return {};
  if (S_ISLNK(there.st_mode)) return "its links lead in a circle";
  if (S_ISDIR(there.st_mode)) return "it is a folder";
  if (!S_ISREG(there.st_mode)) return "it is a pipe or a device, and only files are written";
  return ::access(target.c_str(), W_OK) == 0 ? "" : "no permission to write there";
}

// Returns the reason why no file can be created in a folder.
std::string whyNotMade(int error) {
  if (error == ENOENT || error == ENOTDIR) return "no such folder";
  if (error == EACCES || error == EPERM) return "no permission to write there";
  return std::strerror(error);
}

// Some disks report only at this point that they are full; some cannot report it.
bool isOnDisk(int fd) { return ::fdatasync(fd) == 0 || errno == EINVAL || errno == EROFS || errno == ENOSYS; }

// Renames a file to a name that nothing has. Returns false and sets errno otherwise.
bool renameAsNew(const char* from, const char* to) {
  if (::renameat2(AT_FDCWD, from, AT_FDCWD, to, RENAME_NOREPLACE) == 0) return true;
  // Not all file systems know the flag.
  return (errno == EINVAL || errno == ENOSYS) && ::link(from, to) == 0 && ::unlink(from) == 0;
}

// Returns the permissions of the replaced file, or those of a new one.
mode_t rightsFor(const std::string& target) {
  struct stat there {};
  if (::stat(target.c_str(), &there) == 0) return there.st_mode & 0777;
  return 0666 & ~rightsKept();
}

}  // namespace

Result<OutputFile> OutputFile::create(const std::string& path) {
  OutputFile out(std::make_unique<State>(path));
  State& s = *out.state_;
  if (const std::string why = obstacle(s.target); !why.empty()) return out.fail(why).error();
  const std::size_t name = s.target.find_last_of('/') + 1;
  sweepAside(s.target.substr(0, name));
  s.aside = s.target.substr(0, name) + asideName;
  s.fd = ::mkostemp(s.aside.data(), O_CLOEXEC);
  if (s.fd < 0) {
    const int error = errno;
    s.aside.clear();
    return out.fail(whyNotMade(error)).error();
  }
  if (!claimAside(s.fd)) return create(path);
  ::fchmod(s.fd, rightsFor(s.target));
  return out;
}

const std::string& OutputFile::asidePath() const { return state_->aside; }

Status OutputFile::startGzip() {
  // level 4: almost the size of level 6 at twice its speed
  constexpr int level = 4, gzipWindow = 15 + 16, memory = 8;
  z_stream& stream = state_->stream;
  if (deflateInit2(&stream, level, Z_DEFLATED, gzipWindow, memory, Z_DEFAULT_STRATEGY) != Z_OK)
    return fail("not enough memory to compress");
  state_->gzip = true;
  return {};
}

// Compresses the stream's input and writes the output.
Status OutputFile::deflateAll(int flush) {
  z_stream& stream = state_->stream;
  int code = Z_OK;
  do {
    stream.next_out = state_->packed.data();
    stream.avail_out = uInt(state_->packed.size());
    code = deflate(&stream, flush);
    if (!state_->put(state_->packed.data(), state_->packed.size() - stream.avail_out))
      return fail(std::strerror(errno));
  } while (stream.avail_out == 0 || (flush == Z_FINISH && code == Z_OK));
  return {};
}

Status OutputFile::write(const void* bytes, std::size_t count) {
  if (!state_->gzip) return state_->put(bytes, count) ? Status() : fail(std::strerror(errno));
  const auto* next = static_cast<const Bytef*>(bytes);
  while (count > 0) {
    constexpr std::size_t most = 1u << 30;  // zlib counts in unsigned int
    const std::size_t part = std::min(count, most);
    state_->stream.next_in = const_cast<Bytef*>(next);  // zlib only reads it
    state_->stream.avail_in = uInt(part);
    if (Status s = deflateAll(Z_NO_FLUSH); !s) return s;
    next += part;
    count -= part;
  }
  return {};
}

Status OutputFile::complete() {
  if (state_->gzip)
    if (Status s = deflateAll(Z_FINISH); !s) return s;
  return isOnDisk(state_->fd) ? Status() : fail(std::strerror(errno));
}

Status OutputFile::commit() {
  if (Status s = complete(); !s) return s;
  if (::rename(state_->aside.c_str(), state_->target.c_str()) != 0) return fail(std::strerror(errno));
  state_->aside.clear();
  return {};
}

Result<bool> OutputFile::commitAsNew(const std::string& path) {
  state_->path = state_->target = path;
  struct stat there {};
  if (::lstat(path.c_str(), &there) == 0) return false;
  if (Status s = complete(); !s) return s.error();
  if (!renameAsNew(state_->aside.c_str(), path.c_str()))
    return errno == EEXIST ? Result<bool>(false) : fail(std::strerror(errno)).error();
  state_->aside.clear();
  return true;
}

Status writeWholeFile(const std::string& path, std::string_view bytes) {
  auto file = OutputFile::create(path);
  if (!file) return file.error();
  if (Status s = file->write(bytes); !s) return s;
  return file->commit();
}

}  // namespace volumen
