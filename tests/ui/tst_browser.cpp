// Guards the study browser of the window, by real events: list, search, sort order, thumbnails, removal, keys
// and hidden names.
#include <QHeaderView>
#include <QMenu>

#include "results/text/text.h"
#include "tests/ui/browser_window.h"
#include "tests/unit/suite.h"
#include "ui/views/flat_view.h"
#include "ui/views/view_grid.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

const QString doe = QStringLiteral("Doe, Jane"), mueller = QStringLiteral("Müller, Jörg"),
              yamada = QStringLiteral("Yamada, Tarou  山田 太郎");

}  // namespace

class TestBrowser : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase();
  void init();
  void cleanup();
  void theListStandsInPlaceOfAnEmptyWindow();
  void oneSearchesWhileTyping();
  void everyColumnSorts();
  void columnsAreChosenAndKept();
  void theSeriesOfAStudyHaveThumbnails();
  void studiesAreRemovedAndComeBack();
  void typingInTheListSearches();
  void theMenuOpensAndRemoves();
  void hiddenNamesAreHiddenHereToo();
  void theListIsHiddenAndShown();

 private:
  std::unique_ptr<Studies> studies_;
};

void TestBrowser::initTestCase() { openAlone(); }

void TestBrowser::init() {
  studies_ = std::make_unique<Studies>();
  QVERIFY(studies_->import());
}

void TestBrowser::cleanup() { hideNames(false); }

void TestBrowser::theListStandsInPlaceOfAnEmptyWindow() {
  BrowserWindow w(*studies_);
  QVERIFY(w.shows({doe, mueller, yamada}));
  QVERIFY(w.child<QWidget>("studyBrowser")->isVisible());
  QVERIFY(!w.child<QWidget>("startPage")->isVisible());
  QCOMPARE(w.patients(1), texts({"A111", "B222", "C333"}));
  QCOMPARE(w.patients(2), texts({"2024-03-10", "2023-01-05", "2022-06-02"}));
  QCOMPARE(w.patients(4), texts({"2 studies", "Abdomen", "Knee"}));
  QCOMPARE(w.patients(5)[2], QStringLiteral("20"));
  // Studies are below their patient. Series are below their study once it is expanded.
  const QModelIndex head = w.row("Head", 4);
  QVERIFY(head.parent().isValid());
  w.tree()->setExpanded(head, true);
  QVERIFY(w.has("Soft tissue", 4));
  QCOMPARE(w.row("Soft tissue", 4).parent(), w.row("Head", 4));
}

void TestBrowser::oneSearchesWhileTyping() {
  const struct {
    const char *what, *words;
    QStringList found;
  } searches[] = {{"part of a name", "jan", {doe}},
                  {"without accents", "muller", {mueller}},
                  {"in another script", "山田", {yamada}},
                  {"ID", "b222", {mueller}},
                  {"date", "2022-06", {yamada}},
                  {"modality", "ct ja", {doe}},
                  // Only the older of Doe's studies has this modality.
                  {"another modality", "ot", {mueller, yamada, doe}},
                  {"description of the study", "abdomen", {mueller}},
                  {"description of a series", "tissue", {doe}},
                  {"all words", "jane follow", {doe}},
                  {"not all words", "jane abdomen", {}}};
  BrowserWindow w(*studies_);
  QVERIFY(w.shows({doe, mueller, yamada}));
  w.search()->setFocus();
  for (const auto& [what, utf8, found] : searches) {
    // Searches for something else first, so that a list of all studies is an answer, too.
    QTest::keyClicks(w.search(), QStringLiteral("zzz"));
    QVERIFY(w.shows({}));
    QCOMPARE(w.notice(), QStringLiteral("No study has all of these words."));
    w.search()->selectAll();
    const QString words = QString::fromUtf8(utf8);
    if (QString::fromLatin1(words.toLatin1()) == words)
      QTest::keyClicks(w.search(), words);
    else
      w.search()->insert(words);  // no key types these
    QVERIFY2(w.shows(found), what);
    QTest::keyClick(w.search(), Qt::Key_Escape);
    QVERIFY(w.search()->text().isEmpty());
    QVERIFY(w.shows({doe, mueller, yamada}));
  }
}

// TestStudyList proves the order of further columns.
void TestBrowser::everyColumnSorts() {
  const struct {
    const char* name;
    QStringList ascending, descending;
  } columns[] = {{"name", {doe, mueller, yamada}, {yamada, mueller, doe}},
                 {"ID", {doe, mueller, yamada}, {yamada, mueller, doe}},
                 {"date of the latest study", {yamada, mueller, doe}, {doe, mueller, yamada}},
                 {"modality, those alike by date", {doe, mueller, yamada}, {mueller, yamada, doe}},
                 {"description", {mueller, doe, yamada}, {yamada, doe, mueller}},
                 {"images", {mueller, yamada, doe}, {doe, yamada, mueller}}};
  BrowserWindow w(*studies_);
  QVERIFY(w.shows({doe, mueller, yamada}));
  QHeaderView* header = w.tree()->header();
  int column = 0;
  for (const auto& [name, ascending, descending] : columns) {
    const auto click = [&] {
      QTest::mouseClick(header->viewport(), Qt::LeftButton, {},
                        {header->sectionViewportPosition(column) + 10, header->height() / 2});
    };
    while (header->sortIndicatorSection() != column || header->sortIndicatorOrder() != Qt::AscendingOrder)
      click();
    QVERIFY2(w.shows(ascending), name);
    click();
    QVERIFY2(w.shows(descending), name);
    ++column;
  }
}

// Columns are chosen by a right click on their titles or in the list. The next window keeps the choice.
void TestBrowser::columnsAreChosenAndKept() {
  const auto chosen = [](QWidget* on, QPoint at, const char* column) {
    QContextMenuEvent event(QContextMenuEvent::Mouse, at, on->mapToGlobal(at));
    QCoreApplication::sendEvent(on, &event);
    auto* menu = qobject_cast<QMenu*>(QApplication::activePopupWidget());
    QVERIFY(menu);
    QList<QAction*> actions = menu->actions();
    for (QAction* action : menu->actions())
      if (action->menu()) actions << action->menu()->actions();
    for (QAction* action : actions)
      if (action->text() == QLatin1String(column)) action->trigger();
    menu->close();
  };
  const auto isHidden = [](BrowserWindow& w, StudyColumn column) {
    return w.tree()->isColumnHidden(int(column));
  };
  {
    BrowserWindow w(*studies_);
    QVERIFY(w.shows({doe, mueller, yamada}));
    for (const StudyColumn column :
         {StudyColumn::birthDate, StudyColumn::sex, StudyColumn::accession, StudyColumn::institution})
      QVERIFY(isHidden(w, column));
    chosen(w.tree()->header()->viewport(), {40, 5}, "Birth date");
    QVERIFY(!isHidden(w, StudyColumn::birthDate));
    chosen(w.tree()->header()->viewport(), {40, 5}, "Institution");
    QVERIFY(!isHidden(w, StudyColumn::institution));
    chosen(w.tree()->viewport(), w.tree()->visualRect(w.row("Doe")).center(), "ID");
    QVERIFY(isHidden(w, StudyColumn::id));
    w.shot("browser-columns");
  }
  BrowserWindow w(*studies_);
  QVERIFY(!isHidden(w, StudyColumn::birthDate) && !isHidden(w, StudyColumn::institution) &&
          isHidden(w, StudyColumn::id) && isHidden(w, StudyColumn::sex));
  QVERIFY(!isHidden(w, StudyColumn::name));
  QSettings().remove(QStringLiteral("studyColumns"));
}

void TestBrowser::theSeriesOfAStudyHaveThumbnails() {
  BrowserWindow w(*studies_);
  QVERIFY(w.has("Head", 4));
  w.click(w.row("Head", 4));
  QTRY_COMPARE_WITH_TIMEOUT(w.strip()->count(), 2, longest);
  const auto isLit = [&](int n) {
    const QImage icon = w.strip()->item(n)->icon().pixmap(72, 72).toImage();
    int lit = 0;
    for (int y = 0; y < icon.height(); ++y)
      for (int x = 0; x < icon.width(); ++x)
        lit += qAlpha(icon.pixel(x, y)) > 128 && qGray(icon.pixel(x, y)) > 60;
    return lit > 200;
  };
  QTRY_VERIFY_WITH_TIMEOUT(isLit(0) && isLit(1), longest);
  const QStringList texts{w.strip()->item(0)->text(), w.strip()->item(1)->text()};
  QVERIFY2(texts.filter(QStringLiteral("Soft tissue")).size() == 1, qPrintable(texts.join(QLatin1Char('|'))));
  QVERIFY(texts[0].contains(QStringLiteral("images")));
  // Clicking another study shows the thumbnails of that study.
  w.click(w.row("Abdomen", 4));
  QTRY_COMPARE_WITH_TIMEOUT(w.strip()->count(), 1, longest);
  QVERIFY(w.strip()->item(0)->text().contains(QStringLiteral("Venous")));
  w.shot("browser");
}

void TestBrowser::studiesAreRemovedAndComeBack() {
  BrowserWindow w(*studies_);
  QVERIFY(w.shows({doe, mueller, yamada}));
  w.click(w.row("Müller"));
  w.click(w.row("Yamada"), Qt::ControlModifier);
  QTest::keyClick(w.tree(), Qt::Key_Delete);
  QVERIFY(w.shows({doe}));
  QCOMPARE(w.child<QLabel>("removedText")->text(),
           QStringLiteral("2 studies removed from the list. Their files stay where they are."));
  w.shot("browser-removed");
  QVERIFY(QFileInfo::exists(studies_->data + QStringLiteral("/mueller")));
  QTest::mouseClick(w.child<QPushButton>("undoRemove"), Qt::LeftButton);
  QVERIFY(w.shows({doe, mueller, yamada}));
  QVERIFY(!w.child<QWidget>("removedBar")->isVisible());
  // Removes a patient with all studies.
  w.click(w.row("Doe"));
  QTest::keyClick(w.tree(), Qt::Key_Delete);
  QVERIFY(w.shows({mueller, yamada}));
  QVERIFY(w.child<QLabel>("removedText")->text().startsWith(QStringLiteral("2 studies removed")));
}

void TestBrowser::typingInTheListSearches() {
  BrowserWindow w(*studies_);
  QVERIFY(w.shows({doe, mueller, yamada}));
  w.click(w.row("Doe"));
  QVERIFY(w.tree()->hasFocus());
  // The key A would otherwise choose the anterior view.
  QTest::keyClicks(w.tree(), QStringLiteral("a"));
  QTest::keyClicks(QApplication::focusWidget(), QStringLiteral("bdo"));
  QCOMPARE(w.search()->text(), QStringLiteral("abdo"));
  QVERIFY(w.shows({mueller}));
  QTest::keyClick(w.search(), Qt::Key_Down);
  QVERIFY(w.tree()->hasFocus());
  QVERIFY(w.tree()->currentIndex().isValid());
  QTest::keyClick(w.tree(), Qt::Key_Escape);
  QVERIFY(w.search()->text().isEmpty());
  QVERIFY(w.shows({doe, mueller, yamada}));
  w.child<QAction>("findStudy")->trigger();
  QVERIFY(w.search()->hasFocus());
}

void TestBrowser::theMenuOpensAndRemoves() {
  BrowserWindow w(*studies_);
  QVERIFY(w.shows({doe, mueller, yamada}));
  const auto choose = [&](const char* entry) {
    QMenu* menu = w.menuOf(w.row("Müller"));
    QVERIFY(menu);
    QAction* action = w.entryOf(menu, entry);
    QVERIFY2(action, entry);
    w.chooseEntry(menu, action);
  };
  choose("Remove from list");
  QVERIFY(w.shows({doe, yamada}));
  QTest::mouseClick(w.child<QPushButton>("undoRemove"), Qt::LeftButton);
  QVERIFY(w.shows({doe, mueller, yamada}));
  choose("Open");
  QVERIFY(w.isShown("Venous"));
}

void TestBrowser::hiddenNamesAreHiddenHereToo() {
  BrowserWindow w(*studies_);
  QVERIFY(w.shows({doe, mueller, yamada}));
  w.tree()->expandAll();
  QVERIFY(w.has("Soft tissue", 4));
  w.child<QAction>("hideNames")->trigger();
  w.shot("browser-hidden");
  const QAbstractItemModel* model = w.tree()->model();
  QStringList seen;
  const std::function<void(const QModelIndex&)> read = [&](const QModelIndex& parent) {
    for (int n = 0; n < model->rowCount(parent); ++n) {
      for (int column = 0; column < model->columnCount(); ++column)
        for (const int role : {int(Qt::DisplayRole), int(Qt::ToolTipRole)})
          seen << model->index(n, column, parent).data(role).toString();
      read(model->index(n, 0, parent));
    }
  };
  read({});
  for (int n = 0; n < w.strip()->count(); ++n)
    seen << w.strip()->item(n)->text() << w.strip()->item(n)->toolTip();
  const QString all = seen.join(QLatin1Char('\n'));
  QVERIFY(all.contains(QStringLiteral("(name hidden)")) && all.contains(QStringLiteral("(ID hidden)")));
  QVERIFY(all.contains(QStringLiteral("(date hidden)")));
  for (const char* secret : {"Doe", "Jane", "山田", "A111", "B222", "2024", "2019"})
    QVERIFY2(!all.contains(QString::fromUtf8(secret)), secret);
  w.child<QAction>("hideNames")->trigger();
  QCOMPARE(w.patients(), QStringList({doe, mueller, yamada}));
}

void TestBrowser::theListIsHiddenAndShown() {
  BrowserWindow w(*studies_, {QStringLiteral("phantom:sphere:16")});
  QVERIFY(w.settle());
  auto* browser = w.child<QWidget>("studyBrowser");
  QVERIFY(!browser->isVisible());
  QTest::keyClick(&w.window, Qt::Key_B, Qt::ControlModifier);
  QTRY_VERIFY(browser->isVisible());
  QVERIFY(w.window.views()->isVisible());
  QVERIFY(w.shows({doe, mueller, yamada}));
  QTest::mouseClick(w.child<QWidget>("browserHide"), Qt::LeftButton);
  QVERIFY(!browser->isVisible());
  w.child<QAction>("showBrowser")->trigger();
  w.child<QAction>("maximise")->trigger();
  QVERIFY2(!browser->isVisible(), "one view alone is alone");
  w.child<QAction>("maximise")->trigger();
  QVERIFY(browser->isVisible());
}

VOLUMEN_TEST(TestBrowser);
#include "tst_browser.moc"
