// Guards that a study of an archive is shown series by series, by real events, with an archive that holds
// back the second of two: what is read stays as it is while the other comes, after that, and if it does not
// come.
#include <QToolButton>
#include <QTreeWidget>

#include "tests/ui/archives_window.h"
#include "tests/ui/held_study.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

struct ArrivalWindow : ArchivesWindow {
  using ArchivesWindow::ArchivesWindow;

  Session& session() { return window.session(); }
  qsizetype volumes() { return qsizetype(window.document().open.volumes().size()); }
  QString task() {
    const std::vector<JobRow> rows = window.jobs().rows();
    return rows.empty() ? QString() : rows[0].text;
  }
  bool isIdle() {
    return QTest::qWaitFor([&] { return window.jobs().rows().empty() && !window.document().loader.isBusy(); },
                           longest);
  }
  // Opens the study "Head" of the archive once the search has ended, as the archive answers one question at
  // a time.
  bool begin() {
    if (!child<QWidget>("studyBrowser")->isVisible()) child<QAction>("showBrowser")->trigger();
    if (!choose("held")) return false;
    searchFor("head");
    const auto isListed = [&] { return row("Head", 4).isValid() && notice().isEmpty(); };
    if (!QTest::qWaitFor(isListed, longest) || !isIdle()) return false;
    doubleClick(row("Head", 4));
    return true;
  }
  // Cancels by the bottom line, which shows the button a moment after the task has begun.
  bool cancel() {
    auto* button = child<QToolButton>("cancelTask");
    if (!QTest::qWaitFor([&] { return button->isVisible(); }, longest)) return false;
    QTest::mouseClick(button, Qt::LeftButton);
    return true;
  }
  // Returns the names in bold of the list of open studies.
  QStringList marked() {
    QStringList names;
    auto* tree = child<QTreeWidget>("studyTree");
    for (QTreeWidgetItemIterator it(tree); *it; ++it)
      if ((*it)->font(0).bold()) names << (*it)->text(0).section(QLatin1Char('\n'), 0, 0);
    return names;
  }
};

}  // namespace

class TestArrivingStudies : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void init() { openAlone(); }
  void whatIsReadStaysAsItIs_data();
  void whatIsReadStaysAsItIs();
  void aCancelledStudyIsFetchedOn();
  void aClosedStudyStaysClosed();
  void whatHangsTogetherComesTogether_data();
  void whatHangsTogetherComesTogether();
};

void TestArrivingStudies::whatIsReadStaysAsItIs_data() {
  QTest::addColumn<QString>("end");
  QTest::addColumn<int>("volumes");
  QTest::addColumn<QString>("told");
  QTest::newRow("the other series comes") << QStringLiteral("sent") << 2 << QString();
  QTest::newRow("the user cancels") << QStringLiteral("cancelled") << 1 << QString();
  QTest::newRow("the archive hangs up")
      << QStringLiteral("lost") << 1 << QStringLiteral("%1 of %2 images are missing.");
}

void TestArrivingStudies::whatIsReadStaysAsItIs() {
  QFETCH(QString, end);
  QFETCH(int, volumes);
  QFETCH(QString, told);
  const Studies studies;
  QVERIFY(studies.write());
  HeldStudy held(studies);
  QVERIFY(held.isReady());
  const ListedArchives list(Archives{{held.archive()}});
  ArrivalWindow w(studies);
  QVERIFY(w.begin());
  QVERIFY(w.isShown("Bone"));
  QTRY_VERIFY_WITH_TIMEOUT(held.isHolding(), longest);
  const int bone = held.imagesOf("Bone"), all = bone + held.imagesOf("Soft tissue");
  QTRY_VERIFY2_WITH_TIMEOUT(w.task().contains(QStringLiteral("image %1 of %2").arg(bone).arg(all)),
                            qPrintable(w.task()), longest);
  QCOMPARE(w.volumes(), 1);
  QTest::keyClick(&w.window, Qt::Key_2, Qt::AltModifier);
  const LoadedSeriesPtr shown = w.session().series();
  const Workspace read = w.session().workspace();
  const QStringList marked = w.marked();
  QCOMPARE(marked.size(), qsizetype(1));
  if (end == QStringLiteral("sent")) held.sendRest();
  if (end == QStringLiteral("lost")) held.hangUp();
  if (end == QStringLiteral("cancelled")) QVERIFY(w.cancel());
  QTRY_COMPARE_WITH_TIMEOUT(w.volumes(), qsizetype(volumes), longest);
  QVERIFY(w.isIdle());
  QCOMPARE(w.volumes(), qsizetype(volumes));
  QVERIFY2(w.session().series() == shown, "it is not read again");
  QVERIFY2(w.session().workspace() == read, "views, links and focus stay");
  QCOMPARE(w.marked(), marked);
  QCOMPARE(w.banner()->isVisible(), !told.isEmpty());
  if (!told.isEmpty())
    QVERIFY2(w.banner()->sentence().startsWith(told.arg(all - bone).arg(all)),
             qPrintable(w.banner()->sentence()));
}

// What is on this computer of a cancelled study is listed, and not fetched again.
void TestArrivingStudies::aCancelledStudyIsFetchedOn() {
  const Studies studies;
  QVERIFY(studies.write());
  HeldStudy held(studies);
  const ListedArchives list(Archives{{held.archive()}});
  ArrivalWindow w(studies);
  QVERIFY(w.begin());
  QVERIFY(w.isShown("Bone"));
  QTRY_VERIFY_WITH_TIMEOUT(held.isHolding(), longest);
  QVERIFY(w.cancel());
  QVERIFY(w.isIdle());
  held.sendRest();
  const LoadedSeriesPtr shown = w.session().series();
  QVERIFY(w.begin());
  QTRY_COMPARE_WITH_TIMEOUT(w.volumes(), 2, longest);
  QVERIFY(w.isIdle());
  QVERIFY(w.session().series() == shown);
  QCOMPARE(held.timesAskedForBone(), 1);
  QVERIFY(w.has("Doe, Jane (here)"));
}

void TestArrivingStudies::aClosedStudyStaysClosed() {
  const Studies studies;
  QVERIFY(studies.write());
  HeldStudy held(studies);
  const ListedArchives list(Archives{{held.archive()}});
  ArrivalWindow w(studies);
  QVERIFY(w.begin());
  QVERIFY(w.isShown("Bone"));
  QTRY_VERIFY_WITH_TIMEOUT(held.isHolding(), longest);
  Session& session = w.session();
  session.closeAll(w.window.document().open.everything());
  QCOMPARE(w.volumes(), 0);
  held.sendRest();
  QVERIFY(w.isIdle());
  QCOMPARE(w.volumes(), 0);
  QVERIFY(!session.series());
}

void TestArrivingStudies::whatHangsTogetherComesTogether_data() {
  QTest::addColumn<QString>("modality");
  for (const char* modality : {"PT", "MG", "CR", "DX"})
    QTest::newRow(modality) << QString::fromLatin1(modality);
}

void TestArrivingStudies::whatHangsTogetherComesTogether() {
  QFETCH(QString, modality);
  const Studies studies;
  QVERIFY(studies.write());
  HeldStudy held(studies, modality.toLatin1().constData());
  const ListedArchives list(Archives{{held.archive()}});
  ArrivalWindow w(studies);
  QVERIFY(w.begin());
  QTRY_VERIFY_WITH_TIMEOUT(held.isHolding(), longest);
  QTest::qWait(300);
  QCOMPARE(w.volumes(), 0);
  held.sendRest();
  QVERIFY(w.isShown("Bone"));
  QCOMPARE(w.volumes(), 2);
}

VOLUMEN_TEST(TestArrivingStudies);
#include "tst_arriving_studies.moc"
