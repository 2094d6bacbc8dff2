#include "io/archive/fetched_studies.h"

#include <dirent.h>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <deque>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>

#include "io/archive/fetch_archive.h"
#include "io/files/name_for_uid.h"
#include "io/files/private_folder.h"
#include "io/index/index.h"
#include "io/worker/channel.h"

namespace volumen {

namespace {

using worker::Descriptor;

constexpr const char* marksName = ".marks";  // behind the name of the folder of studies
constexpr const char *instanceSuffix = ".dcm", *keptSuffix = ".kept";

// Opens a folder, but not what a link leads to.
Descriptor openFolder(int in, const std::string& name) {
  return Descriptor(::openat(in, name.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
}

// The marks of fetched studies in a folder. While one program holds this object, others wait for it.
class Marks {
 public:
  // Returns nothing if there are none.
  static std::optional<Marks> of(const std::string& folder) {
    Marks marks(openFolder(AT_FDCWD, folder + marksName));
    if (!marks.folder_) return {};
    while (::flock(marks.folder_.get(), LOCK_EX) != 0)
      if (errno != EINTR) return {};
    return marks;
  }

  bool has(const std::string& study) const { return ::faccessat(get(), study.c_str(), F_OK, 0) == 0; }
  bool add(const std::string& study, const std::string& uid) const {
    const Descriptor file(
        ::openat(get(), study.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW | O_CLOEXEC, 0600));
    return file && ::write(file.get(), uid.data(), uid.size()) == ssize_t(uid.size());
  }
  void touch(const std::string& study) const {
    ::utimensat(get(), study.c_str(), nullptr, AT_SYMLINK_NOFOLLOW);
  }
  void remove(const std::string& study) const { ::unlinkat(get(), study.c_str(), 0); }
  std::string uidOf(const std::string& study) const {
    char uid[65];
    const Descriptor file(::openat(get(), study.c_str(), O_RDONLY | O_NOFOLLOW | O_CLOEXEC));
    const ssize_t size = ::read(file.get(), uid, sizeof uid - 1);
    return size < 0 ? std::string() : std::string(uid, std::size_t(size));
  }
  int get() const { return folder_.get(); }
  const Descriptor& folder() const { return folder_; }

 private:
  explicit Marks(Descriptor folder) : folder_(std::move(folder)) {}
  Descriptor folder_;
};

// Returns whether a name has the form of nameForUid().
bool isNameForUid(std::string_view name) {
  return name.size() == 32 && name.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}
bool isInstanceName(std::string_view name) {
  return name.ends_with(instanceSuffix) && isNameForUid(name.substr(0, name.size() - 4));
}

std::vector<std::string> namesIn(const Descriptor& folder) {
  std::vector<std::string> names;
  const int copy = ::openat(folder.get(), ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  DIR* const list = copy < 0 ? nullptr : ::fdopendir(copy);
  if (!list) return names;
  while (const dirent* one = ::readdir(list)) names.emplace_back(one->d_name);
  ::closedir(list);
  return names;
}

// Locks the folder of a study until the program ends. Removing a study needs an exclusive lock, so no program
// removes it meanwhile.
void hold(const std::string& studyFolder) {
  constexpr std::size_t most = 256;
  static std::mutex mutex;
  static std::deque<std::pair<std::string, Descriptor>> held;
  const std::scoped_lock one(mutex);
  if (std::ranges::any_of(held, [&](const auto& study) { return study.first == studyFolder; })) return;
  Descriptor folder = openFolder(AT_FDCWD, studyFolder);
  if (!folder || ::flock(folder.get(), LOCK_SH) != 0) return;
  held.emplace_back(studyFolder, std::move(folder));
  if (held.size() > most) held.pop_front();
}

struct MarkedStudy {
  std::string name;
  timespec used{};
  std::uint64_t bytes = 0;
};

// Calls `visit(folder, name)` for the images of a study; nothing else counts, and no link is followed.
template <class Visit>
void forEachImage(const Descriptor& study, Visit visit) {
  for (const std::string& series : namesIn(study)) {
    if (!isNameForUid(series)) continue;
    if (const Descriptor folder = openFolder(study.get(), series); folder)
      for (const std::string& name : namesIn(folder))
        if (isInstanceName(name)) visit(folder.get(), name.c_str());
  }
}

std::uint64_t bytesIn(const Descriptor& study) {
  std::uint64_t bytes = 0;
  forEachImage(study, [&](int folder, const char* name) {
    struct stat file {};
    if (::fstatat(folder, name, &file, AT_SYMLINK_NOFOLLOW) == 0) bytes += std::uint64_t(file.st_size);
  });
  return bytes;
}

// Returns the marked studies that are not kept, those unused for the longest time first.
std::vector<MarkedStudy> markedStudies(const Descriptor& root, const Marks& marks) {
  std::vector<MarkedStudy> all;
  for (const std::string& name : namesIn(root)) {
    struct stat mark {};
    if (!isNameForUid(name) || ::fstatat(marks.get(), name.c_str(), &mark, AT_SYMLINK_NOFOLLOW) != 0 ||
        marks.has(name + keptSuffix))
      continue;
    if (const Descriptor study = openFolder(root.get(), name); study)
      all.push_back({name, mark.st_mtim, bytesIn(study)});
  }
  std::ranges::sort(all, {}, [](const MarkedStudy& s) { return std::pair(s.used.tv_sec, s.used.tv_nsec); });
  return all;
}

// Opens the folder of a study for its removal. Returns nothing if a program uses it.
Descriptor openUnused(const Descriptor& root, const std::string& study) {
  Descriptor folder = openFolder(root.get(), study);
  return folder && ::flock(folder.get(), LOCK_EX | LOCK_NB) == 0 ? std::move(folder) : Descriptor();
}

// Removes the empty folders of a study, unless somebody has begun to fill them again.
void removeFolders(const Descriptor& root, const Marks& marks, const std::string& name) {
  if (!marks.has(name)) return;
  {
    const Descriptor study = openUnused(root, name);
    if (!study) return;
    for (const std::string& series : namesIn(study))
      if (isNameForUid(series)) ::unlinkat(study.get(), series.c_str(), AT_REMOVEDIR);
  }
  if (::unlinkat(root.get(), name.c_str(), AT_REMOVEDIR) == 0) marks.remove(name);
}

// Images leave the index when their folders, which are empty but still there, are imported.
Status removeFromIndex(const std::string& indexFolder, const std::vector<std::string>& studies) {
  std::vector<std::string> folders;
  for (const std::string& study : studies) folders.push_back(fetchedFolder(indexFolder) + "/" + study);
  const auto imported = importIntoIndex(indexFolder, folders);
  return imported ? Status() : imported.error();
}

}  // namespace

Status beginFetched(const std::string& studyFolder, const std::string& studyUid) {
  const std::filesystem::path path = studyFolder;
  const std::string root = path.parent_path().string(), study = path.filename().string();
  if (Status s = makePrivateFolder(root + marksName); !s) return s;
  const std::optional<Marks> marks = Marks::of(root);
  std::error_code ignored;
  if (marks && !std::filesystem::exists(path, ignored) && !marks->add(study, studyUid))
    return Error{"Cannot write to the folder " + root + marksName + ": " + std::strerror(errno) + "."};
  if (Status s = makePrivateFolder(studyFolder); !s) return s;
  if (marks) marks->touch(study);
  hold(studyFolder);
  return {};
}

void useFetched(const std::vector<std::string>& files) {
  std::string last;
  for (const std::string& file : files) {
    if (!isInstanceName(file.substr(file.find_last_of('/') + 1))) continue;
    const std::filesystem::path study = std::filesystem::path(file).parent_path().parent_path();
    if (study == last || !isNameForUid(study.filename().string())) continue;
    last = study.string();
    const std::optional<Marks> marks = Marks::of(study.parent_path().string());
    if (!marks || !marks->has(study.filename().string())) continue;
    marks->touch(study.filename().string());
    hold(last);
  }
}

void useFetched(const Study& study) {
  std::vector<std::string> files;
  for (const Series& series : study.volumes)
    files.insert(files.end(), series.files.begin(), series.files.end());
  for (const Image& image : study.images) files.push_back(image.path);
  for (const DerivedObject& object : study.derived) files.push_back(object.path);
  useFetched(files);
}

Status beginReceived(const std::string& folder, const std::string& study, const std::string& series) {
  const std::string path = folder + "/" + study + "/" + series;
  // A fetch that begins from now on finds the study here, and makes no mark.
  if (Status s = makePrivateFolder(path); !s) return s;
  const std::optional<Marks> marks = Marks::of(folder);
  if (!marks) return {};
  const Status made =
      makePrivateFolder(path);  // the study may have been removed before its mark was looked at
  if (!made || !marks->has(study)) return made;
  marks->remove(study);
  marks->remove(study + keptSuffix);
  return makeNamesLast(folder + marksName);
}

Status keepFetched(const std::string& indexFolder, const std::string& studyUid, bool isKept) {
  const std::string root = fetchedFolder(indexFolder), study = nameForUid(studyUid);
  const std::optional<Marks> marks = Marks::of(root);
  const auto isHere = [&] {
    const Descriptor folder = openFolder(AT_FDCWD, root + "/" + study);
    return folder && marks->has(study) && bytesIn(folder) > 0;
  };
  if (!marks || !(isHere() || (!isKept && marks->has(study + keptSuffix))))
    return Error{"The study " + studyUid +
                 " was not fetched from an archive to this computer: `volumen archive fetch` fetches it."};
  if (!isKept)
    marks->remove(study + keptSuffix);
  else if (!marks->add(study + keptSuffix, studyUid))
    return Error{"Cannot write to the folder " + root + marksName + ": " + std::strerror(errno) + "."};
  return makeNamesLast(root + marksName);
}

std::optional<bool> isFetchedKept(const std::string& indexFolder, const std::string& studyUid) {
  const std::string study = fetchedFolder(indexFolder, studyUid),
                    mark = fetchedFolder(indexFolder) + marksName + "/" + nameForUid(studyUid);
  std::error_code ignored;
  if (!std::filesystem::exists(study, ignored) || !std::filesystem::exists(mark, ignored)) return {};
  return std::filesystem::exists(mark + keptSuffix, ignored);
}

std::vector<std::string> keptStudies(const std::string& indexFolder) {
  std::vector<std::string> uids;
  const std::optional<Marks> marks = Marks::of(fetchedFolder(indexFolder));
  if (!marks) return uids;
  for (const std::string& name : namesIn(marks->folder()))
    if (name.ends_with(keptSuffix)) uids.push_back(marks->uidOf(name));
  std::ranges::sort(uids);
  return uids;
}

Result<std::vector<std::string>> trimFetched(const std::string& indexFolder, std::uint64_t mostBytes) {
  std::vector<std::string> uids, emptied;
  if (mostBytes == 0) return uids;
  const std::string root = fetchedFolder(indexFolder);
  const Descriptor folder(::open(root.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  {
    const std::optional<Marks> marks = Marks::of(root);
    if (!marks || !folder) return uids;
    const std::vector<MarkedStudy> all = markedStudies(folder, *marks);
    std::uint64_t bytes = 0;
    for (const MarkedStudy& study : all) bytes += study.bytes;
    for (const MarkedStudy& study : all) {
      // A program that was killed may have left an empty one.
      if (bytes <= mostBytes && study.bytes > 0) continue;
      const Descriptor unused = openUnused(folder, study.name);
      if (!unused) continue;
      forEachImage(unused, [](int images, const char* name) { ::unlinkat(images, name, 0); });
      emptied.push_back(study.name);
      bytes -= study.bytes;
      if (study.bytes > 0) uids.push_back(marks->uidOf(study.name));
    }
  }
  if (emptied.empty()) return uids;
  // Others may look at the marks meanwhile.
  if (Status s = removeFromIndex(indexFolder, emptied); !s) return s.error();
  if (const std::optional<Marks> marks = Marks::of(root))
    for (const std::string& study : emptied) removeFolders(folder, *marks, study);
  return uids;
}

}  // namespace volumen
