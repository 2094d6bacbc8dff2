#include "ui/controller/segment_files.h"

#include <QDir>
#include <QFileInfo>
#include <QRegularExpression>
#include <algorithm>
#include <map>
#include <mutex>
#include <new>

#include "io/export/seg_nrrd.h"
#include "io/file_state.h"
#include "io/files/session_file.h"
#include "io/index/index_path.h"
#include "io/load.h"
#include "ui/workspace/session_json.h"
#include "ui/workspace/text.h"

namespace volumen {

namespace {

std::string fileOf(const std::string& session, const std::string& checksum) {
  return session + "." + checksum + ".seg.nrrd";
}

// The files that this process wrote, or read whole, as they were then: their names say what they hold.
class KnownFiles {
 public:
  void add(const std::string& path) {
    const std::lock_guard lock(mutex_);
    states_[path] = fileState(path);
  }
  bool contains(const std::string& path) {
    const std::lock_guard lock(mutex_);
    const auto known = states_.find(path);
    return known != states_.end() && known->second && known->second == fileState(path);
  }

 private:
  std::mutex mutex_;
  std::map<std::string, std::optional<FileState>> states_;
};

KnownFiles& knownFiles() {
  static KnownFiles known;
  return known;
}

// The session may have another name by now, or it is a copy.
QString fileBeside(const std::string& session, const std::string& checksum) {
  const QFileInfo file(QString::fromStdString(fileOf(session, checksum)));
  if (file.exists()) return file.filePath();
  const QString any = QStringLiteral("*.volumen.%1.seg.nrrd").arg(QString::fromStdString(checksum));
  const QStringList names = file.dir().entryList({any}, QDir::Files, QDir::Name);
  return names.isEmpty() ? QString() : file.dir().filePath(names.front());
}

// Null: they are not what was saved, or too large for the memory.
std::shared_ptr<const LabelMap> labelsIn(const std::string& path, const SavedLabels& saved,
                                         const Progress& progress, const CancelToken& cancel) try {
  const auto study = openPath(path, progress, cancel);
  if (!study || study->volumes.size() != 1) return nullptr;
  if (study->volumes.front().acquired.size != saved.geometry.size) return nullptr;
  const auto loaded = loadSeries(study->volumes.front(), progress, cancel);
  if (!loaded || loaded->acquired->size() != saved.geometry.size) return nullptr;
  const auto* labels = std::get_if<std::vector<std::uint8_t>>(&loaded->acquired->stored());
  if (!labels) return nullptr;
  auto map = std::make_shared<const LabelMap>(DenseLabels{saved.geometry, *labels});
  if (checksumOf(*map) != saved.checksum) return nullptr;
  knownFiles().add(path);
  return map;
} catch (const std::bad_alloc&) {
  return nullptr;
}

QString namesOf(const SegmentMap& map) {
  QStringList names;
  for (const Segment& segment : map.segments) names << shownText(segment.label);
  return names.join(QStringLiteral(", "));
}

// A copy, or what the session was called before.
bool otherSessionNames(const std::string& session, const std::string& checksum) {
  const QFileInfo file(QString::fromStdString(session));
  for (const QFileInfo& other :
       file.dir().entryInfoList({QStringLiteral("*.volumen")}, QDir::Files | QDir::Hidden)) {
    if (other == file) continue;
    const auto text = sessionText(other.filePath().toStdString());
    if (!text || text->find(checksum) != std::string::npos) return true;  // it may
  }
  return false;
}

}  // namespace

Status writeSegmentMaps(const std::string& session, const Workspace& workspace) {
  for (const SegmentMap& map : workspace.segmentMaps) {
    if (!map.labels) continue;
    const std::string path = fileOf(session, checksumOf(*map.labels));
    if (knownFiles().contains(path)) continue;
    if (Status s = writeSegNrrd(*map.labels, map.segments, path); !s) return s;
    knownFiles().add(path);
  }
  return {};
}

Workspace withLabelsApart(Workspace workspace) {
  workspace.segmentMaps.editIf([](const SegmentMap& map) { return map.labels != nullptr; },
                               [](SegmentMap& map) {
                                 map.missing = savedLabelsOf(map);
                                 map.labels.reset();
                               });
  return workspace;
}

Workspace withSegmentMaps(Workspace workspace, const std::string& session, QStringList& problems,
                          const Progress& progress, const CancelToken& cancel) {
  std::map<std::string, std::shared_ptr<const LabelMap>> read;  // each once
  workspace.segmentMaps.editIf(
      [](const SegmentMap& map) { return map.missing.has_value(); },
      [&](SegmentMap& map) {
        const auto [known, isNew] = read.try_emplace(map.missing->checksum);
        const QString path = isNew ? fileBeside(session, map.missing->checksum) : QString();
        if (!path.isEmpty()) known->second = labelsIn(path.toStdString(), *map.missing, progress, cancel);
        map.labels = known->second;
        if (map.labels)
          map.missing.reset();
        else
          problems << tr("The segments %1 were not found: their file must lie beside the session, %2.")
                          .arg(namesOf(map), pathText(fileOf(session, map.missing->checksum)));
      });
  return workspace;
}

QStringList segmentFilesOf(const QString& session) {
  const QFileInfo file(session);
  static const QRegularExpression name(QStringLiteral("^\\.[0-9a-f]{40}\\.seg\\.nrrd$"));
  QStringList files;
  for (const QFileInfo& beside : file.dir().entryInfoList({}, QDir::Files)) {
    const QString rest = beside.fileName().mid(file.fileName().size());
    if (beside.fileName().startsWith(file.fileName()) && name.match(rest).hasMatch())
      files << beside.filePath();
  }
  return files;
}

std::vector<std::string> segmentMapsNamedBy(const std::string& session) {
  std::vector<std::string> checksums;
  if (segmentFilesOf(QString::fromStdString(session)).isEmpty()) return checksums;
  const auto text = sessionText(session);
  if (!text) return checksums;
  const auto saved = sessionFromJson(*text, {});
  if (!saved) return checksums;
  for (const SegmentMap& map : saved->workspace.segmentMaps) checksums.push_back(map.missing->checksum);
  return checksums;
}

void removeSegmentMaps(const std::string& session, const std::vector<std::string>& checksums,
                       const Workspace& workspace) {
  for (const std::string& checksum : checksums) {
    const auto isIt = [&](const SegmentMap& map) { return savedLabelsOf(map).checksum == checksum; };
    if (std::ranges::none_of(workspace.segmentMaps, isIt) && !otherSessionNames(session, checksum))
      QFile::remove(QString::fromStdString(fileOf(session, checksum)));
  }
}

}  // namespace volumen
