// Guards how the study browser groups and sorts the studies of the index.
#include <QTest>
#include <algorithm>

#include "tests/unit/suite.h"
#include "ui/data/study_list.h"

using namespace volumen;

namespace {

IndexedStudy study(std::int64_t id, const char* name, const char* patient, const char* date,
                   const char* modalities, int images, const char* opened = "") {
  IndexedStudy s;
  s.id = id, s.patientName = name, s.patientId = patient, s.date = date;
  s.modalities = modalities, s.images = images, s.openedAt = opened;
  return s;
}

std::vector<IndexedStudy> four() {
  std::vector<IndexedStudy> all;  // filled one by one, as GCC 12 takes an initialiser list for uninitialised
  all.push_back(study(1, "doe^jane", "10", "20200101", "CT, PT", 5, "2026-01-02"));
  all.push_back(study(2, "Roe^Rick", "9", "20230101", "MR", 1000));
  all.push_back(study(3, "doe^jane", "10", "20240101", "CT, MR", 7, "2026-01-03"));
  all.push_back(study(4, "Adams", "11", "20210101", "US", 90, "2026-01-01"));
  const char* const more[][4] = {{"19800101", "F", "7", "North"},
                                 {"19500630", "M", "9", "Hill"},
                                 {"19800101", "F", "7", "North"},
                                 {"19721224", "O", "3", "south"}};
  for (std::size_t n = 0; n < 4; ++n) {
    all[n].birthDate = more[n][0], all[n].sex = more[n][1];
    all[n].accessionNumber = more[n][2], all[n].institution = more[n][3];
  }
  return all;
}

QStringList texts(std::initializer_list<const char*> utf8) {
  QStringList all;
  for (const char* text : utf8) all << QString::fromUtf8(text);
  return all;
}

QStringList idsOf(const StudyList& list) {
  QStringList ids;
  for (const ListedPatient& patient : list.patients)
    ids << QString::fromStdString(patient.studies[0].patientId);
  return ids;
}

}  // namespace

class TestStudyList : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void studiesStandBelowTheirPatient();
  void patientsAreSorted_data();
  void patientsAreSorted();
  void thoseOpenedLastStandFirst();
  void seriesAreSortedByNumber();
};

void TestStudyList::studiesStandBelowTheirPatient() {
  std::vector<IndexedStudy> studies = four();
  studies.push_back(study(5, "Doe^Jane", "10", "20250101", "CR", 1));  // another spelling is another patient
  const StudyList list = listedStudies(studies, {}, 5);
  QCOMPARE(list.patients.size(), std::size_t(4));
  const ListedPatient& doe = list.patients[1];
  QCOMPARE(doe.studies.size(), std::size_t(2));
  QCOMPARE(doe.studies[0].id, 3);  // latest first
  QCOMPARE(doe.images, 12);
  QCOMPARE(doe.modalities, std::string("CT, MR, PT"));
  QCOMPARE(doe.date, std::string("20240101"));
}

void TestStudyList::patientsAreSorted_data() {
  QTest::addColumn<int>("by");
  QTest::addColumn<bool>("ascending");
  QTest::addColumn<QStringList>("ids");
  QTest::newRow("name, without regard to case") << int(StudyColumn::name) << true << texts({"11", "10", "9"});
  QTest::newRow("date of the latest study") << int(StudyColumn::date) << false << texts({"10", "9", "11"});
  QTest::newRow("modality") << int(StudyColumn::modality) << true << texts({"10", "9", "11"});
  QTest::newRow("images, as numbers") << int(StudyColumn::images) << true << texts({"10", "11", "9"});
  QTest::newRow("birth date") << int(StudyColumn::birthDate) << true << texts({"9", "11", "10"});
  QTest::newRow("sex") << int(StudyColumn::sex) << true << texts({"10", "9", "11"});
  QTest::newRow("accession number") << int(StudyColumn::accession) << true << texts({"11", "10", "9"});
  QTest::newRow("institution") << int(StudyColumn::institution) << true << texts({"9", "10", "11"});
}

void TestStudyList::patientsAreSorted() {
  QFETCH(int, by);
  QFETCH(bool, ascending);
  QFETCH(QStringList, ids);
  QCOMPARE(idsOf(listedStudies(four(), {StudyColumn(by), ascending}, 0)), ids);
  std::ranges::reverse(ids);
  QCOMPARE(idsOf(listedStudies(four(), {StudyColumn(by), !ascending}, 0)), ids);
}

void TestStudyList::thoseOpenedLastStandFirst() {
  const StudyList list = listedStudies(four(), {}, 2);
  QCOMPARE(list.recent.size(), std::size_t(2));
  QCOMPARE(list.recent[0].id, 3);
  QCOMPARE(list.recent[1].id, 1);
}

void TestStudyList::seriesAreSortedByNumber() {
  std::vector<IndexedSeries> series(3);
  series[0].number = "10", series[1].number = "9", series[2].number = "";
  const auto sorted = sortedSeries(series, {StudyColumn::name, true});
  QCOMPARE(sorted[0].number, std::string());
  QCOMPARE(sorted[1].number, std::string("9"));
  QCOMPARE(sorted[2].number, std::string("10"));
  QCOMPARE(sortedSeries(series, {StudyColumn::id, true}), series);
}

VOLUMEN_TEST(TestStudyList);
#include "tst_study_list.moc"
