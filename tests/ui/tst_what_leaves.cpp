// Guards the identification of exports. A table lists all of them and what each states of patient, study,
// series, sides, scale and quality, or why it does not. A picture states a field if it differs when only that
// field differs.
#include <QCheckBox>
#include <QMenu>
#include <QTemporaryDir>
#include <QToolButton>
#include <map>

#include "io/export/dicom_series.h"
#include "tests/ui/leaving.h"
#include "tests/ui/marked_window.h"
#include "tests/ui/numbers_table.h"
#include "tests/ui/pdf_images.h"
#include "tests/unit/suite.h"
#include "viewer/phantoms/phantoms.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

// The exported result.
struct Left {
  QString text;
  QList<QImage> pictures;
};

// Returns the result in the files.
Left leftIn(const QString& path) {
  Left left;
  for (const QString& name : filesAt(path)) {
    QFile file(name);
    if (name.endsWith(QStringLiteral(".pdf"))) {
      left.text += textsIn(name).join(QLatin1Char('\n'));
      for (const QImage& image : pixelsIn(name)) left.pictures << image;
    } else if (const QImage image(name); !image.isNull()) {
      left.pictures << rgb(image);
      for (const QString& key : image.textKeys()) left.text += image.text(key) + QLatin1Char('\n');
    } else if (file.open(QIODevice::ReadOnly)) {
      left.text += QString::fromUtf8(file.readAll());
    }
  }
  return left;
}

// A head with these tags in planes, with a length, a key image and a segment.
struct LeavingWindow : MarkedWindow {
  QTemporaryDir folder;

  using MarkedWindow::MarkedWindow;

  void tickSnapshot(bool on) {
    for (const char* box : {"snapshotLetters", "snapshotScaleBar", "snapshotPatient"})
      child<QCheckBox>(box)->setChecked(on);
  }
  QString at(const QString& name) const { return folder.filePath(name); }
  void chooseFrom(const char* button, const char* entry) {
    for (QAction* action : child<QToolButton>(button)->menu()->actions())
      if (action->objectName() == QLatin1String(entry)) action->trigger();
  }
  // Saves to a file name by the dialog that asks for it.
  void saveTo(const char* dialog, const QString& name) { answer(*this, dialog, at(name)); }
  void leave(const char* way, const QString& name) {
    wayOut(QLatin1String(way)).ask(*this);
    answerWhere(*this, wayOut(QLatin1String(way)), at(name));
    session().setFocus(axialViewId);
  }
};

// One export: how it is made in a window, and the name of its file or folder.
struct Thing {
  const char* name;
  const char* file;
  void (*make)(LeavingWindow& w, const QString& file);
  const char* says;  // stated fields
  const char* why;   // reason that the others are not stated
  bool isPicture = true;
};

constexpr const char* fieldNames[] = {"patient", "id",    "date",  "number",  "description",
                                      "sides",   "scale", "level", "clinical"};

const Thing things[] = {
    {"picture", "picture.png",
     [](LeavingWindow& w, const QString& file) { w.leave("slice to a file", file); },
     "patient id date number description sides scale clinical", "slices have no level"},
    {"clipboard", "clipboard.png",
     [](LeavingWindow& w, const QString& file) {
       QApplication::clipboard()->clear();
       w.leave("slice to the clipboard", file);
       QApplication::clipboard()->image().save(w.at(file));
     },
     "patient id date number description sides scale", "a clipboard holds pixels alone"},
    {"all views", "views.png",
     [](LeavingWindow& w, const QString& file) { w.leave("all views to a file", file); },
     "patient id date number description sides scale clinical", "the level stands in the corner of 3D alone"},
    {"picture of any size", "sized.png",
     [](LeavingWindow& w, const QString& file) { w.leave("slice of any size to a file", file); },
     "patient id date number description sides scale clinical", "slices have no level"},
    {"stack", "stack", [](LeavingWindow& w, const QString& file) { w.leave("stack to a folder", file); },
     "patient id date number description sides scale clinical", "slices have no level"},
    {"contact sheet", "sheet.png",
     [](LeavingWindow& w, const QString& file) { w.leave("contact sheet to a file", file); },
     "patient id date number description sides scale clinical", "slices have no level"},
    {"key image pages", "pages.pdf",
     [](LeavingWindow& w, const QString& file) { w.leave("key images to a PDF", file); },
     "patient id date number description sides scale clinical", "slices have no level"},
    {"print", "print.pdf", [](LeavingWindow& w, const QString& file) { w.leave("slice to paper", file); },
     "patient id date number description sides scale clinical", "slices have no level"},
    {"print of 3D", "print3d.pdf",
     [](LeavingWindow& w, const QString& file) { w.leave("3D to paper", file); },
     "patient id date number description sides scale clinical", "the level stands in its corner"},
    {"snapshot", "snapshot.png",
     [](LeavingWindow& w, const QString& file) {
       w.tickSnapshot(true);
       w.leave("snapshot to a file", file);
     },
     "patient id date number description sides scale level clinical", ""},
    {"snapshot as offered", "bare.png",
     [](LeavingWindow& w, const QString& file) {
       w.tickSnapshot(false);
       w.leave("snapshot to a file", file);
     },
     "level clinical", "what is written over it is chosen in the panel"},
    {"turntable", "turn",
     [](LeavingWindow& w, const QString& file) {
       w.tickSnapshot(true);
       w.leave("turntable to a folder", file);
     },
     "patient id date number description sides scale level clinical", ""},
    {"CSV of measurements", "measured.csv",
     [](LeavingWindow& w, const QString& file) {
       w.chooseFrom("measurementSave", "saveMeasurementsCsv");
       w.saveTo("measurementSaveDialog", file);
     },
     "patient id date number description", "numbers have no sides, and units for a scale", false},
    {"shapes", "shapes.json",
     [](LeavingWindow& w, const QString& file) {
       w.chooseFrom("measurementSave", "saveShapes");
       w.saveTo("measurementSaveDialog", file);
     },
     "patient id date number description", "places have no sides, and are mm", false},
    {"CSV of segments", "segments.csv",
     [](LeavingWindow& w, const QString& file) {
       openTable(w);
       QTest::mouseClick(w.child<QWidget>("segmentNumbersCsv"), Qt::LeftButton);
       w.saveTo("segmentNumbersFileDialog", file);
     },
     "patient id date number description", "numbers have no sides, and units for a scale", false},
    {"JSON of segments", "segments.json",
     [](LeavingWindow& w, const QString& file) {
       QTest::mouseClick(w.child<QWidget>("segmentNumbersJson"), Qt::LeftButton);
       w.saveTo("segmentNumbersFileDialog", file);
     },
     "patient id date number description", "numbers have no sides, and units for a scale", false},
    {"session", "all.volumen",
     [](LeavingWindow& w, const QString& file) {
       w.child<QAction>("saveSessionAs")->trigger();
       w.saveTo("saveSessionDialog", file);
     },
     "number description", "it names files and UIDs, which say it", false},
    {"scene", "scene.json",
     [](LeavingWindow& w, const QString& file) {
       w.child<QAction>("saveScene")->trigger();
       w.saveTo("saveSceneDialog", file);
     },
     "", "a look for any series", false},
    {"SEG", "segments.dcm",
     [](LeavingWindow& w, const QString& file) {
       w.child<QAction>("exportSegments")->trigger();
       w.saveTo("segmentDialog", file);
     },
     "patient id date", "it has a number of its own and names the series by its UID", false},
    {"seg.nrrd", "segments.seg.nrrd",
     [](LeavingWindow& w, const QString& file) {
       w.child<QAction>("exportSegments")->trigger();
       w.saveTo("segmentDialog", file);
     },
     "patient id date number description", "labels have no sides, and are mm", false},
    {"STL", "surface.stl",
     [](LeavingWindow& w, const QString& file) {
       w.child<QAction>("exportSegments")->trigger();
       w.saveTo("segmentDialog", file);
       const auto isMade = [&] { return w.button("surfaceSave") && w.button("surfaceSave")->isEnabled(); };
       if (QTest::qWaitFor(isMade, longest)) w.click("surfaceSave");
     },
     "patient id date number description", "triangles have no sides, and are mm", false}};

DicomSeriesTags knownTags() {
  DicomSeriesTags tags;
  tags.patientName = "Doe^Jane", tags.patientId = "PAT4711", tags.studyDate = "20260314";
  tags.studyUid = "1.2.3.4", tags.seriesUid = "1.2.3.4.5", tags.seriesNumber = "1731652894";
  tags.description = "Thorax", tags.modality = "CT";
  return tags;
}

// Returns the spellings of a field's value in texts.
QStringList spellings(const QString& field) {
  static const std::map<QString, QStringList> all{
      {QStringLiteral("patient"), {QStringLiteral("Doe, Jane"), QStringLiteral("Doe^Jane")}},
      {QStringLiteral("id"), {QStringLiteral("PAT4711")}},
      {QStringLiteral("date"), {QStringLiteral("2026-03-14"), QStringLiteral("20260314")}},
      {QStringLiteral("number"), {QStringLiteral("1731652894")}},
      {QStringLiteral("description"), {QStringLiteral("Thorax")}},
      {QStringLiteral("level"), {QStringLiteral("PSNR")}},  // the promised value
      {QStringLiteral("clinical"), {QStringLiteral("Not for clinical use")}}};
  const auto of = all.find(field);
  return of == all.end() ? QStringList() : of->second;
}

// Returns tags in which this field differs from knownTags().
DicomSeriesTags otherTags(const QString& field) {
  DicomSeriesTags tags = knownTags();
  if (field == QStringLiteral("patient")) tags.patientName = "Roe^John";
  if (field == QStringLiteral("id")) tags.patientId = "PAT0815";
  if (field == QStringLiteral("date")) tags.studyDate = "20190807";
  if (field == QStringLiteral("number")) tags.seriesNumber = "1268413975";
  if (field == QStringLiteral("description")) tags.description = "Becken";
  return tags;
}

// Makes all exports of a window that shows a series with these tags, or only the pictures if not `withFiles`.
std::map<QString, Left> allOf(const DicomSeriesTags& tags, bool withFiles) {
  std::map<QString, Left> all;
  const QTemporaryDir data;
  const Result<VolumePtr> volume = makePhantom("ct-head:32");
  const QString path = data.filePath(QStringLiteral("series"));
  if (!volume || !writeDicomSeries(**volume, tags, path.toStdString())) return all;
  LeavingWindow w(path);
  if (!w.prepare()) return all;
  for (const Thing& thing : things) {
    if (!withFiles && !thing.isPicture) continue;
    const QString file = QString::fromLatin1(thing.file);
    thing.make(w, file);
    if (!QTest::qWaitFor(
            [&] {
              const QFileInfo made(w.at(file));
              const bool isThere = made.isDir() ? !QDir(made.filePath()).isEmpty() : made.size() > 0;
              return isThere && w.window.jobs().rows().empty();
            },
            longest))
      continue;
    QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
    all[QString::fromLatin1(thing.name)] = leftIn(w.at(file));
    const QString keep = qEnvironmentVariable("VOLUMEN_SHOTS");
    if (!keep.isEmpty() && withFiles) QFile::copy(w.at(file), QDir(keep).filePath(file));
  }
  return all;
}

const std::map<QString, Left>& leftWith(const QString& field) {
  static std::map<QString, std::map<QString, Left>> made;
  auto known = made.find(field);
  if (known == made.end())
    known =
        made.emplace(field, allOf(field.isEmpty() ? knownTags() : otherTags(field), field.isEmpty())).first;
  return known->second;
}

int brightIn(const QImage& image, QRect part) {
  int count = 0;
  part = part.intersected(image.rect());
  for (int y = part.top(); y <= part.bottom(); ++y)
    for (int x = part.left(); x <= part.right(); ++x) {
      const QRgb p = image.pixel(x, y);
      count += qRed(p) > 200 && qGreen(p) > 200 && qBlue(p) > 200 ? 1 : 0;
    }
  return count;
}

// Returns whether a letter is at the left edge, about the middle of the picture. Of several views the first
// counts, and a contact sheet has a header above.
bool hasLetter(const QString& thing, const QImage& image) {
  const double at = thing == QStringLiteral("all views")       ? 0.25
                    : thing == QStringLiteral("contact sheet") ? 0.6
                                                               : 0.5;
  const int reach = image.height() / (at == 0.6 ? 10 : 16);
  return brightIn(image, {0, int(at * image.height()) - reach, image.width() / 12, 2 * reach}) > 5;
}

// Returns whether a line with a tick at each end is near the bottom. A skull also has bright runs.
bool hasScale(const QImage& image) {
  for (int y = image.height() * 85 / 100; y < image.height(); ++y)
    for (int x = 0, run = 0; x < image.width(); ++x) {
      const bool isBright = brightIn(image, {x, y, 1, 1}) > 0;
      if (!isBright && run > 20) {
        const auto above = [&](int at, int width) { return brightIn(image, {at, y - 2, width, 1}); };
        const int from = x - run;
        if (above(from, 3) && above(x - 3, 3) && !above(from + run / 2, 1) && !above(from - 4, 2) &&
            !above(x + 2, 2))
          return true;
      }
      run = isBright ? run + 1 : 0;
    }
  return false;
}

// Returns the pictures' upper halves, where names are; of several views, the first. Below, 3D tells its time.
QList<QImage> headsOf(const QString& thing, const QList<QImage>& pictures) {
  QList<QImage> heads;
  for (const QImage& image : pictures)
    heads << image.copy(0, 0, image.width() / (thing == QStringLiteral("all views") ? 2 : 1),
                        image.height() / 2);
  return heads;
}

bool says(const QString& thing, const QString& field) {
  const Left& left = leftWith({}).at(thing);
  for (const QString& value : spellings(field))
    if (left.text.contains(value)) return true;
  if (left.pictures.isEmpty() || field == QStringLiteral("level") || field == QStringLiteral("clinical"))
    return false;
  if (field == QStringLiteral("sides")) return hasLetter(thing, left.pictures.front());
  if (field == QStringLiteral("scale")) return hasScale(left.pictures.front());
  return headsOf(thing, leftWith(field).at(thing).pictures) != headsOf(thing, left.pictures);
}

}  // namespace

class TestWhatLeaves : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void whatLeavesSaysWhoseItIs_data();
  void whatLeavesSaysWhoseItIs();
};

void TestWhatLeaves::whatLeavesSaysWhoseItIs_data() {
  QTest::addColumn<QString>("thing");
  QTest::addColumn<QString>("field");
  QTest::addColumn<bool>("isSaid");
  QTest::addColumn<QString>("why");
  for (const Thing& thing : things)
    for (const char* field : fieldNames)
      QTest::addRow("%s: %s", thing.name, field)
          << QString::fromLatin1(thing.name) << QString::fromLatin1(field)
          << QString::fromLatin1(thing.says).split(QLatin1Char(' ')).contains(QLatin1String(field))
          << QString::fromLatin1(thing.why);
}

void TestWhatLeaves::whatLeavesSaysWhoseItIs() {
  QFETCH(QString, thing);
  QFETCH(QString, field);
  QFETCH(bool, isSaid);
  QFETCH(QString, why);
  QVERIFY2(leftWith({}).contains(thing), "it was not made");
  QVERIFY2(says(thing, field) == isSaid, qPrintable(why));
}

VOLUMEN_TEST(TestWhatLeaves);
#include "tst_what_leaves.moc"
