#include "io/walk.h"

#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <set>

#include "io/files/aside.h"

namespace volumen {
namespace {

// Files and folders seen so far; several links count as one.
class Visited {
 public:
  bool firstTime(const struct stat& s) { return seen_.emplace(s.st_dev, s.st_ino).second; }

 private:
  std::set<std::pair<dev_t, ino_t>> seen_;
};

// Returns the kind of an entry that is neither a file nor a folder.
const char* kindOf(const struct stat& s) {
  if (S_ISFIFO(s.st_mode)) return "a pipe";
  return S_ISSOCK(s.st_mode) ? "a socket" : "a device";
}

// Returns the entries of a folder, sorted by name, without files that this program has not completed.
std::vector<std::string> entries(const std::string& folder, std::error_code& error) {
  std::vector<std::string> paths;
  std::filesystem::directory_iterator it(folder, error);
  for (const std::filesystem::directory_iterator end; !error && it != end; it.increment(error))
    if (!isAsideName(it->path().filename().string())) paths.push_back(it->path().string());
  std::sort(paths.begin(), paths.end());
  return paths;
}

// Returns the reason why stat() of an entry failed.
std::string reasonOf(const std::string& path, int error) {
  std::error_code none;
  const bool isLink = std::filesystem::is_symlink(path, none);
  return isLink && error == ENOENT ? "it is a link to what is not there" : std::strerror(error);
}

// True if `path` is a link out of `root`, which is canonical; `links` selects the links that count.
bool leadsOut(const std::string& path, const std::filesystem::path& root, Links links) {
  std::error_code error;
  if (!std::filesystem::is_symlink(path, error)) return false;
  if (links == Links::files && !std::filesystem::is_directory(path, error)) return false;
  const std::filesystem::path target = std::filesystem::canonical(path, error);
  return error || std::mismatch(root.begin(), root.end(), target.begin(), target.end()).first != root.end();
}

}  // namespace

Result<FoundFiles> findFiles(const std::string& path, const CancelToken& cancel, Links links) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0)
    return Error{"Cannot open " + path + ": " +
                 (errno == ENOENT ? "no such file or folder" : std::strerror(errno)) + "."};
  if (!S_ISREG(status.st_mode) && !S_ISDIR(status.st_mode))
    return Error{path + " is " + kindOf(status) + ": name a file or a folder."};
  FoundFiles found;
  Visited visited;
  std::error_code unknown;
  const std::filesystem::path root = std::filesystem::canonical(path, unknown);
  std::vector<std::string> open{path};  // a stack, filled in reverse so that names stay in order
  while (!open.empty() && !cancel.cancelled()) {
    const std::string at = std::move(open.back());
    open.pop_back();
    if (at != path && leadsOut(at, root, links)) {
      const bool elsewhere = ::stat(at.c_str(), &status) == 0 && S_ISDIR(status.st_mode);
      found.unreadable.push_back({at, "it is a link out of the folder and is not followed", elsewhere});
    } else if (::stat(at.c_str(), &status) != 0) {
      found.unreadable.push_back({at, reasonOf(at, errno)});
    } else if (S_ISREG(status.st_mode)) {
      if (visited.firstTime(status)) found.files.push_back(at);
    } else if (S_ISDIR(status.st_mode) && visited.firstTime(status)) {
      std::error_code error;
      const std::vector<std::string> inside = entries(at, error);
      if (error) found.unreadable.push_back({at, error.message()});
      open.insert(open.end(), inside.rbegin(), inside.rend());
    } else if (!S_ISDIR(status.st_mode)) {
      found.unreadable.push_back({at, std::string("it is ") + kindOf(status)});
    }
  }
  return found;
}

std::vector<std::string> filesDirectlyIn(const std::vector<std::string>& folders) {
  std::vector<std::string> files;
  Visited visited;
  struct stat status {};
  std::error_code unreadable;
  for (const std::string& folder : folders)
    for (const std::string& path : entries(folder, unreadable))
      if (::stat(path.c_str(), &status) == 0 && S_ISREG(status.st_mode) && visited.firstTime(status))
        files.push_back(path);
  return files;
}

}  // namespace volumen
