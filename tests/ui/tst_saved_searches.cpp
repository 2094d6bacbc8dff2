// Guards searches that are saved, by real events: they are named, chosen, renamed and removed, and are the
// same in the next window and for archives.
#include <QDate>
#include <QMenu>
#include <QTableWidget>

#include "tests/ui/archives_window.h"
#include "tests/ui/clean_settings.h"
#include "tests/unit/archive/peer_process.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

const QString saveSearchEntry = QStringLiteral("Save this search"),
              editSearchesEntry = QStringLiteral("Edit saved searches...");

struct SearchesWindow : ArchivesWindow {
  using ArchivesWindow::ArchivesWindow;

  QTableWidget* table() { return child<QTableWidget>("searchesTable"); }
  // Opens the menu and returns its entries; those that cannot be chosen in brackets.
  QStringList entries() {
    QStringList texts;
    const QMenu* menu = openMenu();
    for (const QAction* action : menu ? menu->actions() : QList<QAction*>())
      if (!action->isSeparator())
        texts << (action->isEnabled() ? action->text()
                                      : QLatin1Char('(') + action->text() + QLatin1Char(')'));
    closeMenu();
    return texts;
  }
  bool chooseEntry(const QString& entry) {
    QMenu* menu = openMenu();
    for (QAction* action : menu ? menu->actions() : QList<QAction*>())
      if (action->text() == entry)
        return QTest::mouseClick(menu, Qt::LeftButton, {}, menu->actionGeometry(action).center()), true;
    closeMenu();
    return false;
  }
  // Types a text in place of the one of a cell that is being edited.
  void typeInCell(const QString& text) {
    auto* editor = table()->findChild<QLineEdit*>();
    QVERIFY(editor);
    editor->selectAll();
    QTest::keyClicks(editor, text);
    QTest::keyClick(editor, Qt::Key_Return);
    QTRY_VERIFY(!table()->findChild<QLineEdit*>());
  }
  bool closeSearches() {
    child<QDialog>("searchesDialog")->close();
    return QTest::qWaitFor([&] { return !child<QDialog>("searchesDialog"); }, longest);
  }

 private:
  QMenu* openMenu() {
    QTest::mouseClick(child<QToolButton>("savedSearches"), Qt::LeftButton);
    return qobject_cast<QMenu*>(QApplication::activePopupWidget());
  }
  static void closeMenu() {
    if (QWidget* menu = QApplication::activePopupWidget()) QTest::keyClick(menu, Qt::Key_Escape);
  }
};

}  // namespace

class TestSavedSearches : public CleanSettings {
  Q_OBJECT
 private Q_SLOTS:
  void aSearchIsSavedAndChosen();
  void searchesAreRenamedAndRemoved();
  void todayIsADate();
};

// In the next window, too, and for an archive.
void TestSavedSearches::aSearchIsSavedAndChosen() {
  if (!QrPeer::isInstalled()) QSKIP("dcmqrscp is not installed (package dcmtk)");
  const Studies studies;
  QVERIFY(studies.import());
  QrPeer peer;
  peer.add(dicomFilesBelow(studies.data));
  QVERIFY(peer.start());
  const ListedArchives list(peer.port());
  {
    SearchesWindow w(studies);
    QVERIFY(w.has("Head", 4));
    QCOMPARE(w.entries(),
             QStringList({QStringLiteral("(Save this search)"), QStringLiteral("(Edit saved searches...)")}));
    QTest::keyClicks(w.search(), QStringLiteral("2023 abdomen"));
    QVERIFY(w.shows({QString::fromUtf8("Müller, Jörg")}));
    QVERIFY(w.chooseEntry(saveSearchEntry));
    w.typeInCell(QStringLiteral("Bellies & more"));
    QVERIFY(w.closeSearches());
  }
  for (const char* source : {"This computer", "main"}) {
    SearchesWindow w(studies);
    QVERIFY(w.choose(source));
    QVERIFY(w.chooseEntry(QStringLiteral("Bellies && more")));
    QCOMPARE(w.search()->text(), QStringLiteral("2023 abdomen"));
    QTRY_COMPARE_WITH_TIMEOUT(w.patients(4), QStringList(QStringLiteral("Abdomen")), longest);
  }
}

// A cell that is emptied keeps its text.
void TestSavedSearches::searchesAreRenamedAndRemoved() {
  const Studies studies;
  QVERIFY(studies.import());
  SearchesWindow w(studies);
  QVERIFY(w.has("Head", 4));
  for (const char* words : {"head", "knee"}) {
    w.search()->clear();
    QTest::keyClicks(w.search(), QLatin1String(words));
    QVERIFY(w.chooseEntry(saveSearchEntry));
    w.typeInCell(QLatin1String(words).toString().toUpper());
    QVERIFY(w.closeSearches());
  }
  const QStringList both{QStringLiteral("HEAD"), QStringLiteral("KNEE"), saveSearchEntry, editSearchesEntry};
  QCOMPARE(w.entries(), both);
  QVERIFY(w.chooseEntry(editSearchesEntry));
  QCOMPARE(w.table()->rowCount(), 2);
  w.table()->setCurrentCell(1, 0);
  w.table()->editItem(w.table()->currentItem());
  w.typeInCell(QStringLiteral(" "));
  QCOMPARE(w.table()->item(1, 0)->text(), QStringLiteral("KNEE"));
  w.table()->setCurrentCell(1, 1);
  w.table()->editItem(w.table()->currentItem());
  w.typeInCell(QStringLiteral("abdomen"));
  w.table()->setCurrentCell(0, 0);
  w.press("removeSearch");
  QVERIFY(w.closeSearches());
  QCOMPARE(w.entries(), both.mid(1));
  QVERIFY(w.chooseEntry(QStringLiteral("KNEE")));
  QVERIFY(w.shows({QString::fromUtf8("Müller, Jörg")}));
}

void TestSavedSearches::todayIsADate() {
  const Studies studies;
  QVERIFY(studies.write());
  DicomSeriesTags tags;
  tags.patientName = "New^Nora", tags.patientId = "D444", tags.studyUid = "1.2.3.5";
  tags.studyDate = QDate::currentDate().toString(QStringLiteral("yyyyMMdd")).toStdString();
  const Result<VolumePtr> volume = makePhantom("cube:16");
  QVERIFY(volume && writeDicomSeries(**volume, tags, (studies.data + QStringLiteral("/new")).toStdString()));
  Result<Index> index = Index::open(studies.home.toStdString());
  QVERIFY(index && index->import({studies.data.toStdString()}));
  SearchesWindow w(studies);
  QVERIFY(w.has("Head", 4));
  QTest::keyClicks(w.search(), QStringLiteral("Today nora"));
  QVERIFY(w.shows({QStringLiteral("New, Nora")}));
  w.search()->clear();
  QTest::keyClicks(w.search(), QStringLiteral("yesterday"));
  QVERIFY(w.shows({}));
}

VOLUMEN_TEST(TestSavedSearches);
#include "tst_saved_searches.moc"
