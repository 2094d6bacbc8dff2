// Guards mouse bindings by presets and by the user's choices. Real events check every row of every preset, in
// slices and in 3D, by what it changed. Bindings are saved, and invalid ones in the file are ignored.
#include <QComboBox>

#include "tests/ui/clean_settings.h"
#include "tests/ui/mouse_gestures.h"
#include "tests/unit/suite.h"
#include "ui/panels/mouse_table.h"
#include "ui/panels/preferences_dialog.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

Qt::MouseButton buttonOf(MouseInput input) {
  return input == MouseInput::left    ? Qt::LeftButton
         : input == MouseInput::right ? Qt::RightButton
                                      : Qt::MiddleButton;
}

// Does the gesture of a slot, with two fingers if it is one of those.
void doGesture(QWidget* on, const MouseSlot& slot, const std::string& bound) {
  if (slot.input == MouseInput::wheel)
    return bound == "pan" ? slide(on, {12, -9}, slot.held) : wheel(on, 1, slot.held);
  if (slot.input != MouseInput::move) return drag(on, {62, 72}, {92, 40}, buttonOf(slot.input), slot.held);
  const QPointF at(70, 60);
  QMouseEvent move(QEvent::MouseMove, at, on->mapToGlobal(at), Qt::NoButton, Qt::NoButton, slot.held);
  QCoreApplication::sendEvent(on, &move);
}

// Returns the bindable slots of a place and the plain left button, which cannot be bound.
std::vector<MouseSlot> slotsOf(MousePlace place) {
  std::vector<MouseSlot> found{{place, MouseInput::left}};
  for (const MouseSlot& slot : mouseSlots())
    if (slot.place == place) found.push_back(slot);
  return found;
}

void backTo(Session& session, int step) {
  session.endGesture();
  while (session.undoStack().index() > step) session.undoStack().undo();
}

}  // namespace

class TestMouseBindings : public CleanSettings {
  Q_OBJECT
 private Q_SLOTS:
  void everyRowOfAPresetInSlices_data() { addMousePresets(); }
  void everyRowOfAPresetInSlices();
  void everyRowOfAPresetIn3D_data() { addMousePresets(); }
  void everyRowOfAPresetIn3D();
  void rowsOfPresetsAreThoseOfSlots();
  void presetsAreWhatTheySay_data();
  void presetsAreWhatTheySay();
  void everyActionOfEverySlot_data();
  void everyActionOfEverySlot();
  void everyBoxOfTheTableBinds();
  void aPresetIsChosenWhole();
  void whatIsChosenIsKept();
  void nonsenseInTheFileIsPassedOver();
};

void TestMouseBindings::everyRowOfAPresetInSlices() {
  QFETCH(QByteArray, preset);
  MeasureWindow w;
  chooseMousePreset(w.session(), preset);
  for (const MouseSlot& slot : slotsOf(MousePlace::flat)) {
    const std::string bound = boundTo(w.session().preferences(), slot);
    const int step = w.session().undoStack().index();
    const FlatSeen before(w);
    doGesture(w.view(), slot, bound);
    const std::string done = doneBetween(before, FlatSeen(w));
    backTo(w.session(), step);
    const std::string wanted = bound == "chosen" ? "window" : bound;
    QVERIFY2(done == wanted, (wordOf(slot) + " is bound to " + bound + " and did " + done).c_str());
  }
}

void TestMouseBindings::everyRowOfAPresetIn3D() {
  QFETCH(QByteArray, preset);
  MeasureWindow w;
  chooseMousePreset(w.session(), preset);
  const std::map<std::string, QString> steps{{"chosen", QStringLiteral("Rotate")},
                                             {"pan", QStringLiteral("Pan")},
                                             {"zoom", QStringLiteral("Zoom")},
                                             {"curve", QStringLiteral("Adjust curve")},
                                             {"none", QString()}};
  // Lowers opacity, because opaque tissue cannot get more opaque.
  w.session().edit(QStringLiteral("test"), [](Scene& s) {
    for (auto& point : s.transferFunction.points) point.opacity /= 2;
  });
  for (const MouseSlot& slot : slotsOf(MousePlace::scene)) {
    const std::string bound = boundTo(w.session().preferences(), slot);
    const int step = w.session().undoStack().index();
    doGesture(w.window.view(), slot, bound);
    const bool isDone = w.session().undoStack().index() > step;
    const QString done = isDone ? w.session().undoStack().undoText() : QString();
    backTo(w.session(), step);
    const bool isOpacity = bound == "curve" && slot.held & Qt::ControlModifier;
    const QString wanted = isOpacity ? QStringLiteral("Adjust opacity") : steps.at(bound);
    QVERIFY2(bound == "none" ? !isDone : done == wanted,
             (wordOf(slot) + " is bound to " + bound + " and did " + done.toStdString()).c_str());
  }
}

// A misspelt row would have no effect.
void TestMouseBindings::rowsOfPresetsAreThoseOfSlots() {
  std::map<std::string, MouseSlot> known;
  for (const MouseSlot& slot : mouseSlots())
    QVERIFY2(known.emplace(wordOf(slot), slot).second, wordOf(slot).c_str());
  for (const MousePreset& preset : mousePresets())
    for (const auto& [word, action] : preset.rows) {
      QVERIFY2(known.contains(word), (preset.name + ": " + word).c_str());
      const std::vector<MouseAction>& all = mouseActions(known.at(word));
      QVERIFY2(std::ranges::find(all, action, &MouseAction::word) != all.end(),
               (word + ": " + action).c_str());
    }
}

void TestMouseBindings::presetsAreWhatTheySay_data() {
  QTest::addColumn<QByteArray>("preset");
  QTest::addColumn<int>("input");
  QTest::addColumn<int>("held");
  QTest::addColumn<bool>("flat");
  QTest::addColumn<QByteArray>("action");
  const auto row = [](const char* preset, bool flat, MouseInput input, Qt::KeyboardModifier held,
                      const char* action) {
    const MouseSlot slot{flat ? MousePlace::flat : MousePlace::scene, input, held};
    QTest::addRow("%s, %s", preset, wordOf(slot).c_str())
        << QByteArray(preset) << int(input) << int(held) << flat << QByteArray(action);
  };
  const auto none = Qt::NoModifier, shift = Qt::ShiftModifier, ctrl = Qt::ControlModifier,
             alt = Qt::AltModifier;
  row("volumen", true, MouseInput::left, shift, "crosshair");
  row("volumen", true, MouseInput::left, ctrl, "chosen");
  row("volumen", true, MouseInput::right, ctrl, "zoom");
  row("volumen", true, MouseInput::wheel, shift, "fast");
  row("volumen", true, MouseInput::wheel, alt, "slab");
  row("volumen", false, MouseInput::left, shift, "pan");
  row("weasis", true, MouseInput::right, none, "none");
  row("weasis", true, MouseInput::move, shift, "none");
  row("radiant", true, MouseInput::right, none, "window");
  row("slicer", true, MouseInput::left, shift, "pan");
  row("slicer", true, MouseInput::move, shift, "crosshair");
  row("slicer", false, MouseInput::wheel, none, "none");
  row("slicer", false, MouseInput::wheel, ctrl, "zoom");
  row("oneButton", true, MouseInput::left, ctrl, "zoom");
  row("trackpad", true, MouseInput::left, shift, "pan");
  row("trackpad", true, MouseInput::wheel, none, "pan");
}

void TestMouseBindings::presetsAreWhatTheySay() {
  QFETCH(QByteArray, preset);
  QFETCH(int, input);
  QFETCH(int, held);
  QFETCH(bool, flat);
  QFETCH(QByteArray, action);
  const MouseSlot slot{flat ? MousePlace::flat : MousePlace::scene, MouseInput(input),
                       Qt::KeyboardModifier(held)};
  QCOMPARE(boundTo(withMousePreset({}, preset.toStdString()), slot), action.toStdString());
}

void TestMouseBindings::everyActionOfEverySlot_data() {
  QTest::addColumn<bool>("flat");
  QTest::newRow("slices") << true;
  QTest::newRow("3D") << false;
}

// A slot bound to each action does it, and no other slot changes.
void TestMouseBindings::everyActionOfEverySlot() {
  QFETCH(bool, flat);
  for (const MouseSlot& slot : mouseSlots()) {
    if ((slot.place == MousePlace::flat) != flat) continue;
    for (const MouseAction& action : mouseActions(slot)) {
      const Preferences bound = withBound({}, slot, action.word);
      QCOMPARE(boundTo(bound, slot), action.word);
      QVERIFY2(bound.mouseBindings.size() <= 1, "what the preset says is not kept");
      QCOMPARE(bound.mouseBindings.empty(), boundTo({}, slot) == action.word);
      for (const MouseSlot& other : mouseSlots())
        if (other.input != slot.input || other.place != slot.place || other.held == Qt::NoModifier)
          if (other != slot) QCOMPARE(boundTo(bound, other), boundTo({}, other));
    }
  }
}

void TestMouseBindings::everyBoxOfTheTableBinds() {
  MeasureWindow w;
  w.child<QAction>("preferences")->trigger();
  auto* table = w.window.findChild<MouseTable*>();
  QVERIFY(table);
  for (const MouseSlot& slot : mouseSlots()) {
    table->setCurrentIndex(slot.place == MousePlace::flat ? 0 : 1);
    auto* box = table->findChild<QComboBox*>(QString::fromStdString(wordOf(slot)));
    QVERIFY2(box && !box->accessibleName().isEmpty(), wordOf(slot).c_str());
    QCOMPARE(box->count(), int(mouseActions(slot).size()));
    for (int n = 0; n < box->count(); ++n) {
      while (box->currentIndex() != n)
        QTest::keyClick(box, box->currentIndex() < n ? Qt::Key_Down : Qt::Key_Up);
      QCOMPARE(boundTo(w.session().preferences(), slot), mouseActions(slot)[std::size_t(n)].word);
    }
  }
  QVERIFY(w.session().preferences() == storedPreferences());
}

void TestMouseBindings::aPresetIsChosenWhole() {
  MeasureWindow w;
  w.child<QAction>("preferences")->trigger();
  const MouseSlot right{MousePlace::flat, MouseInput::right};
  w.session().prefer(withBound(w.session().preferences(), right, "scroll"));
  auto* box = w.window.findChild<PreferencesDialog*>()->findChild<QComboBox*>(QStringLiteral("mousePreset"));
  QTest::keyClick(box, Qt::Key_Down);
  QCOMPARE(w.session().preferences().mousePreset, std::string("weasis"));
  QCOMPARE(boundTo(w.session().preferences(), right), std::string("none"));
  QTest::keyClick(box, Qt::Key_Up);
  QCOMPARE(boundTo(w.session().preferences(), right), std::string("zoom"));
}

void TestMouseBindings::whatIsChosenIsKept() {
  const MouseSlot right{MousePlace::flat, MouseInput::right},
      fast{MousePlace::scene, MouseInput::wheel, Qt::ShiftModifier};
  Preferences chosen = withMousePreset({}, "slicer");
  chosen = withBound(withBound(chosen, right, "pan"), fast, "zoom");
  storePreferences(chosen);
  QVERIFY(QSettings()
              .value(QStringLiteral("mouseBindings"))
              .toStringList()
              .contains(QStringLiteral("flat.right=pan")));
  QVERIFY(storedPreferences() == chosen);
  MeasureWindow w;
  const FlatSeen before(w);
  drag(w.view(), {62, 72}, {92, 40}, Qt::RightButton);
  QCOMPARE(doneBetween(before, FlatSeen(w)), std::string("pan"));
}

void TestMouseBindings::nonsenseInTheFileIsPassedOver() {
  QSettings settings;
  settings.setValue(QStringLiteral("mousePreset"), QStringLiteral("elephant"));
  settings.setValue(QStringLiteral("mouseBindings"),
                    QStringList{QStringLiteral("flat.right=fly"), QStringLiteral("flat.nose=pan"),
                                QStringLiteral("=="), QString(), QStringLiteral("flat.middle=scissors")});
  const Preferences read = storedPreferences();
  for (const MouseSlot& slot : mouseSlots()) QCOMPARE(boundTo(read, slot), boundTo({}, slot));
  MeasureWindow w;
  const FlatSeen before(w);
  drag(w.view(), {62, 72}, {92, 40}, Qt::RightButton);
  QCOMPARE(doneBetween(before, FlatSeen(w)), std::string("zoom"));
}

VOLUMEN_TEST(TestMouseBindings);
#include "tst_mouse_bindings.moc"
