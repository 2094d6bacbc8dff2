// Guards ui/README.md: a kind of view is a row of one table, and sessions name it by its word.
#include <QSet>
#include <nlohmann/json.hpp>

#include "tests/unit/suite.h"
#include "ui/workspace/session_json.h"

using namespace volumen;
using Json = nlohmann::ordered_json;

namespace {

const std::string folder = "/data";

// Returns the session of a window whose first comparison view has this kind.
Json sessionWith(ViewKind kind) {
  Workspace w;
  w.editView(firstComparedId).kind = kind;
  return Json::parse(*sessionToJson(w, folder));
}

}  // namespace

class TestViewKinds : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void noTwoAreNamedAlike();
  void slicesAloneHaveAPlane();
  void sessionsNameThem_data();
  void sessionsNameThem();
  void otherWordsAreRefused();
};

void TestViewKinds::noTwoAreNamedAlike() {
  QSet<QString> words, texts, actions;
  for (const KindRow& row : viewKinds()) {
    QCOMPARE(&rowOf(row.kind), &row);
    words << QString::fromLatin1(row.word);
    texts << QString::fromLatin1(row.text);
    actions << QString::fromLatin1(row.action);
  }
  const auto count = qsizetype(viewKinds().size());
  QCOMPARE(words.size(), count);
  QCOMPARE(texts.size(), count);
  QCOMPARE(actions.size(), count);
}

void TestViewKinds::slicesAloneHaveAPlane() {
  for (const KindRow& row : viewKinds()) QCOMPARE(row.plane.has_value(), showsSlices(row.kind));
  const Crosshair crosshair;
  QVERIFY(crosshair.plane(ViewKind::axial) == crosshair.axial);
  QVERIFY(crosshair.plane(ViewKind::coronal) == crosshair.coronal);
  QVERIFY(crosshair.plane(ViewKind::sagittal) == crosshair.sagittal);
}

void TestViewKinds::sessionsNameThem_data() {
  QTest::addColumn<int>("kind");
  // Words must be those in older sessions.
  QTest::newRow("volume") << int(ViewKind::volume);
  QTest::newRow("axial") << int(ViewKind::axial);
  QTest::newRow("coronal") << int(ViewKind::coronal);
  QTest::newRow("sagittal") << int(ViewKind::sagittal);
  QTest::newRow("frames") << int(ViewKind::frames);
}

void TestViewKinds::sessionsNameThem() {
  QFETCH(int, kind);
  const Json session = sessionWith(ViewKind(kind));
  QCOMPARE(session["views"][firstComparedId]["kind"].get<std::string>(),
           std::string(QTest::currentDataTag()));
  const auto back = sessionFromJson(session.dump(), {});
  QVERIFY(back);
  QCOMPARE(int(back->workspace.view(firstComparedId).kind), kind);
}

void TestViewKinds::otherWordsAreRefused() {
  Json session = sessionWith(ViewKind::axial);
  session["views"][firstComparedId]["kind"] = "oblique";
  const auto back = sessionFromJson(session.dump(), {});
  QVERIFY(!back);
  const QString sentence = QString::fromStdString(back.message());
  const QString words = QStringLiteral(
      "views[4].kind must be \"volume\" or \"axial\" or \"coronal\" or \"sagittal\" or \"frames\"");
  QVERIFY2(sentence.contains(words), qPrintable(sentence));
}

VOLUMEN_TEST(TestViewKinds);
#include "tst_view_kinds.moc"
