#include "ui/controller/autosave.h"

#include <QCoreApplication>
#include <QDir>
#include <QFileInfo>
#include <QRandomGenerator>
#include <QStandardPaths>

#include "io/files/session_file.h"
#include "ui/controller/open_session.h"
#include "ui/controller/segment_files.h"

namespace volumen {

namespace {

constexpr int keepWithinMs = 1000;  // plus the time to write it, on a slow disk
constexpr int playedRestMs = 5000;  // playback is saved once it rests
constexpr int keepAsideDays = 7;
const QString asideTime =
    QStringLiteral("yyyyMMddHHmmss");  // UTC; the name of a discarded file begins with it

QString asideFolder() { return Autosave::folder() + QStringLiteral("/discarded"); }

// Paths may name patients.
void makePrivate(const QString& folder) {
  QDir().mkpath(folder);
  QFile::setPermissions(folder, QFile::ReadOwner | QFile::WriteOwner | QFile::ExeOwner);
}

QString lockOf(const QString& path) { return path + QStringLiteral(".lock"); }

// Removes a file with its lock and with partial files of a killed program.
void removeKept(const QString& path) {
  const QFileInfo file(path);
  for (const QString& name : file.dir().entryList({file.fileName() + QStringLiteral("*")}, QDir::Files))
    file.dir().remove(name);
}

// Reads the lost session of a file; data that the file lacks stay empty.
LostSession lostIn(const QFileInfo& file, std::shared_ptr<LockFile> lock) {
  LostSession lost{file.filePath(), {}, file.lastModified(), std::move(lock)};
  const auto text = sessionText(lost.path.toStdString());
  if (!text) return lost;
  auto session = sessionFromJson(*text, {});
  if (!session) return lost;
  lost.savedAs = QString::fromStdString(session->savedAs);
  lost.patients = std::move(session->patients);
  return lost;
}

// Moves all files or none. The session itself comes last, because without it the others are not found.
Status moveAside(const QString& path) {
  if (!QFile::exists(path)) return {};
  makePrivate(asideFolder());
  const QString aside = QStringLiteral("%1/%2-%3")
                            .arg(asideFolder(), QDateTime::currentDateTimeUtc().toString(asideTime),
                                 QFileInfo(path).fileName());
  const auto placeOf = [&](const QString& file) { return aside + file.mid(path.size()); };
  QStringList all = segmentFilesOf(path), moved;
  all << path;
  for (const QString& file : all) {
    if (QFile::rename(file, placeOf(file))) {
      moved << file;
      continue;
    }
    for (const QString& back : moved) QFile::rename(placeOf(back), back);
    return Error{"What was not saved stays in " + path.toStdString() + ": it cannot be moved to " +
                 asideFolder().toStdString() + "."};
  }
  removeKept(path);
  return {};
}

// Returns the discarded files, latest first, and removes those that are too old.
std::vector<LostSession> discarded() {
  std::vector<LostSession> all;
  const QDir dir(asideFolder());
  const QDateTime now = QDateTime::currentDateTimeUtc();
  for (const QFileInfo& file :
       dir.entryInfoList({QStringLiteral("*.volumen")}, QDir::Files, QDir::Name | QDir::Reversed)) {
    QDateTime at = QDateTime::fromString(file.fileName().left(asideTime.size()), asideTime);
    at.setTimeSpec(Qt::UTC);
    if (!at.isValid() || at.daysTo(now) > keepAsideDays)
      removeKept(file.filePath());
    else
      all.push_back(lostIn(file, nullptr));
  }
  return all;
}

// Returns the latest file that no running program has locked.
std::optional<LostSession> latestLost() {
  const QDir dir(Autosave::folder());
  for (const QFileInfo& file : dir.entryInfoList({QStringLiteral("*.volumen")}, QDir::Files, QDir::Time))
    if (auto lock = LockFile::take(lockOf(file.filePath()).toStdString()))
      return lostIn(file, std::make_shared<LockFile>(std::move(*lock)));
  return {};
}

// Returns `map` displayed like `shown`, because all maps of a series share these settings.
SegmentMap withLookOf(const SegmentMap& shown, SegmentMap map) {
  map.in3d = shown.in3d;
  map.tissue = shown.tissue;
  return map;
}

// Returns the workspace with segments as last saved; maps never saved are only named.
Workspace withSegmentsKept(const Workspace& workspace, const SharedList<SegmentMap>& kept) {
  Workspace made = withLabelsApart(workspace);
  for (const SegmentMap& map : kept)
    made.segmentMaps.editIf(
        [&](const SegmentMap& other) { return other.series == map.series && other.number == map.number; },
        [&](SegmentMap& other) { other = withLookOf(other, map); });
  return made;
}

}  // namespace

// The file of this program, under a unique name.
class Autosave::File {
 public:
  Status write(const Workspace& workspace, const SessionFiles& files) {
    return write(workspace, files.path().toStdString(), files.savedWork());
  }

  Status write(const Workspace& workspace, const std::string& savedAs, const HandWork& saved) {
    if (!lock_) {
      makePrivate(folder());
      lock_ = LockFile::take(lockOf(path_).toStdString());
    }
    const std::string path = path_.toStdString();
    const Workspace wanted = withClosed(workspace);
    const Status whole = keepSession(path, wanted, savedAs, saved);
    // If there is no room for the labels of segments, the rest is saved anyway.
    if (whole)
      segments_ = wanted.segmentMaps;
    else
      (void)keepSession(path, withSegmentsKept(wanted, segments_), savedAs, saved);
    return whole;
  }

  Status putAside() {
    if (!lock_) return {};
    const Status moved = moveAside(path_);
    release();
    return moved;
  }

  void remove() {
    if (!lock_) return;
    removeKept(path_);
    release();
  }

 private:
  void release() {
    forgetLabelChanges(path_.toStdString());
    segments_.clear();
    lock_.reset();
  }

  const QString path_ = QStringLiteral("%1/%2-%3.volumen")
                            .arg(folder())
                            .arg(QCoreApplication::applicationPid())
                            .arg(QRandomGenerator::system()->generate64(), 16, 16, QLatin1Char('0'));
  std::optional<LockFile> lock_;
  SharedList<SegmentMap> segments_;  // as last saved
};

QString Autosave::folder() {
  return QStandardPaths::writableLocation(QStandardPaths::GenericDataLocation) +
         QStringLiteral("/volumen/autosave");
}

Autosave::Autosave(const Session& session, const SessionFiles& files, QObject* parent)
    : QObject(parent), session_(session), files_(files), file_(std::make_unique<File>()) {
  timer_.setSingleShot(true);
  timer_.setInterval(keepWithinMs);
  connect(&timer_, &QTimer::timeout, this, &Autosave::write);
  played_.setSingleShot(true);
  played_.setInterval(playedRestMs);
  connect(&played_, &QTimer::timeout, this, &Autosave::noteChange);
  connect(&session_, &Session::workspaceChanged, this,
          [this](const Workspace& before, const Workspace& after) {
            const bool isPlayed = session_.playsOn() && before.segmentMaps == after.segmentMaps;
            if (isPlayed)
              played_.start();
            else if (before != after)
              noteChange();
          });
  connect(&files_, &SessionFiles::changed, this, &Autosave::noteChange);
}

Autosave::~Autosave() {
  lane_.wait();
  const bool stays = atEnd_ != AtEnd::usual || !files_.path().isEmpty();
  if (!stays || !wanted()) {
    file_->remove();
    return;
  }
  // If writing or moving fails, the last saved state is offered.
  const Status kept = file_->write(session_.workspace(), files_);
  if (kept && atEnd_ == AtEnd::aside) (void)file_->putAside();
}

void Autosave::noteChange() {
  if (!timer_.isActive()) timer_.start();
}

Status Autosave::keepNow() {
  lane_.wait();
  if (!wanted()) return {};
  return file_->write(session_.workspace(), files_);
}

bool Autosave::wanted() const { return files_.modified() || !files_.unsavedWork().empty(); }

void Autosave::write() {
  if (writing_) return timer_.start();
  writing_ = true;
  if (!wanted())
    return void(lane_.run(
        {}, [this](const Job&) { file_->remove(); }, [this] { written({}); }));
  lane_.run(
      {},
      [this, workspace = session_.workspace(), savedAs = files_.path().toStdString(),
       saved = files_.savedWork()](const Job&) { return file_->write(workspace, savedAs, saved); },
      [this](const Status& status) { written(status); });
}

void Autosave::written(const Status& status) {
  writing_ = false;
  if (!status && !failing_) Q_EMIT failed(QString::fromStdString(status.message()));
  failing_ = !status;
  if (!status || !replaced_) return;
  lane_.run(
      {}, [lost = *std::exchange(replaced_, {})](const Job&) { removeKept(lost.path); }, [] {});
  list();
}

void Autosave::look() {
  lane_.run(
      {}, [](const Job&) { return latestLost(); },
      [this](const std::optional<LostSession>& lost) {
        if (lost) Q_EMIT found(*lost);
      });
  list();
}

void Autosave::discard(const LostSession& lost) {
  lane_.run(
      {}, [lost](const Job&) { return moveAside(lost.path); },
      [this](const Status& moved) {
        if (!moved) Q_EMIT failed(QString::fromStdString(moved.message()));
      });
  look();
}

void Autosave::replace(const LostSession& lost) {
  replaced_ = lost;
  if (!timer_.isActive()) timer_.start();
}

void Autosave::list() {
  lane_.run(
      {}, [](const Job&) { return discarded(); },
      [this](const std::vector<LostSession>& all) { Q_EMIT listed(all); });
}

}  // namespace volumen
