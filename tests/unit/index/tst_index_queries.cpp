// Guards the index (import.md): studies are found in any script, sorted, forgotten and restored. A series has
// a thumbnail.
#include <QDate>
#include <QImage>
#include <QRandomGenerator>
#include <filesystem>

#include "io/index/database.h"
#include "io/index/fold.h"
#include "io/open.h"
#include "tests/fixtures/chance.h"
#include "tests/fixtures/filled_index.h"
#include "tests/unit/index/index_folder.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;
namespace fs = std::filesystem;

namespace {

QStringList found(const Index& index, const StudyQuery& query) {
  QStringList names;
  const auto studies = index.studies(query);
  for (const IndexedStudy& study : *studies) names << QString::fromStdString(study.patientName);
  return names;
}

QImage imageOf(const Thumbnail& png) { return QImage::fromData(png.data(), int(png.size()), "PNG"); }

}  // namespace

class TestIndexQueries : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void textIsFolded_data();
  void textIsFolded();
  void wordsFind_data();
  void wordsFind();
  void daysHaveNames();
  void studiesAreSorted_data();
  void studiesAreSorted();
  void factsAreKept();
  void forgottenComesBack();
  void importBringsBack();
  void forgottenGoesForGood();
  void thumbnailShowsTheMiddle();
  void thumbnailIsKeptAndRemade();
  void thumbnailOfWhatHasNone();
  void opensWhatIsListed();
};

void TestIndexQueries::textIsFolded_data() {
  QTest::addColumn<QString>("text");
  QTest::addColumn<QString>("plain");
  const auto row = [](const char* name, const char* text, const char* plain) {
    QTest::newRow(name) << QString::fromUtf8(text) << QString::fromUtf8(plain);
  };
  row("umlaut", "Müller", "muller");
  row("umlaut of two code points", "Mu\xcc\x88ller", "muller");
  row("sharp s", "Straße", "strasse");
  row("capital sharp s",
      "STRA\xe1\xba\x9e"
      "E",
      "strasse");
  row("Polish l", "Łódź", "lodz");
  row("Danish", "Ærø Ångström", "aero angstrom");
  row("Turkish", "Işık", "isik");
  row("full width", "ＡＢＣ１２", "abc12");
  row("half width kana", "ﾔﾏﾀﾞ", "ヤマタ");
  row("Vietnamese", "Nguyễn", "nguyen");
  row("Greek", "ΣΊΣΥΦΟΣ", "σισυφοσ");
  row("groups and components of a name", "Wang^XiaoDong=王^小东=", "wang xiaodong 王 小东");
  row("a comma", "Müller,  Jörg", "muller jorg");
  row("Chinese stays", "王小东", "王小东");
  row("control characters", "a\tb\nc", "a b c");
}

void TestIndexQueries::textIsFolded() {
  QFETCH(QString, text);
  QFETCH(QString, plain);
  QCOMPARE(QString::fromStdString(folded(text.toStdString())), plain);
  QCOMPARE(QString::fromStdString(folded(plain.toStdString())), plain);
}

void TestIndexQueries::wordsFind_data() {
  QTest::addColumn<QString>("words");
  QTest::addColumn<QStringList>("patients");
  const QString muller = QStringLiteral("Müller^Jörg"), wang = QStringLiteral("Wang^XiaoDong=王^小东"),
                strasse = QStringLiteral("Straße^50%_Anna");
  const auto row = [](const char* words, QStringList patients) {
    QTest::newRow(words) << QString::fromUtf8(words) << patients;
  };
  row("", {muller, strasse, wang});
  row("Müller", {muller});
  row("muller", {muller});
  row("MULL", {muller});
  row("üll", {muller});
  row("Müller, Jörg", {muller});
  row("Jörg^Müller", {muller});
  row("王", {wang});
  row("小东", {wang});
  row("王小东", {});
  row("xiaodong 王", {wang});
  row("strasse", {strasse});
  row("Straße", {strasse});
  row("50%", {strasse});
  row("%", {strasse});
  row("_", {strasse});
  row("0%_a", {strasse});
  row("x%y", {});
  row("'; DROP TABLE study", {});
  row("20261124", {muller, strasse, wang});
  row("2026-11", {muller, strasse, wang});
  row("ct", {muller, strasse, wang});
  row("mr", {});
  row("knee", {wang});
  row("A77", {muller, strasse, wang});
  row("hopital louis", {muller, strasse, wang});
  row("muller wang", {});
  row("ct knee 2026 wang", {wang});
}

void TestIndexQueries::wordsFind() {
  QFETCH(QString, words);
  QFETCH(QStringList, patients);
  const IndexFolder folder;
  folder.add({"a", "Müller^Jörg", "1.1", "1.1.1", 0, "Head"});
  folder.add({"b", "Wang^XiaoDong=王^小东", "1.2", "1.2.1", 0, "Knee left"});
  folder.add({"c", "Straße^50%_Anna", "1.3", "1.3.1", 0, "Chest"});
  folder.import();
  const Index index = folder.open();
  QCOMPARE(found(index, {.words = words.toStdString(), .order = StudyOrder::patient, .ascending = true}),
           patients);
}

void TestIndexQueries::daysHaveNames() {
  const IndexFolder folder;
  const auto add = [&](const char* patient, const char* study, int daysAgo) {
    const QDate day = QDate::currentDate().addDays(-daysAgo);
    folder.add({.name = study,
                .patient = patient,
                .study = study,
                .series = std::string(study) + ".1",
                .date = day.toString(QStringLiteral("yyyyMMdd")).toStdString()});
  };
  add("New^Nora", "1.1", 0);
  add("Old^Olaf", "1.2", 1);
  add("Older^Otto", "1.3", 2);
  folder.import();
  const Index index = folder.open();
  QCOMPARE(found(index, {.words = "Today"}), QStringList{QStringLiteral("New^Nora")});
  QCOMPARE(found(index, {.words = "yesterday old"}), QStringList{QStringLiteral("Old^Olaf")});
}

void TestIndexQueries::studiesAreSorted_data() {
  QTest::addColumn<int>("order");
  for (int order = 0; order <= int(StudyOrder::opened); ++order)
    QTest::newRow(qPrintable(QString::number(order))) << order;
}

// Compares with a plain sort, in both directions, with and without a limit.
void TestIndexQueries::studiesAreSorted() {
  QFETCH(int, order);
  const IndexFolder folder;
  QVERIFY(fillIndex(folder.index(), {.patients = 40, .studies = 3, .series = 3}).ok());
  Index index = folder.open();
  const std::vector<IndexedStudy> all = studiesIn(index);
  QCOMPARE(all.size(), std::size_t(120));
  for (const std::size_t n : {7u, 80u, 13u}) QVERIFY(index.opened(all[n].id).ok());
  const auto key = [&](const IndexedStudy& s) -> std::string {
    switch (StudyOrder(order)) {
      case StudyOrder::date:
        return s.date;
      case StudyOrder::patient:
        return folded(s.patientName);
      case StudyOrder::modality:
        return s.modalities;
      case StudyOrder::imported:
        return s.importedAt;
      case StudyOrder::opened:
        return s.openedAt;
    }
    return {};
  };
  for (const bool ascending : {true, false}) {
    const auto sorted = studiesIn(index, {.words = {}, .order = StudyOrder(order), .ascending = ascending});
    QCOMPARE(sorted.size(), all.size());
    for (std::size_t n = 1; n < sorted.size(); ++n)
      QVERIFY(ascending ? key(sorted[n - 1]) <= key(sorted[n]) : key(sorted[n - 1]) >= key(sorted[n]));
    const auto few =
        studiesIn(index, {.words = {}, .order = StudyOrder(order), .ascending = ascending, .limit = 5});
    QCOMPARE(few.size(), std::size_t(5));
    for (std::size_t n = 0; n < few.size(); ++n) QVERIFY(few[n] == sorted[n]);
  }
}

void TestIndexQueries::factsAreKept() {
  const IndexFolder folder;
  for (int n = 0; n < 3; ++n)
    folder.add({"a" + std::to_string(n), "Test^Patient", "1.1", "1.1.1", n, "Head"});
  folder.import();
  const Index index = folder.open();
  const IndexedStudy s = studiesIn(index).at(0);
  QCOMPARE(s.patientName, std::string("Test^Patient"));
  QCOMPARE(s.birthDate, std::string("19700102"));
  QCOMPARE(s.accessionNumber, std::string("A77"));
  QCOMPARE(s.institution, std::string("Hôpital Saint-Louis"));
  QCOMPARE(s.date, std::string("20261124"));
  QCOMPARE(s.description, std::string("Head"));
  QCOMPARE(s.modalities, std::string("CT"));
  QCOMPARE(s.images, 3);
  QCOMPARE(s.series, 1);
  QVERIFY(s.importedAt.ends_with("Z") && s.openedAt.empty());
  const IndexedSeries series = seriesIn(index, s.id).at(0);
  QVERIFY(series.isVolume);
  QCOMPARE(series.frames, 3);
}

void TestIndexQueries::forgottenComesBack() {
  const IndexFolder folder;
  for (const char* study : {"1.1", "1.2", "1.3"})
    folder.add({study, "A", study, std::string(study) + ".1", 0});
  folder.import();
  Index index = folder.open();
  const std::string before = tests::contentsOf(index);
  const std::vector<IndexedStudy> all = studiesIn(index);
  QVERIFY(index.forget({all[0].id, all[2].id}).ok());
  QCOMPARE(studiesIn(index).size(), std::size_t(1));
  QCOMPARE(index.lastForgotten()->size(), std::size_t(2));
  QTest::qWait(2);  // gives the second call a later time stamp in ms
  QVERIFY(index.forget({all[1].id}).ok());
  QCOMPARE(studiesIn(index).size(), std::size_t(0));
  QCOMPARE(*index.lastForgotten(), std::vector<std::int64_t>{all[1].id});
  QVERIFY(index.undoForget(*index.lastForgotten()).ok());
  QVERIFY(index.undoForget(*index.lastForgotten()).ok());
  QCOMPARE(index.lastForgotten()->size(), std::size_t(0));
  QCOMPARE(tests::contentsOf(index), before);
  for (const char* study : {"1.1", "1.2", "1.3"}) QVERIFY(fs::exists(folder.data(study)));
}

void TestIndexQueries::importBringsBack() {
  const IndexFolder folder;
  folder.add({"a", "A", "1.1", "1.1.1", 0});
  folder.add({"b", "B", "1.2", "1.2.1", 0});
  folder.import();
  Index index = folder.open();
  const std::string before = tests::contentsOf(index);
  QVERIFY(index.forget({studiesIn(index).at(0).id}).ok());
  const ImportReport report = folder.import();
  QCOMPARE(report.added, 1);
  QCOMPARE(report.unchanged, 1);
  QCOMPARE(tests::contentsOf(index), before);
}

void TestIndexQueries::forgottenGoesForGood() {
  const IndexFolder folder;
  folder.add({"a", "A", "1.1", "1.1.1", 0});
  folder.add({"c/b", "B", "1.2", "1.2.1", 0});
  folder.import();
  Index index = folder.open();
  const std::int64_t gone = studiesIn(index).at(0).id;
  QVERIFY(index.forget({gone}).ok());
  Result<std::unique_ptr<Database>> db = Database::open(folder.index() + "/index.sqlite");
  QVERIFY(db.ok());
  (*db)->run("UPDATE study SET forgotten_at = '2020-01-01T00:00:00.000Z' WHERE id = ?", gone);
  QVERIFY((*db)->takeStatus().ok());
  fs::create_directories(folder.data("empty"));
  folder.import("empty");
  QVERIFY(index.undoForget({gone}).ok());
  QCOMPARE(studiesIn(index).size(), std::size_t(1));
}

// Each slice has 2 x 1 voxels of 0.7 x 0.5 mm, black on the left and white on the right.
void TestIndexQueries::thumbnailShowsTheMiddle() {
  const DicomFolder files;
  for (int n = 0; n < 3; ++n) {
    DicomPicture picture = sliceAt(n, n);
    picture.columns = 40, picture.rows = 20;
    picture.spacing = "1\\2";
    picture.pixels.assign(800, 0);
    for (int y = 0; y < 20; ++y)
      for (int x = 20; x < 40; ++x) picture.pixels[std::size_t(y * 40 + x)] = n == 1 ? 100 : 0;
    files.add(numbered("s", n), picture);
  }
  const IndexFolder folder;
  Index index = folder.open();
  QVERIFY(index.import({files.path()}).ok());
  const IndexedSeries series = seriesIn(index, studiesIn(index).at(0).id).at(0);
  const Result<Thumbnail> png = index.thumbnail(series.id);
  QVERIFY(png.ok());
  const QImage image = imageOf(*png);
  QCOMPARE(image.size(), QSize(128, 32));  // 80 mm x 20 mm
  QCOMPARE(qGray(image.pixel(10, 16)), 0);
  QCOMPARE(qGray(image.pixel(117, 16)), 255);
}

void TestIndexQueries::thumbnailIsKeptAndRemade() {
  const IndexFolder folder;
  for (int n = 0; n < 3; ++n) folder.add({"a/i" + std::to_string(n), "A", "1.1", "1.1.1", n});
  folder.import();
  Index index = folder.open();
  const std::int64_t series = seriesIn(index, studiesIn(index).at(0).id).at(0).id;
  const Thumbnail first = *index.thumbnail(series);
  QVERIFY(!imageOf(first).isNull());
  // The cached thumbnail is available while the files are absent.
  fs::rename(folder.data("a"), folder.index() + "-away");
  QCOMPARE(*index.thumbnail(series), first);
  fs::rename(folder.index() + "-away", folder.data("a"));
  // A changed series gets a new thumbnail, and the cache may be deleted at any time.
  folder.add({"a/i3", "A", "1.1", "1.1.1", 3});
  folder.import();
  QVERIFY(!imageOf(*index.thumbnail(series)).isNull());
  Index another = folder.open();
  for (const char* part : {"", "-wal", "-shm"}) fs::remove(folder.index() + "/thumbnails.sqlite" + part);
  QVERIFY(!imageOf(*another.thumbnail(series)).isNull());
  // A damaged cache is silently rebuilt.
  for (const char* part : {"-wal", "-shm"}) fs::remove(folder.index() + "/thumbnails.sqlite" + part);
  writeAll(folder.index() + "/thumbnails.sqlite", std::vector<std::uint8_t>(5000, 'x'));
  Index third = folder.open();
  QVERIFY(third.notice().empty());
  QVERIFY(!imageOf(*third.thumbnail(series)).isNull());
}

void TestIndexQueries::thumbnailOfWhatHasNone() {
  const IndexFolder folder;
  QVERIFY(fillIndex(folder.index(), {.patients = 1, .studies = 1, .series = 1}).ok());
  Index index = folder.open();
  const std::int64_t series = seriesIn(index, studiesIn(index).at(0).id).at(0).id;
  QVERIFY(index.thumbnail(series)->empty());      // its files do not exist
  QVERIFY(index.thumbnail(series + 1)->empty());  // no such series exists
}

void TestIndexQueries::opensWhatIsListed() {
  const IndexFolder folder;
  for (int n = 0; n < 4; ++n) {
    folder.add({"a/i" + std::to_string(n), "A", "1.1", "1.1.1", n});
    folder.add({"b/i" + std::to_string(n), "A", "1.1", "1.1.2", n});
  }
  folder.import();
  const Index index = folder.open();
  const IndexedStudy study = studiesIn(index).at(0);
  const Result<Study> whole = openFiles(filesIn(index, study.id));
  QCOMPARE(whole->volumes.size(), std::size_t(2));
  for (const IndexedSeries& series : seriesIn(index, study.id)) {
    const Result<Study> one = openFiles(filesIn(index, study.id, series.id));
    QCOMPARE(one->volumes.size(), std::size_t(1));
    QCOMPARE(one->volumes[0].seriesUid, series.seriesUid);
    QCOMPARE(one->volumes[0].files, filesIn(index, study.id, series.id));  // in slice order
  }
}

VOLUMEN_TEST(TestIndexQueries);
#include "tst_index_queries.moc"
