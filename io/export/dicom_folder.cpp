#include "io/export/dicom_folder.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "io/files/aside.h"

namespace volumen {

namespace {

namespace fs = std::filesystem;

// Treats "out/" and "out" alike and follows links to their target.
fs::path targetOf(const std::string& folder) {
  const fs::path target = fs::path(folder).lexically_normal();
  return endOfLinks((target.has_filename() ? target : target.parent_path()).string());
}

fs::path parentOf(const fs::path& target) {
  return target.has_parent_path() ? target.parent_path() : fs::path(".");
}

bool isEmptyOrMissing(const fs::path& folder) {
  std::error_code error;
  if (!fs::exists(folder, error)) return true;
  return fs::is_directory(folder, error) && fs::is_empty(folder, error);
}

}  // namespace

Status checkDicomFolder(const std::string& folder) {
  const fs::path target = targetOf(folder);
  if (!isEmptyOrMissing(target))
    return Error{folder + " exists and is not an empty folder; name a new one for the DICOM series."};
  if (const auto probe = FolderAside::in(parentOf(target).string()); probe) return {};
  return Error{"Cannot make the folder " + folder + ": " + parentOf(target).string() +
               " is missing or cannot be written."};
}

Status writeDicomFolder(const std::string& folder, const std::function<Status(const std::string&)>& write) {
  if (Status s = checkDicomFolder(folder); !s) return s;
  const fs::path target = targetOf(folder), parent = parentOf(target);
  const auto cannotMake = [&](const std::string& why) {
    return Error{"Cannot make the folder " + folder + ": " + why + "."};
  };
  auto aside = FolderAside::in(parent.string());
  if (!aside) return cannotMake(aside.message());
  if (Status s = write(aside->path()); !s) return s;
  if (Status s = aside->become(target.string()); !s) return cannotMake(s.message());
  return {};
}

Status saveSlice(DcmFileFormat& file, const std::string& folder, int k) {
  char name[32];
  std::snprintf(name, sizeof name, "slice-%05d.dcm", k + 1);
  const std::string path = (fs::path(folder) / name).string();
  errno = 0;
  const OFCondition done = file.saveFile(OFFilename(path.c_str()), EXS_LittleEndianExplicit);
  if (done.bad())
    return Error{"Cannot write " + std::string(name) +
                 " of the series: " + (errno ? std::strerror(errno) : done.text()) + "."};
  return {};
}

}  // namespace volumen
