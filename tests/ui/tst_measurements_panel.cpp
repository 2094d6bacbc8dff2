// Guards the measurements panel by real events, and that the window and `volumen measure` report the same.
#include <QCheckBox>
#include <QClipboard>
#include <QDockWidget>
#include <QFile>
#include <QGuiApplication>
#include <QHeaderView>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QLabel>
#include <QTemporaryDir>
#include <QToolButton>
#include <QTreeWidget>
#include <cmath>

#include "results/text/measured_text.h"
#include "tests/fixtures/program.h"
#include "tests/ui/measure_window.h"
#include "tests/unit/suite.h"
#include "ui/workspace/flat_plane.h"
#include "viewer/measure/shape_json.h"

using namespace volumen;
using namespace volumen::tests;
using enum ShapeKind;

namespace {

// A window with its measurements panel in front.
struct PanelWindow : MeasureWindow {
  using MeasureWindow::MeasureWindow;
  QTreeWidget* list() { return child<QTreeWidget>("measurementList"); }
  void raise() {
    child<QDockWidget>("measurementsDock")->raise();
    QCoreApplication::processEvents();
  }
  void press(const char* button) { QTest::mouseClick(child<QToolButton>(button), Qt::LeftButton); }
  QPoint rowMiddle(int row) { return list()->visualItemRect(list()->topLevelItem(row)).center(); }
};

QByteArray bytesOf(const QString& path) {
  QFile file(path);
  return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
}

}  // namespace

class TestMeasurementsPanel : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void emptyItSaysHowToBegin();
  void rowsSayNamesNumbersAndSeries();
  void rowsAndViewsSelectTogether();
  void aRowIsRenamed();
  void rowsAreDeleted();
  void copiesTextAndCsv();
  void aDoubleClickGoesThere();
  void itBringsItsSeriesBack();
  void theCommandSaysTheSame();
  void shapesAreOpened();
  void whatIsNoListOfShapesIsRefused();
};

void TestMeasurementsPanel::emptyItSaysHowToBegin() {
  PanelWindow w;
  w.raise();
  QVERIFY(w.child<QLabel>("measurementsEmpty")->isVisible());
  QVERIFY(!w.list()->isVisible());
  QVERIFY(!w.child<QToolButton>("measurementSave")->isEnabled());
  w.draw(length, {{50, 50}, {130, 90}});
  QVERIFY(!w.child<QLabel>("measurementsEmpty")->isVisible());
  QVERIFY(w.list()->isVisible());
  w.undo();
  QVERIFY(w.child<QLabel>("measurementsEmpty")->isVisible());
}

void TestMeasurementsPanel::rowsSayNamesNumbersAndSeries() {
  PanelWindow w;
  w.draw(length, {{50, 50}, {130, 90}});
  w.draw(ellipse, {{60, 60}, {120, 110}});
  QCOMPARE(w.list()->topLevelItemCount(), 2);
  for (int n = 0; n < 2; ++n) {
    const Measurement& m = w.all()[std::size_t(n)];
    const QTreeWidgetItem* item = w.list()->topLevelItem(n);
    QCOMPARE(item->text(0), nameText(m));
    QCOMPARE(item->text(1), measuredText(m.shape, w.measured(m)));
    QCOMPARE(item->text(2), QStringLiteral("CT Ball"));
  }
  drag(w.view(), {60, 60}, {40, 40});  // drags a corner of the ellipse
  QCOMPARE(w.list()->topLevelItem(1)->text(1), measuredText(w.last().shape, w.measured(w.last())));
}

void TestMeasurementsPanel::rowsAndViewsSelectTogether() {
  PanelWindow w;
  w.draw(length, {{50, 50}, {130, 90}});
  w.draw(probe, {{100, 130}});
  w.raise();
  QCOMPARE(w.list()->currentItem(), w.list()->topLevelItem(1));
  QTest::mouseClick(w.list()->viewport(), Qt::LeftButton, {}, w.rowMiddle(0));
  QCOMPARE(w.session().workspace().selected, w.all()[0].id);
  QVERIFY(w.drawn(w.all()[0].id).selected);
  QTest::mouseClick(w.view(), Qt::LeftButton, {}, {100, 130});
  QCOMPARE(w.list()->currentItem(), w.list()->topLevelItem(1));
}

void TestMeasurementsPanel::aRowIsRenamed() {
  PanelWindow w;
  w.draw(length, {{50, 50}, {130, 90}});
  w.raise();
  w.press("measurementRename");
  auto* field = w.list()->findChild<QLineEdit*>();
  QVERIFY(field);
  field->setText(QStringLiteral("aorta"));
  QTest::keyClick(field, Qt::Key_Return);
  QTRY_COMPARE(w.last().shape.name, std::string("aorta"));
  QVERIFY(w.drawn(w.last().id).text.contains(QStringLiteral("aorta")));
  w.undo();
  QCOMPARE(w.list()->topLevelItem(0)->text(0), QStringLiteral("Length 1"));
}

void TestMeasurementsPanel::rowsAreDeleted() {
  PanelWindow w;
  for (int n = 0; n < 3; ++n) w.draw(length, {{50, 50.0 + 30 * n}, {130, 60.0 + 30 * n}});
  const SharedList<Measurement> three = w.all();
  w.raise();
  QTest::mouseClick(w.list()->viewport(), Qt::LeftButton, {}, w.rowMiddle(1));
  w.press("measurementDelete");
  QCOMPARE(w.all().size(), std::size_t(2));
  QVERIFY(w.all()[0] == three[0] && w.all()[1] == three[2]);
  QTest::mouseClick(w.list()->viewport(), Qt::LeftButton, {}, w.rowMiddle(0));
  QTest::keyClick(w.list(), Qt::Key_Delete);
  QCOMPARE(w.all().size(), std::size_t(1));
  w.press("measurementDeleteAll");
  QVERIFY(w.all().empty());
  for (int n = 0; n < 3; ++n) w.undo();
  QVERIFY(w.all() == three);
}

void TestMeasurementsPanel::copiesTextAndCsv() {
  PanelWindow w;
  w.draw(length, {{50, 50}, {130, 90}});
  w.draw(ellipse, {{60, 60}, {120, 110}});
  w.child<QAction>("copyMeasurementsText")->trigger();
  const QString text = QGuiApplication::clipboard()->text();
  QVERIFY(text.startsWith(QStringLiteral("Length 1: ")) && text.contains(QStringLiteral("(CT Ball)")));
  w.child<QAction>("copyMeasurementsCsv")->trigger();
  const QStringList lines = QGuiApplication::clipboard()->text().split(QStringLiteral("\r\n"));
  QCOMPARE(lines.size(), 4);
  const QStringList fields = lines[1].split(QLatin1Char(','));
  QCOMPARE(fields[1], QStringLiteral("length"));
  const double exact = w.measured(w.all()[0])->number;
  QVERIFY2(std::abs(fields[2].toDouble() - exact) <= 5.1e-7 * exact, "seven digits");
  const double mean = w.measured(w.all()[1])->values->mean;
  QVERIFY(std::abs(lines[2].split(QLatin1Char(','))[5].toDouble() - mean) <= 5.1e-7 * mean);
  const QTemporaryDir folder;
  w.child<QAction>("saveMeasurementsCsv")->trigger();
  answer(w, "measurementSaveDialog", folder.filePath(QStringLiteral("numbers.csv")));
  QTRY_COMPARE(QString::fromUtf8(bytesOf(folder.filePath(QStringLiteral("numbers.csv")))),
               QGuiApplication::clipboard()->text());
}

void TestMeasurementsPanel::aDoubleClickGoesThere() {
  PanelWindow w;
  w.draw(length, {{50, 50}, {130, 90}});
  const Measurement m = w.last();
  w.view()->scroll(9);
  w.view(coronalViewId)->scroll(5);
  QVERIFY(w.drawn(m.id).lines.empty());
  w.child<QAction>("layoutOne")->trigger();
  w.session().setFocus(sceneViewId);
  w.raise();
  QTest::mouseClick(w.list()->viewport(), Qt::LeftButton, {}, w.rowMiddle(0));
  QTest::mouseDClick(w.list()->viewport(), Qt::LeftButton, {}, w.rowMiddle(0));
  QVERIFY(w.drawn(m.id).whole && w.view()->isVisible());
  const glm::dvec3 middle = (m.shape.points[0] + m.shape.points[1]) / 2.0;
  QVERIFY(glm::length(crosshairOf(w.session().workspace(), *w.session().series()).at - middle) < 1e-9);
  QVERIFY(w.last() == m);
}

void TestMeasurementsPanel::itBringsItsSeriesBack() {
  PanelWindow w;
  w.draw(length, {{50, 50}, {130, 90}});
  const LoadedSeriesPtr first = w.session().series();
  w.session().show(ballSeries(16, 4));
  QVERIFY(w.session().series() != first);
  w.raise();
  QTest::mouseClick(w.list()->viewport(), Qt::LeftButton, {}, w.rowMiddle(0));
  QTest::mouseDClick(w.list()->viewport(), Qt::LeftButton, {}, w.rowMiddle(0));
  QCOMPARE(w.session().series(), first);
  QVERIFY(w.drawn(w.last().id).whole);
}

// The command measures shapes saved by the window: the same numbers, to the last digit.
void TestMeasurementsPanel::theCommandSaysTheSame() {
  const QString phantom = QStringLiteral("phantom:ct-head:64");
  Journey opened({phantom});
  QVERIFY(opened.settle());
  PanelWindow w(opened.window.session().series());
  w.draw(length, {{50, 50}, {130, 90}});
  w.draw(angle, {{60, 60}, {120, 90}, {100, 150}});
  w.draw(ellipse, {{60, 60}, {160, 190}}, coronalViewId);
  w.draw(freehand, {{60, 60}, {120, 62}, {140, 110}, {100, 150}, {58, 120}}, sagittalViewId);
  w.draw(probe, {{130, 140}});
  const QTemporaryDir folder;
  const QString path = folder.filePath(QStringLiteral("shapes.json"));
  w.child<QAction>("saveShapes")->trigger();
  answer(w, "measurementSaveDialog", path);
  QTRY_VERIFY(QFile::exists(path));
  const Outcome said = runProgram({QStringLiteral("measure"), phantom, QStringLiteral("--roi"), path});
  QVERIFY2(said.status == 0, said.err.constData());
  const QJsonArray list = QJsonDocument::fromJson(said.out)[QStringLiteral("measurements")].toArray();
  QCOMPARE(list.size(), qsizetype(5));
  for (int n = 0; n < 5; ++n) {
    const Measurement& m = w.all()[std::size_t(n)];
    QTRY_COMPARE_WITH_TIMEOUT(w.list()->topLevelItem(n)->text(1), measuredText(m.shape, w.measured(m)),
                              longest);
    const std::string here = measuredToJson(m.shape, w.measured(m)).dump();
    QCOMPARE(QJsonDocument::fromJson(QByteArray::fromStdString(here)).object(), list[n].toObject());
  }
}

void TestMeasurementsPanel::shapesAreOpened() {
  PanelWindow w;
  w.draw(length, {{50, 50}, {130, 90}});
  w.draw(rectangle, {{60, 60}, {120, 110}});
  const SharedList<Measurement> before = w.all();
  const QTemporaryDir folder;
  const QString path = folder.filePath(QStringLiteral("shapes.json"));
  w.child<QAction>("saveShapes")->trigger();
  answer(w, "measurementSaveDialog", path);
  QTRY_VERIFY(QFile::exists(path));
  w.press("measurementDeleteAll");
  const int steps = w.session().undoStack().index();
  w.press("measurementOpen");
  answer(w, "measurementOpenDialog", path);
  QTRY_COMPARE(w.all().size(), std::size_t(2));
  for (std::size_t n = 0; n < 2; ++n) {
    QVERIFY(w.all()[n].shape == before[n].shape);
    QVERIFY(w.all()[n].series == before[n].series);
  }
  QCOMPARE(w.session().undoStack().index(), steps + 1);
}

void TestMeasurementsPanel::whatIsNoListOfShapesIsRefused() {
  PanelWindow w;
  const QTemporaryDir folder;
  const QString path = folder.filePath(QStringLiteral("bad.json"));
  QFile file(path);
  QVERIFY(file.open(QIODevice::WriteOnly));
  file.write(R"([{"kind": "length", "points": [[0, 0, 0]]}])");
  file.close();
  QSignalSpy failed(w.child<QWidget>("measurementsPanel"), SIGNAL(failed(QString)));
  w.press("measurementOpen");
  answer(w, "measurementOpenDialog", path);
  QTRY_COMPARE(failed.size(), qsizetype(1));
  const QString sentence = failed[0].value(0).toString();
  QVERIFY2(sentence.startsWith(path) && sentence.contains(QStringLiteral("[0].points must hold 2")),
           qPrintable(sentence));
  QVERIFY(w.all().empty());
}

VOLUMEN_TEST(TestMeasurementsPanel);
#include "tst_measurements_panel.moc"
