// Guards slices.md 2 (large frames) in the window: reading ends where the pool has no room, a view says that
// it is loading, what is seen small is right and what is seen large, and said, are the pixels of the file.
#include <QLabel>

#include "io/paths/open_path.h"
#include "io/study/frame_series.h"
#include "io/thumbnail.h"
#include "tests/ui/frames_window.h"
#include "tests/ui/hung_studies.h"
#include "ui/controller/frame_picture.h"
#include "ui/controller/thumbnails.h"

using namespace volumen;
using namespace volumen::tests;

class TestLargeFrames : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void readingEndsOnceAllIsSeen_data();
  void readingEndsOnceAllIsSeen();
  void framesAreReadOnceForARequest();
  void framesAndSeriesShareOneBudget();
  void aViewSaysThatItLoads();
  void aViewSaysHowMuchIsRead();
  void readingIsToldByPercents();
  void aSeriesOfFourIsReadOnce();
  void aFrameInMemoryIsNotReadForItsThumbnail();
  void thumbnailsWaitForViews();
  void pixelsAreExact_data();
  void pixelsAreExact();
  void reducedPicturesAreRight_data();
  void reducedPicturesAreRight();
};

namespace {

constexpr int columns = 2403, rows = 1901;
const QPoint mark(1001, 777);

int valueAt(int x, int y) { return x == mark.x() && y == mark.y() ? 3000 : x / 4 + y / 8; }

// Mammograms of a ramp, and one pixel that is none.
struct LargeMammograms {
  QTemporaryDir folder;

  bool write(int count, BreastSeries in = BreastSeries::ofEach) const {
    std::vector<Uint16> pixels(std::size_t(columns) * rows);
    for (int y = 0; y < rows; ++y)
      for (int x = 0; x < columns; ++x)
        pixels[std::size_t(y) * columns + std::size_t(x)] = Uint16(valueAt(x, y));
    for (int n = 0; n < count; ++n) {
      Breast breast = breasts[n];
      breast.columns = columns, breast.rows = rows;
      const QString path = folder.filePath(QString::number(n));
      if (!writeBreast(breast, n + 1, path, in)) return false;
      DcmFileFormat file;
      if (file.loadFile(path.toStdString().c_str()).bad()) return false;
      file.getDataset()->putAndInsertUint16Array(DCM_PixelData, pixels.data(), pixels.size());
      if (file.saveFile(path.toStdString().c_str(), EXS_LittleEndianExplicit).bad()) return false;
    }
    return true;
  }
};

std::vector<Series> seriesIn(const LargeMammograms& data) {
  const Result<Study> study = openPath(data.folder.path().toStdString());
  if (!study) return {};
  std::vector<Series> all = study->volumes;
  for (const Series& series : frameSeries(*study)) all.push_back(series);
  return all;
}

struct LargeWindow : Frames {
  LargeWindow(const LargeMammograms& data, std::size_t budget) : Frames({}) {
    service().setBudget(budget);
    window.open({data.folder.path()});
  }

  FrameService& service() { return window.document().frames; }
  std::vector<FrameView*> framesSeen() {
    std::vector<FrameView*> all;
    for (FrameView* each : window.findChildren<FrameView*>())
      if (each->isVisible()) all.push_back(each);
    return all;
  }
  bool seesAll(std::size_t count) {
    return QTest::qWaitFor(
        [&] {
          const std::vector<FrameView*> seen = framesSeen();
          return seen.size() == count && std::ranges::all_of(seen, [](const FrameView* each) {
                   return each->frame() && !each->picture().isNull();
                 });
        },
        longest);
  }
};

}  // namespace

void TestLargeFrames::readingEndsOnceAllIsSeen_data() {
  QTest::addColumn<int>("count");
  QTest::addColumn<int>("megabytes");
  QTest::newRow("four, of which none has room") << 4 << 1;
  QTest::newRow("four, of which two have room") << 4 << 20;
  QTest::newRow("one, room for more") << 1 << 100;
}

void TestLargeFrames::readingEndsOnceAllIsSeen() {
  QFETCH(int, count);
  QFETCH(int, megabytes);
  const LargeMammograms data;
  QVERIFY(data.write(count));
  LargeWindow w(data, std::size_t(megabytes) << 20);
  QVERIFY(w.seesAll(std::size_t(count)));
  QTest::qWait(200);
  QSignalSpy read(&w.service(), &FrameService::held);
  QTest::qWait(1000);
  QCOMPARE(read.count(), 0);
  for (const FrameView* each : w.framesSeen()) QVERIFY(w.service().find(each->frame()->key));
}

// Of two views in a pool that has room for one frame, and nobody else holds any.
void TestLargeFrames::framesAreReadOnceForARequest() {
  NEED_FILES();
  const Result<Study> study = openPath(dataFile(clipFile).toStdString());
  QVERIFY(study);
  const auto series = std::make_shared<const Series>(frameSeries(*study).at(0));
  FrameService frames(1);
  QSignalSpy read(&frames, &FrameService::held);
  int ready = 0;  // a spy would hold the frames
  connect(&frames, &FrameService::ready, this, [&] { ++ready; });
  frames.request(axialViewId, series, 0, 1);
  QTRY_COMPARE_WITH_TIMEOUT(ready, 1, longest);
  frames.request(coronalViewId, series, 8, 1);
  QTRY_COMPARE_WITH_TIMEOUT(ready, 2, longest);
  QTest::qWait(500);
  QVERIFY2(read.count() <= 3, "those of both, and the middle one for its window");
  QVERIFY(!frames.find({keyOf(*series), 0, {}}));
}

void TestLargeFrames::framesAndSeriesShareOneBudget() {
  constexpr std::size_t frame = std::size_t(2) * columns * rows, budget = 3 * frame;
  const LargeMammograms data;
  QVERIFY(data.write(4));
  LargeWindow w(data, 10 * frame);
  QVERIFY(w.seesAll(4));
  SeriesPool& pool = w.window.session().pool();
  QVERIFY2(pool.counted() >= 4 * frame, qPrintable(QString::number(pool.counted())));
  pool.setBudget(budget);
  QVERIFY2(pool.counted() >= 4 * frame, "what is on screen stays");
  w.window.session().closeAll({});
  w.window.open({QStringLiteral("phantom:ct-head:64")});
  QTRY_VERIFY_WITH_TIMEOUT(w.window.session().series(), longest);
  QTRY_VERIFY_WITH_TIMEOUT(pool.counted() <= budget, longest);
}

void TestLargeFrames::aViewSaysThatItLoads() {
  const LargeMammograms data;
  QVERIFY(data.write(1));
  LargeWindow w(data, 1 << 20);
  w.service().blockSignals(true);
  QTRY_COMPARE_WITH_TIMEOUT(w.framesSeen().size(), std::size_t(1), longest);
  FrameView* view = w.framesSeen().front();
  const auto* loading = view->findChild<QLabel*>(QStringLiteral("loadingMark"));
  QVERIFY(loading);
  QTRY_VERIFY_WITH_TIMEOUT(loading->isVisible(), longest);
  QVERIFY(!view->frame());
  w.service().blockSignals(false);
  QTRY_VERIFY_WITH_TIMEOUT(w.service().find({view->state().series, 0}), longest);
  QVERIFY(w.after(
      [&] {
        view->resize(view->size() - QSize(10, 0));
        w.session().change({}, [&](Workspace& now) {
          now.editView(view->id()).flats.editOrAdd(view->state().series).zoom = 1.5;
        });
      },
      view->id()));
  QVERIFY(!loading->isVisible());
}

void TestLargeFrames::aViewSaysHowMuchIsRead() {
  const LargeMammograms data;
  QVERIFY(data.write(1));
  LargeWindow w(data, 1 << 20);
  w.service().blockSignals(true);  // so that the view goes on to wait
  QTRY_COMPARE_WITH_TIMEOUT(w.framesSeen().size(), std::size_t(1), longest);
  FrameView* view = w.framesSeen().front();
  const auto* loading = view->findChild<QLabel*>(QStringLiteral("loadingMark"));
  QTRY_VERIFY_WITH_TIMEOUT(loading->isVisible(), longest);
  QCOMPARE(loading->text(), QStringLiteral("Loading"));
  w.service().blockSignals(false);
  Q_EMIT w.service().progressed({view->state().series, 7}, 90);
  QCOMPARE(loading->text(), QStringLiteral("Loading"));
  Q_EMIT w.service().progressed({view->state().series, 0}, 40);
  QCOMPARE(loading->text(), QStringLiteral("Loading 40 %"));
  QVERIFY(loading->width() >= loading->sizeHint().width() && view->rect().contains(loading->geometry()));
  QTRY_VERIFY_WITH_TIMEOUT(w.service().find({view->state().series, 0}), longest);
  QVERIFY(w.after(
      [&] {
        w.session().change({}, [&](Workspace& now) {
          now.editView(view->id()).flats.editOrAdd(view->state().series).zoom = 1.5;
        });
      },
      view->id()));
  QVERIFY(!loading->isVisible());
  QCOMPARE(loading->text(), QStringLiteral("Loading"));
}

void TestLargeFrames::readingIsToldByPercents() {
  const LargeMammograms data;
  QVERIFY(data.write(1));
  const auto series = std::make_shared<const Series>(seriesIn(data).at(0));
  FrameService frames(std::size_t(1) << 30);
  QSignalSpy told(&frames, &FrameService::progressed), ready(&frames, &FrameService::ready);
  frames.request(axialViewId, series, 0, 1);
  QTRY_COMPARE_WITH_TIMEOUT(ready.count(), 1, longest);
  QVERIFY(told.count() > 5);
  int last = 0;
  for (const QList<QVariant>& one : told) {
    QCOMPARE(one[0].value<FrameKey>().index, 0);
    QVERIFY(one[1].toInt() > last && one[1].toInt() <= 100);
    last = one[1].toInt();
  }
}

// Of four views, whose window needs the middle frame.
void TestLargeFrames::aSeriesOfFourIsReadOnce() {
  const LargeMammograms data;
  QVERIFY(data.write(4, BreastSeries::ofAll));
  const auto series = std::make_shared<const Series>(seriesIn(data).at(0));
  QCOMPARE(frameCount(*series), 4);
  FrameService frames(std::size_t(1) << 30);
  QSignalSpy read(&frames, &FrameService::held), ready(&frames, &FrameService::ready);
  const ViewId views[] = {axialViewId, coronalViewId, sagittalViewId, sceneViewId};
  for (int n = 0; n < 4; ++n) frames.request(views[n], series, n, 1);
  QTRY_COMPARE_WITH_TIMEOUT(ready.count(), 4, longest);
  QTest::qWait(200);
  QCOMPARE(read.count(), 4);
}

void TestLargeFrames::aFrameInMemoryIsNotReadForItsThumbnail() {
  constexpr int edge = 44;
  const LargeMammograms data;
  QVERIFY(data.write(1));
  const auto series = std::make_shared<const Series>(seriesIn(data).at(0));
  const Result<QImage> fromFile = thumbnailOf(*series, edge);
  QVERIFY(fromFile);
  FrameService frames(std::size_t(1) << 30);
  QSignalSpy ready(&frames, &FrameService::ready);
  frames.request(axialViewId, series, 0, 1);
  QTRY_COMPARE_WITH_TIMEOUT(ready.count(), 1, longest);
  QVERIFY(QFile::remove(QString::fromStdString(series->files.front())));
  Thumbnails thumbnails(edge, frames);
  QSignalSpy made(&thumbnails, &Thumbnails::made);
  thumbnails.request(*series);
  QTRY_COMPARE_WITH_TIMEOUT(made.count(), 1, longest);
  QCOMPARE(made[0][1].value<QImage>(), squareThumbnail(*fromFile, edge));
}

void TestLargeFrames::thumbnailsWaitForViews() {
  const LargeMammograms data;
  QVERIFY(data.write(2));
  const std::vector<Series> all = seriesIn(data);
  QCOMPARE(all.size(), std::size_t(2));
  FrameService frames(std::size_t(1) << 30);
  Thumbnails thumbnails(44, frames);
  QStringList order;
  connect(&frames, &FrameService::ready, this, [&] { order << QStringLiteral("seen"); });
  connect(&thumbnails, &Thumbnails::made, this, [&] { order << QStringLiteral("thumbnail"); });
  for (const Series& series : all) thumbnails.request(series);
  frames.request(axialViewId, std::make_shared<const Series>(all[0]), 0, 1);
  frames.request(coronalViewId, std::make_shared<const Series>(all[1]), 0, 1);
  QTRY_COMPARE_WITH_TIMEOUT(order.size(), 4, longest);
  QCOMPARE(order.mid(0, 2), QStringList({QStringLiteral("seen"), QStringLiteral("seen")}));
}

void TestLargeFrames::pixelsAreExact_data() {
  QTest::addColumn<int>("megabytes");
  QTest::newRow("no room") << 1;
  QTest::newRow("room") << 100;
}

void TestLargeFrames::pixelsAreExact() {
  QFETCH(int, megabytes);
  const LargeMammograms data;
  QVERIFY(data.write(1));
  LargeWindow w(data, std::size_t(megabytes) << 20);
  QVERIFY(w.seesAll(1));
  const FrameView* view = w.framesSeen().front();
  const GreyMapping grey{{400, 800}, WindowFunction::linear, {}, false};
  for (const QPoint pixel : {mark, mark + QPoint(1, 0), QPoint(3, 5), QPoint(columns - 2, rows - 2)}) {
    const double value = valueAt(pixel.x(), pixel.y());
    const int expected = int(255 * greyOf(value, grey) + 0.5);
    QCOMPARE(qGray(w.seen(pixel.x(), pixel.y(), view->id())), expected);
    QVERIFY2(w.said(pixel.x(), pixel.y()).startsWith(QString::number(value) + u' '),
             qPrintable(w.said(pixel.x(), pixel.y())));
  }
}

void TestLargeFrames::reducedPicturesAreRight_data() {
  QTest::addColumn<QString>("kind");
  for (const char* kind : {"MONOCHROME2", "MONOCHROME1", "colour", "signed", "shutter"})
    QTest::newRow(kind) << QString::fromLatin1(kind);
}

// Of a ramp the middle of what a pixel of the screen covers.
void TestLargeFrames::reducedPicturesAreRight() {
  QFETCH(QString, kind);
  const bool isColour = kind == QLatin1String("colour"), isSigned = kind == QLatin1String("signed");
  Frame frame;
  frame.size = {columns, rows};
  const auto value = [&](double x, double y) {
    return isColour ? x / 12 : x / 4 + y / 8 - (isSigned ? 400 : 0);
  };
  std::vector<float> values;
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x) values.push_back(float(std::floor(value(x, y))));
  if (isColour)
    for (const float v : values)
      frame.rgb.insert(frame.rgb.end(), {std::uint8_t(v), std::uint8_t(255 - v), 9});
  else
    frame.values = isSigned ? PixelValues(std::vector<std::int16_t>(values.begin(), values.end()), 1, 0)
                            : PixelValues(std::vector<std::uint16_t>(values.begin(), values.end()), 1, 0);
  const GreyMapping grey{
      {isSigned ? 0. : 400., 800}, WindowFunction::linear, {}, kind == QLatin1String("MONOCHROME1")};
  if (!isColour) frame.greys.push_back({{}, grey});
  if (kind == QLatin1String("shutter")) {
    frame.shutter.assign(values.size(), 0);
    std::fill_n(frame.shutter.begin(), values.size() / 2, std::uint8_t(1));
    frame.shutterGrey = 1;
  }
  Series series;
  const auto shown = shownFrame(series, {}, std::move(frame));
  QVERIFY(shown);
  SlicePlane plane = framePlane((*shown)->geometry());
  plane.mmPerPixel = 9, plane.size = {columns / 9, rows / 9}, plane.average = true;
  QVERIFY(&(*shown)->seenOn(plane, (*shown)->slice->volume) != (*shown)->slice->volume.get());
  const Result<QImage> drawn = drawFrame(**shown, plane, grey, true);
  QVERIFY(drawn);
  for (int y = 4; y < plane.size.y - 4; ++y)
    for (int x = 4; x < plane.size.x - 4; ++x) {
      const glm::dvec2 at((*shown)->geometry().voxelFromPatient(plane.patientFromPixel({x + 0.5, y + 0.5})));
      const bool isHidden = kind == QLatin1String("shutter") && at.y < rows / 2.0;
      if (kind == QLatin1String("shutter") && std::abs(at.y - rows / 2.0) < 20) continue;
      const double v = value(at.x, at.y) - 0.5;  // rounded down above
      const int expected = isHidden ? 255 : isColour ? int(v + 0.5) : int(255 * greyOf(v, grey) + 0.5);
      QVERIFY2(std::abs(qRed(drawn->pixel(x, y)) - expected) <= 1,
               qPrintable(QStringLiteral("%1, %2").arg(x).arg(y)));
      if (isColour) QVERIFY(std::abs(qGreen(drawn->pixel(x, y)) - (255 - expected)) <= 1);
    }
}

VOLUMEN_TEST(TestLargeFrames);
#include "tst_large_frames.moc"
