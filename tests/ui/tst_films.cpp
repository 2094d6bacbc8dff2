// Guards File > More pictures > Film... by real events: each picture of a film is what the view shows there,
// without names; a film is of the stack, of time points that are read for it, also in 3D, or of a turn in 3D;
// one that is cancelled or cannot be written leaves nothing.
#include <QLabel>
#include <QTemporaryDir>

#include "tests/fixtures/program.h"
#include "tests/fixtures/read_film.h"
#include "tests/ui/measure_window.h"
#include "tests/ui/perfusion_window.h"
#include "tests/ui/picture_window.h"
#include "tests/unit/suite.h"
#include "ui/widgets/banner.h"
#include "ui/workspace/time_points.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

// Returns the pictures of an animated PNG once it is there.
FilmRead filmAt(const QString& path) {
  if (!QTest::qWaitFor([&] { return QFile::exists(path); }, longest)) return {QStringLiteral("no file")};
  return readAnimatedPng(contentsOf(path));
}

void chooseByKeys(QDialog* dialog, const char* box, int index) {
  auto* field = dialog->findChild<QComboBox*>(QLatin1String(box));
  QVERIFY(field->isVisible());
  while (field->currentIndex() < index) QTest::keyClick(field, Qt::Key_Down);
}

QImage rgb888(const QImage& image) { return image.convertToFormat(QImage::Format_RGB888); }

QStringList everythingIn(const QTemporaryDir& folder) {
  return QDir(folder.path()).entryList(QDir::AllEntries | QDir::Hidden | QDir::NoDotAndDotDot);
}

}  // namespace

class TestFilms : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void aStackIsAFilm();
  void timePointsAreAFilm();
  void aTurnIsAFilm();
  void timePointsIn3dAreAFilm();
  void timePointsIn3dAreCancelled();
  void itIsMp4WhereThatIsChosen();
  void whatIsMissingForMp4IsSaid();
  void whatIsCancelledLeavesNothing();
  void withoutAPictureThereIsNone();
};

// With measurements and texts, but no names.
void TestFilms::aStackIsAFilm() {
  const QTemporaryDir folder;
  const QString path = folder.filePath(QStringLiteral("stack.png"));
  MeasureWindow w;
  QTRY_VERIFY_WITH_TIMEOUT(!w.view()->picture().isNull(), longest);
  w.draw(ShapeKind::length, {{60, 60}, {120, 90}});
  w.session().select(0);
  PictureDialog* dialog = ask(w, "saveFilm");
  QVERIFY(dialog);
  QVERIFY(!dialog->findChild<QComboBox*>(QStringLiteral("filmOf"))->isVisible());
  QVERIFY(!dialog->findChild<QWidget*>(QStringLiteral("pictureHideNames"))->isVisible());
  set(dialog, "pictureFirst", 3);
  set(dialog, "pictureLast", 9);
  set(dialog, "pictureEvery", 2);
  set(dialog, "filmPerSecond", 25);
  accept(dialog);
  answer(w, "filmDialog", path);
  const FilmRead film = filmAt(path);
  QCOMPARE(film.flaw, QString());
  QCOMPARE(film.pictures.size(), std::size_t(4));
  QCOMPARE(film.delays[0], std::pair(1, 25));
  const QImage named = w.view()->capture();
  w.child<QAction>("hideNames")->trigger();
  QVERIFY(w.view()->capture() != named);
  for (int n = 0; n < 4; ++n) {
    QVERIFY(showNumber(w.view(), 3 + 2 * n));
    QCOMPARE(film.pictures[std::size_t(n)], rgb888(w.view()->capture()));
  }
  w.child<QAction>("hideNames")->trigger();
}

// Those that are not in memory are read.
void TestFilms::timePointsAreAFilm() {
  const QTemporaryDir folder;
  const QString path = folder.filePath(QStringLiteral("time.png"));
  Perfusion w(fourVolumes(folder));
  QVERIFY(w.opened());
  QVERIFY(w.shows(100));
  w.session().setFocus(axialViewId);
  drag(w.view(), {60, 60}, {90, 80});  // window
  w.child<QAction>("hideNames")->trigger();
  const Workspace before = w.workspace();
  const auto steps = timePointsOf(before, before.view(axialViewId).series);
  QCOMPARE(steps.size(), std::size_t(Perfusion::steps));
  const std::size_t budget = w.session().pool().budget();
  w.session().pool().setBudget(0);
  QTRY_VERIFY_WITH_TIMEOUT(!w.session().seriesNamed(keyOf(*steps[2])), longest);
  QVERIFY(w.settle());
  PictureDialog* dialog = ask(w, "saveFilm");
  QVERIFY(dialog);
  chooseByKeys(dialog, "filmOf", 1);
  QCOMPARE(dialog->findChild<QLabel*>(QStringLiteral("pictureCount"))->text(), QStringLiteral("4 pictures"));
  accept(dialog);
  answer(w, "filmDialog", path);
  const FilmRead film = filmAt(path);
  QCOMPARE(film.flaw, QString());
  QVERIFY(w.workspace() == before);
  QCOMPARE(film.pictures.size(), std::size_t(Perfusion::steps));
  w.session().pool().setBudget(budget);
  for (int n = 0; n < Perfusion::steps; ++n) {
    if (n > 0) w.key(Qt::Key_Right);
    QVERIFY(w.shows(100 * (n + 1)));
    QTRY_COMPARE_WITH_TIMEOUT(rgb888(w.view()->capture()), film.pictures[std::size_t(n)], longest);
  }
  w.child<QAction>("hideNames")->trigger();
}

void TestFilms::aTurnIsAFilm() {
  const QTemporaryDir folder;
  const QString path = folder.filePath(QStringLiteral("turn.apng"));
  MeasureWindow w(ballSeries(32, 10, {8, 0, 0}));
  w.session().setFocus(sceneViewId);
  PictureDialog* dialog = ask(w, "saveFilm");
  QVERIFY(dialog);
  QVERIFY(!dialog->findChild<QWidget*>(QStringLiteral("pictureFirst"))->isVisible());
  set(dialog, "filmPictures", 4);
  set(dialog, "pictureWidth", 80);
  tick(dialog, "pictureTexts", false);
  accept(dialog);
  answer(w, "filmDialog", path);
  const FilmRead film = filmAt(path);
  QCOMPARE(film.flaw, QString());
  QCOMPARE(film.pictures.size(), std::size_t(4));
  QCOMPARE(film.pictures[0].width(), 80);
  QVERIFY2(film.pictures[0] != film.pictures[1], "the ball stands beside the axis");
  QVERIFY(film.pictures[1] != film.pictures[3]);
  QCOMPARE(QImage(path, "PNG").text(QStringLiteral("Comment")), QStringLiteral("Not for clinical use"));
}

// By the camera and the window of the one in view, which is as the first picture of its turn. In a maximum
// projection, the grey in the middle is that of the value.
void TestFilms::timePointsIn3dAreAFilm() {
  const QTemporaryDir folder;
  Perfusion w(fourVolumes(folder));
  QVERIFY(w.opened());
  QVERIFY(w.shows(100));
  w.session().edit(sceneViewId, QStringLiteral("test"), [](Scene& s) {
    s.mode = Mode::mip;
    s.window = Window{250, 500};
  });
  w.session().setFocus(sceneViewId);
  const Workspace before = w.workspace();
  std::vector<FilmRead> films;
  for (const bool isOfSteps : {false, true}) {
    const QString path =
        folder.filePath(isOfSteps ? QStringLiteral("steps.png") : QStringLiteral("turn.png"));
    PictureDialog* dialog = ask(w, "saveFilm");
    QVERIFY(dialog);
    chooseByKeys(dialog, "filmOf", isOfSteps);
    QCOMPARE(dialog->findChild<QWidget*>(QStringLiteral("filmPictures"))->isVisible(), !isOfSteps);
    QCOMPARE(dialog->findChild<QWidget*>(QStringLiteral("pictureEvery"))->isVisible(), isOfSteps);
    if (isOfSteps)
      QCOMPARE(dialog->findChild<QLabel*>(QStringLiteral("pictureCount"))->text(),
               QStringLiteral("4 pictures"));
    else
      set(dialog, "filmPictures", 2);
    set(dialog, "pictureWidth", 80);
    tick(dialog, "pictureTexts", false);
    accept(dialog);
    answer(w, "filmDialog", path);
    films.push_back(filmAt(path));
    QCOMPARE(films.back().flaw, QString());
    QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
  }
  QVERIFY(w.workspace() == before);
  const std::vector<QImage>& steps = films[1].pictures;
  QCOMPARE(steps.size(), std::size_t(Perfusion::steps));
  QCOMPARE(steps[0], films[0].pictures[0]);
  for (int n = 0; n < Perfusion::steps; ++n) {
    const QImage& picture = steps[std::size_t(n)];
    QCOMPARE(picture.width(), 80);
    const int grey = qGreen(picture.pixel(picture.rect().center())), wanted = 255 * 100 * (n + 1) / 500;
    QVERIFY2(std::abs(grey - wanted) <= 12, qPrintable(QString::number(grey)));
  }
}

void TestFilms::timePointsIn3dAreCancelled() {
  const QTemporaryDir source, folder;
  Perfusion w(fourVolumes(source));
  QVERIFY(w.opened());
  w.session().setFocus(sceneViewId);
  PictureDialog* dialog = ask(w, "saveFilm");
  QVERIFY(dialog);
  chooseByKeys(dialog, "filmOf", 1);
  set(dialog, "pictureWidth", 4000);  // takes time
  accept(dialog);
  answer(w, "filmDialog", folder.filePath(QStringLiteral("steps.png")));
  QTRY_VERIFY_WITH_TIMEOUT(w.child<QWidget>("cancelTask")->isVisible(), longest);
  QTest::mouseClick(w.child<QWidget>("cancelTask"), Qt::LeftButton);
  QTRY_COMPARE_WITH_TIMEOUT(w.child<Banner>("banner")->sentence(), QStringLiteral("Cancelled."), longest);
  QTRY_COMPARE_WITH_TIMEOUT(everythingIn(folder), QStringList(), longest);
}

void TestFilms::itIsMp4WhereThatIsChosen() {
  NEED_FFMPEG();
  const QTemporaryDir folder;
  const QString path = folder.filePath(QStringLiteral("stack.mp4"));
  MeasureWindow w;
  QTRY_VERIFY_WITH_TIMEOUT(!w.view()->picture().isNull(), longest);
  PictureDialog* dialog = ask(w, "saveFilm");
  chooseByKeys(dialog, "filmFormat", 1);
  set(dialog, "pictureLast", 3);
  accept(dialog);
  QVERIFY(w.child<QFileDialog>("filmDialog")->selectedFiles().value(0).endsWith(QStringLiteral(".mp4")));
  answer(w, "filmDialog", path);
  QTRY_VERIFY_WITH_TIMEOUT(QFile::exists(path), longest);
  const QSize seen = w.view()->pixels(),
              even(seen.width() + seen.width() % 2, seen.height() + seen.height() % 2);
  const std::vector<QImage> decoded = decodedFilm(path, even);
  QCOMPARE(decoded.size(), std::size_t(3));
  w.child<QAction>("hideNames")->trigger();
  QVERIFY(showNumber(w.view(), 3));
  QVERIFY(meanDifference(decoded[2].copy(QRect({0, 0}, seen)), w.view()->capture()) < 4);
  w.child<QAction>("hideNames")->trigger();
}

void TestFilms::whatIsMissingForMp4IsSaid() {
  const QTemporaryDir folder;
  MeasureWindow w;
  QTRY_VERIFY_WITH_TIMEOUT(!w.view()->picture().isNull(), longest);
  PictureDialog* dialog = ask(w, "saveFilm");
  chooseByKeys(dialog, "filmFormat", 1);
  accept(dialog);
  const QByteArray before = qgetenv("PATH");
  qputenv("PATH", folder.path().toUtf8());
  answer(w, "filmDialog", folder.filePath(QStringLiteral("stack.mp4")));
  const bool isSaid = QTest::qWaitFor(
      [&] {
        return w.child<Banner>("banner")->sentence() ==
               QStringLiteral("MP4 needs ffmpeg: install the package ffmpeg.");
      },
      longest);
  qputenv("PATH", before);
  QVERIFY(isSaid);
  QCOMPARE(everythingIn(folder), QStringList());
}

void TestFilms::whatIsCancelledLeavesNothing() {
  const QTemporaryDir folder;
  MeasureWindow w(ballSeries(96, 30));
  QTRY_VERIFY_WITH_TIMEOUT(!w.view()->picture().isNull(), longest);
  PictureDialog* dialog = ask(w, "saveFilm");
  dialog->findChild<QComboBox*>(QStringLiteral("pictureSize"))->setCurrentIndex(wide);
  set(dialog, "pictureWidth", 3000);  // takes time
  accept(dialog);
  answer(w, "filmDialog", folder.filePath(QStringLiteral("stack.png")));
  QTRY_VERIFY_WITH_TIMEOUT(w.child<QWidget>("cancelTask")->isVisible(), longest);
  QVERIFY(w.child<QLabel>("taskText")->text().startsWith(QStringLiteral("Saving a film")));
  QTest::mouseClick(w.child<QWidget>("cancelTask"), Qt::LeftButton);
  QTRY_COMPARE_WITH_TIMEOUT(w.child<Banner>("banner")->sentence(),
                            QStringLiteral("Interrupted; nothing was written."), longest);
  QTRY_COMPARE_WITH_TIMEOUT(everythingIn(folder), QStringList(), longest);
}

void TestFilms::withoutAPictureThereIsNone() {
  Journey empty;
  QVERIFY(!ask(empty, "saveFilm"));
  QCOMPARE(empty.child<Banner>("banner")->sentence(), QStringLiteral("Open a series first."));
}

VOLUMEN_TEST(TestFilms);
#include "tst_films.moc"
