// Guards that patients are not mixed silently: the patients in visible views, and the removal of all others
// from views.
#include <QTest>

#include "tests/unit/suite.h"
#include "ui/workspace/patients.h"

using namespace volumen;

namespace {

Series seriesOf(const char* name, const char* id, const char* format = "DICOM") {
  Series series;
  series.patientName = name;
  series.patientId = id;
  series.format = format;
  static int made = 0;
  series.path = "somewhere", series.id = std::to_string(++made);
  series.acquired.size = {16, 16, 16};
  return series;
}

QStringList texts(std::initializer_list<const char*> utf8) {
  QStringList all;
  for (const char* text : utf8) all << QString::fromUtf8(text);
  return all;
}

QStringList idsOnScreen(const Workspace& workspace) {
  QStringList ids;
  for (const Series* series : patientsOnScreen(workspace)) ids << QString::fromStdString(series->patientId);
  return ids;
}

const ViewId left = firstComparedId, right = firstComparedId + 1;

}  // namespace

class TestPatients : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void patientsOnScreenAreCounted_data();
  void patientsOnScreenAreCounted();
  void anOverlayCounts();
  void otherPatientsLeaveTheirViews();
};

void TestPatients::patientsOnScreenAreCounted_data() {
  QTest::addColumn<QStringList>("first");  // name, ID, format
  QTest::addColumn<QStringList>("second");
  QTest::addColumn<int>("patients");
  const QStringList doe = texts({"Doe^Jane", "1", "DICOM"});
  QTest::newRow("one patient twice") << doe << doe << 1;
  QTest::newRow("of another ID") << doe << texts({"Doe^Jane", "2", "DICOM"}) << 2;
  QTest::newRow("of another name") << doe << texts({"Doe^John", "1", "DICOM"}) << 2;
  QTest::newRow("DICOM without a name is somebody else") << doe << texts({"", "", "DICOM"}) << 2;
  QTest::newRow("a file that names nobody is nobody") << doe << texts({"", "", "NRRD"}) << 1;
  QTest::newRow("a file that names somebody") << doe << texts({"Roe", "", "NRRD"}) << 2;
}

void TestPatients::patientsOnScreenAreCounted() {
  QFETCH(QStringList, first);
  QFETCH(QStringList, second);
  QFETCH(int, patients);
  const auto made = [](const QStringList& s) {
    return seriesOf(qPrintable(s[0]), qPrintable(s[1]), qPrintable(s[2]));
  };
  Workspace workspace = withLayout(withSeries({}, left, made(first), {}), Layout::two);
  workspace = withSeries(workspace, right, made(second), {});
  QCOMPARE(int(patientsOnScreen(workspace).size()), patients);
  workspace.focus = left;
  QCOMPARE(patientsOnScreen(withLayout(workspace, Layout::one)).size(), std::size_t(1));
}

void TestPatients::anOverlayCounts() {
  Workspace workspace = withLayout(withSeries({}, left, seriesOf("Doe", "1"), {}), Layout::two);
  const Series over = seriesOf("Roe", "2");
  QCOMPARE(idsOnScreen(workspace), texts({"1"}));
  QCOMPARE(idsOnScreen(withOverlay(workspace, left, &over)), texts({"1", "2"}));
}

void TestPatients::otherPatientsLeaveTheirViews() {
  const Series doe = seriesOf("Doe", "1"), roe = seriesOf("Roe", "2"), again = seriesOf("Roe", "2");
  Workspace workspace = withSeries({}, sceneViewId, doe, {});
  workspace = withFrames(withSeries(workspace, left, doe, {}), left, doe);
  workspace = withSeries(workspace, right, roe, {});
  const Workspace left1 = withoutOtherPatients(workspace, again);
  for (ViewId id = 0; id < viewCount; ++id)
    QCOMPARE(seriesIn(left1, id) ? seriesIn(left1, id)->patientId : "", id == right ? "2" : "");
  QVERIFY(!showsFrames(left1, left));
  QCOMPARE(left1.series.size(), workspace.series.size());
  QCOMPARE(withoutOtherPatients(left1, again), left1);
}

VOLUMEN_TEST(TestPatients);
#include "tst_patients.moc"
