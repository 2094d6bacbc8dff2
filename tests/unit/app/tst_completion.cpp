// Guards that bash completes every command, option and value of volumen (resources/completion/volumen).
#include <QDir>
#include <QProcess>
#include <QRegularExpression>
#include <QTemporaryDir>

#include "tests/fixtures/program.h"
#include "tests/unit/suite.h"

using namespace volumen::tests;

namespace {

/// Returns what bash offers for the last of the words behind "volumen"; a line of its own for what it says on
/// stderr.
QStringList completed(const QStringList& words) {
  QProcess bash;
  const QString script = QStringLiteral(
      "source '%1/resources/completion/volumen'; COMP_WORDS=(\"$@\"); COMP_CWORD=$(($# - 1)); _volumen 2>&1; "
      "for word in \"${COMPREPLY[@]}\"; do echo \"$word\"; done");
  bash.start(QStringLiteral("bash"), QStringList{QStringLiteral("--norc"), QStringLiteral("-c"),
                                                 script.arg(QStringLiteral(VOLUMEN_SOURCE_DIR)),
                                                 QStringLiteral("bash"), QStringLiteral(VOLUMEN_PROGRAM)} +
                                         words);
  if (!bash.waitForFinished(60000)) return {QStringLiteral("timeout")};
  return QString::fromUtf8(bash.readAllStandardOutput()).split(QLatin1Char('\n'), Qt::SkipEmptyParts);
}

QString helpText(const QStringList& command) {
  return QString::fromUtf8(runProgram(command + QStringList{QStringLiteral("--help")}).out);
}

/// Returns the commands of a help text.
QStringList commandsOf(const QString& help) {
  static const QRegularExpression command(QStringLiteral("^  ([a-z]+)  "),
                                          QRegularExpression::MultilineOption);
  const qsizetype from = help.indexOf(QLatin1String("\nCommands:\n"));
  QStringList names;
  if (from < 0) return names;
  for (auto found = command.globalMatch(help, from); found.hasNext();) names << found.next().captured(1);
  return names;
}

QStringList sorted(QStringList list) {
  list.sort();
  return list;
}

}  // namespace

class TestCompletion : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase();
  void everyCommandAndOptionIsCompleted_data();
  void everyCommandAndOptionIsCompleted();
  void wordsAreCompleted_data();
  void wordsAreCompleted();

 private:
  QTemporaryDir folder_;
};

// The name of a preset is a stranger's text, which bash could run.
void TestCompletion::initTestCase() {
  QVERIFY(QDir(folder_.path()).mkpath(QStringLiteral("volumen/presets")));
  QFile file(folder_.filePath(QStringLiteral("volumen/presets/mine.json")));
  QVERIFY(file.open(QIODevice::WriteOnly));
  file.write(R"json({"name": "Mine $(echo ran)", "modality": "CT", "scene": {"mode": "mip"}})json");
  file.close();
  qputenv("XDG_CONFIG_HOME", folder_.path().toUtf8());
}

void TestCompletion::everyCommandAndOptionIsCompleted_data() {
  QTest::addColumn<QStringList>("command");
  QTest::newRow("volumen") << QStringList();
  for (const QString& name : commandsOf(helpText({}))) {
    QTest::newRow(qPrintable(name)) << QStringList{name};
    for (const QString& below : commandsOf(helpText({name})))
      QTest::newRow(qPrintable(name + QLatin1Char(' ') + below)) << QStringList{name, below};
  }
}

// Of options that take one of several words, these are completed, too.
void TestCompletion::everyCommandAndOptionIsCompleted() {
  QFETCH(QStringList, command);
  const QString help = helpText(command);
  QCOMPARE(completed(command + QStringList{QString()}), commandsOf(help));
  static const QRegularExpression option(QStringLiteral("^  (-\\S+)(?: (\\S+))?"),
                                         QRegularExpression::MultilineOption);
  QStringList names;
  for (auto found = option.globalMatch(help); found.hasNext();) {
    const auto match = found.next();
    const QStringList here = match.captured(1).split(QLatin1Char(','));
    const QStringList values = match.captured(2).split(QLatin1Char('|'));
    names << here;
    if (values.size() < 2 || values[0].front().isUpper()) continue;
    QCOMPARE(completed(command + QStringList{here.back(), QString()}), values);
  }
  QVERIFY(names.contains(QLatin1String("--help")));
  QCOMPARE(sorted(completed(command + QStringList{QStringLiteral("-")})), sorted(names));
}

void TestCompletion::wordsAreCompleted_data() {
  QTest::addColumn<QString>("words");
  QTest::addColumn<QString>("offered");
  const auto row = [](const char* name, const char* words, const char* offered) {
    QTest::newRow(name) << QString::fromLatin1(words) << QString::fromLatin1(offered);
  };
  row("a command", "rend", "render");
  row("a command below another", "archive qu", "query");
  row("an option behind a path", "render scans/ --vi", "--view");
  row("a preset", "render --preset CT-Bo", "CT-Bone CT-Bones");
  row("a preset of one's own, never run", "render --preset Mi", "Mine\\ \\$\\(echo\\ ran\\)");
  row("a recipe", "segment --recipe lu", "lungs-and-airways");
  row("a file is left to bash", "render -o ''", "");
  row("a value only the user knows", "render --size ''", "");
  row("a path is no command", "scans/ rend", "");
  row("a path is no option's value", "render scans/ lu", "");
}

void TestCompletion::wordsAreCompleted() {
  QFETCH(QString, words);
  QFETCH(QString, offered);
  QStringList typed = words.split(QLatin1Char(' '));
  typed.replaceInStrings(QStringLiteral("''"), QString());
  QCOMPARE(completed(typed).join(QLatin1Char(' ')), offered);
}

VOLUMEN_TEST(TestCompletion);
#include "tst_completion.moc"
