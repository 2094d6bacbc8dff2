#include "ui/controller/autosave.h"

#include <QCoreApplication>
#include <QDir>
#include <QFileInfo>
#include <QRandomGenerator>
#include <QStandardPaths>

#include "io/files/session_file.h"
#include "ui/controller/open_session.h"
#include "ui/controller/segment_files.h"
#include "ui/workspace/session_json.h"

namespace volumen {

namespace {

constexpr int keepWithinMs = 1000;  // and the time to write it, on a slow disk
constexpr int keepAsideDays = 7;
const QString asideTime =
    QStringLiteral("yyyyMMddHHmmss");  // UTC, what the name of a discarded one begins with

QString asideFolder() { return Autosave::folder() + QStringLiteral("/discarded"); }

// Paths may name patients.
void makePrivate(const QString& folder) {
  QDir().mkpath(folder);
  QFile::setPermissions(folder, QFile::ReadOwner | QFile::WriteOwner | QFile::ExeOwner);
}

QString lockOf(const QString& path) { return path + QStringLiteral(".lock"); }

// With the lock, and with what was being written when the program was killed.
void removeKept(const QString& path) {
  const QFileInfo file(path);
  for (const QString& name : file.dir().entryList({file.fileName() + QStringLiteral("*")}, QDir::Files))
    file.dir().remove(name);
}

QString savedAsOf(const QString& path) {
  const auto text = sessionText(path.toStdString());
  if (!text) return {};
  const auto session = sessionFromJson(*text, {});
  return session ? QString::fromStdString(session->savedAs) : QString();
}

void moveAside(const QString& path) {
  makePrivate(asideFolder());
  const QString aside = QStringLiteral("%1/%2-%3")
                            .arg(asideFolder(), QDateTime::currentDateTimeUtc().toString(asideTime),
                                 QFileInfo(path).fileName());
  const QStringList segments = segmentFilesOf(path);
  if (!QFile::rename(path, aside)) return;
  for (const QString& file : segments) QFile::rename(file, aside + file.mid(path.size()));
  removeKept(path);
}

// The latest first; those that are too old go.
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
      all.push_back({file.filePath(), savedAsOf(file.filePath()), file.lastModified(), nullptr});
  }
  return all;
}

// The latest that no running program holds.
std::optional<LostSession> latestLost() {
  const QDir dir(Autosave::folder());
  for (const QFileInfo& file : dir.entryInfoList({QStringLiteral("*.volumen")}, QDir::Files, QDir::Time)) {
    const QString path = file.filePath();
    if (auto lock = LockFile::take(lockOf(path).toStdString()))
      return LostSession{path, savedAsOf(path), file.lastModified(),
                         std::make_shared<LockFile>(std::move(*lock))};
  }
  return {};
}

// Shown as `shown` is: all maps of a series are alike in that.
SegmentMap withLookOf(const SegmentMap& shown, SegmentMap map) {
  map.in3d = shown.in3d;
  map.tissue = shown.tissue;
  return map;
}

// With segments as they were kept last; those that never were are only named.
Workspace withSegmentsKept(const Workspace& workspace, const SharedList<SegmentMap>& kept) {
  Workspace made = withLabelsApart(workspace);
  for (const SegmentMap& map : kept)
    made.segmentMaps.editIf(
        [&](const SegmentMap& other) { return other.series == map.series && other.number == map.number; },
        [&](SegmentMap& other) { other = withLookOf(other, map); });
  return made;
}

}  // namespace

// The file of this program, under a name that no other takes.
class Autosave::File {
 public:
  Status write(const Workspace& workspace, const std::string& savedAs) {
    if (!lock_) {
      makePrivate(folder());
      lock_ = LockFile::take(lockOf(path_).toStdString());
    }
    const std::string path = path_.toStdString();
    const Workspace wanted = withClosed(workspace);
    const Status whole = saveSession(path, wanted, savedAs, LabelFiles::changes);
    // Where there is no room for the labels of segments the rest is kept all the same.
    if (whole)
      segments_ = wanted.segmentMaps;
    else
      (void)saveSession(path, withSegmentsKept(wanted, segments_), savedAs, LabelFiles::changes);
    return whole;
  }

  void putAside() {
    if (!lock_) return;
    moveAside(path_);
    lock_.reset();
  }

  void remove() {
    if (!lock_) return;
    removeKept(path_);
    segments_.clear();
    lock_.reset();
  }

 private:
  const QString path_ = QStringLiteral("%1/%2-%3.volumen")
                            .arg(folder())
                            .arg(QCoreApplication::applicationPid())
                            .arg(QRandomGenerator::system()->generate64(), 16, 16, QLatin1Char('0'));
  std::optional<LockFile> lock_;
  SharedList<SegmentMap> segments_;  // as they were kept last
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
  const auto note = [this] {
    if (!timer_.isActive()) timer_.start();
  };
  connect(&session_, &Session::workspaceChanged, this, note);
  connect(&files_, &SessionFiles::changed, this, note);
}

Autosave::~Autosave() {
  lane_.wait();
  const bool stays = atEnd_ != AtEnd::usual || !files_.path().isEmpty();
  if (!stays || !wanted()) {
    file_->remove();
    return;
  }
  (void)file_->write(session_.workspace(), files_.path().toStdString());
  if (atEnd_ == AtEnd::aside) file_->putAside();
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
      [this, workspace = session_.workspace(), savedAs = files_.path().toStdString()](const Job&) {
        return file_->write(workspace, savedAs);
      },
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
      {}, [lost](const Job&) { moveAside(lost.path); }, [] {});
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
