// Guards the first view of a series: its plane and its slice number. Windows do not jump between frames, and
// a layout stays with the modality for which it was chosen. Real files in a real window.
#include <algorithm>
#include <cstdio>
#include <fstream>
#include <set>

#include "io/open.h"
#include "io/study/frame_series.h"
#include "results/series/series_facts.h"
#include "tests/fixtures/fixtures.h"
#include "tests/ui/gestures.h"
#include "tests/ui/journey.h"
#include "tests/ui/test_series.h"
#include "tests/unit/suite.h"
#include "ui/data/picture_stacks.h"
#include "ui/views/view_grid.h"
#include "ui/workspace/corner_text.h"
#include "ui/workspace/first_series.h"
#include "ui/workspace/key_images.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

// Uses the default layouts of a new user.
struct Usual {
  Usual() { openAlone(false); }
  ~Usual() { openAlone(); }
};

struct Opened : Usual, Journey {
  explicit Opened(const QString& path) : Journey() {
    window.resize(1440, 900);
    window.open({path});
  }
  Session& session() { return window.session(); }
  const Workspace& workspace() { return session().workspace(); }
  // Returns the first flat view on screen once its picture is there.
  FlatView* first() {
    FlatView* found = nullptr;
    const auto isThere = [&] {
      found = nullptr;
      for (const ViewId id : viewsOnScreen(workspace()))
        if (!found) found = window.views()->viewAs<FlatView>(id);
      return found && found->isVisible() && found->shown() && !found->picture().isNull();
    };
    return QTest::qWaitFor(isThere, longest) ? found : nullptr;
  }
  QStringList corner() { return first()->overlays().topRight; }
};

// Returns all data sets listed as loadable, and the contents of folders without a list.
std::set<std::string> studiesOfTheData() {
  std::set<std::string> paths;
  std::ifstream manifest(dataPath("MANIFEST.tsv"));
  for (std::string line; std::getline(manifest, line);) {
    const QStringList columns = QString::fromStdString(line).split(QLatin1Char('\t'));
    if (columns.value(3) == QStringLiteral("load")) paths.insert(columns[1].toStdString());
  }
  for (const char* folder : {"dicom-2d", "pet-ct"})
    for (const QString& name :
         QDir(QString::fromStdString(dataPath(folder))).entryList(QDir::AllEntries | QDir::NoDotAndDotDot))
      paths.insert(std::string(folder) + '/' + name.toStdString());
  return paths;
}

// Returns the first view of a study by its headers: modality, layout or "pictures", plane, number.
QString firstView(const std::string& path) {
  Result<Study> study = openStudy(dataPath(path));
  if (!study) return QStringLiteral("nothing");
  *study = withPictureStacks(std::move(*study));
  std::vector<const Series*> open;
  for (const Series& volume : study->volumes) open.push_back(&volume);
  const std::optional<Series> first = firstSeries({}, *study, open);
  if (!first) return QStringLiteral("nothing");
  const Series& series = *first;
  QStringList said{QString::fromStdString(series.modality.empty() ? "-" : series.modality)};
  if (opensAsPictures(series))
    return (said << QStringLiteral("pictures") << QStringLiteral("1 / %1").arg(frameCount(series)))
        .join(QLatin1Char('\t'));
  const Crosshair crosshair = firstCrosshair(series);
  ViewState view;
  view.kind = acquiredKind(series.acquired);
  const SlicePlane plane = flatPlane(view, {}, drawnGeometry(series), crosshair, {100, 100});
  const PlaneNumber number = planeNumber(series, drawnGeometry(series), view.kind, crosshair, plane);
  const char* names[] = {"", "axial", "coronal", "sagittal"};
  said << QLatin1String(layoutName(usualLayout(series))) << QLatin1String(names[int(view.kind)]);
  if (number.reformatted) said << QStringLiteral("reformatted");
  return (said << number.text).join(QLatin1Char('\t'));
}

}  // namespace

class TestFirstViews : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void seriesOpenAsAcquired_data();
  void seriesOpenAsAcquired();
  void everyStudyOfTheDataHasItsFirstView();
  void whatIsNoVolumeForcesNoLayout();
  void acquiredSlicesOfAnObliqueSeriesAreMarked();
  void framesOfASeriesHaveOneWindow();
};

void TestFirstViews::seriesOpenAsAcquired_data() {
  QTest::addColumn<QString>("path");
  QTest::addColumn<int>("views");
  QTest::addColumn<QString>("title");
  QTest::addColumn<QString>("number");
  const auto add = [](const char* path, int views, const char* title, const char* number) {
    QTest::newRow(path) << QString::fromLatin1(path) << views << QString::fromLatin1(title)
                        << QString::fromLatin1(number);
  };
  add("ct-chest-lidc0314-138", 4, "Axial", "70 / 138");
  add("mr-head-ge-mprage-130", 4, "Axial", "65 / 130");
  add("mr-head-siemens-gap-175", 4, "Sagittal", "");
  add("dicom-geometry/ct-ge-tilt-varspacing-28", 4, "Axial", "");
  add("dicom-geometry/mr-mosaic-siemens", 4, "Axial", "18 / 35");
  add("dicom-geometry/mr-localizer-ge-3plane-21", 1, "Frame 1 / 21", "");
  add("dicom-geometry/ct-tiny-23x38x3", 1, "Frame 1 / 3", "");
  add("dicom-geometry/mr-frag", 1, "Frame 1 / 1", "");
  add("dicom-geometry/mr-enh-siemens-xa10", 1, "Axial", "3 / 6");
  add("pet-ct/sts019-pet", 4, "Axial", "24 / 47");
  add("pet-ct/pet-bqml-fdg.dcm", 1, "Frame 1 / 1", "");
  add("dicom-2d/ct-two-windows.dcm", 1, "Frame 1 / 1", "");
  add("dicom-2d/us-cine-aspect-regions.dcm", 1, "", "");
  add("nifti-meta/HeadMRVolume.mhd", 4, "", "");
  // With VOLUMEN_SHOTS set, opens each study of the data and takes a screenshot.
  if (!qEnvironmentVariableIsSet("VOLUMEN_SHOTS")) return;
  for (const std::string& path : studiesOfTheData())
    if (firstView(path) != QStringLiteral("nothing"))
      QTest::newRow(("every study: " + path).c_str())
          << QString::fromStdString(path) << 0 << QString() << QString();
}

void TestFirstViews::seriesOpenAsAcquired() {
  QFETCH(QString, path);
  QFETCH(int, views);
  QFETCH(QString, title);
  QFETCH(QString, number);
  const std::string data = dataPath(path.toStdString());
  NEED_DATA(data);
  Opened w(QString::fromStdString(data));
  QVERIFY(w.first());
  const auto areDrawn = [&] {
    return std::ranges::all_of(viewsOnScreen(w.workspace()), [&](ViewId id) {
      FlatView* flat = w.window.views()->viewAs<FlatView>(id);
      return !(flat ? flat->picture() : w.window.view()->picture()).isNull();
    });
  };
  QTRY_VERIFY_WITH_TIMEOUT(areDrawn(), longest);
  w.shot(qPrintable(QString(path).replace(QLatin1Char('/'), QLatin1Char('_'))));
  if (views > 0) QCOMPARE(int(viewsOnScreen(w.workspace()).size()), views);
  const QStringList corner = w.corner();
  qInfo("%s", qPrintable(corner.join(QStringLiteral(" | "))));
  if (!title.isEmpty()) QCOMPARE(corner[0], title);
  if (!number.isEmpty()) QCOMPARE(corner[1], number);
  QVERIFY2(!corner[0].contains(QStringLiteral("reformatted")), "as acquired");
}

// Compares with tests/ui/first_views.tsv by headers alone. With VOLUMEN_FIGURES set, prints the table anew.
void TestFirstViews::everyStudyOfTheDataHasItsFirstView() {
  const std::string data = dataPath("MANIFEST.tsv");
  NEED_DATA(data);
  std::map<std::string, QString> expected;
  std::ifstream table(VOLUMEN_SOURCE_DIR "/tests/ui/first_views.tsv");
  for (std::string line; std::getline(table, line);)
    if (const std::size_t tab = line.find('\t'); tab != std::string::npos)
      expected[line.substr(0, tab)] = QString::fromStdString(line.substr(tab + 1));
  QStringList wrong;
  for (const std::string& path : studiesOfTheData()) {
    const QString view = firstView(path);
    if (qEnvironmentVariableIsSet("VOLUMEN_FIGURES")) std::printf("%s\t%s\n", path.c_str(), qPrintable(view));
    if (view != expected[path]) wrong << QStringLiteral("%1: %2").arg(QString::fromStdString(path), view);
  }
  QVERIFY2(wrong.isEmpty(), qPrintable(wrong.join(QLatin1Char('\n'))));
  QVERIFY(expected.size() > 100);
}

void TestFirstViews::whatIsNoVolumeForcesNoLayout() {
  const std::string slice = dataPath("dicom-2d/ct-two-windows.dcm");
  NEED_DATA(slice);
  Opened w(QString::fromStdString(slice));
  QVERIFY(w.first());
  QVERIFY(showsFrames(w.first()->state().kind));
  w.window.open({QStringLiteral("phantom:ct-head:32")});
  QTRY_VERIFY_WITH_TIMEOUT(w.session().series() != nullptr, longest);
  QCOMPARE(w.workspace().layout, Layout::planes);
  QCOMPARE(int(viewsOnScreen(w.workspace()).size()), 4);
  // The layout chosen for CT does not apply to MR.
  w.child<QAction>("layoutBesidePlanes")->trigger();
  const std::string mr = dataPath("dicom-geometry/mr-mosaic-siemens");
  NEED_DATA(mr);
  w.window.open({QString::fromStdString(mr)});
  QTRY_VERIFY_WITH_TIMEOUT(w.session().series() && w.session().series()->series.modality == "MR", longest);
  QCOMPARE(w.workspace().layout, Layout::planes);
}

void TestFirstViews::acquiredSlicesOfAnObliqueSeriesAreMarked() {
  const std::string head = dataPath("mr-head-ge-mprage-130");
  NEED_DATA(head);
  Opened w(QString::fromStdString(head));
  FlatView* view = w.first();
  QVERIFY(view);
  w.session().setFocus(view->id());
  wheel(view, -3);
  const std::optional<int> seen = view->stack().seen.index;
  QVERIFY(seen);
  QCOMPARE(w.corner()[1], QStringLiteral("%1 / 130").arg(*seen + 1));
  w.child<QAction>("keyImage")->trigger();
  QCOMPARE(w.workspace().keyImages.size(), std::size_t(1));
  QCOMPARE(w.workspace().keyImages[0], *keyImageOf(view->series()->series, *seen));
  w.child<QAction>("straightenPlanes")->trigger();
  QVERIFY2(w.corner()[0].contains(QStringLiteral("reformatted")), "along the patient");
  w.child<QAction>("keyImage")->trigger();
  QCOMPARE(w.workspace().keyImages.size(), std::size_t(1));
  w.child<QAction>("alignPlanes")->trigger();
  QCOMPARE(w.corner()[0], QStringLiteral("Axial"));
  // A slab is no acquired picture.
  wheel(view, 3, Qt::AltModifier);
  QVERIFY(flatLookOf(view->state()).slabMm > 0 && !view->stack().seen.index);
}

void TestFirstViews::framesOfASeriesHaveOneWindow() {
  const std::string series = dataPath("dicom-geometry/mr-localizer-ge-3plane-21");
  NEED_DATA(series);
  Opened w(QString::fromStdString(series));
  QVERIFY(w.first() && showsFrames(w.first()->state().kind));
  const auto windows = [&] {
    QStringList all;
    for (int n = 0; n < 7; ++n) {
      const auto isThere = [&] {
        return tests::frameIn(w.first()) && tests::frameIn(w.first())->key.index == n;
      };
      if (n == 0) QTest::keyClick(w.first(), Qt::Key_Home);
      if (!QTest::qWaitFor(isThere, longest)) return QStringList();
      all << w.first()->overlays().bottomRight;
      QTest::keyClick(w.first(), Qt::Key_Down);
    }
    all.removeDuplicates();
    return all;
  };
  QCOMPARE(windows().size(), 1);
  QAction* own = w.child<QAction>("ownWindows");
  QVERIFY(own->isEnabled() && !own->isChecked());
  own->trigger();
  QVERIFY2(windows().size() > 1, "each its own");
  w.child<QAction>("undo")->trigger();
  QVERIFY(!own->isChecked());
}

VOLUMEN_TEST(TestFirstViews);
#include "tst_first_views.moc"
