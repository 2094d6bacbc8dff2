// Guards "did you mean": the probable name for a mistyped word, and none for a different word.
#include <QTest>

#include "tests/unit/suite.h"
#include "viewer/scene/similar_name.h"

using namespace volumen;

class TestSimilarName : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void nameThatWasMeant_data();
  void nameThatWasMeant();
};

void TestSimilarName::nameThatWasMeant_data() {
  QTest::addColumn<QString>("word");
  QTest::addColumn<QString>("name");  // empty if none is similar
  const auto row = [](const char* what, const char* word, const char* name) {
    QTest::newRow(what) << QString::fromLatin1(word) << QString::fromLatin1(name);
  };
  row("capitals do not count", "ct-bone", "CT-Bone");
  row("a letter left out", "CT-Boe", "CT-Bone");
  row("a letter too many", "CT-Boone", "CT-Bone");
  row("another letter", "CT-Bonk", "CT-Bone");
  row("the nearest of several", "CT-Bones", "CT-Bones");
  row("another word", "cardiology", "");
  row("one letter", "x", "");
  row("nothing", "", "");
}

void TestSimilarName::nameThatWasMeant() {
  QFETCH(QString, word);
  QFETCH(QString, name);
  const auto similar = similarName(word.toStdString(), {"CT-AAA", "CT-Bone", "CT-Bones", "MR-MIP"});
  QCOMPARE(QString::fromStdString(similar.value_or("")), name);
}

VOLUMEN_TEST(TestSimilarName);
#include "tst_similar_name.moc"
