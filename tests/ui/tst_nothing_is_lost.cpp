// Guards issue 51 "What may not be lost": measurements outlive the list, the window asks before it discards
// work, and discarded work can be restored.
#include <QContextMenuEvent>
#include <QDockWidget>
#include <QLabel>
#include <QMenu>
#include <QMessageBox>
#include <QPushButton>
#include <QTemporaryDir>
#include <QTreeWidget>

#include "io/export/dicom_series.h"
#include "tests/ui/measure_window.h"
#include "tests/unit/suite.h"
#include "ui/controller/autosave.h"
#include "ui/controller/session_files.h"
#include "ui/widgets/offer_bar.h"
#include "ui/workspace/hand_work.h"
#include "viewer/phantoms/phantoms.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

// A series in a folder, opened in a window, with a length and a key image.
struct Worked : Journey {
  explicit Worked(const QString& path) {
    window.open({path});
    if (!settle()) return;
    Shape length;
    length.kind = ShapeKind::length;
    length.points = {{0, 0, 0}, {10, 0, 0}};
    addMeasurement(session(), key(), length);
    session().endGesture();
    session().change(QStringLiteral("mark"), [this](Workspace& w) {
      w.keyImages.push_back({key(), "1.2", 0});
    });
    session().endGesture();
  }
  Session& session() { return window.session(); }
  const Workspace& workspace() { return session().workspace(); }
  SeriesKey key() { return workspace().view(sceneViewId).series; }
  QTreeWidget* tree() { return child<QTreeWidget>("studyTree"); }
  bool isMeasured() { return workspace().measurements.size() == 1 && workspace().keyImages.size() == 1; }
  QTreeWidgetItem* series() {
    QTreeWidgetItem* item = tree()->topLevelItem(0);
    while (item && item->childCount() > 0) item = item->child(0);
    return item;
  }
  void choose(const char* entry) {
    const QPoint at = tree()->visualItemRect(series()).center();
    QContextMenuEvent event(QContextMenuEvent::Mouse, at, tree()->viewport()->mapToGlobal(at));
    QCoreApplication::sendEvent(tree()->viewport(), &event);
    auto* menu = qobject_cast<QMenu*>(QApplication::activePopupWidget());
    QVERIFY(menu);
    for (QAction* action : menu->actions())
      if (action->text() == QLatin1String(entry))
        return QTest::mouseClick(menu, Qt::LeftButton, {}, menu->actionGeometry(action).center());
    QFAIL(entry);
  }
  QMessageBox* box() { return child<QMessageBox>("closeBox"); }
  void answerBox(const QString& text) {
    for (QAbstractButton* button : box()->buttons())
      if (button->text().contains(text)) return QTest::mouseClick(button, Qt::LeftButton);
    QFAIL(qPrintable(text));
  }
};

QMenu* earlier(Journey& w) { return w.child<QMenu>("earlierMenu"); }

}  // namespace

class TestNothingIsLost : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void init();
  void removingIsAStep_data();
  void removingIsAStep();
  void measurementsComeBackWithTheirSeries_data();
  void measurementsComeBackWithTheirSeries();
  void theSessionFileComesBackWithUndo();
  void closingAsksOnce();
  void closingSaves();
  void lookingIsNoWork();
  void aSegmentIsWork();
  void whoCannotBeAskedIsOfferedItAgain();
  void whatIsDiscardedIsKeptForAWeek();

 private:
  QString series() const { return dir_->filePath(QStringLiteral("head")); }
  std::unique_ptr<QTemporaryDir> dir_;
};

void TestNothingIsLost::init() {
  QDir(Autosave::folder()).removeRecursively();
  dir_ = std::make_unique<QTemporaryDir>();
  QVERIFY(writeDicomSeries(**makePhantom("ct-head:24"), {}, series().toStdString()));
}

void TestNothingIsLost::removingIsAStep_data() {
  QTest::addColumn<QByteArray>("entry");
  QTest::newRow("Remove from list") << QByteArray("Remove from list");
  QTest::newRow("Close all") << QByteArray("Close all");
}

void TestNothingIsLost::removingIsAStep() {
  QFETCH(QByteArray, entry);
  Worked w(series());
  QVERIFY(w.isMeasured());
  const Workspace before = w.workspace();
  w.choose(entry.constData());
  QTRY_COMPARE(w.tree()->topLevelItemCount(), 0);
  QVERIFY(w.workspace().measurements.empty() && !w.session().series());
  QAction* undo = w.child<QAction>("undo");
  QVERIFY(undo->isEnabled() && undo->text().contains(QString::fromLatin1(entry)));
  const QImage picture = w.after([&] { undo->trigger(); });
  QVERIFY2(!picture.isNull(), "it is read again");
  QVERIFY(w.workspace() == before);
  QVERIFY(w.series());
  w.child<QAction>("redo")->trigger();
  QCOMPARE(w.tree()->topLevelItemCount(), 0);
  undo->trigger();
  QVERIFY(w.isMeasured() && w.series());
}

void TestNothingIsLost::measurementsComeBackWithTheirSeries_data() {
  QTest::addColumn<QByteArray>("entry");
  QTest::addColumn<bool>("byFile");
  for (const char* entry : {"Remove from list", "Close all"}) {
    QTest::addRow("%s, the same folder", entry) << QByteArray(entry) << false;
    QTest::addRow("%s, all of its files", entry) << QByteArray(entry) << true;
  }
}

void TestNothingIsLost::measurementsComeBackWithTheirSeries() {
  QFETCH(QByteArray, entry);
  QFETCH(bool, byFile);
  Worked w(series());
  const Measurement made = w.workspace().measurements.at(0);
  w.choose(entry.constData());
  QTRY_VERIFY(w.workspace().series.empty());
  const QString elsewhere = dir_->filePath(QStringLiteral("elsewhere"));
  if (byFile) QVERIFY(QDir().rename(series(), elsewhere));
  w.settled.clear();
  w.window.open({byFile ? elsewhere : series()});
  QVERIFY(w.settle());
  QVERIFY(w.isMeasured());
  const Measurement& back = w.workspace().measurements.at(0);
  QVERIFY(back.shape == made.shape && back.id == made.id && back.series == w.key());
  QVERIFY(w.workspace().closed.empty() && w.workspace().unlisted->series.empty() == !byFile);
  // The previous undo step was the closing.
  w.child<QAction>("undo")->trigger();
  QVERIFY(w.workspace().measurements.empty());
  w.child<QAction>("undo")->trigger();
  QVERIFY(w.isMeasured());
}

void TestNothingIsLost::theSessionFileComesBackWithUndo() {
  Worked w(series());
  w.child<QAction>("saveSession")->trigger();
  answer(w, "saveSessionDialog", dir_->filePath(QStringLiteral("s.volumen")));
  QTRY_VERIFY_WITH_TIMEOUT(w.window.windowTitle().contains(QStringLiteral("s.volumen")), longest);
  w.choose("Close all");
  QTRY_VERIFY(!w.window.windowTitle().contains(QStringLiteral("s.volumen")));
  QVERIFY2(w.window.close(), "all of it is in a file");
  w.window.show();
  w.child<QAction>("undo")->trigger();
  QVERIFY(w.window.windowTitle().contains(QStringLiteral("s.volumen")));
  QVERIFY(!w.window.isWindowModified());
}

void TestNothingIsLost::closingAsksOnce() {
  {
    Worked w(series());
    QVERIFY2(!w.window.close() && w.box() && w.box()->isVisible(), "asked");
    w.shot("close-box");
    QVERIFY(w.box()->text().contains(QStringLiteral("1 measurement, 1 key image")));
    w.window.close();
    QCOMPARE(w.window.findChildren<QMessageBox*>(QStringLiteral("closeBox")).size(), 1);
    w.answerBox(QStringLiteral("Cancel"));
    QVERIFY(w.window.isVisible() && w.isMeasured());
    QTRY_VERIFY(!w.box());
    w.choose("Close all");
    QTRY_VERIFY(w.workspace().series.empty());
    QVERIFY2(!w.window.close(), "what is closed counts, too");
    w.answerBox(QStringLiteral("Close without saving"));
    QTRY_VERIFY(!w.window.isVisible());
  }
  Journey w;
  QTRY_VERIFY_WITH_TIMEOUT(earlier(w)->isEnabled(), longest);
  QVERIFY2(w.child<OfferBar>("offerBar")->isHidden(), "nobody wanted it");
  QCOMPARE(earlier(w)->actions().size(), 1);
  earlier(w)->actions().at(0)->trigger();
  QTRY_COMPARE_WITH_TIMEOUT(w.window.session().workspace().measurements.size(), std::size_t(1), longest);
  QCOMPARE(w.window.session().workspace().keyImages.size(), std::size_t(1));
  QTRY_VERIFY_WITH_TIMEOUT(!earlier(w)->isEnabled(), longest);
}

void TestNothingIsLost::closingSaves() {
  const QString path = dir_->filePath(QStringLiteral("s.volumen"));
  Worked w(series());
  QVERIFY(!w.window.close());
  w.answerBox(QStringLiteral("Save session"));
  answer(w, "saveSessionDialog", path);
  QTRY_VERIFY_WITH_TIMEOUT(!w.window.isVisible(), longest);
  QVERIFY(QFile::exists(path));
}

void TestNothingIsLost::lookingIsNoWork() {
  Journey w({series()});
  QVERIFY(w.settle());
  w.child<QAction>("viewLeft")->trigger();
  QVERIFY(w.window.close());
}

void TestNothingIsLost::aSegmentIsWork() {
  const QString path = dir_->filePath(QStringLiteral("a.seg.nrrd"));
  Journey w({series()});
  QVERIFY(w.settle());
  w.child<QDockWidget>("segmentDock")->raise();
  QTest::mouseClick(w.child<QPushButton>("segment"), Qt::LeftButton);
  auto* save = w.child<QPushButton>("segmentSave");
  QTRY_VERIFY_WITH_TIMEOUT(save->isEnabled(), longest);
  QVERIFY(!w.window.close());
  auto* box = w.child<QMessageBox>("closeBox");
  QVERIFY(box && box->text().contains(QStringLiteral("1 segment")));
  QTest::keyClick(box, Qt::Key_Escape);
  QVERIFY(w.window.isVisible());
  save->click();
  answer(w, "segmentDialog", path);
  QTRY_VERIFY_WITH_TIMEOUT(QFile::exists(path) && w.window.close(), longest);
}

void TestNothingIsLost::whoCannotBeAskedIsOfferedItAgain() {
  {
    Worked w(series());
    w.choose("Close all");
    QTRY_VERIFY(w.workspace().series.empty());
    w.window.end();
    QVERIFY(!w.window.isVisible());
  }
  Journey w;
  QTRY_VERIFY_WITH_TIMEOUT(w.child<OfferBar>("offerBar")->isVisible(), longest);
  QTest::mouseClick(w.child<QWidget>("offerAccept"), Qt::LeftButton);
  QTRY_COMPARE_WITH_TIMEOUT(w.window.session().workspace().measurements.size(), std::size_t(1), longest);
}

void TestNothingIsLost::whatIsDiscardedIsKeptForAWeek() {
  {
    Worked w(series());
    w.window.end();
  }
  {
    Journey w;
    QTRY_VERIFY_WITH_TIMEOUT(w.child<OfferBar>("offerBar")->isVisible(), longest);
    QTest::mouseClick(w.child<QWidget>("offerRefuse"), Qt::LeftButton);
    discard(w);
    QTRY_VERIFY_WITH_TIMEOUT(earlier(w)->isEnabled(), longest);
  }
  const QDir aside(Autosave::folder() + QStringLiteral("/discarded"));
  const QStringList names = aside.entryList(QDir::Files);
  QCOMPARE(names.size(), 1);
  const auto rename = [&](int days) {
    const QString at =
        QDateTime::currentDateTimeUtc().addDays(-days).toString(QStringLiteral("yyyyMMddHHmmss"));
    return QFile::rename(aside.filePath(aside.entryList(QDir::Files).at(0)),
                         aside.filePath(at + names[0].mid(14)));
  };
  QVERIFY(rename(6));
  {
    Journey w;
    QTRY_VERIFY_WITH_TIMEOUT(earlier(w)->isEnabled(), longest);
    QVERIFY(w.child<OfferBar>("offerBar")->isHidden());
  }
  QVERIFY(rename(9));
  Journey w;
  QTRY_VERIFY_WITH_TIMEOUT(aside.entryList(QDir::Files).isEmpty(), longest);
  QVERIFY(!earlier(w)->isEnabled());
}

VOLUMEN_TEST(TestNothingIsLost);
#include "tst_nothing_is_lost.moc"
