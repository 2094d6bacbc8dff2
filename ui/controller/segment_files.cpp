#include "ui/controller/segment_files.h"

#include <QDir>
#include <QFileInfo>
#include <QRegularExpression>
#include <algorithm>
#include <map>
#include <mutex>
#include <new>
#include <tuple>

#include "io/export/seg_nrrd.h"
#include "io/file_state.h"
#include "io/files/output_file.h"
#include "io/files/session_file.h"
#include "io/paths/open_path.h"
#include "io/load.h"
#include "results/text/text.h"
#include "ui/controller/label_changes.h"
#include "ui/workspace/session_json.h"

namespace volumen {

namespace {

const std::string wholeEnding = ".seg.nrrd", changesEnding = ".labels";

std::string fileOf(const std::string& session, const std::string& checksum,
                   const std::string& ending = wholeEnding) {
  return session + "." + checksum + ending;
}

// The state of files this process wrote or read completely. Their names identify their content.
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

// The base maps of the files of changes beside a session: the last version of each map that was written
// completely.
class BaseMaps {
 public:
  struct Base {
    std::string checksum;
    std::shared_ptr<const LabelMap> labels;
  };

  void set(const std::string& session, const SegmentMap& map, const std::string& checksum) {
    const std::lock_guard lock(mutex_);
    bases_[{session, map.series, map.number}] = {checksum, map.labels};
  }
  // Labels are null if there is no base or its file has changed.
  Base of(const std::string& session, const SegmentMap& map) {
    const std::lock_guard lock(mutex_);
    const auto found = bases_.find({session, map.series, map.number});
    if (found == bases_.end() || found->second.labels->geometry() != map.labels->geometry()) return {};
    return knownFiles().contains(fileOf(session, found->second.checksum)) ? found->second : Base{};
  }
  // Releases the bases of a session for which `isGone` holds. Returns their checksums.
  template <class IsGone>
  std::vector<std::string> release(const std::string& session, const IsGone& isGone) {
    const std::lock_guard lock(mutex_);
    std::vector<std::string> checksums;
    std::erase_if(bases_, [&](const auto& base) {
      const auto& [of, series, number] = base.first;
      if (of != session || !isGone(series, number)) return false;
      checksums.push_back(base.second.checksum);
      return true;
    });
    return checksums;
  }
  bool holds(const std::string& session, const std::string& checksum) {
    const std::lock_guard lock(mutex_);
    return std::ranges::any_of(bases_, [&](const auto& base) {
      return std::get<0>(base.first) == session && base.second.checksum == checksum;
    });
  }

 private:
  std::mutex mutex_;
  std::map<std::tuple<std::string, SeriesKey, int>, Base> bases_;
};

BaseMaps& baseMaps() {
  static BaseMaps bases;
  return bases;
}

// Returns the file under this or another session name, because the session may be renamed or copied.
QString fileBeside(const std::string& session, const std::string& checksum,
                   const std::string& ending = wholeEnding) {
  const QFileInfo file(QString::fromStdString(fileOf(session, checksum, ending)));
  if (file.exists()) return file.filePath();
  const QString any = QString::fromStdString("*.volumen." + checksum + ending);
  const QStringList names = file.dir().entryList({any}, QDir::Files, QDir::Name);
  return names.isEmpty() ? QString() : file.dir().filePath(names.front());
}

// Returns null if the labels are not what was saved, or too large for the memory.
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

// Returns the labels from a file of changes and its base; null as above.
std::shared_ptr<const LabelMap> changedLabels(const std::string& session, const SavedLabels& saved,
                                              const Progress& progress, const CancelToken& cancel) {
  const QString path = fileBeside(session, saved.checksum, changesEnding);
  QFile file(path);
  if (path.isEmpty() || !file.open(QIODevice::ReadOnly)) return nullptr;
  const QByteArray changes = file.readAll();
  const auto checksum = baseOfChanges(changes);
  const QString basePath = checksum ? fileBeside(session, *checksum) : QString();
  if (basePath.isEmpty()) return nullptr;
  const auto base = labelsIn(basePath.toStdString(), {*checksum, saved.geometry}, progress, cancel);
  auto map = base ? withLabelChanges(*base, changes) : nullptr;
  return map && checksumOf(*map) == saved.checksum ? map : nullptr;
}

// Returns null if the labels are missing or not what was saved.
std::shared_ptr<const LabelMap> labelsBeside(const std::string& session, const SavedLabels& saved,
                                             const Progress& progress, const CancelToken& cancel) {
  const QString whole = fileBeside(session, saved.checksum);
  return whole.isEmpty() ? changedLabels(session, saved, progress, cancel)
                         : labelsIn(whole.toStdString(), saved, progress, cancel);
}

Status writeChanges(const std::string& path, const BaseMaps::Base& base, const LabelMap& map) {
  const QByteArray changes = labelChanges(*base.labels, base.checksum, map);
  return writeWholeFile(path, {changes.constData(), std::size_t(changes.size())});
}

QString namesOf(const SegmentMap& map) {
  QStringList names;
  for (const Segment& segment : map.segments) names << shownText(segment.label);
  return names.join(QStringLiteral(", "));
}

// Returns whether another session, such as a copy or an earlier name, refers to the map.
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

Status writeSegmentMaps(const std::string& session, const Workspace& workspace, LabelFiles how) {
  for (const SegmentMap& map : workspace.segmentMaps) {
    if (!map.labels) continue;
    const std::string checksum = savedLabelsOf(map).checksum, whole = fileOf(session, checksum);
    if (knownFiles().contains(whole)) continue;
    const BaseMaps::Base base = how == LabelFiles::changes ? baseMaps().of(session, map) : BaseMaps::Base{};
    const std::string path = base.labels ? fileOf(session, checksum, changesEnding) : whole;
    if (knownFiles().contains(path)) continue;
    const Status written =
        base.labels ? writeChanges(path, base, *map.labels) : writeSegNrrd(*map.labels, map.segments, path);
    if (!written) return written;
    knownFiles().add(path);
    if (how == LabelFiles::changes && !base.labels) baseMaps().set(session, map, checksum);
  }
  return {};
}

std::vector<std::string> releasedBases(const std::string& session, const Workspace& workspace) {
  return baseMaps().release(session, [&](const SeriesKey& series, int number) {
    return std::ranges::none_of(workspace.segmentMaps, [&](const SegmentMap& map) {
      return map.labels && map.series == series && map.number == number;
    });
  });
}

void forgetLabelChanges(const std::string& session) {
  (void)baseMaps().release(session, [](const SeriesKey&, int) { return true; });
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
  std::map<std::string, std::shared_ptr<const LabelMap>> read;  // each is read once
  workspace.segmentMaps.editIf(
      [](const SegmentMap& map) { return map.missing.has_value(); },
      [&](SegmentMap& map) {
        const auto [known, isNew] = read.try_emplace(map.missing->checksum);
        if (isNew) known->second = labelsBeside(session, *map.missing, progress, cancel);
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
  static const QRegularExpression name(QStringLiteral("^\\.[0-9a-f]{40}\\.(seg\\.nrrd|labels)$"));
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
    if (std::ranges::any_of(workspace.segmentMaps, isIt) || otherSessionNames(session, checksum)) continue;
    QFile::remove(QString::fromStdString(fileOf(session, checksum, changesEnding)));
    if (!baseMaps().holds(session, checksum))
      QFile::remove(QString::fromStdString(fileOf(session, checksum)));
  }
}

}  // namespace volumen
