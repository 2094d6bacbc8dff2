// Guards window.md "Open objects that refer to pictures": presentation states show pictures as they specify.
// Real events on real files. Pixels are those that the README of the data states.
#include <QAbstractButton>
#include <QDir>
#include <QTemporaryDir>
#include <cmath>

#include "results/pictures/paint_graphics.h"
#include "tests/ui/derived_2d.h"
#include "tests/unit/suite.h"
#include "ui/controller/open_session.h"
#include "ui/widgets/banner.h"
#include "ui/workspace/view_window.h"

using namespace volumen;
using namespace volumen::tests;

class TestPresentationStates : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void pixelsOfAPresentationState();
  void presentationStatesAreChosenInTheMenu();
  void aWindowAloneGoesOverThatOfTheState();
  void aPresentationStateIsInTheSession();
  void itIsFoundInAFolderThatWasMoved();
  void oneThatIsMissingIsNamed();
  void textsOfTheDisplayGiveWay_data();
  void textsOfTheDisplayGiveWay();
};

namespace {

// A folder with a picture, its presentation state in a subfolder, and a session that shows both.
struct Kept {
  QTemporaryDir dir;
  QString folder = dir.filePath(QStringLiteral("here"));

  QString session() const { return folder + QStringLiteral("/s.volumen"); }
  QString state() const { return folder + QStringLiteral("/more/pr.dcm"); }
  bool make() const {
    QDir().mkpath(folder + QStringLiteral("/more"));
    QFile::copy(QString::fromStdString(dataPath(ct)), folder + QStringLiteral("/ct.dcm"));
    QFile::copy(QString::fromStdString(dataPath(presentation)), state());
    References2d w({});
    // Opens both separately, so that the folder of one does not contain the other.
    w.window.open({folder + QStringLiteral("/ct.dcm"), state()});
    if (!w.has("Presentation state: TEST") || !w.has("CT (1)")) return false;
    w.click("Presentation state: TEST");
    return w.isPresented() && saveSession(session().toStdString(), w.workspace());
  }
};

}  // namespace

void TestPresentationStates::pixelsOfAPresentationState() {
  NEED_REFERENCES();
  References2d w({ct, presentation});
  QVERIFY(w.has("Presentation state: TEST") && w.has("CT (1)"));
  w.click("Presentation state: TEST");
  QVERIFY(w.isPresented() && w.looksAtPixels());
  const auto isGrey = [&](int column, int row, int grey) {
    const QRgb seen = w.seen(column, row);
    return qRed(seen) == grey && qGreen(seen) == grey && qBlue(seen) == grey;
  };
  QVERIFY2(isGrey(51, 51, 157), qPrintable(QString::number(w.seen(51, 51), 16)));
  QVERIFY2(isGrey(64, 64, 50), qPrintable(QString::number(w.seen(64, 64), 16)));
  QVERIFY2(isGrey(20, 11, 0), "under the shutter");
  // Pixel (x, y) is drawn at (y, x).
  FlatView* view = w.view();
  const auto at = [&](int column, int row) {
    return view->plane()->pixelFromPatient(
        tests::frameIn(view)->geometry().patientFromVoxel({column, row, 0}));
  };
  QVERIFY(at(10, 100).x > at(10, 20).x && at(100, 10).y > at(20, 10).y);
  QVERIFY(std::abs(at(10, 100).y - at(10, 20).y) < 1e-6);
  // The circle about (64, 64) of radius 20 is drawn over the picture.
  const QImage screen = view->grab().toImage();
  const double ratio = view->devicePixelRatioF();
  const auto brightest = [&](glm::dvec2 p) {
    int most = 0;
    for (int dy = -2; dy <= 2; ++dy)
      for (int dx = -2; dx <= 2; ++dx)
        most = std::max(most, qGray(screen.pixel(int(p.x / ratio) + dx, int(p.y / ratio) + dy)));
    return most;
  };
  const auto ofCorner = [&](double x, double y) {  // (0, 0) is the corner of the first pixel
    return view->plane()->pixelFromPatient(
        tests::frameIn(view)->geometry().patientFromVoxel({x - 0.5, y - 0.5, 0}));
  };
  for (const double angle : {0.3, 1.9, 3.5, 5.1}) {
    const glm::dvec2 p = ofCorner(64 + 20 * std::cos(angle), 64 + 20 * std::sin(angle));
    QVERIFY2(brightest(p) > 230, qPrintable(QString::number(brightest(p))));
  }
  QVERIFY(w.saysOnView("Presentation TEST"));
  w.shot("presentation");
}

void TestPresentationStates::presentationStatesAreChosenInTheMenu() {
  NEED_REFERENCES();
  References2d w({ct, presentation});
  QVERIFY(w.has("Presentation state: TEST") && w.has("CT (1)"));
  w.click("Presentation state: TEST");
  QVERIFY(w.isPresented());
  QMenu* menu = w.menu(w.view());
  QVERIFY(menu);
  auto* choices = menu->findChild<QMenu*>(QStringLiteral("presentationMenu"));
  QVERIFY(choices);
  QVERIFY(actionNamed(choices, "TEST") && actionNamed(choices, "TEST")->isChecked());
  actionNamed(choices, "None")->trigger();
  menu->close();
  QVERIFY(w.isPresented(false));
  QVERIFY(w.workspace().view(axialViewId).flats.at(w.view()->state().series).presentation.empty());
  w.child<QAction>("undo")->trigger();
  QVERIFY(w.isPresented(true));
}

// The window alone starts as the state's window. Its changes belong to the view and are lost with it.
void TestPresentationStates::aWindowAloneGoesOverThatOfTheState() {
  NEED_REFERENCES();
  References2d w({ct, presentation});
  QVERIFY(w.has("Presentation state: TEST") && w.has("CT (1)"));
  w.click("Presentation state: TEST");
  QVERIFY(w.isPresented() && w.looksAtPixels());
  const auto seen = [&] { return qGray(w.seen(51, 51)); };
  QCOMPARE(seen(), 157);
  w.session().setFocus(axialViewId);
  w.child<QAction>("windowAlone")->trigger();
  const auto alone = [&] { return flatLookOf(w.workspace().view(axialViewId)).windowAlone; };
  QVERIFY(alone() && !alone()->window);
  QCOMPARE(seen(), 157);
  w.session().change(QStringLiteral("test"), [&](Workspace& all) {
    setWindow(all, axialViewId, Window{-600, 1500});
  });
  QVERIFY(alone()->window && !w.workspace().series.at(w.view()->state().series).window);
  // 70 HU by LINEAR of DICOM, inverted by the state, within one grey level.
  const double grey = 255 - 255 * ((70 + 600.5) / 1499 + 0.5);
  QTRY_VERIFY_WITH_TIMEOUT(std::abs(seen() - grey) <= 1, longest);
  QVERIFY(w.isPresented());
  w.session().endGesture();
  w.child<QAction>("windowAlone")->trigger();
  QVERIFY(!alone());
  QTRY_COMPARE_WITH_TIMEOUT(seen(), 157, longest);
}

void TestPresentationStates::aPresentationStateIsInTheSession() {
  NEED_REFERENCES();
  References2d w({ct, presentation});
  QVERIFY(w.has("Presentation state: TEST") && w.has("CT (1)"));
  w.click("Presentation state: TEST");
  QVERIFY(w.isPresented());
  const QTemporaryDir folder;
  const QString file = folder.filePath(QStringLiteral("s.volumen"));
  QVERIFY(saveSession(file.toStdString(), w.workspace()));
  // Only its own file is read again, because the studies of the session list only the picture.
  References2d again({});
  again.window.open({file});
  QVERIFY(again.isPresented());
}

void TestPresentationStates::itIsFoundInAFolderThatWasMoved() {
  NEED_REFERENCES();
  const Kept kept;
  QVERIFY(kept.make());
  const QString moved = kept.dir.filePath(QStringLiteral("there"));
  QVERIFY(QDir().rename(kept.folder, moved));
  References2d w({});
  w.window.open({moved + QStringLiteral("/s.volumen")});
  QVERIFY(w.isPresented());
  QVERIFY(w.child<Banner>("banner")->isHidden());
  QVERIFY2(w.has("Presentation state: TEST"), "it is in the list, too");
  QCOMPARE(flatLookOf(w.workspace().view(axialViewId)).presentation.path,
           (moved + QStringLiteral("/more/pr.dcm")).toStdString());
}

void TestPresentationStates::oneThatIsMissingIsNamed() {
  NEED_REFERENCES();
  const Kept kept;
  QVERIFY(kept.make());
  const QString away = kept.dir.filePath(QStringLiteral("away"));
  QVERIFY(QDir().mkpath(away) && QFile::rename(kept.state(), away + QStringLiteral("/other name.dcm")));
  References2d w({});
  w.window.open({kept.session()});
  QVERIFY2(w.isPresented(false), "the picture is shown");
  const auto* banner = w.child<Banner>("banner");
  QTRY_VERIFY_WITH_TIMEOUT(banner->isVisible(), longest);
  QVERIFY2(banner->sentence().contains(QStringLiteral("presentation state")) &&
               banner->sentence().contains(kept.state()),
           qPrintable(banner->sentence()));
  // The file is found by its UID.
  w.child<QAbstractButton>("bannerOffer")->click();
  answer(w, "locateDialog", away);
  QVERIFY(w.isPresented());
  QVERIFY(banner->isHidden());
}

void TestPresentationStates::textsOfTheDisplayGiveWay_data() {
  QTest::addColumn<bool>("display");
  QTest::addColumn<bool>("box");
  QTest::addColumn<int>("texts");
  QTest::addColumn<bool>("moves");
  QTest::newRow("at a point of the display") << true << false << 1 << true;
  QTest::newRow("in a box of the display") << true << true << 1 << true;
  QTest::newRow("two at one place") << true << true << 2 << true;
  QTest::newRow("at a pixel of the picture, which it tells of") << false << false << 1 << false;
}

// Texts are white on black in a corner that already has lines.
void TestPresentationStates::textsOfTheDisplayGiveWay() {
  QFETCH(bool, display);
  QFETCH(bool, box);
  QFETCH(int, texts);
  QFETCH(bool, moves);
  const AnnotationUnits units = display ? AnnotationUnits::display : AnnotationUnits::pixel;
  FramePresentation how;
  const std::string layer(1, 'L');
  how.layers.emplace_back().name = layer;
  for (int n = 0; n < texts; ++n) {
    GraphicText text;
    text.text.assign(4, n == 0 ? 'M' : 'W');
    text.layer = layer;
    if (box) text.box = GraphicText::Box{glm::dvec2(0.02), glm::dvec2(0.5, 0.1), units};
    if (!box) text.anchor = GraphicText::Anchor{glm::dvec2(0.02), units, false};
    how.texts.push_back(text);
  }
  const QRectF first(0, 0, 60, 20), second(0, 20, 90, 20);
  const auto painted = [&](std::vector<QRectF> taken) {
    QImage image(200, 200, QImage::Format_RGB32);
    image.fill(Qt::black);
    QPainter painter(&image);
    paintGraphics(
        painter, how, [](glm::dvec2 p, AnnotationUnits) { return QPointF(200 * p.x, 200 * p.y); },
        std::move(taken));
    return image;
  };
  const auto litIn = [](const QImage& image, int from, int to) {
    int lit = 0;
    for (int y = from; y < to; ++y)
      for (int x = 0; x < image.width(); ++x) lit += qGray(image.pixel(x, y)) > 100;
    return lit;
  };
  const QImage alone = painted({}), beside = painted({first, second});
  QVERIFY(litIn(alone, 0, 40) > 20);
  QCOMPARE(litIn(beside, 0, 40) == 0, moves);
  QCOMPARE(beside == alone, !moves);
  if (texts == 2) QVERIFY2(litIn(beside, 0, 200) > litIn(alone, 0, 200), "they are apart");
}

VOLUMEN_TEST(TestPresentationStates);
#include "tst_presentation_states.moc"
