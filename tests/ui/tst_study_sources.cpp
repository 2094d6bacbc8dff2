// Guards ui/controller/study_source.h. Answers of a source that come late, twice, in another order or not at
// all are assigned to their requests. The browser needs nothing else of a source.
#include <QComboBox>
#include <QDirIterator>

#include "tests/ui/browser_window.h"
#include "tests/ui/fake_source.h"
#include "tests/unit/suite.h"

using namespace volumen;

namespace {

using tests::BrowserWindow;
using tests::FakeSource;
using tests::longest;

FakeSource::Study studyOf(const tests::Studies& studies, std::int64_t id, const tests::WrittenSeries& s) {
  FakeSource::Study study;
  study.listed.id = id;
  study.listed.patientName = s.name, study.listed.patientId = s.id;
  study.listed.studyUid = s.studyUid, study.listed.date = s.date, study.listed.description = s.study;
  QDirIterator files(studies.data + QLatin1Char('/') + QString::fromUtf8(s.folder), QDir::Files);
  while (files.hasNext()) study.files.push_back(files.next().toStdString());
  return study;
}

// Returns studies 1, 2 and 3: Doe's bone, Müller's and Yamada's.
std::vector<FakeSource::Study> threeStudies(const tests::Studies& studies) {
  const std::vector<tests::WrittenSeries>& all = tests::writtenSeries();
  return {studyOf(studies, 1, all[0]), studyOf(studies, 2, all[3]), studyOf(studies, 3, all[4])};
}

// A window whose studies come from sources that answer on command.
struct Sources {
  explicit Sources(const tests::Studies& studies, const QStringList& keys = {QStringLiteral("fake")})
      : window(services(studies, keys)) {
    window.child<QAction>("showBrowser")->trigger();
  }

  Services services(const tests::Studies& studies, const QStringList& keys) {
    Services all = studies.services();
    all.makeSources = [this, &studies, keys](const std::string&, Jobs& jobs) {
      StudySourceList made;
      for (const QString& key : keys) {
        made.push_back(std::make_unique<FakeSource>(key, jobs, threeStudies(studies)));
        fakes.push_back(static_cast<FakeSource*>(made.back().get()));
      }
      return made;
    };
    return all;
  }
  void type(const char* words) {
    window.search()->clear();
    QTest::keyClicks(window.search(), QString::fromUtf8(words));
  }
  bool isAsked(const std::string& words, std::size_t source = 0) {
    return QTest::qWaitFor([&] { return fakes[source]->wasAsked(words); }, longest);
  }
  // Requests the study of a patient from the first source.
  void open(const char* name, OpenHow how) {
    window.tree()->setCurrentIndex(window.row(name));
    QTest::keyClick(window.tree(), Qt::Key_Return,
                    how == OpenHow::beside ? Qt::ControlModifier : Qt::NoModifier);
  }
  QStringList openPlaces() {
    QStringList places;
    for (const OpenStudy& opened : window.window.document().open.all()) places << opened.path;
    return places;
  }

  std::vector<FakeSource*> fakes;
  BrowserWindow window;
};

}  // namespace

class TestStudySources : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase();
  void init() { tests::openAlone(); }
  void theNewestSearchIsShown_data();
  void theNewestSearchIsShown();
  void twoOpensEndWhereTheyWereMeant_data();
  void twoOpensEndWhereTheyWereMeant();
  void oneOfThreeOpensIsCancelled();
  void whatFailsIsASentence();
  void severalAreChosenFrom();
  void oneAloneIsNotChosen();

 private:
  const tests::Studies studies_;
};

void TestStudySources::initTestCase() { QVERIFY(studies_.write()); }

void TestStudySources::theNewestSearchIsShown_data() {
  QTest::addColumn<std::vector<std::string>>("answers");
  QTest::newRow("answered in order") << std::vector<std::string>{"Doe", "Yam"};
  QTest::newRow("the older answer comes last") << std::vector<std::string>{"Yam", "Doe"};
  QTest::newRow("the older answer comes twice") << std::vector<std::string>{"Doe", "Yam", "Doe"};
}

void TestStudySources::theNewestSearchIsShown() {
  QFETCH(std::vector<std::string>, answers);
  Sources s(studies_);
  for (const char* words : {"Doe", "Yam"}) {
    s.type(words);
    QVERIFY(s.isAsked(words));
  }
  for (const std::string& words : answers) s.fakes[0]->answer(words);
  QCOMPARE(s.window.patients(1), QStringList(QStringLiteral("C333")));
}

void TestStudySources::twoOpensEndWhereTheyWereMeant_data() {
  QTest::addColumn<bool>("firstIsBeside");
  QTest::addColumn<std::vector<std::size_t>>("answers");
  QTest::addColumn<QStringList>("places");
  const QString doe = QStringLiteral("fake:1"), mueller = QStringLiteral("fake:2");
  QTest::newRow("in place, then beside; answered in order")
      << false << std::vector<std::size_t>{0, 1} << QStringList{doe, mueller};
  QTest::newRow("beside, then in place; the later one answered first")
      << true << std::vector<std::size_t>{1, 0} << QStringList{mueller, doe};
}

// Both are requested before either is answered.
void TestStudySources::twoOpensEndWhereTheyWereMeant() {
  QFETCH(bool, firstIsBeside);
  QFETCH(std::vector<std::size_t>, answers);
  QFETCH(QStringList, places);
  Sources s(studies_);
  QVERIFY(s.isAsked({}));
  s.fakes[0]->answer({});
  s.open("Doe", firstIsBeside ? OpenHow::beside : OpenHow::instead);
  s.open("Müller", firstIsBeside ? OpenHow::instead : OpenHow::beside);
  QCOMPARE(s.fakes[0]->opens.size(), std::size_t(2));
  for (const std::size_t n : answers) s.fakes[0]->answerOpen(n);
  QVERIFY(s.window.isShown(firstIsBeside ? "Venous" : "Bone", firstComparedId));
  QVERIFY(s.window.isShown(firstIsBeside ? "Bone" : "Venous", firstComparedId + 1));
  QCOMPARE(s.openPlaces(), places);
}

void TestStudySources::oneOfThreeOpensIsCancelled() {
  Sources s(studies_);
  QVERIFY(s.isAsked({}));
  s.fakes[0]->answer({});
  for (const char* name : {"Doe", "Müller", "Yamada"}) s.open(name, OpenHow::beside);
  const std::vector<JobRow> rows = s.window.window.jobs().rows();
  QCOMPARE(rows.size(), std::size_t(3));
  s.window.window.jobs().cancel(rows[1].id);
  for (std::size_t n = 0; n < 3; ++n) s.fakes[0]->answerOpen(n);
  QTRY_COMPARE_WITH_TIMEOUT(s.openPlaces().size(), qsizetype(2), longest);
  QCOMPARE(s.openPlaces(), QStringList({QStringLiteral("fake:1"), QStringLiteral("fake:3")}));
  QVERIFY(s.window.isShown("Bone", firstComparedId));
  QVERIFY(s.window.isShown("Sagittal", firstComparedId + 1));
}

void TestStudySources::whatFailsIsASentence() {
  Sources s(studies_);
  QVERIFY(s.isAsked({}));
  s.fakes[0]->answer({});
  Q_EMIT s.fakes[0]->failed(QStringLiteral("The archive does not answer."));
  QTRY_VERIFY(s.window.banner()->isVisible());
  QVERIFY(s.window.banner()->sentence().contains(QStringLiteral("The archive does not answer.")));
  Q_EMIT s.fakes[0]->unavailable(QStringLiteral("It is not there."));
  QCOMPARE(s.window.notice(), QStringLiteral("The list of studies cannot be used: It is not there."));
  QVERIFY(!s.window.tree()->isEnabled());
  s.fakes[0]->answer({});
  QVERIFY(s.window.tree()->isEnabled());
}

// Later answers of a source that is no longer listed are not shown.
void TestStudySources::severalAreChosenFrom() {
  Sources s(studies_, {QStringLiteral("a"), QStringLiteral("b")});
  QVERIFY(s.isAsked({}));
  auto* box = s.window.child<QComboBox>("browserSource");
  QVERIFY(box->isVisible());
  QCOMPARE(box->currentText(), QStringLiteral("Archive a"));
  box->setCurrentIndex(1);
  QVERIFY(s.isAsked({}, 1));
  s.fakes[0]->answer({});
  QCOMPARE(s.window.patients().size(), qsizetype(0));
  s.fakes[1]->answer({});
  QCOMPARE(s.window.patients().size(), qsizetype(3));
  s.open("Doe", OpenHow::instead);
  QVERIFY(s.fakes[0]->opens.empty());
  s.fakes[1]->answerOpen(0);
  QVERIFY(s.window.isShown("Bone"));
  QCOMPARE(s.openPlaces(), QStringList(QStringLiteral("b:1")));
}

void TestStudySources::oneAloneIsNotChosen() {
  Sources s(studies_);
  QVERIFY(!s.window.child<QComboBox>("browserSource")->isVisible());
  QVERIFY2(!s.window.child<QPushButton>("browserImport")->isVisible(), "nothing can be imported into it");
  const BrowserWindow real(studies_);
  const auto* import = real.window.findChild<QPushButton*>(QStringLiteral("browserImport"));
  QVERIFY(import->isVisibleTo(import->parentWidget()));
}

VOLUMEN_TEST(TestStudySources);
#include "tst_study_sources.moc"
