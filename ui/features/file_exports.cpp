#include <QTemporaryDir>

#include "io/study/faces.h"
#include "results/text/text.h"
#include "ui/controller/segment_target.h"
#include "ui/exports/flat_pictures.h"
#include "ui/exports/hand_over.h"
#include "ui/features/exporting.h"
#include "ui/panels/export_dialog.h"
#include "ui/views/view_grid.h"
#include "ui/workspace/derived_text.h"

namespace volumen {

namespace {

constexpr int picturesOfTurn = 36;

// Exports files to a folder or an archive: the series in focus, what was made of it, an open object, or a
// study or series of the study list.
class FileExports : public ExportFeature {
 public:
  explicit FileExports(Workbench& bench);
  QString unsavedText() const override {
    return lane_.isBusy() ? tr("files that are being exported") : ExportFeature::unsavedText();
  }

 private:
  void offerShown(const QString& archive);
  void offerListed(const IndexedChoice& choice, const QString& name);
  void offerObject(const DerivedObjectPtr& object);
  void addOfView(std::vector<FileOffer>& offers, const Series& shown) const;
  SnapshotRequest snapshot(int pictures) const;
  std::optional<Archives> knownArchives();
  void ask(const QString& name, const std::vector<FileOffer>& offers, const QString& archive);
  void begin(const QString& name, const FileOffer& offer, const ExportTarget& target, bool namesHidden);
  void draw(const QString& name, const FileOffer& offer, const ExportTarget& target, bool namesHidden);
  void handOn(const QString& name, const FileOffer& offer, const ExportTarget& target);

  QString last_;  // archive of the last dialog
  JobLane lane_{&bench_.document.jobs};
};

FileExports::FileExports(Workbench& bench) : ExportFeature(bench) {
  const auto add = [&](const char* name, const QString& text, int order, const std::function<void()>& run) {
    bench_.addAction({name, text, {}, "", false, [run](bool) { run(); }, {{"fileMenu", 50, order}}});
  };
  add("exportFiles", tr("Export..."), 55, [this] { offerShown({}); });
  add("sendToArchive", tr("Send to archive..."), 60, [this] {
    const auto archives = knownArchives();
    if (archives) offerShown(QString::fromStdString(archives->archives[0].name));
  });
  connect(&bench_, &Workbench::sendRequested, this, &FileExports::offerListed);
  connect(&bench_, &Workbench::objectSendRequested, this, &FileExports::offerObject);
}

// Returns nothing, after reporting why, if archives cannot be read or there is none.
std::optional<Archives> FileExports::knownArchives() {
  const Result<Archives> archives = readArchives(userArchivesFile());
  if (archives && !archives->archives.empty()) return *archives;
  warn(archives ? tr("No archive is set up: add one in Edit > Preferences > Edit archives.")
                : QString::fromStdString(archives.message()));
  return {};
}

void FileExports::offerShown(const QString& archive) {
  const Series* shown = seriesIn(session_.workspace(), session_.workspace().focus);
  if (!shown) return warn(tr("Open a series first."));
  if (shown->curved)
    return warn(
        tr("A curved plane has no files to export: click a view of the series that it was made from."));
  if (shown->format != "DICOM" || shown->files.empty())
    return warn(
        tr("Archives take DICOM files only: write this series as DICOM first (volumen convert FILE FOLDER/), "
           "and open that folder."));
  const bool isSegmented = session_.series() && keyOf(session_.series()->series) == keyOf(*shown);
  const std::vector<const SegmentMap*> maps =
      isSegmented ? allSegmentsShown(session_) : std::vector<const SegmentMap*>();
  std::vector<FileOffer> offers = offersOf(*shown, copiesOf(maps), session_, open_);
  addOfView(offers, *shown);
  ask(patientText(*shown) + QStringLiteral(", ") + studyText(*shown) + QStringLiteral(", ") +
          seriesText(*shown),
      offers, archive);
}

// Adds the picture of the view in focus, slices like it or a turn of a 3D view, as they are now.
void FileExports::addOfView(std::vector<FileOffer>& offers, const Series& shown) const {
  FileOffer offer{tr("The picture in the view"), QStringLiteral("picture")};
  offer.series = shown;
  offer.tags.seriesNumber = nextSeriesNumber(openStudyOf(open_, shown), shown.studyUid);
  if (auto* flat = qobject_cast<FlatView*>(grid_.viewShown()); flat && flat->shown()) {
    offer.tags.description = "Picture of a slice";
    offer.tags.showsFace = false;
    offer.pictures = [this, size = flat->size(),
                      now = heldNow({session_.workspace(), flat->id()}, session_)](bool isHidden) {
      PictureLook look;
      look.seen = size;
      look.namesHidden = isHidden;
      const HidingNames hiding(isHidden);
      return flatPictures(grid_, {now}, look);
    };
    offers.push_back(offer);
    const auto plane = flat->plane();
    if (plane && showsSlices(flat->state().kind))
      offers.push_back(offerOfSlices(flat->shown(), *plane, offer.tags.seriesNumber));
    if (const auto window = flat->windowShown())
      offers.push_back(offerOfPresentation(shown, window, session_, open_));
  }
  if (!qobject_cast<VolumeView*>(grid_.viewShown()) || !session_.series()) return;
  offer.tags.description = "Volume rendering";
  offer.tags.hasNames = false;
  offer.tags.showsFace = showsFaceIn3d(shown);
  const auto rendered = [this](const SnapshotRequest& request) {
    return [this, request](bool) { return picturesOf(request); };
  };
  offer.pictures = rendered(snapshot(1));
  offers.push_back(offer);
  offer.text = tr("A full turn in %1 pictures").arg(picturesOfTurn);
  offer.name = QStringLiteral("turn");
  offer.tags.description = "Volume rendering, a full turn";
  offer.frames = picturesOfTurn;
  offer.pictures = rendered(snapshot(picturesOfTurn));
  offers.push_back(offer);
}

SnapshotRequest FileExports::snapshot(int pictures) const {
  constexpr QSize ofTurn(512, 512);
  SnapshotRequest request;
  request.seen = sceneNow(true);
  request.size = pictures > 1 ? ofTurn : bench_.view()->pixels();
  request.quality = Quality::standard;
  request.shown.letters = true;
  request.pictures = pictures;
  return request;
}

void FileExports::offerObject(const DerivedObjectPtr& object) {
  const auto archives = knownArchives();
  if (!archives) return;
  const auto make = [path = object->path](const QString&, const Job&) {
    return Result(LeavingFiles{{path}});
  };
  ask(patientText(*object) + QStringLiteral(", ") + derivedName(*object),
      {{tr("This object"), QStringLiteral("object"), make}},
      QString::fromStdString(archives->archives[0].name));
}

void FileExports::offerListed(const IndexedChoice& choice, const QString& name) {
  const auto archives = knownArchives();
  if (!archives) return;
  const StudySource& source = bench_.document.sources.current();
  const auto offer = [](const QString& text, const char* file, const ListFiles& files) {
    const auto make = [files](const QString&, const Job&) -> Result<LeavingFiles> {
      const auto paths = files();
      if (!paths) return paths.error();
      return LeavingFiles{*paths};
    };
    FileOffer listed{text, QString::fromLatin1(file), make};
    listed.hasFace = true;  // what it shows is known when its files are read
    return listed;
  };
  std::vector<FileOffer> offers{offer(tr("The whole study"), "study", source.filesOf({choice.study, 0}))};
  if (choice.series != 0)
    offers.insert(offers.begin(), offer(tr("This series"), "series", source.filesOf(choice)));
  ask(name, offers, QString::fromStdString(archives->archives[0].name));
}

void FileExports::ask(const QString& name, const std::vector<FileOffer>& offers, const QString& archive) {
  Result<Archives> archives = readArchives(userArchivesFile());
  if (!archives) archives = Archives();
  std::vector<ExportChoice> choices;
  for (const FileOffer& one : offers)
    choices.push_back({one.text, one.pictures && one.tags.hasNames, one.hasFace});
  auto* dialog =
      new ExportDialog(name, choices, *archives, last_.isEmpty() || archive.isEmpty() ? archive : last_,
                       session_.preferences().exportsWithoutIdentity, bench_.dialogParent());
  connect(dialog, &QDialog::accepted, this, [this, dialog, name, offers, archives] {
    const FileOffer& offer = offers[std::size_t(dialog->choice())];
    ExportTarget target{{}, {}, dialog->deidentified(), dialog->faceless()};
    session_.prefer([on = target.deidentified](Preferences& p) { p.exportsWithoutIdentity = on; });
    const bool isHidden = dialog->namesHidden();
    if (dialog->archive() >= 0) {
      target.archive = archives->archives[std::size_t(dialog->archive())];
      last_ = QString::fromStdString(target.archive->name);
      return begin(name, offer, target, isHidden);
    }
    askForPath({"exportFolderDialog", tr("Export into the folder"), {}, {}, QFileDialog::Directory},
               [this, name, offer, target, isHidden](const QString& folder) {
                 ExportTarget there = target;
                 there.folder = folder;
                 begin(name, offer, there, isHidden);
               });
  });
  dialog->open();
}

void FileExports::begin(const QString& name, const FileOffer& offer, const ExportTarget& target,
                        bool namesHidden) {
  takeBack();
  offer.pictures ? draw(name, offer, target, namesHidden) : handOn(name, offer, target);
}

// Draws the pictures of an offer into a file, which is then handed on.
void FileExports::draw(const QString& name, const FileOffer& offer, const ExportTarget& target,
                       bool namesHidden) {
  const auto folder = std::make_shared<const QTemporaryDir>();
  const QString path = folder->filePath(offer.name + QStringLiteral(".dcm"));
  CaptureTags tags = offer.tags;
  tags.hasNames = tags.hasNames && !namesHidden;
  PictureSink sink = captureFile(path, offer.series, tags, offer.frames);
  sink.finish = [this, finish = sink.finish, name, offer, target, folder, path](std::size_t count) {
    Result<QString> drawn = finish(count);
    if (!drawn) return drawn;
    FileOffer made{offer.text, offer.name};
    made.make = [folder, path](const QString&, const Job&) {
      return Result(LeavingFiles{{path.toStdString()}});
    };
    QMetaObject::invokeMethod(this, [this, name, made, target] { handOn(name, made, target); });
    return Result<QString>(tr("The pictures are drawn."));
  };
  run({JobName(tr("Drawing"), offer.text), offer.pictures(namesHidden), sink});
}

void FileExports::handOn(const QString& name, const FileOffer& offer, const ExportTarget& target) {
  const auto work = [offer, target](const Job& job) -> Result<HandedOver> {
    const QTemporaryDir folder;
    const auto files = offer.make(folder.path(), job);
    if (!files) return files.error();
    return handOver(*files, offer.name, target, job);
  };
  lane_.run(JobName(target.archive ? tr("Sending") : tr("Exporting"), name), work,
            [this](const Result<HandedOver>& done) {
              if (!done) return warnUntilDone(QString::fromStdString(done.message()));
              if (done->details.isEmpty()) return tell(done->sentence);
              warnUntilDone(done->sentence, done->details);
            });
}

}  // namespace

std::unique_ptr<Feature> makeFileExports(Workbench& bench) { return std::make_unique<FileExports>(bench); }

}  // namespace volumen
