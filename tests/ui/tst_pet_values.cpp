// Guards slices.md 4 in the window: PET values are SUVbw where possible, in the status line, regions, windows
// and panels. Stored values keep the units of the file. Real mouse and key events.
#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QPushButton>
#include <QSettings>
#include <QTreeWidget>

#include "results/text/value_text.h"
#include "tests/fixtures/fixtures.h"
#include "tests/ui/measure_window.h"
#include "tests/unit/suite.h"
#include "ui/workspace/frame_look.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

// A PET of the field cases in planes.
struct Pet : Journey {
  explicit Pet(const QString& name)
      : Journey({QString::fromStdString(dataPath("field-cases/" + name.toStdString()))}) {}

  bool opened() {
    // A series of two or three slices opens as frames.
    if (!QTest::qWaitFor([this] { return view() && showsFrames(view()->state().kind) && frameIn(view()); },
                         longest))
      return false;
    child<QAction>("showAsFrames")->trigger();
    if (!QTest::qWaitFor([this] { return session().series() != nullptr; }, longest)) return false;
    child<QAction>("layoutPlanes")->trigger();
    QCoreApplication::processEvents();
    session().setFocus(axialViewId);
    return true;
  }
  Session& session() { return window.session(); }
  FlatView* view() { return window.views()->viewAs<FlatView>(axialViewId); }
  // Returns the status line's text for the middle of the view.
  QString said() {
    QString text;
    const auto listening =
        QObject::connect(view(), &View::hovered, view(), [&](const QString& t) { text = t; });
    hover(view(), QRectF(view()->rect()).center());
    QObject::disconnect(listening);
    return text;
  }
  // Draws an ellipse about the middle of the view.
  void drawRegion() {
    child<QAction>("ellipseTool")->trigger();
    const QPointF middle = QRectF(view()->rect()).center(),
                  half(view()->width() / 5.0, view()->height() / 5.0);
    drawShape(view(), ShapeKind::ellipse, {middle - half, middle + half});
  }
  QString listed() {
    auto* list = child<QTreeWidget>("measurementList");
    return list->topLevelItemCount() == 0 ? QString() : list->topLevelItem(0)->text(1);
  }
  QString corner() { return view()->overlays().bottomRight; }
  std::optional<Window> windowSet() { return session().workspace().series.at(view()->state().series).window; }
  // Chooses an entry of View > PET values by the mouse.
  void choose(const char* unit) {
    auto* menu = child<QMenu>("petUnitMenu");
    menu->popup(window.mapToGlobal(QPoint(60, 60)));
    auto* entry = menu->findChild<QAction*>(QStringLiteral("petUnit") + QLatin1String(unit));
    QTest::mouseClick(menu, Qt::LeftButton, {}, menu->actionGeometry(entry).center());
  }
};

// 70 kg, 350 MBq, 3600 s with a half-life of 6586.2 s: SLICE.md's formula.
const double bqFactor = 70000 / (350e6 * std::pow(2, -3600 / 6586.2));

}  // namespace

class TestPetValues : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void cleanup();
  void valuesAreSuv_data();
  void valuesAreSuv();
  void theUnitIsChosenAndRemembered();
  void framesAreSuv();
  void windowsAreSuv();
  void whyThereIsNoSuv();
  void panelsAreSuv();
  void segmentsAreSuv();
};

void TestPetValues::cleanup() {
  QSettings().remove(QStringLiteral("petUnit"));
  showPetIn(PetUnit::suvBodyWeight);
}

void TestPetValues::valuesAreSuv_data() {
  QTest::addColumn<QString>("said");
  QTest::addColumn<QString>("listed");
  QTest::newRow("c28-suv-bqml") << QStringLiteral("0.58425 SUVbw at ")
                                << QStringLiteral("Mean 0.584, SD 0 SUVbw");
  QTest::newRow("c28-suv-cnts-factor")
      << QStringLiteral("1.00000 SUVbw at ") << QStringLiteral("Mean 1, SD 0 SUVbw");
}

void TestPetValues::valuesAreSuv() {
  NEED_DATA(dataPath("field-cases"));
  QFETCH(QString, said);
  QFETCH(QString, listed);
  Pet w(QLatin1String(QTest::currentDataTag()));
  QVERIFY(w.opened());
  QVERIFY2(w.said().startsWith(said), qPrintable(w.said()));
  w.drawRegion();
  QTRY_VERIFY2_WITH_TIMEOUT(w.listed().contains(listed), qPrintable(w.listed()), longest);
  QVERIFY2(w.corner().endsWith(QStringLiteral(" SUVbw")), qPrintable(w.corner()));
  w.shot("pet-values");
}

void TestPetValues::theUnitIsChosenAndRemembered() {
  NEED_DATA(dataPath("field-cases"));
  {
    Pet w(QStringLiteral("c28-suv-bqml"));
    QVERIFY(w.opened());
    w.drawRegion();
    QTRY_VERIFY_WITH_TIMEOUT(w.listed().contains(QStringLiteral("SUVbw")), longest);
    const int steps = w.session().undoStack().index();
    const Workspace before = w.session().workspace();
    w.choose("file");
    QVERIFY2(w.said().startsWith(QStringLiteral("2000.000 Bq/ml at ")), qPrintable(w.said()));
    QTRY_VERIFY_WITH_TIMEOUT(w.listed().contains(QStringLiteral("Mean 2000, SD 0 Bq/ml")), longest);
    QVERIFY(w.corner().endsWith(QStringLiteral(" Bq/ml")));
    QCOMPARE(w.session().undoStack().index(), steps);
    QVERIFY(w.session().workspace() == before);
    w.choose("SUVlbm");  // its files state no body height
    QVERIFY2(w.said().contains(
                 QStringLiteral("2000.000 Bq/ml (no SUVlbm: PatientSize (0010,1020) is missing) at ")),
             qPrintable(w.said()));
    w.choose("file");
  }
  Pet again(QStringLiteral("c28-suv-bqml"));
  QVERIFY(again.opened());
  QVERIFY2(again.said().startsWith(QStringLiteral("2000.000 Bq/ml at ")), qPrintable(again.said()));
  again.choose("SUVbw");
  QVERIFY2(again.said().startsWith(QStringLiteral("0.58425 SUVbw at ")), qPrintable(again.said()));
}

void TestPetValues::framesAreSuv() {
  NEED_DATA(dataPath("field-cases"));
  Pet w(QStringLiteral("c28-suv-bqml"));
  QVERIFY(w.opened());
  w.child<QAction>("showAsFrames")->trigger();
  QTRY_VERIFY_WITH_TIMEOUT(showsFrames(w.view()->state().kind) && frameIn(w.view()), longest);
  QVERIFY2(w.said().startsWith(QStringLiteral("0.58425")) && w.said().contains(QStringLiteral(" SUVbw")),
           qPrintable(w.said()));
  w.drawRegion();
  QTRY_VERIFY_WITH_TIMEOUT(w.listed().contains(QStringLiteral("Mean 0.584, SD 0 SUVbw")), longest);
  QTest::keyClick(w.view(), Qt::Key_1);
  QCOMPARE(w.corner(), QStringLiteral("W 5.0 L 2.5 SUVbw"));
}

void TestPetValues::windowsAreSuv() {
  NEED_DATA(dataPath("field-cases"));
  Pet w(QStringLiteral("c28-suv-bqml"));
  QVERIFY(w.opened());
  const auto digits = {std::pair(Qt::Key_1, 5.0), {Qt::Key_2, 7.0}, {Qt::Key_3, 10.0}, {Qt::Key_4, 15.0}};
  for (const auto& [key, most] : digits) {
    QTest::keyClick(w.view(), key);
    QVERIFY(w.windowSet());
    // Inverted as usual for PET.
    QVERIFY(std::abs(w.windowSet()->width * bqFactor + most) < 1e-9);
    QVERIFY(std::abs(w.windowSet()->centre * bqFactor - most / 2) < 1e-9);
    QCOMPARE(w.corner(),
             QStringLiteral("W %1 L %2 SUVbw").arg(most, 0, 'f', most == 10 ? 0 : 1).arg(most / 2));
  }
  // Types at the numbers of the window.
  const Overlays over = w.view()->overlays();
  for (const PlacedText& text :
       placeOverlays(over, QRectF(w.view()->rect()).adjusted(0, 0, -6, 0), w.view()->font()).texts)
    if (text.text == over.bottomRight)
      QTest::mouseClick(w.view(), Qt::LeftButton, {}, text.rect.center().toPoint());
  auto *width = w.child<QLineEdit>("flatWindowWidth"), *centre = w.child<QLineEdit>("flatWindowCentre");
  QVERIFY(width && centre);
  QCOMPARE(width->text(), QStringLiteral("15"));
  QTest::keyClicks(width, QStringLiteral("8"));
  QTest::keyClick(width, Qt::Key_Tab);
  QTest::keyClicks(centre, QStringLiteral("4"));
  QTest::keyClick(centre, Qt::Key_Return);
  QVERIFY(std::abs(w.windowSet()->width * bqFactor + 8) < 1e-9);
  QCOMPARE(w.corner(), QStringLiteral("W 8 L 4 SUVbw"));
  w.choose("file");
  const auto inFile = windowNumbers({4 / bqFactor, 8 / bqFactor});
  QCOMPARE(w.corner(), QStringLiteral("W %1 L %2 Bq/ml").arg(inFile.first, inFile.second));
}

void TestPetValues::whyThereIsNoSuv() {
  auto series = std::make_shared<LoadedSeries>(*ballSeries());
  series->series.modality = "PT";
  series->series.unit = "Bq/ml";
  series->series.suv.why = "PatientWeight (0010,1030) is missing";
  MeasureWindow w(series);
  QString text;
  const auto listening =
      QObject::connect(w.view(), &View::hovered, w.view(), [&](const QString& t) { text = t; });
  hover(w.view(), QRectF(w.view()->rect()).center());
  QObject::disconnect(listening);
  QVERIFY2(text.startsWith(QStringLiteral("1000 Bq/ml (no SUV: PatientWeight (0010,1030) is missing) at ")),
           qPrintable(text));
  auto* menu = w.child<QMenu>("petUnitMenu");
  menu->popup(w.window.mapToGlobal(QPoint(60, 60)));
  QVERIFY(menu->findChild<QAction*>(QStringLiteral("petUnitSUVbw"))
              ->toolTip()
              .contains(QStringLiteral("no SUV: PatientWeight (0010,1030) is missing")));
  menu->close();
  QVERIFY(w.view()->overlays().bottomRight.endsWith(QStringLiteral(" Bq/ml")));
}

namespace {

// Returns a ball whose 1000 Bq/ml are 5 SUVbw and 4 SUVlbm.
LoadedSeriesPtr petBall() {
  auto series = std::make_shared<LoadedSeries>(*ballSeries());
  series->series.modality = "PT";
  series->series.unit = "Bq/ml";
  series->series.suv.bodyWeight = 0.005;
  series->series.suv.leanBodyMass = 0.004;
  series->series.suv.why = "test";
  return series;
}

}  // namespace

void TestPetValues::panelsAreSuv() {
  MeasureWindow w(petBall());
  w.session().setFocus(sceneViewId);
  w.session().edit(QStringLiteral("test"), [](Scene& s) { s.mode = Mode::mip, s.window = Window{400, 800}; });
  auto *centre = w.child<QDoubleSpinBox>("windowCentre"), *width = w.child<QDoubleSpinBox>("windowWidth");
  QCOMPARE(width->value(), 4.0);
  QCOMPARE(w.child<QComboBox>("windowChoice")->placeholderText(), QStringLiteral("as set"));
  w.session().choosePreset(QStringLiteral("test"), "test", w.session().scene());
  QCOMPARE(w.child<QComboBox>("windowChoice")->placeholderText(), QStringLiteral("of the preset"));
  QCOMPARE(centre->text(),
           centre->locale().toString(2.0, 'f', centre->decimals()) + QStringLiteral(" SUVbw"));
  w.session().prefer([](Preferences& p) { p.petUnit = PetUnit::suvLeanBodyMass; });
  QCOMPARE(width->value(), 3.2);
  QVERIFY(width->suffix() == QStringLiteral(" SUVlbm"));
  width->setValue(6);  // as if typed
  QVERIFY(std::abs(w.session().scene().window->width - 1500) < 1e-9);
  w.session().prefer([](Preferences& p) { p.petUnit = PetUnit::suvBodySurface; });
  QCOMPARE(width->value(), 1500.0);
  QVERIFY(width->suffix() == QStringLiteral(" Bq/ml"));
}

void TestPetValues::segmentsAreSuv() {
  MeasureWindow w(petBall());
  auto *low = w.child<QDoubleSpinBox>("segmentLow"), *high = w.child<QDoubleSpinBox>("segmentHigh");
  QVERIFY(low->suffix() == QStringLiteral(" SUVbw"));
  low->setValue(2.5);
  high->setValue(6);
  QTest::mouseClick(w.child<QPushButton>("segment"), Qt::LeftButton);
  auto* result = w.child<QLabel>("segmentResult");
  QTRY_VERIFY2_WITH_TIMEOUT(result->text().contains(QStringLiteral("mean 5.000")), qPrintable(result->text()),
                            longest);
  QVERIFY(result->text().contains(QStringLiteral("SUVbw")));
  w.session().prefer([](Preferences& p) { p.petUnit = PetUnit::file; });
  QCOMPARE(low->value(), 500.0);
  QCOMPARE(high->value(), 1200.0);
  QVERIFY2(result->text().contains(QStringLiteral("mean 1000 Bq/ml")), qPrintable(result->text()));
}

VOLUMEN_TEST(TestPetValues);
#include "tst_pet_values.moc"
