#include "io/files/data_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <system_error>

namespace volumen {

namespace fs = std::filesystem;

Result<DataFile> DataFile::open(const std::string& path) {
  // O_NONBLOCK: opening a pipe nobody writes to must not wait.
  const int fd = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY);
  if (fd < 0) return Error{path + " cannot be opened: " + std::generic_category().message(errno) + "."};
  std::shared_ptr<const int> descriptor(new int(fd), [](const int* p) {
    ::close(*p);
    delete p;
  });
  struct stat facts {};
  if (::fstat(fd, &facts) != 0)
    return Error{path + " cannot be opened: " + std::generic_category().message(errno) + "."};
  if (!S_ISREG(facts.st_mode)) return Error{path + " is not a regular file."};
  return DataFile(std::move(descriptor), std::uint64_t(facts.st_size), path);
}

Result<std::size_t> DataFile::readAt(std::uint64_t offset, void* to, std::size_t count) const {
  std::size_t done = 0;
  while (done < count) {
    const ssize_t n =
        ::pread(*descriptor_, static_cast<char*>(to) + done, count - done, off_t(offset + done));
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return Error{path_ + " cannot be read: " + std::generic_category().message(errno) + "."};
    if (n == 0) break;
    done += std::size_t(n);
  }
  return done;
}

Result<std::string> readHead(const std::string& path, std::size_t count) {
  auto file = DataFile::open(path);
  if (!file) return file.error();
  std::string head(std::min<std::uint64_t>(count, file->size()), '\0');
  auto got = file->readAt(0, head.data(), head.size());
  if (!got) return got.error();
  head.resize(*got);
  return head;
}

Result<std::string> resolveBeside(const std::string& headerPath, const std::string& name) {
  const std::string refers = headerPath + " refers to the data file '" + name.substr(0, 200) + "'";
  const Error outside{refers + "; only files in or below its own folder are read."};
  const fs::path relative(name);
  if (name.empty() || name.find('\0') != std::string::npos || relative.is_absolute()) return outside;
  std::error_code e;
  const fs::path folder = fs::canonical(fs::absolute(fs::path(headerPath), e).parent_path(), e);
  if (e) return Error{headerPath + " cannot be opened: " + e.message() + "."};
  const fs::path whole = fs::weakly_canonical(folder / relative, e);
  if (e) return Error{refers + ": " + e.message() + "."};
  const auto end = std::mismatch(folder.begin(), folder.end(), whole.begin(), whole.end());
  if (end.first != folder.end()) return outside;
  if (!fs::exists(whole, e)) return Error{refers + ", which is not there."};
  if (!fs::is_regular_file(whole, e)) return Error{refers + ", which is not a regular file."};
  return whole.string();
}

}  // namespace volumen
