// Guards the steps in time of a view: slider, keys and clip go through the volumes of one file, and nothing
// but the volume changes. Real events on a file of several volumes.
#include <QSlider>
#include <QTemporaryDir>
#include <fstream>

#include "tests/ui/gestures.h"
#include "tests/ui/journey.h"
#include "tests/unit/suite.h"
#include "ui/views/slice_view.h"
#include "ui/views/time_bar.h"
#include "ui/views/view_grid.h"
#include "ui/workspace/flat_plane.h"
#include "ui/workspace/time_points.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

constexpr int edge = 16, steps = 4;

// An NRRD file of `steps` volumes; those of the n-th have the value 100 n everywhere but for a frame of 0.
QString fourVolumes(const QTemporaryDir& folder) {
  const QString path = folder.filePath(QStringLiteral("perfusion.nrrd"));
  std::ofstream file(path.toStdString(), std::ios::binary);
  file << "NRRD0005\ntype: int16\ndimension: 4\nspace: left-posterior-superior\nsizes: " << edge << ' '
       << edge << ' ' << edge << ' ' << steps
       << "\nspace directions: (2,0,0) (0,2,0) (0,0,2) none\nkinds: domain domain domain time\nspace origin: "
          "(0,0,0)\nendian: little\nencoding: raw\n\n";
  for (int n = 1; n <= steps; ++n)
    for (int k = 0; k < edge; ++k)
      for (int j = 0; j < edge; ++j)
        for (int i = 0; i < edge; ++i) {
          const bool inside = std::min({i, j, k}) > 2 && std::max({i, j, k}) < edge - 3;
          const auto value = std::int16_t(inside ? 100 * n : 0);
          file.write(reinterpret_cast<const char*>(&value), sizeof value);
        }
  return path;
}

struct Perfusion : Journey {
  explicit Perfusion(const QString& path) {
    openAlone(false);
    window.open({path});
  }
  ~Perfusion() { openAlone(); }
  Session& session() { return window.session(); }
  const Workspace& workspace() { return session().workspace(); }
  SliceView* view(ViewId id = axialViewId) { return window.views()->sliceView(id); }
  bool opened() {
    return QTest::qWaitFor([&] { return session().series() && view() && view()->isVisible(); }, longest);
  }
  // The value of the volume on screen, once it is there.
  bool shows(int value) {
    return QTest::qWaitFor(
        [&] {
          const ShownSeriesPtr shown = session().seriesOf(axialViewId);
          return shown && shown->volume->value(edge / 2, edge / 2, edge / 2) == value;
        },
        longest);
  }
  QSlider* slider(ViewId id = axialViewId) { return view(id)->findChild<QSlider*>(); }
  void key(int code) { QTest::keyClick(view(), Qt::Key(code)); }
  QString corner() { return view()->overlays().topRight.join(QLatin1Char('\n')); }
};

ShownSeriesPtr named(const char* id, std::string Series::*axis, const char* value) {
  auto series = std::make_shared<ShownSeries>();
  series->series.format = "DICOM";
  series->series.path = "folder";
  series->series.seriesUid = "1.2.3";
  series->series.id = id;
  series->series.*axis = value;
  return series;
}

}  // namespace

class TestTimePoints : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase() { path_ = fourVolumes(folder_); }
  void keysStepInAllViewsOfTheGroup();
  void theNextOneIsLoadedAhead();
  void memoryWithoutRoomLoadsNothingAhead();
  void theSliderIsThereWhereThereAreSeveral();
  void aClipRunsInTime();
  void theAxisIsNamedByWhatVaries_data();
  void theAxisIsNamedByWhatVaries();

 private:
  QTemporaryDir folder_;
  QString path_;
};

void TestTimePoints::keysStepInAllViewsOfTheGroup() {
  Perfusion w(path_);
  QVERIFY(w.opened());
  QVERIFY(w.shows(100));
  drag(w.view(), {60, 60}, {90, 80});                                                  // window
  drag(w.view(), {60, 100}, {60, 70}, Qt::RightButton);                                // zoom
  drag(w.view(coronalViewId), {40, 40}, {60, 55}, Qt::LeftButton, Qt::ShiftModifier);  // crosshair
  const Workspace before = w.workspace();
  const SeriesKey first = before.view(axialViewId).series;
  w.key(Qt::Key_Right);
  QVERIFY(w.shows(200));
  const Workspace& after = w.workspace();
  const SeriesKey second = after.view(axialViewId).series;
  QVERIFY(first != second);
  for (const ViewId id : {axialViewId, coronalViewId, sagittalViewId}) {
    QCOMPARE(after.view(id).series, second);
    QVERIFY(flatLookOf(after.view(id)) == flatLookOf(before.view(id)));
  }
  QCOMPARE(after.view(sceneViewId).series, second);
  QVERIFY(after.view(sceneViewId).scenes.at(second) == before.view(sceneViewId).scenes.at(first));
  QVERIFY(after.series.at(second).window && after.series.at(second).window == before.series.at(first).window);
  const auto crosshair = [](const Workspace& of, const SeriesKey& key) {
    return of.crosshairs.at(frameOfReference(*of.series.at(key).series));
  };
  QVERIFY(crosshair(after, second) == crosshair(before, first));
  QCOMPARE(w.corner().section(QLatin1Char('\n'), -1), QStringLiteral("time point 2 of 4"));
  w.key(Qt::Key_Left);
  w.key(Qt::Key_Left);
  QVERIFY(w.shows(100));
  w.key(Qt::Key_Right);
  QSignalSpy settled(w.view(), &SliceView::settled);
  w.key(Qt::Key_Right);
  QVERIFY(w.shows(300));
  QTRY_VERIFY_WITH_TIMEOUT(settled.count() > 0, longest);
  w.shot("time-points");
  w.child<QAction>("undo")->trigger();
  QVERIFY(w.shows(100));
  QVERIFY(w.workspace().view(axialViewId).series == first);
}

void TestTimePoints::theNextOneIsLoadedAhead() {
  Perfusion w(path_);
  QVERIFY(w.opened());
  const auto held = [&](int n) {
    const auto all = timePointsOf(w.workspace(), w.workspace().view(axialViewId).series);
    return all.size() == steps && w.session().seriesNamed(keyOf(*all[std::size_t(n)])) != nullptr;
  };
  QTRY_VERIFY_WITH_TIMEOUT(held(1), longest);
  QVERIFY2(w.shows(100), "it is not shown for that");
  QTRY_VERIFY_WITH_TIMEOUT(!w.view()->picture().isNull(), longest);
  w.key(Qt::Key_Right);
  QVERIFY2(!w.view()->picture().isNull(), "no flash of black between two steps");
  QCOMPARE(w.session().seriesOf(axialViewId)->volume->value(8, 8, 8), 200.f);
  QTRY_VERIFY_WITH_TIMEOUT(held(2), longest);
}

void TestTimePoints::memoryWithoutRoomLoadsNothingAhead() {
  SeriesPool pool(100);
  const auto volume = [] {
    VolumeParts parts;
    parts.geometry.size = {40, 1, 1};
    parts.values = std::vector<std::uint8_t>(40);
    std::vector<std::string> warnings;
    auto series = std::make_shared<ShownSeries>();
    series->volume = *Volume::make(std::move(parts), warnings);
    return series;
  };
  pool.put({{"a", "1"}, {}}, volume());
  pool.put({{"a", "2"}, {}}, volume());
  pool.setOnScreen({{{"a", "1"}, {}}});
  QVERIFY(pool.hasRoomFor(60));
  QVERIFY(!pool.hasRoomFor(61));
}

void TestTimePoints::theSliderIsThereWhereThereAreSeveral() {
  Perfusion w(path_);
  QVERIFY(w.opened());
  QVERIFY(w.slider()->isVisible());
  QCOMPARE(w.slider()->maximum(), steps - 1);
  QTest::mouseClick(w.slider(), Qt::LeftButton, {}, {w.slider()->width() - 3, w.slider()->height() / 2});
  QVERIFY(w.slider()->value() > 0);
  QCOMPARE(w.slider(coronalViewId)->value(), w.slider()->value());
  Perfusion alone(QStringLiteral("phantom:sphere:16"));
  QVERIFY(alone.opened());
  QVERIFY(!alone.slider()->isVisible());
}

void TestTimePoints::aClipRunsInTime() {
  Perfusion w(path_);
  QVERIFY(w.opened());
  QVERIFY(w.shows(100));
  w.session().setFocus(axialViewId);
  w.view()->setFocus();
  const int before = w.session().undoStack().count();
  const glm::dvec3 place = w.view()->plane()->centre;
  QTest::keyClick(w.view(), Qt::Key_C);
  for (const int value : {200, 300, 400, 100}) QVERIFY(w.shows(value));
  QTest::keyClick(w.view(), Qt::Key_C);
  QCOMPARE(w.view()->plane()->centre, place);
  QCOMPARE(w.session().undoStack().count(), before + 1);
}

void TestTimePoints::theAxisIsNamedByWhatVaries_data() {
  QTest::addColumn<int>("axis");
  QTest::addColumn<QStringList>("values");
  QTest::addColumn<QString>("second");
  QTest::addColumn<QString>("all");
  QTest::newRow("b-values") << 0
                            << QStringList{QStringLiteral("800"), QStringLiteral("0"), QStringLiteral("50")}
                            << QStringLiteral("b 50 (2 of 3)") << QStringLiteral("b = 0, 50, 800");
  QTest::newRow("echoes") << 1 << QStringList{QStringLiteral("9.5"), QStringLiteral("31")}
                          << QStringLiteral("echo 2 of 2: 31 ms") << QStringLiteral("echo times 9.5, 31 ms");
  QTest::newRow("times, not as text")
      << 2 << QStringList{QStringLiteral("10"), QStringLiteral("9"), QStringLiteral("8")}
      << QStringLiteral("time point 2 of 3") << QStringLiteral("time points 8, 9, 10");
  QTest::newRow("one alone") << 2 << QStringList{QStringLiteral("1")} << QString() << QString();
}

void TestTimePoints::theAxisIsNamedByWhatVaries() {
  QFETCH(int, axis);
  QFETCH(QStringList, values);
  QFETCH(QString, second);
  QFETCH(QString, all);
  std::string Series::*const axes[] = {&Series::bValue, &Series::echoTime, &Series::timePoint};
  Workspace workspace;
  for (const QString& value : values) {
    const QByteArray text = value.toUtf8();
    const ShownSeriesPtr step = named(text.constData(), axes[axis], text.constData());
    workspace.series[keyOf(step->series)].series = std::make_shared<const Series>(step->series);
  }
  Series other = named("other", axes[axis], "77")->series;
  other.seriesUid = "1.2.4";
  workspace.series[keyOf(other)].series = std::make_shared<const Series>(other);
  const SeriesKey any = keyOf(named(values[0].toUtf8().constData(), axes[axis], "")->series);
  const auto steps = timePointsOf(workspace, any);
  QCOMPARE(steps.size(), std::size_t(values.size()));
  if (steps.size() > 1) QCOMPARE(timePointText(workspace, keyOf(*steps[1])), second);
  QCOMPARE(timeAxisText(workspace, any), all);
}

VOLUMEN_TEST(TestTimePoints);
#include "tst_time_points.moc"
