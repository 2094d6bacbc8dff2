#include <QDir>
#include <QFileDialog>
#include <QStandardPaths>
#include <QTemporaryDir>
#include <algorithm>

#include "io/files/picture_file.h"
#include "ui/features/feature.h"
#include "ui/overlays/slice_sheet.h"
#include "ui/panels/picture_dialog.h"
#include "ui/views/picture_run.h"
#include "ui/views/view_grid.h"
#include "ui/workspace/frame_look.h"
#include "ui/workspace/series_text.h"
#include "ui/workspace/text.h"
#include "ui/workspace/view_window.h"
#include "viewer/volume/free_name.h"

namespace volumen {

namespace {

// Exports pictures of the slice or frame in focus: one of any size, its whole stack, or a contact sheet.
class PictureFiles : public Feature {
 public:
  explicit PictureFiles(Workbench& bench);

  QString unsavedText() const override;

 private:
  // The chosen options and the views at that moment.
  struct Wanted {
    PicturesOf of;
    PictureLook look;
    std::vector<NumberedPlace> places;
    int columns;
    bool hasHead;
    std::vector<PictureStop> stops;
    QString name;
  };

  void ask(PicturesOf of);
  void askWhere(const Wanted& wanted);
  void write(const Wanted& wanted, const QString& path);
  void writeOne(const Wanted& wanted, const QString& path);
  void writeStack(const Wanted& wanted, const QString& folder);
  void writeSheet(const Wanted& wanted, const QString& path);
  void run(const Wanted& wanted, const PictureRun::Keep& keep, const PictureRun::Finish& finish,
           const std::function<QString()>& saved);
};

Status writeMade(const MadePicture& made, const QImage& image, const QString& path) {
  PictureText text{{"Software", "volumen " VOLUMEN_VERSION}, {"Comment", "Not for clinical use"}};
  if (!made.warnings.isEmpty())
    text.emplace_back("volumen-warnings", made.warnings.join(QLatin1Char('\n')).toStdString());
  return writeImage(image.convertToFormat(QImage::Format_RGB888), path.toStdString(), text);
}

// Returns a file name without extension.
QString fileName(const Series& series, bool namesHidden) {
  constexpr int longest = 80;
  const HidingNames hiding(namesHidden);
  return seriesText(series).replace(QLatin1Char('/'), QLatin1Char('_')).left(longest);
}

// Returns whether all pictures of the view share one window.
bool sharesWindow(const PictureStop& stop) {
  const ViewState& view = stop.workspace.view(stop.view);
  const SeriesState state = seriesStateIn(stop.workspace, stop.view);
  return !showsFrames(view.kind) || state.window || !hasOwnWindows(state, *state.series);
}

// Returns the position in the stack, such as "12 / 31" or "Frame 3 / 10".
QString numberText(const MadePicture& made) {
  for (const QString& line : made.overlays.topRight)
    if (line.contains(QStringLiteral(" / "))) return line;
  return {};
}

// Returns the path of a folder that does not exist yet.
QString freeFolder(const QString& parent, const QString& name) {
  const auto pathOf = [&](const std::string& one) {
    return parent + QLatin1Char('/') + QString::fromStdString(one);
  };
  return pathOf(
      freeName(name.toStdString(), [&](const std::string& one) { return QFileInfo::exists(pathOf(one)); }));
}

PictureFiles::PictureFiles(Workbench& bench) : Feature(bench) {
  bench_.addMenu("picturesMenu", tr("More pictures"), {{"fileMenu", 50, 30}});
  const auto add = [this](const char* name, const QString& text, PicturesOf of) {
    bench_.addAction({name, text, {}, "", false, [this, of](bool) { ask(of); }, {{"picturesMenu", 10}}});
  };
  add("saveSizedPicture", tr("Picture of any size..."), PicturesOf::view);
  add("saveStack", tr("Stack as pictures..."), PicturesOf::stack);
  add("saveSheet", tr("Contact sheet..."), PicturesOf::sheet);
}

QString PictureFiles::unsavedText() const {
  const bool any = std::ranges::any_of(findChildren<PictureRun*>(),
                                       [](const PictureRun* run) { return !run->hasEnded(); });
  return any ? tr("pictures that are being written") : QString();
}

void PictureFiles::ask(PicturesOf of) {
  if (session_.workspace().series.empty()) return warn(tr("Open a series first."));
  auto* flat = qobject_cast<FlatView*>(grid_.viewShown());
  if (!flat || !flat->shown())
    return warn(tr("Click a slice or a frame first. 3D pictures of any size: File > Save 3D snapshot."));
  auto* dialog =
      new PictureDialog(of, flat->numberedPlaces(), flat->numberCount(), flat->size(), bench_.dialogParent());
  // Uses the view as it is now, whatever happens while the dialog is open.
  const LoadedSeriesPtr shown = flat->shown();
  const PictureStop now = heldNow({session_.workspace(), flat->id()}, session_);
  const auto accept = [this, of, dialog, shown, now] {
    Wanted wanted{of,
                  dialog->look(),
                  of == PicturesOf::view ? std::vector<NumberedPlace>() : dialog->places(),
                  dialog->columns(),
                  dialog->withTexts(),
                  {},
                  fileName(*seriesIn(now.workspace, now.view), dialog->look().namesHidden)};
    for (const NumberedPlace& each : wanted.places)
      wanted.stops.push_back(
          {withPlace(now.workspace, now.view, *shown, each.place), now.view, now.held, now.preferences});
    if (of == PicturesOf::view) wanted.stops.push_back(now);
    askWhere(wanted);
  };
  connect(dialog, &QDialog::accepted, this, accept);
  dialog->open();
}

void PictureFiles::askWhere(const Wanted& wanted) {
  const bool isFolder = wanted.of == PicturesOf::stack;
  auto* dialog = new QFileDialog(
      bench_.dialogParent(), isFolder ? tr("Put a folder of pictures into") : tr("Save the picture"),
      QStandardPaths::writableLocation(QStandardPaths::PicturesLocation),
      isFolder ? QString() : tr("PNG pictures (*.png);;JPEG pictures (*.jpg *.jpeg)"));
  dialog->setObjectName(QStringLiteral("pictureFilesDialog"));
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  if (isFolder) {
    dialog->setFileMode(QFileDialog::Directory);
    dialog->setOption(QFileDialog::ShowDirsOnly);
  } else {
    dialog->setAcceptMode(QFileDialog::AcceptSave);
    dialog->setDefaultSuffix(QStringLiteral("png"));
    dialog->selectFile(wanted.name + QStringLiteral(".png"));
  }
  connect(dialog, &QFileDialog::fileSelected, this,
          [this, wanted](const QString& path) { write(wanted, path); });
  dialog->open();
}

void PictureFiles::write(const Wanted& wanted, const QString& path) {
  switch (wanted.of) {
    case PicturesOf::view:
      return writeOne(wanted, path);
    case PicturesOf::stack:
      return writeStack(wanted, path);
    case PicturesOf::sheet:
      return writeSheet(wanted, path);
  }
}

void PictureFiles::run(const Wanted& wanted, const PictureRun::Keep& keep, const PictureRun::Finish& finish,
                       const std::function<QString()>& saved) {
  auto* run = new PictureRun(grid_, session_, bench_.document.jobs, tr("Saving pictures"), wanted.stops,
                             wanted.look, this);
  connect(run, &PictureRun::ended, this, [this, saved](const QString& failure) {
    if (failure.isEmpty())
      tell(saved());
    else
      warnUntilDone(failure);
  });
  run->start(keep, finish);
}

void PictureFiles::writeOne(const Wanted& wanted, const QString& path) {
  const auto made = std::make_shared<MadePicture>();
  run(
      wanted,
      [made](std::size_t, const MadePicture& picture) {
        *made = picture;
        return Status();
      },
      [made, path] { return writeMade(*made, made->image, path); },
      [path] { return tr("Saved %1").arg(path); });
}

// Writes to a temporary folder first, so that an existing folder is always complete. Its subfolder has the
// usual permissions.
void PictureFiles::writeStack(const Wanted& wanted, const QString& folder) {
  const auto aside = std::make_shared<QTemporaryDir>(folder + QStringLiteral("/.volumen-XXXXXX"));
  const QString pictures = aside->filePath(QStringLiteral("pictures"));
  if (!aside->isValid() || !QDir().mkdir(pictures))
    return warnUntilDone(tr("Cannot write into %1: choose another folder.").arg(folder));
  const auto made = std::make_shared<QString>();
  run(
      wanted,
      [aside, pictures, name = wanted.name, places = wanted.places](std::size_t n,
                                                                    const MadePicture& picture) {
        const QString number = QStringLiteral("%1").arg(places[n].number, 4, 10, QLatin1Char('0'));
        return writeMade(picture, picture.image, QStringLiteral("%1/%2-%3.png").arg(pictures, name, number));
      },
      [aside, pictures, made, folder, name = wanted.name] {
        const QString target = freeFolder(folder, name);
        if (!QDir().rename(pictures, target))
          return Status(Error{tr("Cannot write %1: choose another folder.").arg(target).toStdString()});
        *made = target;
        return Status();
      },
      [made, count = wanted.places.size()] {
        return count == 1 ? tr("Saved 1 picture in %1").arg(*made)
                          : tr("Saved %1 pictures in %2").arg(count).arg(*made);
      });
}

void PictureFiles::writeSheet(const Wanted& wanted, const QString& path) {
  struct Made {
    std::unique_ptr<SliceSheet> sheet;
    MadePicture first;
  };
  const auto made = std::make_shared<Made>();
  const int count = int(wanted.places.size()), columns = std::min(wanted.columns, count);
  run(
      wanted,
      [made, columns, rows = (count + columns - 1) / columns, hasHead = wanted.hasHead,
       isShared = sharesWindow(wanted.stops.front())](std::size_t n, const MadePicture& picture) {
        if (n == 0) {
          QStringList head = picture.overlays.topLeft;
          if (isShared && !picture.overlays.bottomRight.isEmpty()) head << picture.overlays.bottomRight;
          made->sheet = std::make_unique<SliceSheet>(rows, columns, picture.image.size(),
                                                     hasHead ? head : QStringList());
          made->first = picture;
        }
        made->sheet->add(picture.image, hasHead ? numberText(picture) : QString(),
                         hasHead ? picture.overlays.left : QString(),
                         hasHead ? picture.mmPerPixel.value_or(0) : 0);
        return Status();
      },
      [made, path] { return writeMade(made->first, made->sheet->image(), path); },
      [path] { return tr("Saved %1").arg(path); });
}

}  // namespace

std::unique_ptr<Feature> makePictureFiles(Workbench& bench) { return std::make_unique<PictureFiles>(bench); }

}  // namespace volumen
