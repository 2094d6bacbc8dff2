// Guards ui.md: while names are hidden, no notice shows a path, as paths often contain names.
#include <QDir>
#include <QTemporaryDir>

#include "results/text/text.h"
#include "tests/unit/suite.h"
#include "ui/workspace/hidden_paths.h"

using namespace volumen;

class TestHiddenPaths : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void cleanup() { hideNames(false); }
  void pathsAreHidden_data();
  void pathsAreHidden();
};

// F is an existing folder with a folder "Doe Jane", which holds "a scan.dcm".
void TestHiddenPaths::pathsAreHidden_data() {
  QTest::addColumn<QString>("said");
  QTest::addColumn<QString>("shown");
  const auto row = [](const char* name, const char* said, const char* shown) {
    QTest::newRow(name) << QString::fromLatin1(said) << QString::fromLatin1(shown);
  };
  row("no path", "2 files could not be read and/or shown.", "2 files could not be read and/or shown.");
  row("a file", "F/Doe Jane/a scan.dcm: it is cut off.", "P: it is cut off.");
  row("at the end", "No images found in F/Doe Jane.", "No images found in P.");
  row("inside", "F/Doe Jane/a scan.dcm is a session, not a volume.", "P is a session, not a volume.");
  row("in brackets", "CT Head (F/Doe Jane) was not found.", "CT Head (P) was not found.");
  row("not there", "Cannot open /no/Doe Jane/x.dcm: no such file.", "Cannot open P: no such file.");
  row("not there, at the end", "Not found: /no/Doe Jane/x y.dcm", "Not found: P");
  row("not there, in a folder that is", "F/Doe Jane/b scan.dcm: not found.", "P: not found.");
  row("not there, named like a folder that is", "F/Doe Jane two/x.dcm: not found.", "P: not found.");
  row("in an archive", "F/Doe Jane/s.zip/CT 1/x: it is cut off.", "P: it is cut off.");
  row("two", "F/Doe Jane lies beside F/Doe Jane/a scan.dcm.", "P lies beside P.");
  row("two lines", "F/Doe Jane: a\n/no/Doe: b", "P: a\nP: b");
}

void TestHiddenPaths::pathsAreHidden() {
  QFETCH(QString, said);
  QFETCH(QString, shown);
  const QTemporaryDir folder;
  QVERIFY(QDir(folder.path()).mkpath(QStringLiteral("Doe Jane")));
  QFile file(folder.filePath(QStringLiteral("Doe Jane/a scan.dcm")));
  QVERIFY(file.open(QIODevice::WriteOnly));
  said.replace(QLatin1String("F/"), folder.path() + QLatin1Char('/'));
  QCOMPARE(withoutPaths(said), said);
  hideNames(true);
  QCOMPARE(withoutPaths(said), shown.replace(QLatin1Char('P'), QStringLiteral("(path hidden)")));
}

VOLUMEN_TEST(TestHiddenPaths);
#include "tst_hidden_paths.moc"
