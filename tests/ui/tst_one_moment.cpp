// Guards that whatever leaves the window as pictures is of the moment of the request. A table lists what may
// leave and where to. Between the request and the picture the view changes, names are hidden, or another
// patient is shown. Then the export is what was seen, or there is a sentence: never a mixture.
#include <QApplication>
#include <QCheckBox>
#include <QClipboard>
#include <QComboBox>
#include <QDirIterator>
#include <QPrintDialog>
#include <QSpinBox>
#include <QTemporaryDir>
#include <map>

#include "tests/ui/measure_window.h"
#include "tests/ui/pdf_images.h"
#include "tests/ui/picture_window.h"
#include "tests/unit/suite.h"
#include "ui/panels/pages_dialog.h"
#include "ui/widgets/banner.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

// Returns a patient's ball as a DICOM series, so that its slices can be key images.
LoadedSeriesPtr ballOf(const char* patient, double radius) {
  auto series = std::make_shared<LoadedSeries>(*ballSeries(32, radius, {3, -2, 4}));
  series->series.patientName = patient;
  series->series.studyDate = "20260314";
  for (int n = 0; n < 32; ++n) {
    series->series.sopInstanceUids.push_back(series->series.id + "." + std::to_string(n));
    series->series.frames.push_back(0);
  }
  return series;
}

// The exported pictures and texts.
using Content = std::pair<QList<QImage>, QStringList>;

// Returns the content of a file or of all files in a folder, of each picture only a part given in fractions.
Content contentIn(const QString& path, const QRectF& part) {
  QStringList files{path};
  if (QFileInfo(path).isDir()) {
    files.clear();
    for (QDirIterator each(path, QDir::Files, QDirIterator::Subdirectories); each.hasNext();)
      files << each.next();
    files.sort();
  }
  Content content;
  for (const QString& file : files) {
    content.second << file.mid(path.size());
    if (!file.endsWith(QStringLiteral(".pdf"))) {
      content.first << rgb(QImage(file));
      continue;
    }
    content.second << textsIn(file);
    for (const QImage& image : pixelsIn(file)) content.first << image;
  }
  for (QImage& image : content.first)
    image = image.copy(QRectF(part.x() * image.width(), part.y() * image.height(),
                              part.width() * image.width(), part.height() * image.height())
                           .toRect());
  return content;
}

struct MomentWindow : MeasureWindow {
  const LoadedSeriesPtr series;
  QTemporaryDir folder;
  int exports = 0;

  explicit MomentWindow(const LoadedSeriesPtr& seen = ballOf("Doe^Jane", 10))
      : MeasureWindow(seen), series(seen) {}

  bool isDrawn() {
    return QTest::qWaitFor(
        [&] {
          return view() && !view()->picture().isNull() && view()->isMeasured() &&
                 window.view()->hasItsPicture() &&
                 window.view()->caption().startsWith(QStringLiteral("final"));
        },
        longest);
  }
  bool prepare() {
    if (!isDrawn()) return false;
    draw(ShapeKind::length, {{60, 60}, {120, 90}});
    session().select(0);
    view()->setFocus();
    QTest::keyClick(&window, Qt::Key_K);
    for (const char* box : {"snapshotLetters", "snapshotPatient"}) child<QCheckBox>(box)->setChecked(true);
    child<QSpinBox>("snapshotWidth")->setValue(120);
    child<QSpinBox>("snapshotHeight")->setValue(100);
    child<QComboBox>("snapshotQuality")->setCurrentIndex(0);
    child<QSpinBox>("turntablePictures")->setValue(2);
    return !session().workspace().keyImages.empty() && isDrawn();
  }
  bool restore(const Workspace& before) {
    session().prefer([](Preferences& preferences) { preferences.hideNames = false; });
    session().keep(series);
    session().change(QStringLiteral("test"), before);
    session().endGesture();
    child<Banner>("banner")->hide();
    QApplication::clipboard()->clear();
    QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
    return isDrawn();
  }
  void run(const char* action) { child<QAction>(action)->trigger(); }
  void askFor3D(const char* action) {
    session().setFocus(sceneViewId);
    run(action);
  }
  // The 3D picture is still being drawn at the request.
  void askForTurned(const char* action) {
    run("viewLeft");
    askFor3D(action);
  }
  void askForKeyImages(const char* button) {
    run("keyImagePages");
    for (auto* dialog : window.findChildren<PagesDialog*>())
      if (dialog->isVisible())
        QTest::mouseClick(dialog->findChild<QWidget*>(QLatin1String(button)), Qt::LeftButton);
  }
};

// One kind of export: its request, and the last dialog that asks where to.
struct Leaving {
  void (*ask)(MomentWindow& w);
  const char* dialog = "";  // none: to the clipboard
  const char* file = "";
  QRectF part{0, 0, 1, 1};  // compared; in the lower half 3D states the time it took
};

constexpr QRectF upperHalf(0, 0, 1, 0.5), firstView(0, 0, 0.5, 0.5);

const std::map<const char*, Leaving> leaving{
    {"slice to a file", {[](MomentWindow& w) { w.run("savePicture"); }, "pictureDialog", "a.png"}},
    {"slice to the clipboard", {[](MomentWindow& w) { w.run("copyPicture"); }}},
    {"slice to paper", {[](MomentWindow& w) { w.run("printPicture"); }, "printDialog", "a.pdf"}},
    {"slice to paper in true size",
     {[](MomentWindow& w) {
        w.run("printPicture");
        w.child<QCheckBox>("printTrueSize")->setChecked(true);
      },
      "printDialog", "a.pdf"}},
    {"slice of any size to a file",
     {[](MomentWindow& w) { accept(ask(w, "saveSizedPicture")); }, "pictureFilesDialog", "a.png"}},
    {"stack to a folder",
     {[](MomentWindow& w) {
        PictureDialog* dialog = ask(w, "saveStack");
        set(dialog, "pictureLast", 2);
        accept(dialog);
      },
      "pictureFilesDialog", ""}},
    {"contact sheet to a file",
     {[](MomentWindow& w) {
        PictureDialog* dialog = ask(w, "saveSheet");
        set(dialog, "sheetRows", 1);
        set(dialog, "sheetColumns", 2);
        accept(dialog);
      },
      "pictureFilesDialog", "a.png"}},
    {"key images to a PDF",
     {[](MomentWindow& w) { w.askForKeyImages("pagesPdf"); }, "pagesFileDialog", "a.pdf"}},
    {"key images to paper",
     {[](MomentWindow& w) { w.askForKeyImages("pagesPrint"); }, "pagesPrintDialog", "a.pdf"}},
    {"3D to a file",
     {[](MomentWindow& w) { w.askFor3D("savePicture"); }, "pictureDialog", "a.png", upperHalf}},
    {"3D to the clipboard", {[](MomentWindow& w) { w.askFor3D("copyPicture"); }, "", "", upperHalf}},
    {"3D to paper", {[](MomentWindow& w) { w.askFor3D("printPicture"); }, "printDialog", "a.pdf", upperHalf}},
    {"3D that is drawn to a file",
     {[](MomentWindow& w) { w.askForTurned("savePicture"); }, "pictureDialog", "a.png", upperHalf}},
    {"3D that is drawn to the clipboard",
     {[](MomentWindow& w) { w.askForTurned("copyPicture"); }, "", "", upperHalf}},
    {"3D that is drawn to paper",
     {[](MomentWindow& w) { w.askForTurned("printPicture"); }, "printDialog", "a.pdf", upperHalf}},
    {"all views to a file",
     {[](MomentWindow& w) { w.run("saveAllPictures"); }, "pictureDialog", "a.png", firstView}},
    {"all views to the clipboard", {[](MomentWindow& w) { w.run("copyAllPictures"); }, "", "", firstView}},
    {"snapshot to a file", {[](MomentWindow& w) { w.run("snapshot"); }, "snapshotDialog", "a.png"}},
    {"snapshot to the clipboard", {[](MomentWindow& w) { w.run("copySnapshot"); }}},
    {"turntable to a folder",
     {[](MomentWindow& w) { QTest::mouseClick(w.child<QWidget>("turntableSave"), Qt::LeftButton); },
      "turntableDialog", ""}}};

using Act = std::function<void(MomentWindow& w)>;

const std::map<const char*, Act> acts{
    {"worked on",
     [](MomentWindow& w) {
       QTest::keyClick(w.view(), Qt::Key_PageDown);
       w.session().change(QStringLiteral("test"), [&](Workspace& after) {
         after.measurements.editIf([](const auto&) { return true; },
                                   [](Measurement& m) { m.shape.points[1].x += 3; });
         after.keyImages.eraseIf([](const KeyImage&) { return true; });
         after.series.edit(keyOf(w.series->series)).window = Window{100, 50};
       });
       w.session().endGesture();
       w.run("viewRight");
     }},
    {"names hidden",
     [](MomentWindow& w) { w.session().prefer([](Preferences& all) { all.hideNames = true; }); }},
    {"another patient", [](MomentWindow& w) { w.session().show(ballOf("Roe^John", 7)); }},
    {"closed", [](MomentWindow& w) { w.session().close({keyOf(w.series->series)}); }}};

// Exports with an act while dialogs are open, and one after them. Returns nothing if there is a sentence
// instead.
std::optional<Content> left(MomentWindow& w, const Leaving& how, const Act& whileAsked, const Act& then) {
  const QString place = w.folder.filePath(QString::number(w.exports++));
  QDir().mkdir(place);
  const QString path = QLatin1String(how.file).isEmpty() ? place : place + u'/' + QLatin1String(how.file);
  const bool isCopied = QLatin1String(how.dialog).isEmpty();
  how.ask(w);
  if (whileAsked) whileAsked(w);
  if (auto* dialog = w.window.findChild<QPrintDialog*>(QLatin1String(how.dialog))) {
    dialog->findChild<QLineEdit*>(QStringLiteral("filename"))->setText(path);
    dialog->accept();
  } else if (!isCopied) {
    answer(w, how.dialog, path);
  }
  if (then) then(w);
  const auto isThere = [&] {
    if (isCopied) return !QApplication::clipboard()->image().isNull();
    return QFileInfo(path).isDir() ? !QDir(path).isEmpty() : QFileInfo(path).size() > 0;
  };
  const auto isOver = [&] {
    return w.window.jobs().rows().empty() && (isThere() || w.child<Banner>("banner")->isVisible());
  };
  if (!QTest::qWaitFor(isOver, longest) || !isThere()) return {};
  if (isCopied) QApplication::clipboard()->image().save(place + QStringLiteral("/copied.png"));
  return contentIn(isCopied ? place : path, how.part);
}

}  // namespace

class TestOneMoment : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void whatLeavesIsOfTheRequest_data();
  void whatLeavesIsOfTheRequest();
};

void TestOneMoment::whatLeavesIsOfTheRequest_data() {
  QTest::addColumn<QString>("name");
  for (const auto& [name, how] : leaving) QTest::newRow(name) << QString::fromLatin1(name);
}

void TestOneMoment::whatLeavesIsOfTheRequest() {
  QFETCH(QString, name);
  const Leaving& how = std::ranges::find_if(leaving, [&](const auto& row) {
                         return name == QLatin1String(row.first);
                       })->second;
  MomentWindow w;
  QVERIFY(w.prepare());
  const Workspace before = w.session().workspace();
  QVERIFY(w.restore(before));
  const std::optional<Content> seen = left(w, how, {}, {});
  QVERIFY(seen && !seen->first.isEmpty());
  for (const auto& [did, act] : acts)
    for (const bool isAsked : {true, false}) {
      const QString when = QStringLiteral("%1 %2").arg(
          QLatin1String(did), isAsked ? QStringLiteral("while asked") : QStringLiteral("while drawn"));
      QVERIFY2(w.restore(before), qPrintable(when));
      const std::optional<Content> then = left(w, how, isAsked ? act : Act(), isAsked ? Act() : act);
      const bool isTold = !w.child<Banner>("banner")->sentence().isEmpty();
      QVERIFY2(then ? then == seen : isTold, qPrintable(when));
    }
}

VOLUMEN_TEST(TestOneMoment);
#include "tst_one_moment.moc"
