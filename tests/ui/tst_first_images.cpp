// Guards the first image while a series is being loaded: its middle slice, which scrolls. It disappears once
// the views show the series or the load is cancelled.
#include <QLineEdit>
#include <QSemaphore>
#include <QTemporaryDir>
#include <QTreeView>
#include <atomic>

#include "io/export/dicom_series.h"
#include "io/index/index.h"
#include "tests/ui/frames_window.h"
#include "tests/ui/two_series.h"
#include "ui/views/first_image.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

// A window whose loads end when the gate releases them.
struct SlowLoads {
  QSemaphore gate;
  std::atomic<int> came = 0;  // arrivals at the gate
  Journey w;

  explicit SlowLoads(const char* path) : SlowLoads(QString::fromStdString(dataPath(path))) {}
  explicit SlowLoads(const QString& path, const std::string& indexFolder = {})
      : w({}, services(indexFolder)) {
    openAlone(false);
    if (!path.isEmpty()) w.window.open({path});
  }
  ~SlowLoads() { gate.release(100); }
  Services services(const std::string& indexFolder) {
    Services services = realServices();
    if (!indexFolder.empty()) services.indexFolder = indexFolder;
    services.makeScene = [this, real = services.makeScene](const std::string& preset, const Volume& volume) {
      ++came;
      gate.acquire();
      return real(preset, volume);
    };
    return services;
  }
  FirstImage* image() { return w.child<FirstImage>("firstImage"); }
  bool appears() {
    return QTest::qWaitFor([this] { return image()->isVisible(); }, longest);
  }
  Session& session() { return w.window.session(); }
  Loader& loader() { return w.window.document().loader; }
  // Releases a load, waits until the series is on screen and returns its key.
  SeriesKey loaded() {
    gate.release(1);
    const auto isSeen = [&] { return flat() && !flat()->picture().isNull() && image()->isHidden(); };
    return QTest::qWaitFor(isSeen, longest) ? flat()->state().series : SeriesKey{};
  }
  FlatView* flat() { return qobject_cast<FlatView*>(w.window.views()->viewShown()); }
};

// Writes a CT of -1000 to 1000 HU from side to side whose files have these windows.
Status writeCt(const QString& folder, const std::vector<Window>& windows) {
  VolumeParts parts;
  parts.geometry.size = {64, 64, 48};
  parts.geometry.patientFromVoxelStep *= 2;
  std::vector<std::int16_t> values;
  for (int n = 0; n < 64 * 64 * 48; ++n) values.push_back(std::int16_t(-1000 + 2000 * (n % 64) / 63));
  parts.values = std::move(values);
  parts.attributes.modality = "CT";
  parts.attributes.windows = windows;
  std::vector<std::string> warnings;
  const Result<VolumePtr> volume = Volume::make(std::move(parts), warnings);
  if (!volume) return volume.error();
  DicomSeriesTags tags;
  tags.patientName = "Doe^Jane", tags.patientId = "77", tags.studyDate = "20260301",
  tags.description = "Chest";
  const auto written = writeDicomSeries(**volume, tags, folder.toStdString());
  return written ? Status() : Status(written.error());
}

constexpr const char* chest = "ct-chest-lidc0314-138";

}  // namespace

class TestFirstImages : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void cleanup() { openAlone(); }
  void theMiddleSliceIsThereBeforeTheVolume();
  void theWheelScrollsIt();
  void theWindowIsThatOfTheVolume_data();
  void theWindowIsThatOfTheVolume();
  void theListOfStudiesGivesWayToIt();
  void itGoesOnceTheViewsShowTheSeries();
  void itGoesWithTheLoad_data();
  void itGoesWithTheLoad();
  void itLiesOverTheViewThatWaits();
  void whatAnOverlayIsLaidOverStays();
  void whatIsShownAgainEndsTheLoad();
  void whatIsLoadedAtOnceHasNone();
  void whatIsDoneMeanwhileHolds();
  void aGridThatIsChosenMeanwhileHolds();
  void noFieldHasTheKeysAtFirst();
  void whatIsTypedMeanwhileIsNotSearchedFor();
};

void TestFirstImages::theMiddleSliceIsThereBeforeTheVolume() {
  NEED_DATA(dataPath(chest));
  SlowLoads s(chest);
  QVERIFY(s.appears());
  QVERIFY(!s.w.window.session().series());
  QCOMPARE(s.image()->index(), 69);
  QCOMPARE(s.w.window.session().undoStack().count(), 0);
  // The CT is 512 pixels wide. Its middle is body, its corner air.
  const QImage& picture = s.image()->picture();
  QCOMPARE(picture.size(), s.image()->size() * s.image()->devicePixelRatioF());
  QVERIFY(qGray(picture.pixel(picture.width() / 2, picture.height() / 2)) > 0);
  s.w.shot("first-image");
}

void TestFirstImages::theWheelScrollsIt() {
  NEED_DATA(dataPath(chest));
  SlowLoads s(chest);
  QVERIFY(s.appears());
  const QImage middle = s.image()->picture();
  wheel(s.image(), -3);
  QTRY_VERIFY_WITH_TIMEOUT(s.image()->index() == 72 && s.image()->picture() != middle, longest);
  wheel(s.image(), 1000);
  QTRY_COMPARE_WITH_TIMEOUT(s.image()->index(), 0, longest);
}

void TestFirstImages::theWindowIsThatOfTheVolume_data() {
  QTest::addColumn<bool>("hasWindows");
  QTest::newRow("that of the files") << true;
  QTest::newRow("40 / 400 where files have none") << false;
}

// The window does not jump when the volume arrives.
void TestFirstImages::theWindowIsThatOfTheVolume() {
  QFETCH(bool, hasWindows);
  const QTemporaryDir folder;
  const QString path = folder.filePath(QStringLiteral("ct"));
  const std::vector<Window> windows{{-600, 1500}, {50, 350}};
  const Status written = writeCt(path, hasWindows ? windows : std::vector<Window>());
  QVERIFY2(written, written ? "" : written.message().c_str());
  SlowLoads s(path);
  std::optional<GreyMapping> seen;
  connect(&s.w.window.document().slices, &SliceService::ready, s.image(), [&](const SlicePicture& picture) {
    if (picture.request.view == firstImageId) seen = picture.request.layers[0].grey;
  });
  QVERIFY(s.appears());
  QVERIFY(seen && seen->window == (hasWindows ? windows[0] : Window{40, 400}));
  QVERIFY(!s.loaded().empty());
  const GreyMapping then = s.flat()->requestFor({64, 64})->layers[0].grey;
  QVERIFY(then.window == seen->window && then.function == seen->function && then.inverted == seen->inverted);
}

// Double-clicking a study while nothing is open hides the study browser. It returns if the load is cancelled.
void TestFirstImages::theListOfStudiesGivesWayToIt() {
  const QTemporaryDir folder;
  const QString path = folder.filePath(QStringLiteral("ct"));
  const std::string home = folder.filePath(QStringLiteral("home")).toStdString();
  QVERIFY(writeCt(path, {}));
  {
    Result<Index> index = Index::open(home);
    QVERIFY(index && index->import({path.toStdString()}));
  }
  SlowLoads s(QString(), home);
  auto* browser = s.w.child<QWidget>("studyBrowser");
  auto* tree = s.w.child<QTreeView>("browserTree");
  const auto doubleClick = [&] {
    const QModelIndex row = tree->model()->index(tree->model()->rowCount() - 1, 0);
    const QPoint at = tree->visualRect(row).center();
    QTest::mouseClick(tree->viewport(), Qt::LeftButton, {}, at);
    QTest::mouseDClick(tree->viewport(), Qt::LeftButton, {}, at);
  };
  QTRY_VERIFY_WITH_TIMEOUT(browser->isVisible() && tree->model()->rowCount() > 0, longest);
  doubleClick();
  QVERIFY(s.appears());
  QVERIFY(!browser->isVisible());
  QTRY_COMPARE_WITH_TIMEOUT(s.came.load(), 1, longest);
  s.loader().cancel();
  QTRY_VERIFY_WITH_TIMEOUT(browser->isVisible() && !s.image()->isVisible(), longest);
  s.gate.release(1);  // lets the cancelled load end
  // The list may be refilled between the two clicks, which then are no double-click.
  const auto opens = [&] {
    doubleClick();
    return QTest::qWaitFor([&] { return s.image()->isVisible(); }, 2000);
  };
  QTRY_VERIFY_WITH_TIMEOUT(opens(), longest);
  QVERIFY(!s.loaded().empty());
  QVERIFY(!browser->isVisible());
}

void TestFirstImages::itGoesOnceTheViewsShowTheSeries() {
  NEED_DATA(dataPath(chest));
  SlowLoads s(chest);
  QVERIFY(s.appears());
  s.gate.release(10);
  QTRY_VERIFY_WITH_TIMEOUT(s.image()->isHidden(), longest);
  QVERIFY(s.flat() && !s.flat()->picture().isNull());
}

void TestFirstImages::itGoesWithTheLoad_data() {
  QTest::addColumn<bool>("another");
  QTest::newRow("it is cancelled") << false;
  QTest::newRow("another series is opened") << true;
}

void TestFirstImages::itGoesWithTheLoad() {
  QFETCH(bool, another);
  NEED_DATA(dataPath(chest));
  SlowLoads s(chest);
  QVERIFY(s.appears());
  if (another) {
    s.w.window.open({QStringLiteral("phantom:sphere:32")});
    s.gate.release(10);
  } else {
    s.w.window.document().loader.cancel();
  }
  QTRY_VERIFY_WITH_TIMEOUT(s.image()->isHidden(), longest);
  QVERIFY(s.image()->picture().isNull());
}

// The image lies not over the view in focus, which shows something else, but over the waiting view, and moves
// with it.
void TestFirstImages::itLiesOverTheViewThatWaits() {
  NEED_DATA(dataPath(chest));
  SlowLoads s(chest);
  const SeriesKey key = s.loaded();
  QVERIFY(!key.empty());
  s.w.child<QAction>("layoutTwo")->trigger();
  s.session().show(ballIn("A"), tests::right);
  s.session().setFocus(tests::right);
  QCOMPARE(s.session().workspace().view(tests::left).series, key);
  s.session().close({key});
  s.session().undoStack().undo();
  QVERIFY(s.appears());
  const auto placeOf = [&](const QWidget* widget) {
    return QRect(widget->mapTo(&s.w.window, QPoint(0, 0)), widget->size());
  };
  QCOMPARE(placeOf(s.image()), placeOf(s.w.window.views()->viewOf(tests::left)));
  s.w.child<QAction>("maximise")->trigger();
  QTRY_VERIFY_WITH_TIMEOUT(s.image()->isHidden(), longest);
  QVERIFY(s.loader().isLoading());
}

void TestFirstImages::whatAnOverlayIsLaidOverStays() {
  NEED_DATA(dataPath(chest));
  SlowLoads s(chest);
  const SeriesKey key = s.loaded();
  QVERIFY(!key.empty());
  const Series over = *s.session().workspace().series.at(key).series;
  s.session().show(ballIn("A"));
  s.session().pool().forget(key);
  QVERIFY(!s.loader().isLoading());
  s.session().change(QStringLiteral("test"),
                     withOverlay(s.session().workspace(), s.session().workspace().focus, &over));
  QVERIFY(s.loader().isLoading());
  QVERIFY(!QTest::qWaitFor([&] { return s.image()->isVisible(); }, 2000));
  QVERIFY(s.loader().isLoading());
}

void TestFirstImages::whatIsShownAgainEndsTheLoad() {
  NEED_DATA(dataPath(chest));
  SlowLoads s(chest);
  QVERIFY(s.appears());
  const LoadedSeriesPtr ball = ballIn("A");
  s.session().show(ball);
  QVERIFY(s.loader().isLoading());
  s.w.window.document().opener.show(ball->series);
  QVERIFY(!s.loader().isLoading());
  QTRY_VERIFY_WITH_TIMEOUT(s.image()->isHidden(), longest);
}

// Frames need no volume, and samples have no acquired slices.
void TestFirstImages::whatIsLoadedAtOnceHasNone() {
  NEED_FILES();
  Frames w({clipFile});
  QVERIFY(w.shows());
  QVERIFY(w.child<FirstImage>("firstImage")->isHidden());
}

void TestFirstImages::whatIsDoneMeanwhileHolds() {
  const QTemporaryDir dir;
  QVERIFY(writeCt(dir.path(), {{35, 350}}).ok());
  SlowLoads s(QString{});
  QSettings().setValue(QStringLiteral("layouts/CT"), QStringLiteral("one"));
  s.w.window.open({dir.path()});
  QVERIFY(s.appears());
  QTest::keyClick(&s.w.window, Qt::Key_2, Qt::AltModifier);
  QTest::keyClick(s.w.window.focusWidget() ? s.w.window.focusWidget() : &s.w.window, Qt::Key_6);
  const SeriesKey key = s.loaded();
  QVERIFY(!key.empty());
  QCOMPARE(s.session().workspace().layout, Layout::planes);
  const auto window = [&] { return s.session().workspace().series.at(key).window; };
  QTRY_COMPARE_WITH_TIMEOUT(window(), std::optional(Window{-600, 1500}), longest);
  // From now on, keys act on the shown series.
  s.flat()->setFocus();
  QTest::keyClick(s.flat(), Qt::Key_0);
  QVERIFY(!window());
}

void TestFirstImages::aGridThatIsChosenMeanwhileHolds() {
  const QTemporaryDir dir;
  QVERIFY(writeCt(dir.path(), {}).ok());
  SlowLoads s(dir.path());
  QVERIFY(s.appears());
  QTest::keyClick(&s.w.window, Qt::Key_4, Qt::AltModifier);
  const SeriesKey key = s.loaded();
  QCOMPARE(s.session().workspace().layout, Layout::two);
  QVERIFY(s.session().workspace().view(tests::left).series == key);
}

void TestFirstImages::noFieldHasTheKeysAtFirst() {
  const QTemporaryDir dir;
  QVERIFY(writeCt(dir.path(), {}).ok());
  SlowLoads s(dir.path());
  QVERIFY(!qobject_cast<QLineEdit*>(s.w.window.focusWidget()));
  QVERIFY(s.appears());
  QVERIFY(!qobject_cast<QLineEdit*>(s.w.window.focusWidget()));
  // A field that had the keyboard focus as something else was opened does not keep it.
  QVERIFY(!s.loaded().empty());
  s.w.child<QLineEdit>("studySearch")->setFocus();
  const QTemporaryDir other;
  QVERIFY(writeCt(other.path(), {}).ok());
  s.w.window.open({other.path()});
  QVERIFY(!qobject_cast<QLineEdit*>(s.w.window.focusWidget()));
}

void TestFirstImages::whatIsTypedMeanwhileIsNotSearchedFor() {
  const QTemporaryDir dir;
  QVERIFY(writeCt(dir.filePath(QStringLiteral("ct")), {}).ok());
  const std::string index = dir.filePath(QStringLiteral("index")).toStdString();
  {
    Result<Index> listed = Index::open(index);
    QVERIFY(listed && listed->import({dir.filePath(QStringLiteral("ct")).toStdString()}));
  }
  SlowLoads s(QString{}, index);
  auto* search = s.w.child<QLineEdit>("browserSearch");
  QTRY_VERIFY_WITH_TIMEOUT(search && search->isVisible(), longest);
  s.w.window.open({dir.filePath(QStringLiteral("ct"))});
  const auto type = [&](Qt::Key key) {
    QWidget* focus = s.w.window.focusWidget();
    QTest::keyClick(focus && focus->isVisible() ? focus : &s.w.window, key);
  };
  type(Qt::Key_J);
  QVERIFY(s.appears());
  type(Qt::Key_J);
  type(Qt::Key_7);
  QCOMPARE(search->text(), QString());
  const SeriesKey key = s.loaded();
  QTRY_VERIFY_WITH_TIMEOUT(s.session().workspace().series.at(key).window == Window({170, 600}), longest);
}

VOLUMEN_TEST(TestFirstImages);
#include "tst_first_images.moc"
