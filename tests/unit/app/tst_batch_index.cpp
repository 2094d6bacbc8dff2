// Guards `volumen batch --from-index`: a list of work of the studies of the index.
#include <QRegularExpression>

#include "tests/unit/app/batch_case.h"
#include "tests/unit/suite.h"

using namespace volumen::tests;

class TestBatchIndex : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase();
  void listsAreMadeOfTheIndex();
  void wrongCommandsAreRefused_data();
  void wrongCommandsAreRefused();
  void wordsAreThoseOfAShell_data();
  void wordsAreThoseOfAShell();

 private:
  Outcome list(const QString& words, const QString& command) const;

  BatchFolder folder_;
};

void TestBatchIndex::initTestCase() {
  const QString index = folder_.at(QStringLiteral("index")), scans = folder_.at(QStringLiteral("scans/"));
  QCOMPARE(runProgram(QStringLiteral("convert %1 -o %2").arg(smallHead, scans)).status, 0);
  QCOMPARE(runProgram(QStringLiteral("import %1 --index %2").arg(scans, index)).status, 0);
}

Outcome TestBatchIndex::list(const QString& words, const QString& command) const {
  return runProgram({QStringLiteral("batch"), QStringLiteral("--from-index"), words, QStringLiteral("--do"),
                     command, QStringLiteral("--index"), folder_.at(QStringLiteral("index"))});
}

void TestBatchIndex::listsAreMadeOfTheIndex() {
  const Outcome a = list(QStringLiteral("ct"),
                         QStringLiteral("segment --recipe bone --csv \"{out}.csv\" -o {out}.stl --one-file"));
  QVERIFY2(a.status == 0, a.err);
  const QJsonObject one = QJsonDocument::fromJson(a.out).object();
  QVERIFY2(one[QStringLiteral("path")].toString().startsWith(QLatin1String("index:")), a.out);
  QCOMPARE(one[QStringLiteral("command")].toString(), QStringLiteral("segment"));
  QCOMPARE(one[QStringLiteral("one-file")].toBool(), true);
  QVERIFY(one[QStringLiteral("csv")].toString().size() > 20);
  QCOMPARE(one[QStringLiteral("output")].toString().chopped(4),
           one[QStringLiteral("csv")].toString().chopped(4));
  QVERIFY(list(QStringLiteral("nobody"), QStringLiteral("render -o {out}.png"))
              .err.contains("No study of the index"));
}

void TestBatchIndex::wrongCommandsAreRefused_data() {
  QTest::addColumn<QString>("command");
  for (const char* command : {"segment --colour 1", "paint", "segment --csv", "segment --csv a b",
                              "segment --csv 'a", "segment --csv \"a", "segment --csv a\\"})
    QTest::newRow(command) << QString::fromLatin1(command);
}

void TestBatchIndex::wrongCommandsAreRefused() {
  QFETCH(QString, command);
  const Outcome a = list(QStringLiteral("ct"), command);
  QVERIFY2(a.status == 2 && a.out.isEmpty() && a.err.contains("--do"), a.err);
}

void TestBatchIndex::wordsAreThoseOfAShell_data() {
  QTest::addColumn<QString>("typed");
  QTest::addColumn<QString>("table");
  const auto row = [](const char* name, const char* typed, const char* table) {
    QTest::newRow(name) << QString::fromLatin1(typed) << QString::fromLatin1(table);
  };
  row("single quotes", R"('a "\b" {out}.csv')", R"(a "\b" {out}.csv)");
  row("double quotes", R"("it's \"a\" \b {out}.csv")", R"(it's "a" \b {out}.csv)");
  row("backslashes", R"(a\ \'\\{out}.csv)", R"(a '\{out}.csv)");
  row("parts of a word", R"(a' b'" z"{out}.csv)", "a b z{out}.csv");
  row("a quoted value behind an option", R"(--csv='a {out}.csv')", "a {out}.csv");
  row("nothing is expanded", R"("$HOME"~*{out}`a`.csv)", "$HOME~*{out}`a`.csv");
  row("spaces around words", "  {out}.csv \t ", "{out}.csv");
}

void TestBatchIndex::wordsAreThoseOfAShell() {
  QFETCH(QString, typed);
  QFETCH(QString, table);
  if (!typed.startsWith(QLatin1String("--csv="))) typed.prepend(QLatin1String("--csv "));
  const Outcome a = list(QStringLiteral("ct"), QStringLiteral("segment --recipe bone ") + typed);
  QVERIFY2(a.status == 0, a.err);
  static const QRegularExpression nameOfStudy(QStringLiteral("[0-9a-f]{32}"));
  const QString csv = QJsonDocument::fromJson(a.out).object()[QStringLiteral("csv")].toString();
  QCOMPARE(QString(csv).replace(nameOfStudy, QStringLiteral("{out}")), table);
}

VOLUMEN_TEST(TestBatchIndex);
#include "tst_batch_index.moc"
