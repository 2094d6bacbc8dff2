#include "io/index/copies.h"

#include <QCryptographicHash>
#include <QString>
#include <algorithm>
#include <filesystem>

#include "io/files/output_file.h"
#include "io/files/private_folder.h"
#include "io/files/same_bytes.h"
#include "io/index/schema.h"
#include "io/open.h"
#include "io/regular_file.h"

namespace volumen {
namespace {

constexpr std::size_t batchSize = 512;
constexpr std::uint64_t block = std::uint64_t(1) << 20;

// Returns `text` as a folder or file name: letters, digits, "-" and ".", at most 60 bytes.
std::string safeName(const std::string& text, const char* ifEmpty) {
  QString name;
  for (const QChar c : QString::fromStdString(text))
    name += c.isLetterOrNumber() || c == QLatin1Char('-') || c == QLatin1Char('.') ? c : QLatin1Char('_');
  while (name.toUtf8().size() > 60) name.chop(1);
  while (name.startsWith(QLatin1Char('.'))) name[0] = QLatin1Char('_');
  return name.isEmpty() ? ifEmpty : name.toStdString();
}

// Returns the first eight hexadecimal digits of a hash.
std::string shortHash(const std::string& text) {
  return QCryptographicHash::hash(QByteArray::fromStdString(text), QCryptographicHash::Sha256)
      .toHex()
      .left(8)
      .toStdString();
}

std::string folderFor(const std::string& managed, const FoundSeries& series) {
  const SeriesIdentity& s = series.identity;
  const std::string& source = series.files[0].path;
  const std::string study = s.studyUid.empty() ? source : s.studyUid;
  const std::string patient = s.patientName.empty() ? s.patientId : s.patientName;
  return managed + "/" + safeName(patient, "files") + "/" +
         safeName(s.studyDate + " " + s.studyDescription, "study") + "-" + shortHash(study + s.patientId) +
         "/" + safeName(s.seriesNumber + " " + s.modality + " " + s.description, "series") + "-" +
         shortHash(s.seriesUid.empty() ? source : s.seriesUid);
}

Status copyTo(const RegularFile& from, const std::string& path) {
  Result<OutputFile> to = OutputFile::create(path);
  if (!to) return to.error();
  for (std::uint64_t at = 0; at < from.size(); at += block) {
    const auto bytes = from.read(at, std::min(block, from.size() - at));
    if (!bytes) return Error{path + ": " + bytes.message() + "."};
    if (Status written = to->write(bytes->data(), bytes->size()); !written) return written;
  }
  return to->commit();
}

// Copies a file and returns its new path: its own name, or with a number if another file has that name.
Result<std::string> copyFile(const std::string& path, const std::string& folder) {
  const Result<RegularFile> from = RegularFile::open(path);
  if (!from) return Error{path + ": " + from.message() + "."};
  const std::string name = safeName(path.substr(path.find_last_of('/') + 1), "file");
  for (int n = 1;; ++n) {
    // The number comes first, so that the end of the name keeps the format.
    const std::string target = folder + "/" + (n > 1 ? std::to_string(n) + "-" : "") + name;
    std::error_code error;
    if (std::filesystem::exists(target, error)) {
      if (haveSameBytes(path, target) == true) return target;
      continue;
    }
    if (Status copied = copyTo(*from, target); !copied) return copied.error();
    return target;
  }
}

// True if a single file can be opened: a header with its data in another file cannot.
bool standsAlone(const std::string& path) {
  const Result<Study> study = openFiles({path});
  return study && !study->volumes.empty();
}

void copySeries(const FoundSeries& series, const std::string& managed, const CancelToken& cancel,
                Copies& copies) {
  const std::string folder = folderFor(managed, series);
  copies.status = makePrivateFolder(folder);
  for (const FoundFile& file : series.files) {
    if (!copies.status || cancel.cancelled()) return;
    Result<std::string> copy = copyFile(file.path, folder);
    if (!copy) {
      copies.status = copy.error();
    } else if (!series.isDicom && !standsAlone(*copy)) {
      std::error_code ignored;
      std::filesystem::remove(*copy, ignored);
      copies.refused.push_back({file.path, "Its data lie in another file: import it without copying."});
    } else {
      copies.files.push_back(std::move(*copy));
    }
  }
}

}  // namespace

Copies copyStudies(const std::vector<ImportRoot>& roots, const std::string& indexFolder,
                   const std::string& managedFolder, const Progress& progress, const CancelToken& cancel) {
  Copies copies;
  std::vector<std::string> paths;
  for (const ImportRoot& root : roots) {
    const Result<FilesBelow> below = filesBelow(root, indexFolder, cancel);
    if (!below) {
      copies.status = below.error();
      return copies;
    }
    if (below->files.empty() && below->unreadable.empty()) copies.empty.push_back(root.path);
    for (const FileOnDisk& file : below->files) paths.push_back(file.path());
    for (const UnreadableOnDisk& file : below->unreadable)
      copies.refused.push_back({file.entry.path(), file.reason});
  }
  for (std::size_t n = 0; n < paths.size() && copies.status && !cancel.cancelled(); n += batchSize) {
    if (progress) progress("copying", n, paths.size());
    const std::vector<std::string> batch(
        paths.begin() + std::ptrdiff_t(n),
        paths.begin() + std::ptrdiff_t(std::min(n + batchSize, paths.size())));
    const Result<ReadFiles> read = readFiles(batch, {}, cancel);
    if (!read) break;  // cancelled
    std::size_t images = 0;
    for (const ReadSeries& series : read->series) {
      images += series.files.size();
      copySeries(series, managedFolder, cancel, copies);
    }
    copies.refused.insert(copies.refused.end(), read->refused.begin(), read->refused.end());
    copies.lacking.insert(copies.lacking.end(), read->lacking.begin(), read->lacking.end());
    copies.notImages += std::max(0, int(batch.size()) - int(images + read->refused.size()));
  }
  return copies;
}

}  // namespace volumen
