#include "io/dicom/directory.h"

#include <algorithm>
#include <cctype>
#include <unordered_set>

#include "io/dicom/scan.h"
#include "io/regular_file.h"

namespace volumen::dicom {
namespace {

/// Returns whether a file ID stays below the DICOMDIR's folder.
bool staysInside(const std::string& id) {
  if (id.empty() || id.find('\0') != std::string::npos) return false;
  for (std::size_t begin = 0; begin <= id.size();) {
    const std::size_t end = std::min(id.find('/', begin), id.size());
    const std::string component = id.substr(begin, end - begin);
    if (component.empty() || component == "." || component == "..") return false;
    begin = end + 1;
  }
  return true;
}

/// Returns a form of `path` that matches the variants of ISO 9660 and of copies from it. They differ in case,
/// and may end with a version, a dot or a picture's extension.
std::string comparable(std::string path) {
  std::ranges::transform(path, path.begin(), [](unsigned char c) { return char(std::tolower(c)); });
  for (const std::string_view end : {";1", ".", ".dcm", ".ima"})
    if (path.ends_with(end)) path.resize(path.size() - end.size());
  return path;
}

std::string counted(std::size_t count, const char* one, const char* many) {
  return std::to_string(count) + ' ' + (count == 1 ? one : many);
}

}  // namespace

bool isDirectoryFile(const std::string& path) {
  constexpr std::string_view directoryClass = "1.2.840.10008.1.3.10";
  constexpr std::uint64_t enough = 1024;  // the class is near the beginning
  const Result<RegularFile> file = RegularFile::open(path);
  std::vector<std::uint8_t> head;
  if (!file || !file->readUpTo(head, enough) || !hasMagic(head)) return false;
  return std::search(head.begin(), head.end(), directoryClass.begin(), directoryClass.end()) != head.end();
}

std::vector<ListedFile> listedFiles(const DataSet& data) {
  std::vector<ListedFile> listed;
  ListedFile at;  // records follow the records they belong to
  for (const DataSet::Scope& record : data.items(directoryRecords, data.root())) {
    const std::string type = data.text(0x00041430, record);
    if (type == "PATIENT") at = {};
    if (type == "STUDY") at = {{}, data.text(0x0020000d, record), {}};
    if (type == "SERIES") at.seriesUid = data.text(0x0020000e, record);
    at.isPicture = type == "IMAGE";
    at.id.clear();
    for (const std::string& component : data.values(0x00041500, record))
      at.id += (at.id.empty() ? "" : "/") + component;
    if (!at.id.empty()) listed.push_back(at);
  }
  return listed;
}

std::vector<ListedFile> notFound(const std::string& path, const std::vector<ListedFile>& listed,
                                 const std::vector<std::string>& found) {
  const std::string folder = path.substr(0, path.find_last_of('/') + 1);
  std::unordered_set<std::string> here;
  for (const std::string& file : found)
    if (file.starts_with(folder)) here.insert(comparable(file.substr(folder.size())));
  std::vector<ListedFile> missing;
  for (const ListedFile& file : listed)
    if (!staysInside(file.id) || !here.contains(comparable(file.id))) missing.push_back(file);
  return missing;
}

std::string directoryText(const std::string& path, const std::vector<ListedFile>& listed,
                          const std::vector<std::string>& found) {
  const std::vector<ListedFile> gone = notFound(path, listed, found);
  const auto outside =
      std::size_t(std::ranges::count_if(gone, [](const ListedFile& file) { return !staysInside(file.id); }));
  const std::size_t missing = gone.size() - outside;
  std::string text = "DICOMDIR of " + counted(listed.size(), "file", "files");
  if (missing) text += ", " + counted(missing, "is not here", "are not here");
  if (outside) text += ", " + counted(outside, "leads", "lead") + " out of its folder";
  return text;
}

}  // namespace volumen::dicom
