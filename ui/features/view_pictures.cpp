#include <QApplication>
#include <QClipboard>
#include <QFileDialog>
#include <QStandardPaths>
#include <memory>
#include <optional>

#include "io/files/picture_file.h"
#include "ui/features/feature.h"
#include "ui/features/once_drawn.h"
#include "ui/views/view_grid.h"
#include "ui/workspace/series_text.h"
#include "ui/workspace/text.h"

namespace volumen {

namespace {

// Copies or saves the view in focus or all views as they appear on screen.
class ViewPictures : public Feature {
 public:
  explicit ViewPictures(Workbench& bench);

 private:
  struct Seen {
    QImage picture;
    QStringList warnings;
  };

  void take(const std::vector<View*>& views, const std::function<void()>& picture);
  void copy(const QImage& picture);
  void save(const std::vector<View*>& views, const QString& title, const std::function<Seen()>& see);
  void write(const Seen& seen, const QString& path);
  QString nameOffered() const;

  JobLane writing_{&bench_.document.jobs};
};

ViewPictures::ViewPictures(Workbench& bench) : Feature(bench) {
  writing_.keepToTheEnd();
  const auto add = [&](const char* name, const QString& text, const QList<QKeySequence>& keys,
                       const char* icon, const std::function<void()>& run, std::vector<Place> places) {
    bench_.addAction({name, text, keys, icon, false,
                      [this, run](bool) {
                        if (session_.workspace().series.empty()) return warn(tr("Open a series first."));
                        run();
                      },
                      std::move(places)});
  };
  add("savePicture", tr("Save picture..."), {tr("Ctrl+E")}, "snapshot",
      [this] {
        save({grid_.viewShown()}, tr("Save the picture of the view"), [view = grid_.viewShown()] {
          return Seen{view->capture(), view->warningsShown()};
        });
      },
      {{"fileMenu", 50}, {"toolBar", 30, toolBarGap + 10}});
  add("copyPicture", tr("Copy picture"), {QKeySequence::Copy}, "",
      [this] { take({grid_.viewShown()}, [this, view = grid_.viewShown()] { copy(view->capture()); }); },
      {{"fileMenu", 50}});
  add("saveAllPictures", tr("Save all views..."), {}, "",
      [this] {
        save(grid_.viewsSeen(), tr("Save the picture of all views"), [this] {
          return Seen{grid_.capture(), grid_.warningsShown()};
        });
      },
      {{"fileMenu", 50, 10}});
  add("copyAllPictures", tr("Copy all views"), {tr("Ctrl+Shift+C")}, "",
      [this] { take(grid_.viewsSeen(), [this] { copy(grid_.capture()); }); }, {{"fileMenu", 50, 10}});
}

// Waits until all views are drawn, so that texts and pictures match.
void ViewPictures::take(const std::vector<View*>& views, const std::function<void()>& picture) {
  onceDrawn(views, session_, this, picture,
            [this] { warn(tr("The view changed before it was drawn: ask for its picture again.")); });
}

void ViewPictures::copy(const QImage& picture) {
  QGuiApplication::clipboard()->setImage(picture);
  tell(tr("Copied to the clipboard"));
}

QString ViewPictures::nameOffered() const {
  const Series* series = seriesIn(session_.workspace(), session_.workspace().focus);
  return series ? seriesText(*series).replace(QLatin1Char('/'), QLatin1Char('_')) : QStringLiteral("volumen");
}

// Saves the picture as it was at the request, once it is drawn and has a file name.
void ViewPictures::save(const std::vector<View*>& views, const QString& title,
                        const std::function<Seen()>& see) {
  struct Asked {
    std::optional<Seen> seen;
    QString path;
  };
  const auto asked = std::make_shared<Asked>();
  const auto look = [this, asked] {
    if (asked->seen && !asked->path.isEmpty()) write(*asked->seen, asked->path);
  };
  take(views, [asked, see, look] {
    asked->seen = see();
    look();
  });
  auto* dialog = new QFileDialog(bench_.dialogParent(), title,
                                 QStandardPaths::writableLocation(QStandardPaths::PicturesLocation),
                                 tr("PNG pictures (*.png);;JPEG pictures (*.jpg *.jpeg)"));
  dialog->setObjectName(QStringLiteral("pictureDialog"));
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setAcceptMode(QFileDialog::AcceptSave);
  dialog->setDefaultSuffix(QStringLiteral("png"));
  dialog->selectFile(nameOffered() + QStringLiteral(".png"));
  connect(dialog, &QFileDialog::fileSelected, this, [asked, look](const QString& path) {
    asked->path = path;
    look();
  });
  dialog->open();
}

void ViewPictures::write(const Seen& seen, const QString& path) {
  PictureText text{{"Software", "volumen " VOLUMEN_VERSION}, {"Comment", "Not for clinical use"}};
  if (!seen.warnings.isEmpty())
    text.emplace_back("volumen-warnings", seen.warnings.join(QLatin1Char('\n')).toStdString());
  writing_.run(
      JobName(tr("Saving"), path),
      [=](const Job&) {
        return writeImage(seen.picture.convertToFormat(QImage::Format_RGB888), path.toStdString(), text);
      },
      [this, path](const Status& status) {
        if (!status) return warnUntilDone(QString::fromStdString(status.message()));
        tell(tr("Saved %1").arg(path));
      });
}

}  // namespace

std::unique_ptr<Feature> makeViewPictures(Workbench& bench) { return std::make_unique<ViewPictures>(bench); }

}  // namespace volumen
