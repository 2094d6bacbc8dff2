// Guards design.md 8 (presets): the list, its thumbnails, the mark for modified presets, and user presets.
#include <QAbstractItemView>
#include <QApplication>
#include <QComboBox>
#include <QInputDialog>
#include <QLineEdit>
#include <algorithm>
#include <set>

#include "io/files/preset_files.h"
#include "tests/ui/gestures.h"
#include "tests/ui/journey.h"
#include "tests/ui/test_series.h"
#include "tests/unit/suite.h"
#include "ui/panels/preset_bar.h"
#include "ui/widgets/banner.h"
#include "ui/widgets/curve_editor.h"

using namespace volumen;
using volumen::tests::Journey;
using volumen::tests::longest;

namespace {

const QStringList sample{QStringLiteral("phantom:ct-head:64")};

// Drags the curve's highest point down slightly.
void dragCurve(Journey& w) {
  auto* editor = w.child<CurveEditor>("curveEditor");
  const auto& points = editor->curve().points;
  const int highest =
      int(std::max_element(points.begin(), points.end(),
                           [](const auto& a, const auto& b) { return a.opacity < b.opacity; }) -
          points.begin());
  const QPointF from = editor->positionOf(highest);
  w.after([&] { tests::drag(editor, from, from + QPointF(0, 25)); });
}

int colours(const QIcon& icon) {
  const QImage image = icon.pixmap(PresetBar::thumbnailEdge).toImage();
  std::set<QRgb> seen;
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) seen.insert(image.pixel(x, y));
  return int(seen.size());
}

// Chooses a preset by a click in the drop-down list.
void choose(Journey& w, const char* name) {
  auto* box = w.child<QComboBox>("presets");
  const int n = box->findData(QLatin1String(name));
  w.after([&] {
    box->showPopup();
    QAbstractItemView* list = box->view();
    const QModelIndex item = list->model()->index(n, 0);
    list->scrollTo(item);
    QTest::qWait(QApplication::doubleClickInterval() + 200);  // clicks right after it opened are ignored
    QTest::mouseMove(list->viewport(), list->visualRect(item).center() - QPoint(2, 0));
    QTest::mouseMove(list->viewport(), list->visualRect(item).center());
    QTest::mouseClick(list->viewport(), Qt::LeftButton, {}, list->visualRect(item).center());
  });
}

}  // namespace

class TestPresetBar : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void thoseOfTheModalityComeFirst_data();
  void thoseOfTheModalityComeFirst();
  void modifiedAfterAnEditAndRightAgainAfterUndo();
  void thumbnailsShowTheOpenVolume();
  void thumbnailsGiveWayToAnotherSeries();
  void ownPresetsAreSavedUsedAndDeleted();
  void aNameOfTheProgramsOwnIsRefused();
  void aFileThatIsNoPresetIsTold();
};

void TestPresetBar::thoseOfTheModalityComeFirst_data() {
  QTest::addColumn<QString>("modality");
  QTest::addColumn<QString>("first");
  QTest::newRow("CT") << "CT"
                      << "CT-AAA";
  QTest::newRow("MR") << "MR"
                      << "MR-Angio";
  QTest::newRow("PET") << "PT"
                       << "PET-MIP";
  QTest::newRow("ultrasound") << "US"
                              << "US-Fetal";
}

void TestPresetBar::thoseOfTheModalityComeFirst() {
  QFETCH(QString, modality);
  QFETCH(QString, first);
  Session session;
  const PresetBar bar(session, realServices().presets);
  auto series = std::make_shared<LoadedSeries>(*tests::ballSeries());
  series->series.modality = modality.toStdString();
  session.show(series);
  const auto* box = bar.findChild<QComboBox*>(QStringLiteral("presets"));
  QCOMPARE(box->itemText(0), QStringLiteral("automatic"));
  QCOMPARE(box->itemText(1), first);
  int line = 1;
  while (line < box->count() && box->itemData(line).isValid()) ++line;
  QVERIFY2(line < box->count() - 1, "the rest below a line");
  const auto fits = [&](int n) {
    const std::string name = box->itemData(n).toString().toStdString();
    for (const PresetEntry& entry : presetEntries())
      if (entry.name == name) return entry.modality == modality.toStdString();
    return false;
  };
  for (int n = 1; n < box->count(); ++n)
    if (n != line) QCOMPARE(fits(n), n < line);
}

void TestPresetBar::modifiedAfterAnEditAndRightAgainAfterUndo() {
  Journey w(sample);
  QVERIFY(w.settle());
  auto* box = w.child<QComboBox>("presets");
  QCOMPARE(box->currentText(), QStringLiteral("automatic"));
  choose(w, "CT-X-ray");
  QCOMPARE(box->currentText(), QStringLiteral("CT-X-ray"));
  dragCurve(w);
  QCOMPARE(box->currentText(), QStringLiteral("CT-X-ray (modified)"));
  w.after("undo");
  QCOMPARE(box->currentText(), QStringLiteral("CT-X-ray"));
  w.after("redo");
  QCOMPARE(box->currentText(), QStringLiteral("CT-X-ray (modified)"));
  w.after("undo");
  w.after("undo");
  QCOMPARE(box->currentText(), QStringLiteral("automatic"));
  w.after("viewLeft");
  QVERIFY2(box->currentText() == QStringLiteral("automatic"), "a view is no part of a preset");
}

void TestPresetBar::thumbnailsShowTheOpenVolume() {
  Journey w(sample);
  auto* box = w.child<QComboBox>("presets");
  QCOMPARE(colours(box->itemIcon(1)), 1);
  QVERIFY(w.settle());
  const auto drawn = [&](const char* name) {
    return colours(box->itemIcon(box->findData(QLatin1String(name)))) > 20;
  };
  QVERIFY(QTest::qWaitFor([&] { return drawn("US-Fetal"); }, longest));
  for (const char* name : {"auto", "CT-Bone", "CT-Muscle", "CT-MIP", "MR-Default"})
    QVERIFY2(drawn(name), name);
  const auto picture = [&](const char* name) {
    return box->itemIcon(box->findData(QLatin1String(name))).pixmap(PresetBar::thumbnailEdge).toImage();
  };
  QVERIFY(picture("CT-Bone") != picture("CT-Muscle"));
  box->showPopup();
  if (const QString folder = qEnvironmentVariable("VOLUMEN_SHOTS"); !folder.isEmpty())
    box->view()->window()->grab().save(folder + QStringLiteral("/presets.png"));
  box->hidePopup();
  w.shot("preset-bar");
}

void TestPresetBar::thumbnailsGiveWayToAnotherSeries() {
  Journey w(sample);
  QVERIFY(w.settle());
  w.after([&] { w.window.open({QStringLiteral("phantom:sphere:32")}); });
  auto* box = w.child<QComboBox>("presets");
  QVERIFY(QTest::qWaitFor([&] { return colours(box->itemIcon(box->findData(QStringLiteral("auto")))) > 1; },
                          longest));
}

void TestPresetBar::ownPresetsAreSavedUsedAndDeleted() {
  Journey w(sample);
  QVERIFY(w.settle());
  dragCurve(w);
  const Scene kept = w.window.session().scene();
  w.child<QAction>("savePreset")->trigger();
  auto* dialog = w.child<QInputDialog>("presetNameDialog");
  QVERIFY(dialog && dialog->isVisible());
  QTest::keyClicks(dialog->findChild<QLineEdit*>(), QStringLiteral("My bone / 2"));
  QTest::keyClick(dialog, Qt::Key_Return);
  QTRY_VERIFY(!w.child<QInputDialog>("presetNameDialog"));
  auto* box = w.child<QComboBox>("presets");
  QCOMPARE(box->currentText(), QStringLiteral("My bone / 2"));
  QCOMPARE(readPresetFiles().size(), std::size_t(1));
  QVERIFY(readPresetFiles()[0].path.ends_with("/volumen/presets/My bone %2F 2.json"));

  choose(w, "CT-X-ray");
  QVERIFY(!(w.window.session().scene() == kept));
  QVERIFY(!w.child<QAction>("deletePreset")->isEnabled());
  choose(w, "My bone / 2");
  QVERIFY(w.window.session().scene() == kept);
  {
    Journey next(sample);
    QVERIFY2(next.child<QComboBox>("presets")->findText(QStringLiteral("My bone / 2")) > 0,
             "the next time, too");
  }
  QVERIFY(w.child<QAction>("deletePreset")->isEnabled());
  w.child<QAction>("deletePreset")->trigger();
  QVERIFY(readPresetFiles().empty());
  QCOMPARE(box->findText(QStringLiteral("My bone / 2")), -1);
  QVERIFY2(w.window.session().scene() == kept, "what is on screen stays");
}

void TestPresetBar::aNameOfTheProgramsOwnIsRefused() {
  Journey w(sample);
  QVERIFY(w.settle());
  w.child<QAction>("savePreset")->trigger();
  auto* dialog = w.child<QInputDialog>("presetNameDialog");
  QTest::keyClicks(dialog->findChild<QLineEdit*>(), QStringLiteral("CT-Bone"));
  QTest::keyClick(dialog, Qt::Key_Return);
  QVERIFY(w.window.findChild<Banner*>()->isVisible());
  QVERIFY(readPresetFiles().empty());
}

void TestPresetBar::aFileThatIsNoPresetIsTold() {
  QVERIFY(writePresetFile("broken", "{").ok());
  {
    Journey w;
    QVERIFY(w.window.findChild<Banner*>()->isVisible());
  }
  QVERIFY(deletePresetFile(readPresetFiles()[0].path).ok());
}

VOLUMEN_TEST(TestPresetBar);
#include "tst_preset_bar.moc"
