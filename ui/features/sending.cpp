#include <QLocale>
#include <QTemporaryDir>
#include <algorithm>
#include <set>

#include "io/archive/send_archive.h"
#include "io/export/export_segments.h"
#include "results/text/text.h"
#include "ui/controller/segment_target.h"
#include "ui/controller/segments_on_slices.h"
#include "ui/document/job_lane.h"
#include "ui/features/feature.h"
#include "ui/panels/send_dialog.h"
#include "ui/workspace/derived_text.h"

namespace volumen {

namespace {

// Images that can be sent.
struct SendOffer {
  QString text;  // which these are
  ListFiles files;
};

// Sends the series in focus with its segments, an open object, or a study or series of the study list, to an
// archive.
class Sending : public Feature {
 public:
  explicit Sending(Workbench& bench);
  QString unsavedText() const override {
    return sends_.isBusy() ? tr("images that are being sent") : QString();
  }

 private:
  void offerShown();
  void offerListed(const IndexedChoice& choice, const QString& name);
  void offerObject(const DerivedObjectPtr& object);
  void ask(const QString& name, const std::vector<SendOffer>& offers);
  void send(const QString& name, const Archive& archive, const ListFiles& files);
  void showReport(const QString& archive, const SendReport& report);

  QString last_;  // archive of the last dialog
  JobLane sends_{&bench_.document.jobs};
};

// Returns the files of an open series, or of all that is open of its study.
std::vector<std::string> openFilesOf(const OpenStudies& open, const Series& shown, bool isOfStudy) {
  std::set<std::string> files(shown.files.begin(), shown.files.end());
  const auto belongs = [&](const SeriesIdentity& each) {
    const bool isSameSeries = !shown.seriesUid.empty() && each.seriesUid == shown.seriesUid;
    return !shown.studyUid.empty() && each.studyUid == shown.studyUid && each.patientId == shown.patientId &&
           (isOfStudy || isSameSeries);
  };
  for (const Series* series : open.pictures()) {
    if (series->format != "DICOM" || !belongs(*series)) continue;
    files.insert(series->files.begin(), series->files.end());
    for (const Unread& unread : series->unread)
      if (!unread.beside) files.insert(unread.path);
  }
  for (const DerivedObjectPtr& object : open.derived())
    if (isOfStudy && belongs(*object)) files.insert(object->path);
  return {files.begin(), files.end()};
}

// Writes segments as a DICOM segmentation into a folder that is deleted with the last copy of the function.
ListFiles filesOfSegments(const std::vector<SegmentMap>& maps, const Series& series) {
  return
      [maps, series, folder = std::make_shared<const QTemporaryDir>()]() -> Result<std::vector<std::string>> {
        const auto segments = segmentedOnSlices(maps, series, {});
        if (!segments) return segments.error();
        const auto written =
            exportSegments(folder->filePath(QStringLiteral("segments.dcm")).toStdString(), *segments, series);
        if (!written) return written.error();
        return written->files;
      };
}

QString sentNumber(std::size_t number) { return QLocale().toString(qulonglong(number)); }

// Runs on the thread of a job.
Result<SendReport> sent(const Archive& archive, const ListFiles& files, const Job& job) {
  const Result<std::vector<std::string>> paths = files();
  if (!paths) return paths.error();
  const Progress progress = [&](const char*, std::size_t done, std::size_t total) {
    job.tell(Sending::tr("image %1 of %2").arg(sentNumber(done), sentNumber(total)),
             double(done) / double(total));
  };
  return sendToArchive(archive, *paths, progress, job.cancel());
}

// Returns the reason that all share; empty if there is none.
QString commonReason(const std::vector<Refused>& failed) {
  const auto isFirst = [&](const Refused& each) { return each.reason == failed[0].reason; };
  return !failed.empty() && std::ranges::all_of(failed, isFirst) ? shownText(failed[0].reason) : QString();
}

Sending::Sending(Workbench& bench) : Feature(bench) {
  bench_.addAction({"sendToArchive",
                    tr("Send to archive..."),
                    {},
                    "",
                    false,
                    [this](bool) { offerShown(); },
                    {{"fileMenu", 50, 60}}});
  connect(&bench_, &Workbench::sendRequested, this, &Sending::offerListed);
  connect(&bench_, &Workbench::objectSendRequested, this, &Sending::offerObject);
}

void Sending::offerShown() {
  const Series* shown = seriesIn(session_.workspace(), session_.workspace().focus);
  if (!shown) return warn(tr("Open a series first."));
  if (shown->curved)
    return warn(tr("A curved plane has no files to send: click a view of the series that it was made from."));
  if (shown->format != "DICOM" || shown->files.empty())
    return warn(
        tr("Archives take DICOM files only: write this series as DICOM first (volumen convert FILE FOLDER/), "
           "and open that folder."));
  const auto files = [&](bool isOfStudy) {
    return [files = openFilesOf(open_, *shown, isOfStudy)] { return Result(files); };
  };
  std::vector<SendOffer> offers{{tr("The series in the view"), files(false)},
                                {tr("All open series of its study"), files(true)}};
  const bool isSegmented = session_.series() && keyOf(session_.series()->series) == keyOf(*shown);
  const std::vector<const SegmentMap*> maps =
      isSegmented ? allSegmentsShown(session_) : std::vector<const SegmentMap*>();
  if (!maps.empty())
    offers.push_back({tr("Its segments as they are now"), filesOfSegments(copiesOf(maps), *shown)});
  ask(patientText(*shown) + QStringLiteral(", ") + studyText(*shown) + QStringLiteral(", ") +
          seriesText(*shown),
      offers);
}

void Sending::offerObject(const DerivedObjectPtr& object) {
  ask(patientText(*object) + QStringLiteral(", ") + derivedName(*object),
      {{tr("This object"), [path = object->path] { return Result(std::vector<std::string>{path}); }}});
}

void Sending::offerListed(const IndexedChoice& choice, const QString& name) {
  const StudySource& source = bench_.document.sources.current();
  std::vector<SendOffer> offers{{tr("The whole study"), source.filesOf({choice.study, 0})}};
  if (choice.series != 0) offers.insert(offers.begin(), {tr("This series"), source.filesOf(choice)});
  ask(name, offers);
}

void Sending::ask(const QString& name, const std::vector<SendOffer>& offers) {
  const Result<Archives> archives = readArchives(userArchivesFile());
  if (!archives) return warn(QString::fromStdString(archives.message()));
  if (archives->archives.empty())
    return warn(tr("No archive is set up: add one in Edit > Preferences > Edit archives."));
  QStringList choices;
  for (const SendOffer& offer : offers) choices << offer.text;
  auto* dialog = new SendDialog(name, choices, *archives, last_, bench_.dialogParent());
  connect(dialog, &QDialog::accepted, this, [this, dialog, name, offers, archives] {
    const Archive& archive = archives->archives[std::size_t(dialog->archive())];
    last_ = QString::fromStdString(archive.name);
    send(name, archive, offers[std::size_t(dialog->choice())].files);
  });
  dialog->open();
}

void Sending::send(const QString& name, const Archive& archive, const ListFiles& files) {
  takeBack();
  sends_.run(
      JobName(tr("Sending"), name), [archive, files](const Job& job) { return sent(archive, files, job); },
      [this, archive = QString::fromStdString(archive.name)](const Result<SendReport>& report) {
        if (!report) return warnUntilDone(QString::fromStdString(report.message()));
        showReport(archive, *report);
      });
}

void Sending::showReport(const QString& archive, const SendReport& report) {
  QStringList sentences{
      tr("Sent %1 of %2 images to %3.")
          .arg(sentNumber(std::size_t(report.sent)), sentNumber(std::size_t(report.instances)), archive)};
  if (report.failed.empty() && report.notDicom.empty()) return tell(sentences[0]);
  sentences << commonReason(report.failed);
  if (report.notDicom.size() == 1) sentences << tr("1 file holds no image to send.");
  if (report.notDicom.size() > 1)
    sentences << tr("%1 files hold no image to send.").arg(sentNumber(report.notDicom.size()));
  std::vector<Refused> lost = report.failed;
  lost.insert(lost.end(), report.notDicom.begin(), report.notDicom.end());
  sentences.removeAll(QString());
  warnUntilDone(sentences.join(QLatin1Char(' ')), refusedTexts(lost));
}

}  // namespace

std::unique_ptr<Feature> makeSending(Workbench& bench) { return std::make_unique<Sending>(bench); }

}  // namespace volumen
