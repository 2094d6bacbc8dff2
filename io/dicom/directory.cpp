#include "io/dicom/directory.h"

#include <algorithm>
#include <cctype>
#include <unordered_set>

#include "io/dicom/scan.h"
#include "io/regular_file.h"

namespace volumen::dicom {
namespace {

/// Whether a file ID names a file below the DICOMDIR's folder.
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

/// As ISO 9660 file systems, and those that copy from them, may show it: in any case, with a version, a dot
/// or an extension for pictures behind.
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
  constexpr std::uint64_t enough = 1024;  // the class stands near the beginning
  const Result<RegularFile> file = RegularFile::open(path);
  std::vector<std::uint8_t> head;
  if (!file || !file->readUpTo(head, enough) || !hasMagic(head)) return false;
  return std::search(head.begin(), head.end(), directoryClass.begin(), directoryClass.end()) != head.end();
}

std::vector<std::string> listedFiles(const DataSet& data) {
  std::vector<std::string> listed;
  for (const DataSet::Scope& record : data.items(directoryRecords, data.root())) {
    std::string id;
    for (const std::string& component : data.values(0x00041500, record))
      id += (id.empty() ? "" : "/") + component;
    if (!id.empty()) listed.push_back(id);
  }
  return listed;
}

std::string directoryText(const std::string& path, const std::vector<std::string>& listed,
                          const std::vector<std::string>& found) {
  const std::string folder = path.substr(0, path.find_last_of('/') + 1);
  std::unordered_set<std::string> here;
  for (const std::string& file : found)
    if (file.starts_with(folder)) here.insert(comparable(file.substr(folder.size())));
  std::size_t missing = 0, outside = 0;
  for (const std::string& id : listed) {
    if (!staysInside(id))
      ++outside;
    else if (!here.contains(comparable(id)))
      ++missing;
  }
  std::string text = "DICOMDIR of " + counted(listed.size(), "file", "files");
  if (missing) text += ", " + counted(missing, "is not here", "are not here");
  if (outside) text += ", " + counted(outside, "leads", "lead") + " out of its folder";
  return text;
}

}  // namespace volumen::dicom
