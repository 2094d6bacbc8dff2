// Guards files that could not be read for a moment, as if a disk was offline. Frames, numbers on them,
// regions and series appear once the files can be read again.
#include <QSignalSpy>
#include <QTemporaryDir>

#include "io/paths/open_path.h"
#include "io/study/frame_series.h"
#include "results/series/loaded_frame.h"
#include "tests/ui/frames_window.h"
#include "ui/controller/derived_objects.h"
#include "ui/controller/loader.h"
#include "ui/derivations/measured_numbers.h"
#include "ui/panels/regions_panel.h"
#include "ui/workspace/measurements.h"

using namespace volumen;
using namespace volumen::tests;

class TestTriedAgain : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void framesAndNumbers();
  void framesOnScreen();
  void regions_data();
  void regions();
  void series_data();
  void series();
};

namespace {

// A file that can be moved away.
struct Away {
  QTemporaryDir folder;
  QString path = folder.filePath(QStringLiteral("a.dcm"));
  explicit Away(const QString& of) { QFile::copy(of, path); }
  bool go() const { return QFile::rename(path, path + QStringLiteral(".away")); }
  bool comeBack() const { return QFile::rename(path + QStringLiteral(".away"), path); }
};

}  // namespace

void TestTriedAgain::framesAndNumbers() {
  NEED_FILES();
  const Away file(dataFile(clipFile));
  const Result<Study> study = openPath(file.path.toStdString());
  QVERIFY(study);
  const std::vector<Series> all = frameSeries(*study);
  QCOMPARE(all.size(), std::size_t(1));
  const auto series = std::make_shared<const Series>(all[0]);
  Session session;
  session.showFrames(*series, axialViewId);
  FrameService frames;
  MeasuredNumbers measurer(session, frames);
  QSignalSpy ready(&frames, &FrameService::ready), failed(&frames, &FrameService::failed),
      measured(&measurer, &MeasuredNumbers::changed);
  Measurement length;
  length.id = 1;
  length.series = keyOf(*series);
  length.shape.points = {{10, 10, 0}, {20, 10, 0}};
  length.shape.frame = frameNamed(*series, 0);
  QVERIFY(file.go());
  QVERIFY(!measurer.numbersOf(length));
  QTRY_VERIFY_WITH_TIMEOUT(measured.count() > 0, longest);
  MeasuredPtr numbers = measurer.numbersOf(length);
  QVERIFY(numbers && !*numbers);
  frames.request(sceneViewId, series, 0, 1);
  QTRY_VERIFY_WITH_TIMEOUT(failed.count() == 1, longest);
  QVERIFY(file.comeBack());
  QTRY_VERIFY_WITH_TIMEOUT((numbers = measurer.numbersOf(length)) && *numbers, longest);
  const auto isThere = [&] {
    frames.request(sceneViewId, series, 0, 1);
    return frames.find({keyOf(*series), 0, {}}) != nullptr;
  };
  QTRY_VERIFY_WITH_TIMEOUT(isThere(), longest);
}

// Nobody touches the window meanwhile.
void TestTriedAgain::framesOnScreen() {
  NEED_FILES();
  const Away file(dataFile(clipFile));
  const Result<Study> study = openPath(file.path.toStdString());
  QVERIFY(study);
  Frames w(std::vector<const char*>{});
  QVERIFY(file.go());
  w.session().showFrames(frameSeries(*study).at(0), axialViewId);
  const auto fails = [&] { return w.view() && !w.view()->failure().isEmpty(); };
  QTRY_VERIFY_WITH_TIMEOUT(fails(), longest);
  QVERIFY(file.comeBack());
  QVERIFY(w.shows());
  QVERIFY(w.view()->failure().isEmpty());
}

void TestTriedAgain::regions_data() {
  QTest::addColumn<bool>("isShownAnew");
  QTest::newRow("shown anew") << true;
  QTest::newRow("left as they are") << false;
}

void TestTriedAgain::regions() {
  QFETCH(bool, isShownAnew);
  NEED_DATA(dataPath("pet-ct"));
  const Away file(QString::fromStdString(dataPath("pet-ct/sts019-rtstruct-ct.dcm")));
  const Result<Study> study = openPath(file.path.toStdString());
  QVERIFY(study && study->derived.size() == 1);
  const auto object = std::make_shared<const DerivedObject>(study->derived[0]);
  Session session;
  Jobs jobs;
  DerivedObjects derived(session, jobs);
  derived.setOpen({object});
  QSignalSpy failed(&derived, &DerivedObjects::failed);
  const auto show = [&](bool on) {
    session.change(QStringLiteral("test"), [&](Workspace& w) {
      if (on)
        w.regions.add(keyOf(*object), firstLook(*object));
      else
        w.regions.erase(keyOf(*object));
    });
  };
  QVERIFY(file.go());
  show(true);
  QTRY_COMPARE_WITH_TIMEOUT(failed.count(), 1, longest);
  QVERIFY(file.comeBack());
  QVERIFY2(!derived.regions(keyOf(*object)), "views that ask again and again do not read again");
  QVERIFY(jobs.rows().empty());
  if (isShownAnew) {
    show(false);
    show(true);
  }
  QTRY_VERIFY_WITH_TIMEOUT(derived.regions(keyOf(*object)), longest);
  QCOMPARE(failed.count(), 1);
}

void TestTriedAgain::series_data() {
  QTest::addColumn<bool>("isRequested");
  QTest::newRow("after a while") << false;
  QTest::newRow("at once where it is requested") << true;
}

void TestTriedAgain::series() {
  QFETCH(bool, isRequested);
  NEED_DATA(dataPath("dicom-geometry/mr-mosaic-siemens/axasc35.dcm"));
  const Away file(QString::fromStdString(dataPath("dicom-geometry/mr-mosaic-siemens/axasc35.dcm")));
  const Result<Study> study = openPath(file.path.toStdString());
  QVERIFY(study && !study->volumes.empty());
  const Series& series = study->volumes[0];
  Session session;
  Jobs jobs;
  Loader loader(session, jobs, realServices().makeScene);
  QSignalSpy failed(&loader, &Loader::failed), requested(&loader, &Loader::requestLoaded);
  QVERIFY(file.go());
  session.open(QStringLiteral("test"), withSeries({}, sceneViewId, series, {}));
  QTRY_COMPARE_WITH_TIMEOUT(failed.count(), 1, longest);
  QVERIFY(file.comeBack());
  session.setFocus(axialViewId);
  QVERIFY2(!loader.isBusy(), "not at every change");
  if (isRequested) {
    session.request([&](Requests& r) { r.show = {std::make_shared<const Series>(series)}; });
    QTRY_COMPARE_WITH_TIMEOUT(requested.count(), 1, longest);
  } else {
    QTest::qWait(Loader::tryAgainMs + 100);
    session.setFocus(sceneViewId);
    QTRY_VERIFY_WITH_TIMEOUT(session.seriesNamed(keyOf(series)), longest);
  }
  QCOMPARE(failed.count(), 1);
}

VOLUMEN_TEST(TestTriedAgain);
#include "tst_tried_again.moc"
