#include "io/zip_archive.h"

#include <sys/stat.h>

#include <climits>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <mutex>
#include <optional>

#include "io/files/lock_file.h"
#include "io/regular_file.h"
#include "io/zip_entries.h"

namespace volumen {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t mostBytes = std::uint64_t(16) << 30, alwaysBytes = 16 << 20, mostRatio = 200;
constexpr std::size_t mostFiles = 100'000, mostDepth = 64, mostNameBytes = 255;
constexpr std::size_t leastEntryBytes = 46;  // smallest entry of the central directory
constexpr const char* lockName = "lock";

// A folder for the files of one archive, with a lock that marks it as in use.
class PrivateFolder {
 public:
  static std::optional<PrivateFolder> make(const std::string& base) {
    std::error_code error;
    fs::create_directories(base, error);
    std::string name = base + "/XXXXXX";
    if (error || !mkdtemp(name.data())) return {};
    auto lock = LockFile::take(name + "/" + lockName);
    if (!lock) return {};
    return PrivateFolder(name, std::move(*lock));
  }
  PrivateFolder(PrivateFolder&& other) noexcept
      : path_(std::exchange(other.path_, {})), lock_(std::move(other.lock_)) {}
  PrivateFolder& operator=(PrivateFolder&&) = delete;
  ~PrivateFolder() {
    std::error_code error;
    if (!path_.empty()) fs::remove_all(path_, error);
  }
  std::string files() const { return path_ + "/files"; }

 private:
  PrivateFolder(std::string path, LockFile lock) : path_(std::move(path)), lock_(std::move(lock)) {}
  std::string path_;
  LockFile lock_;
};

// Removes unlocked folders, left by programs that crashed.
void removeLeftovers(const std::string& base) {
  std::error_code error;
  for (fs::directory_iterator it(base, error), end; !error && it != end; it.increment(error)) {
    if (!it->is_directory(error) || it->is_symlink(error)) continue;
    if (const auto lock = LockFile::take(it->path().string() + "/" + lockName))
      fs::remove_all(it->path(), error);
  }
}

// Returns the path of an entry below `root`; empty if its name leads out of it or is invalid.
std::optional<fs::path> placeOf(const std::string& name, const fs::path& root) {
  if (name.empty() || name[0] == '/' || name.find('\0') != std::string::npos) return {};
  fs::path place = root;
  std::size_t depth = 0;
  for (const fs::path& component : fs::path(name)) {
    const std::string text = component.string();
    if (text.empty() || text == ".") continue;
    if (text == ".." || text.size() > mostNameBytes || text.find('\\') != std::string::npos) return {};
    if (++depth > mostDepth) return {};
    place /= component;
  }
  if (depth == 0) return {};
  return place;
}

Error tooMany(const std::string& path) {
  return Error{path + " holds more than " + std::to_string(mostFiles) + " files: it is not unpacked."};
}

// Unpacks the entries of one archive.
class Unpacker {
 public:
  Unpacker(std::string path, std::uint64_t size, fs::path root, const CancelToken& cancel)
      : path_(std::move(path)),
        root_(std::move(root)),
        cancel_(cancel),
        entries_(readArchive(path_, cancel)) {
    std::error_code error;
    const fs::space_info disk = fs::space(root_, error);
    limit_ = std::min(mostBytes, error ? mostBytes : std::uint64_t(disk.available) / 2);
    limit_ = std::min(limit_, std::max(alwaysBytes, size * mostRatio));
    size_ = size;
  }

  Result<std::vector<std::pair<std::string, std::string>>> run() {
    for (std::size_t files = 0;;) {
      if (cancel_.cancelled()) return interrupted();
      const auto entry = entries_->next();
      if (!entry) return problem(entry.message());
      if (!*entry) return std::move(leftOut_);
      if (++files > mostFiles) return tooMany(path_);
      if ((*entry)->kind == ArchiveEntry::Kind::folder) continue;
      if (Status s = unpack(**entry); !s) return s.error();
    }
  }

 private:
  Error problem(const std::string& reason) const {
    return cancel_.cancelled() ? interrupted() : Error{path_ + " " + reason + "."};
  }
  Error interrupted() const { return Error{path_ + ": interrupted."}; }

  Status unpack(const ArchiveEntry& entry) {
    const std::string shown = entry.name.empty() ? "?" : entry.name;
    if (entry.kind != ArchiveEntry::Kind::file) return leaveOut(shown, "a link or no file");
    const auto place = placeOf(entry.name, root_);
    if (!place) return leaveOut(shown, "its name leads out of the archive or cannot be a file's");
    std::error_code error;
    fs::create_directories(place->parent_path(), error);
    if (error || fs::exists(*place, error)) return leaveOut(shown, "its name is there twice");
    std::ofstream out(*place, std::ios::binary);
    std::vector<char> block(1 << 18);
    while (true) {
      if (cancel_.cancelled()) return interrupted();
      const Result<std::size_t> got = entries_->read(block.data(), block.size());
      if (!got) return problem(got.message());
      if (*got == 0) break;
      written_ += *got;
      if (written_ > limit_) return tooLarge();
      out.write(block.data(), std::streamsize(*got));
    }
    out.close();
    if (!out) return Error{path_ + " cannot be unpacked: the disk is full."};
    return {};
  }

  Status leaveOut(const std::string& name, const char* reason) {
    leftOut_.emplace_back(name, reason);
    return {};
  }

  Status tooLarge() const {
    return Error{path_ + " holds more than " + std::to_string(limit_ >> 20) + " MiB in " +
                 std::to_string(size_) + " bytes: it is not unpacked."};
  }

  std::string path_;
  fs::path root_;
  const CancelToken& cancel_;
  std::unique_ptr<ArchiveEntries> entries_;
  std::uint64_t limit_ = 0, size_ = 0, written_ = 0;
  std::vector<std::pair<std::string, std::string>> leftOut_;
};

struct Unpacked {
  std::string path;  ///< absolute path of the archive
  PrivateFolder folder;
  UnpackedArchive archive;
};

// Archives that this program has unpacked, by file identity; removed when the program ends.
struct AllUnpacked {
  std::mutex unpacking;  ///< one archive at a time
  std::mutex listed;
  std::map<std::string, Unpacked> byIdentity;
};

AllUnpacked& allUnpacked() {
  static AllUnpacked all;
  return all;
}

std::optional<UnpackedArchive> unpackedBefore(const std::string& identity) {
  const std::scoped_lock one(allUnpacked().listed);
  const auto found = allUnpacked().byIdentity.find(identity);
  if (found == allUnpacked().byIdentity.end()) return {};
  return found->second.archive;
}

// Returns a text that changes if the file changes.
std::string identityOf(const std::string& path) {
  struct stat s {};
  if (::stat(path.c_str(), &s) != 0) return path;
  return std::to_string(s.st_dev) + ":" + std::to_string(s.st_ino) + ":" + std::to_string(s.st_size) + ":" +
         std::to_string(s.st_mtim.tv_sec) + ":" + std::to_string(s.st_mtim.tv_nsec);
}

}  // namespace

bool isZipArchive(const std::string& path) {
  const Result<RegularFile> file = RegularFile::open(path);
  std::vector<std::uint8_t> head;
  if (!file || !file->readUpTo(head, 4) || head.size() < 4 || head[0] != 'P' || head[1] != 'K') return false;
  return (head[2] == 3 && head[3] == 4) || (head[2] == 5 && head[3] == 6);
}

Result<UnpackedArchive> unpackZip(const std::string& path, const std::string& cacheFolder,
                                  const CancelToken& cancel) {
  const std::scoped_lock one(allUnpacked().unpacking);
  const std::string identity = identityOf(path);
  if (const auto before = unpackedBefore(identity)) return *before;
  const std::string base = cacheFolder + "/archives";
  removeLeftovers(base);
  auto folder = PrivateFolder::make(base);
  std::error_code error;
  if (!folder || !fs::create_directory(folder->files(), error))
    return Error{path + " cannot be unpacked: " + base + " cannot be written."};
  const std::uint64_t size = fs::file_size(path, error);
  if (error) return Error{path + " cannot be opened: " + error.message() + "."};
  if (size > mostFiles * leastEntryBytes && hasMoreEntries(path, mostFiles, cancel)) return tooMany(path);
  auto leftOut = Unpacker(path, size, folder->files(), cancel).run();
  if (!leftOut) return leftOut.error();
  UnpackedArchive archive{folder->files(), std::move(*leftOut)};
  const std::scoped_lock now(allUnpacked().listed);
  allUnpacked().byIdentity.emplace(identity,
                                   Unpacked{fs::absolute(path).string(), std::move(*folder), archive});
  return archive;
}

std::string lastingPath(const std::string& path) {
  const std::scoped_lock one(allUnpacked().listed);
  for (const auto& [identity, unpacked] : allUnpacked().byIdentity) {
    const std::string& folder = unpacked.archive.folder;
    if (path == folder || path.starts_with(folder + "/")) return unpacked.path + path.substr(folder.size());
  }
  return path;
}

Result<PathOnDisk> pathOnDisk(const std::string& path, const std::string& cacheFolder,
                              const CancelToken& cancel) {
  if (path.size() >= PATH_MAX) return PathOnDisk{path, false, {}};  // the system refuses it
  std::error_code error;
  fs::path archive = path;
  while (archive.has_relative_path() && !fs::exists(archive, error)) archive = archive.parent_path();
  if (!isZipArchive(archive.string())) return PathOnDisk{path, false, {}};
  Result<UnpackedArchive> unpacked = unpackZip(archive.string(), cacheFolder, cancel);
  if (!unpacked) return unpacked.error();
  const std::string behind = path.substr(archive.string().size());
  if (behind.empty() || behind == "/")
    return PathOnDisk{unpacked->folder, true, std::move(unpacked->leftOut)};
  const std::string name = behind.substr(1);
  const auto place = placeOf(name, unpacked->folder);
  if (!place || !fs::exists(*place, error)) return Error{archive.string() + " holds no " + name + "."};
  return PathOnDisk{place->string(), true, {}};
}

}  // namespace volumen
