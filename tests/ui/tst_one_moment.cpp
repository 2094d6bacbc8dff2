// Guards that whatever leaves the window as pictures is of the moment of the request. A table lists what may
// leave and where to. Between the request and the picture the view changes, names are hidden, or another
// patient is shown. Then the export is what was seen, or there is a sentence: never a mixture.
#include <QApplication>
#include <QCheckBox>
#include <QTemporaryDir>
#include <map>

#include "tests/ui/leaving.h"
#include "tests/ui/measure_window.h"
#include "tests/ui/pdf_images.h"
#include "tests/unit/suite.h"
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
  Content content;
  for (const QString& file : filesAt(path)) {
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
    child<QCheckBox>("snapshotLetters")->setChecked(true);
    child<QSpinBox>("snapshotWidth")->setValue(120);
    child<QSpinBox>("snapshotHeight")->setValue(100);
    child<QComboBox>("snapshotQuality")->setCurrentIndex(0);
    return !session().workspace().keyImages.empty() && isDrawn();
  }
  bool restore(const Workspace& before) {
    session().prefer([](Preferences& preferences) { preferences.hideNames = false; });
    session().keep(series);
    session().change(QStringLiteral("test"), before);
    session().endGesture();
    child<QCheckBox>("snapshotPatient")->setChecked(true);
    child<Banner>("banner")->hide();
    QApplication::clipboard()->clear();
    QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
    return isDrawn();
  }
};

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
       run(w, "viewRight");
       w.child<QCheckBox>("snapshotPatient")->toggle();
     }},
    {"names hidden",
     [](MomentWindow& w) { w.session().prefer([](Preferences& all) { all.hideNames = true; }); }},
    {"another patient", [](MomentWindow& w) { w.session().show(ballOf("Roe^John", 7)); }},
    {"closed", [](MomentWindow& w) { w.session().close({keyOf(w.series->series)}); }}};

// Exports with an act while dialogs are open, and one after them. Returns nothing if there is a sentence
// instead.
std::optional<Content> exported(MomentWindow& w, const Leaving& way, const Act& whileAsked, const Act& then) {
  const QString path = w.folder.filePath(QString::number(w.exports++) + QLatin1String(way.ending));
  way.ask(w);
  if (whileAsked) whileAsked(w);
  answerWhere(w, way, path);
  if (then) then(w);
  const auto copied = [] { return QApplication::clipboard()->image(); };
  const auto isThere = [&] {
    if (!*way.dialog) return !copied().isNull();
    return !*way.ending ? !QDir(path).isEmpty() : QFileInfo(path).size() > 0;
  };
  const auto isOver = [&] {
    return w.window.jobs().rows().empty() && (isThere() || w.child<Banner>("banner")->isVisible());
  };
  if (!QTest::qWaitFor(isOver, longest) || !isThere()) return {};
  if (!*way.dialog) copied().save(path);
  return contentIn(path, way.part);
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
  for (const Leaving& way : waysOut()) QTest::newRow(way.name) << QString::fromLatin1(way.name);
}

void TestOneMoment::whatLeavesIsOfTheRequest() {
  QFETCH(QString, name);
  const Leaving& way = wayOut(name);
  MomentWindow w;
  QVERIFY(w.prepare());
  const Workspace before = w.session().workspace();
  QVERIFY(w.restore(before));
  const std::optional<Content> seen = exported(w, way, {}, {});
  QVERIFY(seen && !seen->first.isEmpty());
  for (const auto& [did, act] : acts)
    for (const bool isAsked : {true, false}) {
      const QString when =
          QStringLiteral("%1 while %2")
              .arg(QLatin1String(did), isAsked ? QStringLiteral("asked") : QStringLiteral("drawn"));
      QVERIFY2(w.restore(before), qPrintable(when));
      const std::optional<Content> then = exported(w, way, isAsked ? act : Act(), isAsked ? Act() : act);
      const bool isTold = !w.child<Banner>("banner")->sentence().isEmpty();
      QVERIFY2(then ? then == seen : isTold, qPrintable(when));
    }
}

VOLUMEN_TEST(TestOneMoment);
#include "tst_one_moment.moc"
