// Guards PS3.15 table E.1-1 as compiled in: the action for each attribute, with each option.
#include <QFile>

#include "io/deidentify/descriptor_words.h"
#include "io/deidentify/profile.h"
#include "io/deidentify/profile_tables.h"
#include "io/dicom/scan.h"
#include "tests/fixtures/fixtures.h"
#include "tests/unit/suite.h"

using namespace volumen;
using namespace volumen::tests;

using Action = ProfileAction;
Q_DECLARE_METATYPE(ProfileAction)
Q_DECLARE_METATYPE(Retained)

class TestConfidentialityProfile : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void theTableIsThatOfTheStandard();
  void everyRowCounts_data();
  void everyRowCounts();
  void optionsKeepWhatTheySay_data();
  void optionsKeepWhatTheySay();
  void unlistedTimesAndUidsAreTreatedAlike_data();
  void unlistedTimesAndUidsAreTreatedAlike();
  void onlyKnownWordsStay_data();
  void onlyKnownWordsStay();
};

namespace {

QList<QByteArrayList> cellsOf(const QByteArray& table) {
  QList<QByteArrayList> rows;
  for (const QByteArray& line : table.split('\n'))
    if (line.size() > 9 && !line.startsWith('#') && !line.startsWith("tag")) rows << line.split('\t');
  return rows;
}

QByteArray compiledTable() { return QByteArray::fromStdString(profileTables().front()); }

std::uint32_t tagOfRow(QByteArray text) {
  return text.replace(",", "").replace("x", "0").toUInt(nullptr, 16);
}

}  // namespace

// The table of the data has a column of names where the compiled one has VRs.
void TestConfidentialityProfile::theTableIsThatOfTheStandard() {
  const QList<QByteArrayList> ours = cellsOf(compiledTable());
  QCOMPARE(ours.size(), 656);
  const std::string path = dataPath("ps3.15-e.1-1-2026c.tsv");
  NEED_DATA(path);
  QFile file(QString::fromStdString(path));
  QVERIFY(file.open(QIODevice::ReadOnly));
  const QList<QByteArrayList> theirs = cellsOf(file.readAll());
  QCOMPARE(theirs.size(), ours.size());
  for (qsizetype n = 0; n < ours.size(); ++n) {
    QCOMPARE(ours[n][0], theirs[n][0]);
    QCOMPARE(ours[n][2], theirs[n][1]);
    for (qsizetype c = 3; c < std::max(ours[n].size(), theirs[n].size()); ++c)
      QCOMPARE(ours[n].value(c), theirs[n].value(c));
  }
}

void TestConfidentialityProfile::everyRowCounts_data() {
  QTest::addColumn<quint32>("tag");
  QTest::addColumn<QByteArray>("basic");
  for (const QByteArrayList& row : cellsOf(compiledTable()))
    if (row[0] != "private") QTest::newRow((row[0] + ' ' + row[2]).constData()) << tagOfRow(row[0]) << row[3];
}

// Where the standard leaves a choice, the profile takes one of the allowed actions.
void TestConfidentialityProfile::everyRowCounts() {
  QFETCH(quint32, tag);
  QFETCH(QByteArray, basic);
  const bool isNeeded = tag == 0x00700082 || tag == 0x00700083;
  const ConfidentialityProfile profile({});
  const std::map<Action, char> letters{
      {Action::remove, 'X'}, {Action::empty, 'Z'}, {Action::dummy, 'D'}, {Action::newUid, 'U'}};
  for (const bool isClassic : {false, true}) {
    const Action action = profile.actionOf(tag, isClassic);
    QVERIFY(letters.contains(action));
    if (isNeeded)
      QCOMPARE(action, Action::dummy);
    else
      QVERIFY2(basic.contains(letters.at(action)), basic.constData());
  }
}

void TestConfidentialityProfile::optionsKeepWhatTheySay_data() {
  QTest::addColumn<Retained>("retained");
  QTest::addColumn<quint32>("tag");
  QTest::addColumn<ProfileAction>("action");
  const auto row = [](const char* name, const Retained& retained, quint32 tag, Action action) {
    QTest::newRow(name) << retained << tag << action;
  };
  row("a name is kept by none", {true, true, true, true, true, true, true, 0}, 0x00100010, Action::empty);
  row("uids", {.uids = true}, 0x00080018, Action::keep);
  row("dates", {.dates = true}, 0x00080020, Action::keep);
  row("times", {.dates = true}, 0x00080030, Action::keep);
  row("shifted dates", {.shiftDays = 3}, 0x00080020, Action::shift);
  row("device", {.device = true}, 0x00181000, Action::keep);
  row("institution", {.institution = true}, 0x00080080, Action::keep);
  row("weight", {.patient = true}, 0x00101030, Action::keep);
  row("sex", {.patient = true}, 0x00100040, Action::keep);
  row("descriptions", {.descriptors = true}, 0x0008103e, Action::clean);
  row("birth by another calendar", {.dates = true}, 0x00100033, Action::remove);
  row("curves", {}, 0x50020010, Action::remove);
  row("pixels of any overlay", {}, 0x601e3000, Action::remove);
  row("what the table does not list", {}, 0x00280010, Action::keep);
}

void TestConfidentialityProfile::optionsKeepWhatTheySay() {
  QFETCH(Retained, retained);
  QFETCH(quint32, tag);
  QTEST(ConfidentialityProfile(retained).actionOf(tag, false), "action");
}

void TestConfidentialityProfile::unlistedTimesAndUidsAreTreatedAlike_data() {
  QTest::addColumn<Retained>("retained");
  QTest::addColumn<quint32>("tag");
  QTest::addColumn<QByteArray>("vr");
  QTest::addColumn<ProfileAction>("action");
  const auto row = [](const char* name, const Retained& retained, quint32 tag, const char* vr,
                      Action action) { QTest::newRow(name) << retained << tag << QByteArray(vr) << action; };
  row("a date", {}, 0x00143076, "DA", Action::empty);
  row("a time", {}, 0x00143077, "TM", Action::empty);
  row("date and time", {}, 0x40101025, "DT", Action::empty);
  row("a kept date", {.dates = true}, 0x00143076, "DA", Action::keep);
  row("a shifted date", {.shiftDays = 3}, 0x00143076, "DA", Action::shift);
  row("an instance", {}, 0x00081167, "UI", Action::newUid);
  row("the source of a concatenation", {}, 0x00200242, "UI", Action::newUid);
  row("a kept instance", {.uids = true}, 0x00200242, "UI", Action::keep);
  row("a class", {}, 0x00081150, "UI", Action::keep);
  row("a coding scheme", {}, 0x0008010c, "UI", Action::keep);
  row("a number", {}, 0x00280010, "US", Action::keep);
}

void TestConfidentialityProfile::unlistedTimesAndUidsAreTreatedAlike() {
  QFETCH(Retained, retained);
  QFETCH(quint32, tag);
  QFETCH(QByteArray, vr);
  QTEST(ConfidentialityProfile(retained).actionOf(tag, false, dicom::vrOf(vr[0], vr[1])), "action");
}

void TestConfidentialityProfile::onlyKnownWordsStay_data() {
  QTest::addColumn<QString>("description");
  QTest::addColumn<QString>("kept");
  QTest::newRow("all known") << "CT Chest with Contrast"
                             << "CT Chest with Contrast";
  QTest::newRow("a name among them") << "MR brain, Dr Schmidt"
                                     << "MR brain";
  QTest::newRow("dates and numbers") << "CT 20240102 abd 5mm 1.25 B30f"
                                     << "CT abd 1 25";
  QTest::newRow("other scripts") << QString::fromUtf8("胸部 CT Lunge \u0413\u0440") << "CT";
  QTest::newRow("nothing") << ""
                           << "";
}

void TestConfidentialityProfile::onlyKnownWordsStay() {
  QFETCH(QString, description);
  QTEST(QString::fromStdString(knownWordsOf(description.toStdString())), "kept");
}

VOLUMEN_TEST(TestConfidentialityProfile);
#include "tst_profile.moc"
