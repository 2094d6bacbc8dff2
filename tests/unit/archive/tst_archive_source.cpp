// Guards ui/controller/archive_source.h with a real archive (dcmqrscp): numbers that stay, the latest search,
// what opening brings onto this computer, and what ends in a sentence.
#include <QDate>
#include <QElapsedTimer>
#include <QFile>
#include <QTcpServer>

#include "tests/unit/archive/archived_studies.h"
#include "tests/unit/archive/peer_process.h"
#include "tests/unit/suite.h"
#include "ui/controller/archive_source.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

constexpr int longestAnswer = 30000;  // ms

// A source with all that it has answered.
struct AskedArchive {
  AskedArchive(int port, const QString& home) : source(archiveAt(port), home.toStdString(), jobs) {
    using Source = StudySource;
    QObject::connect(&source, &Source::listed, &source,
                     [this](const StudyListRequest& request, const StudyListPtr& list) {
                       if (list->isGrowing) return;
                       words << QString::fromStdString(request.words);
                       lists.push_back(list);
                     });
    QObject::connect(&source, &Source::seriesListed, &source,
                     [this](qint64, const SeriesListPtr& all) { series = all; });
    QObject::connect(
        &source, &Source::patientListed, &source,
        [this](const std::string&, const std::string&,
               const std::optional<std::vector<IndexedStudy>>& studies) { patients.push_back(studies); });
    QObject::connect(
        &source, &Source::filesFound, &source,
        [this](const IndexedChoice&, const std::vector<std::string>& all, const OpenIntent& intent) {
          files.push_back(all);
          hows.push_back(intent.how);
          seriesUid = intent.seriesUid;
        });
    QObject::connect(&source, &Source::notOpened, &source,
                     [this](const IndexedChoice&, const QString& sentence) { notOpened << sentence; });
    QObject::connect(&source, &Source::failed, &source, [this](const QString& s) { failed << s; });
    QObject::connect(&source, &Source::unavailable, &source, [this](const QString& s) { unavailable << s; });
  }
  static Archive archiveAt(int port) {
    Archive archive;
    archive.name = "qr", archive.host = "127.0.0.1", archive.port = port, archive.calledAe = "ARCH";
    return archive;
  }

  // Returns the list for these words, or null if there was none.
  StudyListPtr listOf(const char* typed, const StudySort& sort = {}) {
    const std::size_t before = lists.size();
    const qsizetype refused = unavailable.size();
    source.list({typed, sort});
    const bool isAnswered =
        QTest::qWaitFor([&] { return lists.size() > before || unavailable.size() > refused; }, longestAnswer);
    return isAnswered && lists.size() > before ? lists.back() : nullptr;
  }
  // Returns the number of the only study with these words; 0 if there is another number of them.
  std::int64_t studyOf(const char* typed) {
    const StudyListPtr list = listOf(typed);
    const bool isOne = list && list->patients.size() == 1 && list->patients[0].studies.size() == 1;
    return isOne ? list->patients[0].studies[0].id : 0;
  }
  // Returns the series of a study, or nothing.
  std::vector<IndexedSeries> seriesOf(std::int64_t study) {
    series = nullptr;
    source.series(study);
    const bool isAnswered = QTest::qWaitFor([&] { return series != nullptr; }, longestAnswer);
    return isAnswered ? *series : std::vector<IndexedSeries>();
  }
  // Opens a study or series and waits until the archive has sent it. Returns whether the source found its
  // files.
  bool open(const IndexedChoice& choice, OpenHow how = OpenHow::instead) {
    const std::size_t before = files.size();
    source.open(choice, how);
    const auto hasEnded = [&] {
      return jobs.rows().empty() && (files.size() > before || !notOpened.isEmpty());
    };
    return QTest::qWaitFor(hasEnded, longestAnswer) && files.size() > before;
  }
  // Cancels the only job in the list.
  bool cancelJob() {
    const std::vector<JobRow> rows = jobs.rows();
    if (rows.size() != 1) return false;
    jobs.cancel(rows[0].id);
    return true;
  }

  Jobs jobs;
  QStringList words, notOpened, failed, unavailable;
  std::vector<StudyListPtr> lists;
  SeriesListPtr series;
  std::vector<std::optional<std::vector<IndexedStudy>>> patients;
  std::vector<std::vector<std::string>> files;
  std::vector<OpenHow> hows;  // for each entry of `files`
  std::string seriesUid;
  ArchiveSource source;
};

std::vector<std::string> studiesInIndex(const QString& home) {
  std::vector<std::string> uids;
  const Result<Index> index = Index::openAsItIs(home.toStdString());
  if (const auto studies = index ? index->studies() : index.error())
    for (const IndexedStudy& study : *studies) uids.push_back(study.studyUid);
  return uids;
}

}  // namespace

class TestArchiveSource : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase();
  void studiesAndSeriesKeepTheirNumbers();
  void theLatestSearchWins_data();
  void theLatestSearchWins();
  void withoutWordsItListsToday();
  void anotherOrderAsksNobody();
  void studiesOfOnePatientAreListed_data();
  void studiesOfOnePatientAreListed();
  void whatIsOpenedIsFetchedAndImported();
  void aStudyComesSeriesBySeries_data();
  void aStudyComesSeriesBySeries();
  void chosenSeriesComeOneByOne();
  void whatIsMissingIsTold_data();
  void whatIsMissingIsTold();
  void aFetchIsCancelled();
  void aSilentArchiveIsLeft();

 private:
  QString home(const char* name) const { return folder_.filePath(QLatin1String(name)); }

  QTemporaryDir folder_;
  QrPeer peer_;
};

void TestArchiveSource::initTestCase() {
  if (!QrPeer::isInstalled()) QSKIP("dcmqrscp is not installed (package dcmtk)");
  const QByteArray today = QDate::currentDate().toString(QStringLiteral("yyyyMMdd")).toLatin1();
  const ArchivedStudy ofToday{"1.2.7", "NEW^NORA", "", "PID7", today.constData(), "CT", "Skull"};
  peer_.add(writeAllArchived(folder_.path()) << writeArchived(folder_.path(), ofToday, 1));
  QVERIFY(peer_.start());
}

void TestArchiveSource::studiesAndSeriesKeepTheirNumbers() {
  AskedArchive a(peer_.port(), home("numbers"));
  const std::int64_t doe = a.studyOf("thorax"), john = a.studyOf("brain");
  QVERIFY(doe != 0 && john != 0 && doe != john);
  QCOMPARE(a.studyOf("pid1"), doe);
  const std::vector<IndexedSeries> series = a.seriesOf(doe);
  QCOMPARE(series.size(), std::size_t(2));
  QVERIFY(series[0].id != series[1].id);
  const std::vector<IndexedSeries> other = a.seriesOf(john);
  QCOMPARE(other.size(), std::size_t(1));
  QVERIFY(other[0].id != series[0].id && other[0].id != series[1].id);
  QVERIFY(a.studyOf("pid1") == doe && a.seriesOf(doe) == series);
}

void TestArchiveSource::theLatestSearchWins_data() {
  QTest::addColumn<QStringList>("typed");
  const auto row = [](const char* name, const QStringList& typed) { QTest::newRow(name) << typed; };
  row("of two", {QStringLiteral("thorax"), QStringLiteral("brain")});
  row("of three", {QStringLiteral("thorax"), QStringLiteral("knie"), QStringLiteral("brain")});
  row("typed back", {QStringLiteral("brain"), QStringLiteral("brai"), QStringLiteral("brain")});
  row("the same again", {QStringLiteral("brain"), QStringLiteral("brain")});
}

void TestArchiveSource::theLatestSearchWins() {
  QFETCH(QStringList, typed);
  AskedArchive a(peer_.port(), home("latest"));
  for (const QString& words : typed) a.source.list({words.toStdString(), {}});
  QCOMPARE(a.jobs.rows().size(), std::size_t(1));
  QTRY_COMPARE_WITH_TIMEOUT(a.words, QStringList(QStringLiteral("brain")), longestAnswer);
  QCOMPARE(a.lists[0]->patients.size(), std::size_t(1));
  QCOMPARE(a.lists[0]->patients[0].studies[0].studyUid, std::string("1.2.2"));
  QVERIFY(a.jobs.rows().empty() && a.unavailable.isEmpty());
}

void TestArchiveSource::withoutWordsItListsToday() {
  AskedArchive a(peer_.port(), home("today"));
  const StudyListPtr list = a.listOf("");
  QVERIFY(list);
  QCOMPARE(list->notice, QStringLiteral("Studies of today. Type words to search the archive."));
  QCOMPARE(list->patients.size(), std::size_t(1));
  QCOMPARE(list->patients[0].studies[0].studyUid, std::string("1.2.7"));
  QVERIFY(a.listOf("thorax") && a.lists.back()->notice.isEmpty());
}

// Once the archive is gone, other words end in a sentence.
void TestArchiveSource::anotherOrderAsksNobody() {
  auto peer = std::make_unique<QrPeer>();
  peer->add(writeAllArchived(folder_.path()));
  QVERIFY(peer->start());
  AskedArchive a(peer->port(), home("order"));
  const StudySort ascending{StudyColumn::id, true}, descending{StudyColumn::id, false};
  const StudyListPtr up = a.listOf("ct", ascending);
  QVERIFY(up && up->patients.size() == 3);
  peer.reset();
  const StudyListPtr down = a.listOf("ct", descending);
  QVERIFY(down && down->patients.size() == 3);
  QVERIFY(down->patients.front() == up->patients.back());
  QVERIFY(!a.listOf("mr", descending));
  QVERIFY2(a.unavailable[0].contains(QStringLiteral("\"qr\"")), qPrintable(a.unavailable[0]));
  QVERIFY(!a.listOf("ct", ascending));
}

void TestArchiveSource::studiesOfOnePatientAreListed_data() {
  QTest::addColumn<QString>("id");
  QTest::addColumn<QString>("name");
  QTest::addColumn<QStringList>("uids");
  const auto row = [](const char* title, const char* id, const char* name, const QStringList& uids) {
    QTest::newRow(title) << QString::fromLatin1(id) << QString::fromUtf8(name) << uids;
  };
  const QStringList none, doe(QStringLiteral("1.2.1"));
  row("ID and name", "PID1", "DOE^JANE", doe);
  row("another name", "PID1", "DOE^JOHN", none);
  row("part of an ID", "PID", "DOE^JANE", none);
  row("no ID in the archive", "", "DOE^JANE", none);
  row("nothing to ask for", "", "", none);
  row("a name with accents", "PID3", "Buc^Jérôme", QStringList(QStringLiteral("1.2.3")));
}

void TestArchiveSource::studiesOfOnePatientAreListed() {
  QFETCH(QString, id);
  QFETCH(QString, name);
  QFETCH(QStringList, uids);
  AskedArchive a(peer_.port(), home("patient"));
  a.source.studiesOf(id.toStdString(), name.toStdString());
  QTRY_COMPARE_WITH_TIMEOUT(a.patients.size(), std::size_t(1), longestAnswer);
  QVERIFY(a.patients[0]);
  QStringList listed;
  for (const IndexedStudy& study : *a.patients[0]) {
    listed << QString::fromStdString(study.studyUid);
    QCOMPARE(study.modalities, std::string("CT"));
  }
  QCOMPARE(listed, uids);
}

// It is imported after it was found. The list then says by itself what is here.
void TestArchiveSource::whatIsOpenedIsFetchedAndImported() {
  AskedArchive a(peer_.port(), home("opened"));
  const std::int64_t doe = a.studyOf("thorax");
  QVERIFY(a.lists.back()->here.empty());
  QVERIFY2(a.open({doe, 0}), qPrintable(a.notOpened.join(QLatin1Char(' '))));
  QCOMPARE(a.files.back().size(), std::size_t(2));
  QVERIFY(a.jobs.rows().empty());
  const std::map<std::int64_t, int> here{{doe, 2}};
  QTRY_COMPARE_WITH_TIMEOUT(a.lists.back()->here, here, longestAnswer);
  QVERIFY(a.failed.isEmpty());
  QCOMPARE(studiesInIndex(home("opened")), std::vector<std::string>{"1.2.1"});
  QCOMPARE(a.studyOf("thorax pid1"), doe);
  QCOMPARE(a.lists.back()->here, here);
}

void TestArchiveSource::aStudyComesSeriesBySeries_data() {
  QTest::addColumn<OpenHow>("how");
  QTest::addColumn<std::vector<std::size_t>>("files");
  QTest::addColumn<std::vector<OpenHow>>("hows");
  using Counts = std::vector<std::size_t>;
  using Hows = std::vector<OpenHow>;
  const auto row = [](const char* name, OpenHow how, const Counts& files, const Hows& hows) {
    QTest::newRow(name) << how << files << hows;
  };
  row("in place of others", OpenHow::instead, {1, 2}, {OpenHow::instead, OpenHow::joining});
  row("beside others", OpenHow::beside, {1, 2}, {OpenHow::beside, OpenHow::joining});
  row("all at once if it is looked into", OpenHow::lookedInto, {2}, {OpenHow::lookedInto});
}

void TestArchiveSource::aStudyComesSeriesBySeries() {
  QFETCH(OpenHow, how);
  QFETCH(std::vector<std::size_t>, files);
  QFETCH(std::vector<OpenHow>, hows);
  AskedArchive a(peer_.port(), home(QTest::currentDataTag()));
  QVERIFY(a.open({a.studyOf("thorax"), 0}, how));
  std::vector<std::size_t> counts;
  for (const std::vector<std::string>& all : a.files) counts.push_back(all.size());
  QCOMPARE(counts, files);
  QVERIFY(a.hows == hows);
}

// Those that were opened before stay among the files of the study.
void TestArchiveSource::chosenSeriesComeOneByOne() {
  AskedArchive a(peer_.port(), home("chosen"));
  const std::int64_t doe = a.studyOf("thorax");
  const std::vector<IndexedSeries> series = a.seriesOf(doe);
  QCOMPARE(series.size(), std::size_t(2));
  for (std::size_t n = 0; n < 2; ++n) {
    QVERIFY(a.open({doe, series[n].id}));
    QCOMPARE(a.seriesUid, series[n].seriesUid);
    QCOMPARE(a.files.back().size(), n + 1);
  }
}

void TestArchiveSource::whatIsMissingIsTold_data() {
  QTest::addColumn<int>("lost");
  QTest::addColumn<QString>("beginning");
  QTest::newRow("one of two") << 1 << QStringLiteral("1 of 2 images are missing. The archive \"qr\" ");
  QTest::newRow("all") << 2 << QStringLiteral("The archive \"qr\" ");
}

void TestArchiveSource::whatIsMissingIsTold() {
  QFETCH(int, lost);
  QFETCH(QString, beginning);
  const QTemporaryDir files;
  QStringList doe;
  for (const int series : {1, 2}) doe << writeArchived(files.path(), archivedStudies[0], series);
  QrPeer peer;
  peer.add(doe);
  QVERIFY(peer.start());
  for (int n = 0; n < lost; ++n) QVERIFY(QFile::remove(doe[n]));
  AskedArchive a(peer.port(), files.filePath(QStringLiteral("home")));
  const std::int64_t study = a.studyOf("thorax");
  QCOMPARE(a.open({study, 0}), lost == 1);
  const QStringList& told = lost == 1 ? a.failed : a.notOpened;
  QCOMPARE(told.size(), qsizetype(1));
  QVERIFY2(told[0].startsWith(beginning), qPrintable(told[0]));
  if (lost == 1) QCOMPARE(a.files.back().size(), std::size_t(1));
}

void TestArchiveSource::aFetchIsCancelled() {
  AskedArchive a(peer_.port(), home("cancelled"));
  const std::int64_t doe = a.studyOf("thorax");
  a.source.open({doe, 0}, OpenHow::instead);
  QVERIFY(a.cancelJob());
  QTest::qWait(500);
  QVERIFY(a.files.empty() && a.notOpened.isEmpty() && a.failed.isEmpty());
  QVERIFY(a.open({doe, 0}));
  QCOMPARE(a.files.back().size(), std::size_t(2));
}

// A cancelled search is told, a cancelled question for priors answered. The end of the program waits for
// none.
void TestArchiveSource::aSilentArchiveIsLeft() {
  QTcpServer silent;
  QVERIFY(silent.listen(QHostAddress::LocalHost));
  QElapsedTimer since;
  {
    AskedArchive a(silent.serverPort(), home("silent"));
    a.source.list({"doe", {}});
    QTest::qWait(300);
    QVERIFY(a.cancelJob());
    QCOMPARE(a.unavailable.size(), qsizetype(1));
    QVERIFY(a.unavailable[0].startsWith(QStringLiteral("The search of qr was cancelled.")));
    a.source.studiesOf("PID1", "DOE^JANE");
    QTest::qWait(300);
    QVERIFY(a.cancelJob());
    QCOMPARE(a.patients.size(), std::size_t(1));
    QVERIFY(!a.patients[0]);
    a.source.list({"doe", {}});
    QTest::qWait(300);
    since.start();
  }
  QVERIFY2(since.elapsed() < 3000, qPrintable(QStringLiteral("%1 ms").arg(since.elapsed())));
}

VOLUMEN_TEST(TestArchiveSource);
#include "tst_archive_source.moc"
