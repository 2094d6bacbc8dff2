// Guards the keys of the window, by real key events. Views are chosen by letter and keypad with and without
// NumLock. No key has two meanings, and none fires while the user types.
#include <QApplication>
#include <QDockWidget>
#include <QLibrary>
#include <QLineEdit>
#include <QSettings>

#include "tests/ui/journey.h"
#include "tests/ui/measure_window.h"
#include "tests/ui/test_series.h"
#include "tests/unit/suite.h"
#include "ui/workspace/camera_moves.h"

using namespace volumen;

namespace {

struct Shown : MainWindow {
  Shown() : MainWindow(realServices()) {
    resize(1200, 800);
    show();
    session().show(tests::ballSeries());
    activateWindow();
    QApplication::setActiveWindow(this);
    view()->setFocus();
  }
  QString seen() { return QString::fromStdString(viewName(view()->camera())); }
};

// The keyboard as the X server sees it. Its libraries are loaded on demand.
class XKeyboard {
 public:
  bool open() {
    display_ = call<void*>(x11_, "XOpenDisplay", static_cast<const char*>(nullptr));
    return display_ && test_.resolve("XTestFakeKeyEvent");
  }
  ~XKeyboard() {
    if (display_) call<int>(x11_, "XCloseDisplay", display_);
  }
  void focus(WId window) {
    call<int>(x11_, "XSetInputFocus", display_, static_cast<unsigned long>(window), 2, 0UL);
    call<int>(x11_, "XSync", display_, 0);
  }
  void press(unsigned long keysym, bool down) {
    const auto code = call<unsigned char>(x11_, "XKeysymToKeycode", display_, keysym);
    call<int>(test_, "XTestFakeKeyEvent", display_, static_cast<unsigned>(code), down ? 1 : 0, 0UL);
    call<int>(x11_, "XSync", display_, 0);
  }
  void click(unsigned long keysym) {
    press(keysym, true);
    press(keysym, false);
  }

 private:
  template <class Out, class... In>
  Out call(QLibrary& library, const char* name, In... in) {
    const auto function = reinterpret_cast<Out (*)(In...)>(library.resolve(name));
    return function ? function(in...) : Out{};
  }

  QLibrary x11_{QStringLiteral("X11"), 6}, test_{QStringLiteral("Xtst"), 6};
  void* display_ = nullptr;
};

constexpr unsigned long numLock = 0xff7f, leftControl = 0xffe3, keypad1 = 0xffb1, keypad3 = 0xffb3,
                        keypad7 = 0xffb7;  // X11 keysyms

}  // namespace

class TestKeys : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void init() {
    QSettings().clear();
    tests::openAlone();
  }
  void keysChooseViews_data();
  void keysChooseViews();
  void theKeypadWorksByTheXServer_data();
  void theKeypadWorksByTheXServer();
  void keysResetTheView_data();
  void keysResetTheView();
  void otherNavigationKeysChooseNoView();
  void noKeyMeansTwoThings();
  void nothingFiresWhileOneTypes_data();
  void nothingFiresWhileOneTypes();
  void escapeLeavesTheMaximisedView();
  void lettersOfOtherScriptsMeasure_data();
  void lettersOfOtherScriptsMeasure();
  void lettersOfOtherScriptsChooseViews();
  void otherLettersAndOtherPlacesMeanNothing();
  void afterOpeningKeysMeasure();
};

void TestKeys::keysChooseViews_data() {
  QTest::addColumn<int>("key");
  QTest::addColumn<int>("modifiers");
  QTest::addColumn<QString>("view");
  struct View {
    const char* name;
    int letter, digit, navigation;
    bool opposite;
  };
  const View views[] = {{"anterior", Qt::Key_A, Qt::Key_1, Qt::Key_End, false},
                        {"posterior", Qt::Key_P, Qt::Key_1, Qt::Key_End, true},
                        {"left", Qt::Key_L, Qt::Key_3, Qt::Key_PageDown, false},
                        {"right", Qt::Key_R, Qt::Key_3, Qt::Key_PageDown, true},
                        {"superior", Qt::Key_S, Qt::Key_7, Qt::Key_Home, false},
                        {"inferior", Qt::Key_I, Qt::Key_7, Qt::Key_Home, true}};
  for (const View& view : views) {
    const int control = view.opposite ? int(Qt::ControlModifier) : 0, keypad = int(Qt::KeypadModifier);
    const QString name = QString::fromLatin1(view.name);
    QTest::addRow("%s by letter", view.name) << view.letter << 0 << name;
    QTest::addRow("%s by keypad, NumLock on", view.name) << view.digit << (control | keypad) << name;
    QTest::addRow("%s by keypad, NumLock off", view.name) << view.navigation << (control | keypad) << name;
  }
}

void TestKeys::keysChooseViews() {
  QFETCH(int, key);
  QFETCH(int, modifiers);
  QFETCH(QString, view);
  Shown window;
  window.view()->showView(view == QStringLiteral("left") ? QStringLiteral("right") : QStringLiteral("left"));
  QTest::keyClick(window.view(), Qt::Key(key), Qt::KeyboardModifiers(modifiers));
  QCOMPARE(window.seen(), view);
}

void TestKeys::theKeypadWorksByTheXServer_data() {
  QTest::addColumn<bool>("locked");
  QTest::addColumn<qulonglong>("key");
  QTest::addColumn<bool>("control");
  QTest::addColumn<QString>("view");
  for (bool locked : {false, true})
    for (const auto& [key, control, view] :
         {std::tuple(keypad1, false, "anterior"), std::tuple(keypad1, true, "posterior"),
          std::tuple(keypad3, false, "left"), std::tuple(keypad3, true, "right"),
          std::tuple(keypad7, false, "superior"), std::tuple(keypad7, true, "inferior")})
      QTest::addRow("%s, NumLock %s", view, locked ? "on" : "off")
          << locked << qulonglong(key) << control << QString::fromLatin1(view);
}

void TestKeys::theKeypadWorksByTheXServer() {
  QFETCH(bool, locked);
  QFETCH(qulonglong, key);
  QFETCH(bool, control);
  QFETCH(QString, view);
  if (QGuiApplication::platformName() != QStringLiteral("xcb")) QSKIP("there is no X server");
  XKeyboard keyboard;
  QVERIFY2(keyboard.open(), "the X server's keys cannot be pressed: libxtst6 is not installed");
  Shown window;
  QVERIFY(QTest::qWaitForWindowExposed(&window));
  window.view()->showView(view == QStringLiteral("left") ? QStringLiteral("right") : QStringLiteral("left"));
  keyboard.focus(window.winId());
  QVERIFY(QTest::qWaitForWindowActive(&window));
  if (locked) keyboard.click(numLock);
  if (control) keyboard.press(leftControl, true);
  keyboard.click(static_cast<unsigned long>(key));
  if (control) keyboard.press(leftControl, false);
  if (locked) keyboard.click(numLock);
  QTRY_COMPARE(window.seen(), view);
}

void TestKeys::keysResetTheView_data() {
  QTest::addColumn<int>("key");
  QTest::addColumn<int>("modifiers");
  QTest::newRow("F") << int(Qt::Key_F) << 0;
  QTest::newRow("keypad 0, NumLock on") << int(Qt::Key_0) << int(Qt::KeypadModifier);
  QTest::newRow("keypad 0, NumLock off") << int(Qt::Key_Insert) << int(Qt::KeypadModifier);
}

void TestKeys::keysResetTheView() {
  QFETCH(int, key);
  QFETCH(int, modifiers);
  Shown window;
  window.view()->showView(QStringLiteral("left"));
  QTest::keyClick(window.view(), Qt::Key(key), Qt::KeyboardModifiers(modifiers));
  QVERIFY(!window.session().scene().camera);
}

void TestKeys::otherNavigationKeysChooseNoView() {
  Shown window;
  window.view()->showView(QStringLiteral("right"));
  for (Qt::Key key : {Qt::Key_End, Qt::Key_PageDown, Qt::Key_Home, Qt::Key_Insert})
    QTest::keyClick(window.view(), key);
  QCOMPARE(window.seen(), QStringLiteral("right"));
}

void TestKeys::noKeyMeansTwoThings() {
  Shown window;
  std::map<QString, QString> actions;
  for (const QAction* action : window.findChildren<QAction*>())
    for (const QKeySequence& key : action->shortcuts()) {
      const auto [known, added] = actions.try_emplace(key.toString(), action->text());
      QVERIFY2(added, qPrintable(key.toString() + QStringLiteral(": ") + known->second +
                                 QStringLiteral(" and ") + action->text()));
    }
  QVERIFY(actions.size() > 15);
}

void TestKeys::nothingFiresWhileOneTypes_data() {
  QTest::addColumn<QString>("field");
  QTest::newRow("search") << QStringLiteral("studySearch");
  QTest::newRow("a number's field") << QStringLiteral("segmentLow");
  QTest::newRow("a whole number's field") << QStringLiteral("snapshotWidth");
}

void TestKeys::nothingFiresWhileOneTypes() {
  QFETCH(QString, field);
  Shown window;
  for (const char* dock : {"segmentDock", "snapshotDock"}) {
    auto* widget = window.findChild<QWidget*>(field);
    if (widget->isVisible()) break;
    window.findChild<QDockWidget*>(QLatin1String(dock))->raise();
    QTest::qWait(20);
  }
  auto* widget = window.findChild<QWidget*>(field);
  QVERIFY(widget->isVisible());
  widget->setFocus();
  const SessionState before = window.session().state();
  for (const char key : std::string("aplrsifwt1370?")) QTest::keyClick(widget, key);
  for (Qt::Key key :
       {Qt::Key_1, Qt::Key_3, Qt::Key_7, Qt::Key_0, Qt::Key_End, Qt::Key_Home, Qt::Key_PageDown})
    QTest::keyClick(widget, key, Qt::KeypadModifier);
  QVERIFY(window.session().state() == before);
  QCOMPARE(&window.view()->tool(), &toolNamed("rotate"));
  if (auto* line = qobject_cast<QLineEdit*>(widget))
    QVERIFY(line->text().contains(QStringLiteral("aplrsifwt1370?")));
}

void TestKeys::escapeLeavesTheMaximisedView() {
  Shown window;
  const int width = window.view()->width();
  QTest::keyClick(window.view(), Qt::Key_Escape);
  QCOMPARE(window.view()->width(), width);
  QTest::keyClick(window.view(), Qt::Key_F10);
  QTRY_VERIFY(window.view()->width() > width + 200);
  QTest::keyClick(window.view(), Qt::Key_Escape);
  QTRY_COMPARE(window.view()->width(), width);
  QVERIFY(!window.findChild<QAction*>(QStringLiteral("maximise"))->isChecked());
}

// Sends a key as Qt does if its letter has no shortcut. Returns whether the widget wants it before shortcuts
// do.
bool pressAt(QWidget* on, int key, quint32 scanCode) {
  const QString text{QChar(char16_t(key))};
  QKeyEvent wanted(QEvent::ShortcutOverride, key, Qt::NoModifier, scanCode, 0, 0, text);
  wanted.ignore();
  QCoreApplication::sendEvent(on, &wanted);
  QKeyEvent press(QEvent::KeyPress, key, Qt::NoModifier, scanCode, 0, 0, text);
  QCoreApplication::sendEvent(on, &press);
  return wanted.isAccepted();
}

void TestKeys::lettersOfOtherScriptsMeasure_data() {
  QTest::addColumn<int>("letter");
  QTest::addColumn<int>("scanCode");
  QTest::addColumn<QByteArray>("tool");
  QTest::newRow("Cyrillic, D") << 0x0412 << 40 << QByteArray("lengthTool");
  QTest::newRow("Cyrillic, A") << 0x0424 << 38 << QByteArray("angleTool");
  QTest::newRow("Cyrillic, E") << 0x0423 << 26 << QByteArray("ellipseTool");
  QTest::newRow("Cyrillic, P") << 0x0417 << 33 << QByteArray("probeTool");
  QTest::newRow("Greek, D") << 0x0394 << 40 << QByteArray("lengthTool");
  QTest::newRow("Hebrew, D") << 0x05d2 << 40 << QByteArray("lengthTool");
}

void TestKeys::lettersOfOtherScriptsMeasure() {
  QFETCH(int, letter);
  QFETCH(int, scanCode);
  QFETCH(QByteArray, tool);
  tests::MeasureWindow w;
  const Camera before = w.window.view()->camera();
  QVERIFY2(pressAt(w.view(), letter, quint32(scanCode)), "no shortcut may take it");
  QVERIFY(w.child<QAction>(tool.constData())->isChecked());
  QVERIFY(w.window.view()->camera() == before);
}

// Qt finds no shortcut for these letters unless a second keyboard layout is Latin.
void TestKeys::lettersOfOtherScriptsChooseViews() {
  Shown window;
  window.view()->showView(QStringLiteral("left"));
  pressAt(window.view(), 0x0424, 38);
  QCOMPARE(window.seen(), QStringLiteral("anterior"));
  pressAt(window.view(), 0x0417, 33);
  QCOMPARE(window.seen(), QStringLiteral("posterior"));
}

void TestKeys::otherLettersAndOtherPlacesMeanNothing() {
  Shown window;
  window.view()->showView(QStringLiteral("left"));
  pressAt(window.view(), 0x0424, 100);
  pressAt(window.view(), 0x00c4, 38);  // A with diaeresis is Latin, on another key of a German keyboard
  QCOMPARE(window.seen(), QStringLiteral("left"));
}

void TestKeys::afterOpeningKeysMeasure() {
  tests::openAlone(false);
  tests::Journey w({QStringLiteral("phantom:ct-head:32")});
  QTRY_VERIFY_WITH_TIMEOUT(w.window.session().series(), tests::longest);
  QCOMPARE(w.window.session().workspace().layout, Layout::planes);
  QTRY_VERIFY(qobject_cast<FlatView*>(w.window.focusWidget()));
  const Camera before = w.window.view()->camera();
  QTest::keyClick(w.window.focusWidget(), Qt::Key_D);
  QVERIFY(w.child<QAction>("lengthTool")->isChecked());
  QVERIFY(w.window.view()->camera() == before);
  tests::openAlone();
}

VOLUMEN_TEST(TestKeys);
#include "tst_keys.moc"
