// Guards design.md 8: there is one list of open studies, shared by all that show it.
#include <QSignalSpy>

#include "tests/unit/suite.h"
#include "ui/document/open_studies.h"

using namespace volumen;

namespace {

Series series(const std::string& uid, const std::string& path) {
  Series made;
  made.format = "DICOM";
  made.path = path;
  made.id = made.seriesUid = made.studyUid = uid;
  return made;
}

std::shared_ptr<const Study> study(std::vector<Series> volumes, int objects = 0) {
  auto made = std::make_shared<Study>();
  made->volumes = std::move(volumes);
  for (int n = 0; n < objects; ++n) {
    DerivedObject& object = made->derived.emplace_back();
    object.path = "/object" + std::to_string(n);
    object.sopInstanceUid = std::to_string(n);
    made->other.push_back({object.path, "DICOM file without pixel data (SR)"});
  }
  return made;
}

const QString a = QStringLiteral("/a"), b = QStringLiteral("/b");

}  // namespace

class TestOpenStudies : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void theyStandInTheOrderInWhichTheyWereOpened();
  void aPathThatIsOpenedAgainIsListedOnce();
  void whatIsTakenOffComesBack();
  void whatHoldsNothingIsForgotten();
  void filesWithoutPixelsAreTheOthers();
};

void TestOpenStudies::theyStandInTheOrderInWhichTheyWereOpened() {
  OpenStudies studies;
  studies.add(b, study({series("2", "/b")}, 1));
  studies.add(a, study({series("1", "/a"), series("3", "/a")}));
  std::vector<std::string> uids;
  for (const Series* each : studies.volumes()) uids.push_back(each->seriesUid);
  QCOMPARE(uids, (std::vector<std::string>{"2", "1", "3"}));
  QCOMPARE(studies.derived().size(), std::size_t(1));
  QCOMPARE(studies.everything().series.size(), std::size_t(3));
  QCOMPARE(studies.everything().derived.size(), std::size_t(1));
}

void TestOpenStudies::aPathThatIsOpenedAgainIsListedOnce() {
  OpenStudies studies;
  QSignalSpy added(&studies, &OpenStudies::added), changed(&studies, &OpenStudies::changed);
  studies.add(a, study({series("1", "/a")}));
  const auto again = study({series("1", "/a"), series("2", "/a")});
  studies.add(a, again);
  QCOMPARE(added.count(), 2);
  QCOMPARE(changed.count(), 2);
  QCOMPARE(studies.all().size(), std::size_t(1));
  QCOMPARE(studies.studyOf(a), again);
  QVERIFY(!studies.find(b));
}

void TestOpenStudies::whatIsTakenOffComesBack() {
  OpenStudies studies;
  studies.add(a, study({series("1", "/a")}, 1));
  studies.add(b, study({series("2", "/b")}));
  QSignalSpy unlisted(&studies, &OpenStudies::unlistedChanged), changed(&studies, &OpenStudies::changed);
  Unlisted gone;
  gone.series = {keyOf(*studies.volumes()[1])};
  studies.setUnlisted(gone);
  QCOMPARE(studies.volumes().size(), std::size_t(1));
  QVERIFY(studies.studyOf(a) && !studies.studyOf(b));
  gone = studies.everything();
  studies.setUnlisted(gone);
  studies.setUnlisted(gone);  // a repeated call has no effect
  QVERIFY(studies.volumes().empty() && studies.derived().empty());
  QVERIFY(!studies.studyOf(a));
  gone.derived.clear();
  studies.setUnlisted(gone);
  QCOMPARE(studies.derived().size(), std::size_t(1));
  QVERIFY(studies.studyOf(a));
  QVariantList told;
  for (const QVariantList& each : unlisted) told << each[0];
  QCOMPARE(told, QVariantList({false, false, true}));
  QCOMPARE(changed.count(), 3);
}

void TestOpenStudies::whatHoldsNothingIsForgotten() {
  OpenStudies studies;
  studies.add(a, study({}));
  studies.add(b, study({}, 1));
  QVERIFY2(studies.studyOf(a), "there is nothing in it to be listed");
  studies.forgetEmpty();
  QVERIFY(!studies.find(a) && studies.find(b));
}

void TestOpenStudies::filesWithoutPixelsAreTheOthers() {
  auto some = std::make_shared<Study>(*study({}, 1));
  some->other.push_back({"/cr", "DICOM file without pixel data (CR)"});
  some->other.push_back({"/text", "text"});
  OpenStudies studies;
  studies.add(a, some);
  QCOMPARE(studies.filesWithoutPixels(),
           QStringList(QStringLiteral("/cr: DICOM file without pixel data (CR).")));
}

VOLUMEN_TEST(TestOpenStudies);
#include "tst_open_studies.moc"
