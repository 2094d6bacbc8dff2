// Guards that a copied picture is what is on screen. Ctrl+C and Ctrl+E give the view in focus, whatever it
// shows, and Ctrl+Shift+C all views side by side. Only controls are left out.
#include <QClipboard>
#include <QPainter>
#include <QTemporaryDir>

#include "tests/ui/frames_window.h"
#include "tests/ui/measure_window.h"
#include "ui/widgets/banner.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

// The scroll bar on the right and the cine bar at the bottom.
constexpr int barPixels = 6, timeBarPixels = 20;

QImage copied(Journey& w, Qt::KeyboardModifiers keys = Qt::ControlModifier) {
  QApplication::clipboard()->clear();
  QTest::keyClick(&w.window, Qt::Key_C, keys);
  return QApplication::clipboard()->image().convertToFormat(QImage::Format_RGB32);
}

QImage onScreen(QWidget* widget) { return widget->grab().toImage().convertToFormat(QImage::Format_RGB32); }

// Returns the picture without bars and the frame of the focus.
QImage inner(const QImage& image, int bottom = 2) {
  return image.copy(QRect(2, 2, image.width() - 2 - barPixels, image.height() - 2 - bottom));
}

bool hasColours(const QImage& image) {
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x)
      if (const QColor c = image.pixelColor(x, y); c.value() > 100 && c.saturation() > 100) return true;
  return false;
}

}  // namespace

class TestViewPictures : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void aSliceIsCopiedWithWhatIsMeasuredInIt();
  void aFrameIsCopiedAsItIsSeen();
  void aFrameThatIsReadIsAwaited();
  void a3DPictureIsCopiedAsItIsSeen();
  void textsIn3DAreOfThePictureUnderThem();
  void whatChangedBeforeItWasDrawnIsTold();
  void theViewInFocusIsCopiedAndAllViews();
  void hiddenNamesStayHidden();
  void itIsSavedAsItWasAskedFor();
  void allViewsAreSavedAsOnePicture();
  void whatCannotBeWrittenIsTold();
  void withoutASeriesThereIsASentence();
};

void TestViewPictures::aSliceIsCopiedWithWhatIsMeasuredInIt() {
  MeasureWindow w;
  QTRY_VERIFY_WITH_TIMEOUT(!w.view()->picture().isNull(), longest);
  const QImage before = copied(w);
  QCOMPARE(before.size(), w.view()->pixels());
  const int steps = w.session().undoStack().count();
  w.draw(ShapeKind::length, {{60, 60}, {120, 90}});
  const QImage after = copied(w);
  QTRY_COMPARE_WITH_TIMEOUT(inner(onScreen(w.view())), inner(after), longest);
  QVERIFY(after != before && hasColours(after));
  QCOMPARE(w.session().undoStack().count(), steps + 1);  // only the length is an undo step
}

void TestViewPictures::aFrameIsCopiedAsItIsSeen() {
  NEED_DATA(dataPath("dicom-2d"));
  Frames w({clipFile});
  QVERIFY(w.shows());
  w.session().setFocus(axialViewId);
  const QImage picture = copied(w);
  QCOMPARE(picture.size(), w.view()->pixels());
  QTRY_COMPARE_WITH_TIMEOUT(inner(onScreen(w.view()), timeBarPixels), inner(picture, timeBarPixels), longest);
}

void TestViewPictures::aFrameThatIsReadIsAwaited() {
  NEED_DATA(dataPath("dicom-2d"));
  Frames w({clipFile});
  QVERIFY(w.shows());
  w.session().setFocus(axialViewId);
  w.view()->scroll(w.view()->stack().place.count / 2);
  copied(w);
  QVERIFY(w.shows());
  const auto clipboard = [] { return QApplication::clipboard()->image(); };
  QTRY_VERIFY_WITH_TIMEOUT(!clipboard().isNull(), longest);
  QCOMPARE(clipboard().convertToFormat(QImage::Format_RGB32), w.view()->capture());
}

void TestViewPictures::a3DPictureIsCopiedAsItIsSeen() {
  Journey w;
  w.window.session().show(ballSeries());
  QVERIFY(w.settle());
  QTRY_VERIFY_WITH_TIMEOUT(w.window.view()->hasItsPicture(), longest);  // its size may still change
  QCOMPARE(inner(copied(w)), inner(onScreen(w.window.view())));
}

// Letters of a new view direction never stand over the previous picture.
void TestViewPictures::textsIn3DAreOfThePictureUnderThem() {
  Journey w;
  w.window.session().show(ballSeries(32, 10, {8, 0, 0}));
  QVERIFY(w.settle());
  w.child<QAction>("viewRight")->trigger();
  QVERIFY(!w.window.view()->hasItsPicture());
  QVERIFY2(copied(w).isNull(), "it is waited for");
  QTRY_VERIFY_WITH_TIMEOUT(!QApplication::clipboard()->image().isNull(), longest);
  QVERIFY(w.window.view()->hasItsPicture());
  const QImage picture = QApplication::clipboard()->image().convertToFormat(QImage::Format_RGB32);
  QVERIFY(w.settle());
  const QRect left(0, picture.height() / 2 - 20, 30, 40);
  QCOMPARE(picture.copy(left), onScreen(w.window.view()).copy(left));
}

void TestViewPictures::whatChangedBeforeItWasDrawnIsTold() {
  Journey w;
  w.window.session().show(ballSeries());
  QVERIFY(w.settle());
  w.child<QAction>("viewRight")->trigger();
  QVERIFY(copied(w).isNull());
  w.child<QAction>("viewLeft")->trigger();
  QCOMPARE(w.child<Banner>("banner")->sentence(),
           QStringLiteral("The view changed before it was drawn: ask for its picture again."));
  QVERIFY(w.settle());
  QVERIFY(QApplication::clipboard()->image().isNull());
}

void TestViewPictures::theViewInFocusIsCopiedAndAllViews() {
  MeasureWindow w;
  QVERIFY(w.settle());
  const QImage all = copied(w, Qt::ControlModifier | Qt::ShiftModifier);
  QCOMPARE(all.size(), w.window.views()->size());
  QList<QImage> pictures;
  for (const ViewId id : viewsOnScreen(w.session().workspace())) {
    w.session().setFocus(id);
    const QWidget* view = w.window.views()->viewOf(id);
    pictures << copied(w);
    QCOMPARE(pictures.back(), all.copy(view->geometry()));
    QVERIFY(pictures.indexOf(pictures.back()) == pictures.size() - 1);
  }
  QCOMPARE(pictures.size(), 4);
}

void TestViewPictures::hiddenNamesStayHidden() {
  auto series = std::make_shared<LoadedSeries>(*ballSeries());
  series->series.patientName = "Doe^Jane";
  MeasureWindow w(series);
  QTRY_VERIFY_WITH_TIMEOUT(!w.view()->picture().isNull(), longest);
  const QImage named = copied(w);
  w.child<QAction>("hideNames")->trigger();
  const QImage hidden = copied(w);
  w.child<QAction>("hideNames")->trigger();
  QVERIFY(hidden != named);
  QCOMPARE(copied(w), named);
}

// Slices scrolled to while the file dialog is open do not count.
void TestViewPictures::itIsSavedAsItWasAskedFor() {
  const QTemporaryDir folder;
  MeasureWindow w;
  QTRY_VERIFY_WITH_TIMEOUT(!w.view()->picture().isNull(), longest);
  const QImage shown = w.view()->capture();
  QTest::keyClick(&w.window, Qt::Key_E, Qt::ControlModifier);
  w.view()->scroll(3);
  QVERIFY(w.view()->capture() != shown);
  for (const char* name : {"slice.png", "slice.jpg"}) {
    const QString path = folder.filePath(QLatin1String(name));
    if (!w.window.findChild<QFileDialog*>(QStringLiteral("pictureDialog"))) {
      w.view()->scroll(-3);
      QCOMPARE(w.view()->capture(), shown);
      w.child<QAction>("savePicture")->trigger();
    }
    answer(w, "pictureDialog", path);
    QTRY_VERIFY_WITH_TIMEOUT(QFile::exists(path), longest);
    const QImage saved = QImage(path).convertToFormat(QImage::Format_RGB32);
    QCOMPARE(saved.size(), shown.size());
    if (path.endsWith(QStringLiteral(".png"))) {
      QCOMPARE(saved, shown);
      QCOMPARE(QImage(path).text(QStringLiteral("Comment")), QStringLiteral("Not for clinical use"));
    }
    QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
  }
}

void TestViewPictures::allViewsAreSavedAsOnePicture() {
  const QTemporaryDir folder;
  const QString path = folder.filePath(QStringLiteral("all.png"));
  MeasureWindow w;
  QVERIFY(w.settle());
  const QImage seen = w.window.views()->capture();
  w.child<QAction>("saveAllPictures")->trigger();
  answer(w, "pictureDialog", path);
  QTRY_VERIFY_WITH_TIMEOUT(QFile::exists(path), longest);
  QCOMPARE(QImage(path).convertToFormat(QImage::Format_RGB32), seen);
}

void TestViewPictures::whatCannotBeWrittenIsTold() {
  MeasureWindow w;
  w.child<QAction>("saveAllPictures")->trigger();
  answer(w, "pictureDialog", QStringLiteral("/proc/no/where.png"));
  auto* banner = w.child<Banner>("banner");
  QTRY_VERIFY_WITH_TIMEOUT(banner->isVisible(), longest);
  QVERIFY(banner->sentence().contains(QStringLiteral("/proc/no/where.png")));
}

void TestViewPictures::withoutASeriesThereIsASentence() {
  Journey w;
  for (const char* action : {"copyPicture", "savePicture", "copyAllPictures", "saveAllPictures"}) {
    w.child<Banner>("banner")->hide();
    w.child<QAction>(action)->trigger();
    QCOMPARE(w.child<Banner>("banner")->sentence(), QStringLiteral("Open a series first."));
  }
}

VOLUMEN_TEST(TestViewPictures);
#include "tst_view_pictures.moc"
