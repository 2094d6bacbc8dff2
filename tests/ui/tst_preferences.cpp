// Guards Edit > Preferences, by real events: each choice applies at once and is kept for the next start.
#include <QApplication>
#include <QCheckBox>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QFileDialog>
#include <QLineEdit>
#include <QMessageBox>
#include <QPushButton>
#include <QSettings>
#include <QTreeWidget>
#include <QWheelEvent>

#include "results/text/text.h"
#include "tests/ui/gestures.h"
#include "tests/ui/journey.h"
#include "tests/ui/scene_session.h"
#include "tests/ui/test_series.h"
#include "tests/unit/suite.h"
#include "ui/panels/mouse_table.h"
#include "ui/panels/preferences_dialog.h"
#include "ui/panels/studies_panel.h"
#include "ui/widgets/curve_editor.h"

using namespace volumen;

namespace {

// A window with its preferences open.
struct Opened : MainWindow {
  Opened() : MainWindow(realServices()) {
    resize(1200, 800);
    show();
    session().show(tests::ballSeries());
    QApplication::setActiveWindow(this);
    view()->setFocus();
    QTest::keyClick(view(), Qt::Key_Comma, Qt::ControlModifier);
  }
  PreferencesDialog* dialog() { return findChild<PreferencesDialog*>(); }
  // Moves down in a combo box by the keyboard.
  void choose(const char* name, int downwards) {
    auto* box = dialog()->findChild<QComboBox*>(QLatin1String(name));
    for (int n = 0; n < downwards; ++n) QTest::keyClick(box, Qt::Key_Down);
  }
  void tick(const char* name) {
    auto* box = dialog()->findChild<QCheckBox*>(QLatin1String(name));
    QTest::mouseClick(box, Qt::LeftButton, {}, QPoint(8, box->height() / 2));
  }
  double height() { return view()->camera().height; }
};

}  // namespace

class TestPreferences : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void init() {
    QSettings().clear();
    tests::openAlone();
  }
  void cleanup();
  void themeAndTextSize();
  void mouseButtons();
  void draggingDoesWhatIsPreferred_data();
  void draggingDoesWhatIsPreferred();
  void directions();
  void opacityAxis();
  void namesAreHiddenEverywhere();
  void hiddenNamesAreNoFileNames();
  void choicesAreKeptAndReset();
  void enterClosesAndRestoresNothing();
  void nonsenseInTheFileIsPassedOver();
};

void TestPreferences::cleanup() {
  init();
  hideNames(false);
}

void TestPreferences::themeAndTextSize() {
  Opened window;
  const QColor dark = QApplication::palette().color(QPalette::Window);
  const double size = window.findChild<QWidget*>(QStringLiteral("studySearch"))->font().pointSizeF();
  window.choose("theme", 1);
  QVERIFY(QApplication::palette().color(QPalette::Window).lightness() > dark.lightness() + 100);
  QVERIFY(window.findChild<QAction*>(QStringLiteral("lightTheme"))->isChecked());
  window.choose("textSize", 2);
  const double larger = window.findChild<QWidget*>(QStringLiteral("studySearch"))->font().pointSizeF();
  QVERIFY(std::abs(larger / size - 1.4) < 0.05);
}

void TestPreferences::mouseButtons() {
  Opened window;
  window.dialog()->findChild<MouseTable*>()->setCurrentIndex(1);
  window.choose("scene.middle", 1);  // from Pan to Zoom
  const double before = window.height();
  tests::drag(window.view(), {300, 300}, {300, 340}, Qt::MiddleButton);
  QVERIFY(window.height() > 1.1 * before);
}

void TestPreferences::draggingDoesWhatIsPreferred_data() {
  QTest::addColumn<int>("button");
  QTest::addColumn<bool>("shift");
  QTest::addColumn<QByteArray>("action");
  QTest::addColumn<QString>("step");
  const std::pair<const char*, const char*> actions[] = {
      {"rotate", "Rotate"}, {"pan", "Pan"}, {"zoom", "Zoom"}, {"curve", "Adjust curve"}};
  for (const auto& [action, step] : actions)
    for (const auto& [button, shift, name] :
         {std::tuple(Qt::MiddleButton, false, "middle"), std::tuple(Qt::RightButton, false, "right"),
          std::tuple(Qt::LeftButton, true, "Shift+left")})
      QTest::addRow("%s: %s", name, step)
          << int(button) << shift << QByteArray(action) << QString::fromLatin1(step);
}

void TestPreferences::draggingDoesWhatIsPreferred() {
  QFETCH(int, button);
  QFETCH(bool, shift);
  QFETCH(QByteArray, action);
  QFETCH(QString, step);
  tests::SceneSession s;
  Session& session = s.session;
  session.show(tests::ballSeries());
  VolumeView view(session, s.scenes, s.drawService);
  view.resize(400, 300);
  view.show();
  const Qt::KeyboardModifiers keys = shift ? Qt::ShiftModifier : Qt::NoModifier;
  const MouseSlot slot = slotOf(MousePlace::scene, Qt::MouseButton(button), keys);
  session.prefer(withBound(session.preferences(), slot, action.toStdString()));
  tests::drag(&view, {230, 150}, {260, 190}, Qt::MouseButton(button), keys);
  QCOMPARE(session.undoStack().undoText(), step);
}

void TestPreferences::directions() {
  Opened window;
  QWheelEvent wheel({300, 300}, window.view()->mapToGlobal(QPointF(300, 300)), {}, {0, 120}, Qt::NoButton,
                    Qt::NoModifier, Qt::NoScrollPhase, false);
  const auto ratio = [&](const std::function<void()>& act) {
    const double before = window.height();
    act();
    return window.height() / before;
  };
  const auto dragUp = [&] { tests::drag(window.view(), {300, 300}, {300, 260}, Qt::RightButton); };
  const auto wheelUp = [&] { QCoreApplication::sendEvent(window.view(), &wheel); };
  QVERIFY(ratio(dragUp) < 1);
  QVERIFY(ratio(wheelUp) < 1);
  window.tick("zoomDragInverted");
  window.tick("wheelInverted");
  QVERIFY(ratio(dragUp) > 1);
  QVERIFY(ratio(wheelUp) > 1);
  const auto shift = [&] {
    const double before = window.session().scene().transferFunction.points[0].value;
    tests::drag(window.view(), {300, 300}, {300, 260});
    return window.session().scene().transferFunction.points[0].value - before;
  };
  window.view()->setTool(toolNamed("curve"));
  QVERIFY(shift() < 0);
  window.tick("curveDragInverted");
  QVERIFY(shift() > 0);
}

void TestPreferences::opacityAxis() {
  Opened window;
  auto* editor = window.findChild<CurveEditor*>(QStringLiteral("curveEditor"));
  auto* box = window.findChild<QComboBox*>(QStringLiteral("opacityScale"));
  window.choose("opacityAxis", 1);
  QVERIFY(editor->opacityScale() == OpacityScale::extinction);
  QCOMPARE(box->currentIndex(), 1);
  // The panel's own box shows the same choice.
  QTest::keyClick(box, Qt::Key_Up);
  QVERIFY(editor->opacityScale() == OpacityScale::linear);
  QVERIFY(!storedPreferences().logarithmicOpacity);
}

void TestPreferences::namesAreHiddenEverywhere() {
  Opened window;
  QVERIFY(window.windowTitle().contains(QStringLiteral("Test, Ball (42)")));
  auto* panel = window.findChild<StudiesPanel*>();
  auto study = std::make_shared<Study>();
  study->volumes = {window.session().series()->series, window.session().series()->series};
  study->volumes[1].patientName = "Other^Name";
  for (Series& series : study->volumes) series.studyDate = "20260314";
  study->refused = {{"/data/Test_Ball/broken.dcm", "cut off"}};
  window.document().open.add(QStringLiteral("/data"), study);
  const auto listed = [&] {
    QStringList texts;
    for (QTreeWidgetItemIterator it(panel->tree()); *it; ++it) texts << (*it)->text(0) << (*it)->toolTip(0);
    return texts.join(QLatin1Char('\n'));
  };
  QVERIFY(listed().contains(QStringLiteral("Test, Ball (42)")));
  const auto marked = [&] {
    int count = 0;
    for (QTreeWidgetItemIterator it(panel->tree()); *it; ++it) count += (*it)->font(0).bold();
    return count;
  };
  panel->markShown(study->volumes[0], nullptr);
  const int shown = marked();
  QVERIFY(shown > 0);
  window.tick("hideNames");
  QCOMPARE(marked(), shown);
  QVERIFY(window.findChild<QAction*>(QStringLiteral("hideNames"))->isChecked());
  const QString seen = window.windowTitle() + listed() + patientText(study->volumes[0]);
  for (const char* secret : {"Test", "42", "Other", "2026", "Test_Ball"})
    QVERIFY2(!seen.contains(QLatin1String(secret)), qPrintable(seen));
  QCOMPARE(panel->tree()->topLevelItemCount(), 3);  // two patients remain separate
  window.findChild<QAction*>(QStringLiteral("hideNames"))->trigger();
  QVERIFY(window.windowTitle().contains(QStringLiteral("Test, Ball (42)")));
  QVERIFY(listed().contains(QStringLiteral("2026-03-14")));
  Series file;
  file.format = "NRRD";
  file.path = "/data/test_ball.nrrd";
  QCOMPARE(seriesText(file), QStringLiteral("test_ball.nrrd"));
  hideNames(true);
  QVERIFY(!seriesText(file).contains(QStringLiteral("ball")));
}

// A snapshot is named after its series, whose name may come from a file's.
void TestPreferences::hiddenNamesAreNoFileNames() {
  Opened window;
  auto file = std::make_shared<LoadedSeries>(*tests::ballSeries());
  file->series.format = "NRRD";
  file->series.path = "/data/smith.nrrd";
  file->series.description.clear();
  window.session().show(file);
  const auto offered = [&] {
    window.findChild<QAction*>(QStringLiteral("snapshot"))->trigger();
    const std::unique_ptr<QFileDialog> dialog(
        window.findChild<QFileDialog*>(QStringLiteral("snapshotDialog")));
    return dialog->findChild<QLineEdit*>(QStringLiteral("fileNameEdit"))->text();
  };
  QVERIFY2(offered().contains(QStringLiteral("smith")), qPrintable(offered()));
  window.tick("hideNames");
  QVERIFY2(!offered().contains(QStringLiteral("smith")), qPrintable(offered()));
}

void TestPreferences::choicesAreKeptAndReset() {
  Preferences chosen;
  {
    Opened window;
    for (const char* box : {"theme", "textSize", "mousePreset", "flat.middle", "opacityAxis", "memory"})
      window.choose(box, 1);
    for (const char* box : {"zoomDragInverted", "wheelInverted", "curveDragInverted", "crosshairLines",
                            "referenceLines", "referenceEnds", "hideNames"})
      window.tick(box);
    chosen = window.session().preferences();
  }
  const Preferences expected{.theme = Theme::light,
                             .textPercent = 120,
                             .mousePreset = "weasis",
                             .mouseBindings = {{"flat.middle", "zoom"}},
                             .zoomDragInverted = true,
                             .wheelInverted = true,
                             .curveDragInverted = true,
                             .logarithmicOpacity = true,
                             .crosshairLines = false,
                             .referenceLines = false,
                             .referenceEnds = true,
                             .hideNames = true,
                             .memoryPercent = 50,
                             .brush = {},
                             .windows = {}};
  QVERIFY(chosen == expected);
  Opened window;
  QVERIFY(window.session().preferences() == expected);
  QVERIFY(window.windowTitle().contains(QStringLiteral("hidden")));
  auto* buttons = window.dialog()->findChild<QDialogButtonBox*>();
  QTest::mouseClick(buttons->button(QDialogButtonBox::RestoreDefaults), Qt::LeftButton);
  QVERIFY2(window.session().preferences() == expected, "it asks");
  auto* box = window.dialog()->findChild<QMessageBox*>(QStringLiteral("restoreBox"));
  QVERIFY(box);
  QTest::keyClick(box, Qt::Key_Return);
  QVERIFY2(window.session().preferences() == expected, "Enter is no answer to that");
  QTRY_VERIFY(!window.dialog()->findChild<QMessageBox*>(QStringLiteral("restoreBox")));
  QTest::mouseClick(buttons->button(QDialogButtonBox::RestoreDefaults), Qt::LeftButton);
  for (QAbstractButton* button :
       window.dialog()->findChild<QMessageBox*>(QStringLiteral("restoreBox"))->buttons())
    if (button->text() == QStringLiteral("Restore defaults")) QTest::mouseClick(button, Qt::LeftButton);
  QVERIFY(window.session().preferences() == Preferences{});
  QVERIFY(storedPreferences() == Preferences{});
  QCOMPARE(window.dialog()->findChild<QComboBox*>(QStringLiteral("textSize"))->currentIndex(), 0);
}

void TestPreferences::enterClosesAndRestoresNothing() {
  Opened window;
  window.session().prefer([](Preferences& p) { p.textPercent = 120; });
  auto* dialog = window.dialog();
  QTest::keyClick(dialog, Qt::Key_Return);
  QTRY_VERIFY(!dialog->isVisible());
  QCOMPARE(window.session().preferences().textPercent, 120);
}

void TestPreferences::nonsenseInTheFileIsPassedOver() {
  QSettings settings;
  settings.setValue(QStringLiteral("textPercent"), 100000);
  settings.setValue(QStringLiteral("mouseBindings"), QStringLiteral("fly"));
  settings.setValue(QStringLiteral("theme"), QStringLiteral("plaid"));
  QVERIFY(storedPreferences() == Preferences{});
}

VOLUMEN_TEST(TestPreferences);
#include "tst_preferences.moc"
