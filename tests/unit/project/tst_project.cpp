// Guards design.md 1: rooms include only what the table allows. Also guards that the sections of
// resources/docs cited in comments exist. Texts from files must be shown only as plain text
// (ui/widgets/plain_text.h). Prints the longest files and functions for a reader to judge.
#include <QDirIterator>
#include <QFile>
#include <QRegularExpression>
#include <algorithm>

#include "tests/unit/suite.h"

namespace {

const QString root = QStringLiteral(VOLUMEN_SOURCE_DIR);

QStringList sources() {
  QStringList out;
  for (const char* top : {"app", "viewer", "io", "results", "ui", "tests"}) {
    QDirIterator files(root + QLatin1Char('/') + QLatin1String(top),
                       {QStringLiteral("*.h"), QStringLiteral("*.cpp")}, QDir::Files,
                       QDirIterator::Subdirectories);
    while (files.hasNext()) out << files.next().mid(root.size() + 1);
  }
  return out;
}

QString textOf(const QString& path) {
  QFile file(root + QLatin1Char('/') + path);
  return file.open(QIODevice::ReadOnly) ? QString::fromUtf8(file.readAll()) : QString();
}

struct Room {
  QString name;
  QStringList allowed;
};

QVector<Room> rooms() {
  QVector<Room> out;
  for (const QString& line : textOf(QStringLiteral("tests/rooms.txt")).split(QLatin1Char('\n'))) {
    if (line.isEmpty() || line.startsWith(QLatin1Char('#'))) continue;
    QStringList words = line.split(QLatin1Char(' '), Qt::SkipEmptyParts);
    const QString name = words.takeFirst();
    out.push_back({name, words});
  }
  return out;
}

bool inside(const QString& path, const QString& folder) { return path.startsWith(folder + QLatin1Char('/')); }

// Returns the room of a file: the room with the longest name that its path starts with.
Room roomOf(const QString& path) {
  Room best;
  for (const Room& r : rooms())
    if (inside(path, r.name) && r.name.size() > best.name.size()) best = r;
  return best;
}

// The rooms that each room includes, without itself.
using Includes = QMap<QString, QStringList>;

Includes includesOfRooms() {
  static const QRegularExpression include(QStringLiteral("^#include \"([^\"]+)\""),
                                          QRegularExpression::MultilineOption);
  Includes all;
  for (const QString& path : sources()) {
    const QString room = roomOf(path).name;
    for (auto found = include.globalMatch(textOf(path)); found.hasNext();) {
      const QString other = roomOf(found.next().captured(1)).name;
      if (!other.isEmpty() && other != room && !all[room].contains(other)) all[room] << other;
    }
  }
  return all;
}

// Returns the first cycle found, as "a -> b -> a"; empty if there is none. `way` holds the rooms on the
// current path, `clear` those from which no path leads into a cycle.
QString circleIn(const Includes& includes, const QStringList& way, QStringList& clear) {
  for (const QString& next : includes[way.back()]) {
    const qsizetype seen = way.indexOf(next);
    if (seen >= 0) return (way.mid(seen) << next).join(QStringLiteral(" -> "));
    if (clear.contains(next)) continue;
    if (const QString circle = circleIn(includes, QStringList(way) << next, clear); !circle.isEmpty())
      return circle;
  }
  clear << way.back();
  return {};
}

QString circleIn(const Includes& includes) {
  QStringList clear;
  for (const QString& room : includes.keys())
    if (const QString circle = circleIn(includes, {room}, clear); !circle.isEmpty()) return circle;
  return {};
}

bool mayInclude(const Room& room, const QString& included) {
  return inside(included, room.name) ||
         std::any_of(room.allowed.begin(), room.allowed.end(), [&](const QString& allowed) {
           return allowed == QLatin1String("*") || included == allowed || inside(included, allowed);
         });
}

// Returns the last argument of each call of a function, without the closing bracket.
QStringList lastArguments(const QString& text, const QString& function) {
  QStringList out;
  for (qsizetype at = text.indexOf(function + QLatin1Char('(')); at >= 0;
       at = text.indexOf(function + QLatin1Char('('), at + 1)) {
    qsizetype begin = at + function.size() + 1, n = begin;
    bool quoted = false;
    for (int depth = 1; depth > 0 && n < text.size(); ++n) {
      const QChar c = text[n];
      if (c == QLatin1Char('"') && text[n - 1] != QLatin1Char('\\')) quoted = !quoted;
      if (quoted) continue;
      depth += (c == QLatin1Char('(')) - (c == QLatin1Char(')'));
      if (depth == 1 && c == QLatin1Char(',')) begin = n + 1;
    }
    out << text.mid(begin, n - 1 - begin).simplified();
  }
  return out;
}

// Returns code of a source file that might let Qt show a text as rich text; empty if there is none.
QString richTextIn(const QString& text) {
  static const QRegularExpression safeTip(
      QStringLiteral("^(tr\\((\"[^\"]*\" ?)+\\)|toolTipOf\\(.*\\)|\\w+->toolTip\\(\\))$"));
  for (const char* setter : {"setToolTip", "QToolTip::showText", "setWhatsThis"})
    for (const QString& argument : lastArguments(text, QLatin1String(setter)))
      if (!safeTip.match(argument).hasMatch()) return QLatin1String(setter) + QStringLiteral(": ") + argument;
  static const QRegularExpression safeRole(
      QStringLiteral("toolTipOf\\(|tr\\(\"[^\"]*\"\\), Qt::ToolTipRole"));
  if (text.contains(QLatin1String("Qt::ToolTipRole")) && !text.contains(safeRole))
    return QStringLiteral("Qt::ToolTipRole");
  static const QRegularExpression shower(
      QStringLiteral("new QLabel\\b|: public QLabel\\b|\\bQLabel\\(parent\\)|new QMessageBox\\b|"
                     "QMessageBox::(warning|critical|question|information|about)\\("));
  const auto shown = shower.match(text);
  const bool isPlain = text.contains(QLatin1String("setTextFormat(Qt::PlainText)"));
  return shown.hasMatch() && !isPlain ? shown.captured() : QString();
}

struct Length {
  qsizetype lines;
  QString what;
};

void printLongest(const char* kind, QVector<Length> all) {
  std::sort(all.begin(), all.end(), [](const Length& a, const Length& b) { return a.lines > b.lines; });
  for (int n = 0; n < std::min<qsizetype>(10, all.size()); ++n)
    qInfo("longest %s: %4lld lines  %s", kind, static_cast<long long>(all[n].lines), qPrintable(all[n].what));
}

}  // namespace

class TestProject : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void theTableForbidsWhatItShould_data();
  void theTableForbidsWhatItShould();
  void roomsIncludeOnlyWhatTheTableAllows_data();
  void roomsIncludeOnlyWhatTheTableAllows();
  void circlesAreFound_data();
  void circlesAreFound();
  void citedSectionsExist_data();
  void citedSectionsExist();
  void textsOfStrangersAreNoRichText_data();
  void textsOfStrangersAreNoRichText();
  void theRulesOfTextsForbidWhatTheyShould_data();
  void theRulesOfTextsForbidWhatTheyShould();
  void longestFilesAndFunctions();
};

void TestProject::theTableForbidsWhatItShould_data() {
  QTest::addColumn<QString>("from");
  QTest::addColumn<QString>("to");
  QTest::addColumn<bool>("allowed");
  const auto row = [](const char* name, const char* from, const char* to, bool allowed) {
    QTest::newRow(name) << QString::fromLatin1(from) << QString::fromLatin1(to) << allowed;
  };
  row("volume knows no scene", "viewer/volume/volume.h", "viewer/scene/scene.h", false);
  row("a plan knows no pixels", "viewer/plan/plan.cpp", "viewer/render/render.h", false);
  row("io knows no rendering", "io/open.cpp", "viewer/render/render.h", false);
  row("what a study is knows no reader", "io/study/series.h", "io/dicom/header.h", false);
  row("nobody includes app", "ui/main_window.cpp", "app/command.h", false);
  row("app starts the window", "app/commands/open.cpp", "ui/main_window.h", true);
  row("app knows no panel", "app/commands/open.cpp", "ui/panels/clip_panel.h", false);
  row("results know no window", "results/text/text.cpp", "ui/workspace/session.h", false);
  row("widgets know no session", "ui/widgets/light_ball.cpp", "ui/workspace/session.h", false);
  row("the reference shares nothing with kernels", "viewer/reference/cell.cpp", "viewer/kernels/trace.h",
      false);
  row("render reads plans", "viewer/render/render.cpp", "viewer/plan/plan.h", true);
  row("a room includes itself", "io/dicom/scan.cpp", "io/study/study.h", true);
}

void TestProject::theTableForbidsWhatItShould() {
  QFETCH(QString, from);
  QFETCH(QString, to);
  QFETCH(bool, allowed);
  // A room inside a room (ui/widgets in ui) may include only what its own row of the table allows.
  QCOMPARE(mayInclude(roomOf(from), to), allowed);
}

void TestProject::roomsIncludeOnlyWhatTheTableAllows_data() {
  QTest::addColumn<QString>("path");
  for (const QString& path : sources()) QTest::newRow(qPrintable(path)) << path;
}

void TestProject::roomsIncludeOnlyWhatTheTableAllows() {
  QFETCH(QString, path);
  const Room room = roomOf(path);
  QVERIFY2(!room.name.isEmpty(), "the file lies in no room of tests/rooms.txt");
  static const QRegularExpression include(QStringLiteral("^#include \"([^\"]+)\""),
                                          QRegularExpression::MultilineOption);
  for (auto found = include.globalMatch(textOf(path)); found.hasNext();) {
    const QString included = found.next().captured(1);
    if (included.endsWith(QLatin1String(".moc"))) continue;
    QVERIFY2(included.contains(QLatin1Char('/')),
             qPrintable(included + QStringLiteral(": includes name their full path from the root")));
    QVERIFY2(mayInclude(room, included),
             qPrintable(room.name + QStringLiteral(" may not include ") + included));
  }
}

void TestProject::circlesAreFound_data() {
  QTest::addColumn<Includes>("includes");
  QTest::addColumn<QString>("circle");
  const QString a = QStringLiteral("a"), b = QStringLiteral("b"), c = QStringLiteral("c");
  QTest::newRow("two") << Includes{{a, {b}}, {b, {a}}} << QStringLiteral("a -> b -> a");
  QTest::newRow("three") << Includes{{a, {b, c}}, {b, {c}}, {c, {b}}} << QStringLiteral("b -> c -> b");
  QTest::newRow("none") << Includes{{a, {b, c}}, {b, {c}}, {c, {}}} << QString();
  QTest::newRow("this project") << includesOfRooms() << QString();
}

void TestProject::circlesAreFound() {
  QFETCH(Includes, includes);
  QFETCH(QString, circle);
  QCOMPARE(circleIn(includes), circle);
}

void TestProject::citedSectionsExist_data() {
  QTest::addColumn<QString>("document");
  for (const char* document : {"picture", "design", "slices"})
    QTest::newRow(document) << QString::fromLatin1(document) + QStringLiteral(".md");
}

void TestProject::citedSectionsExist() {
  QFETCH(QString, document);
  const QString text = textOf(QStringLiteral("resources/docs/") + document);
  const QRegularExpression cited(
      QStringLiteral("\\b%1(?:'s)? (\\d+)").arg(QRegularExpression::escape(document)));
  int citations = 0;
  for (const QString& path : sources())
    for (auto found = cited.globalMatch(textOf(path)); found.hasNext(); ++citations) {
      const QString section = found.next().captured(1);
      QVERIFY2(text.contains(QStringLiteral("\n## %1 ").arg(section)),
               qPrintable(path + QStringLiteral(" cites section ") + section));
    }
  QVERIFY2(citations > 0, "nobody cites it");
}

void TestProject::textsOfStrangersAreNoRichText_data() {
  QTest::addColumn<QString>("path");
  for (const QString& path : sources())
    if ((inside(path, QStringLiteral("ui")) || inside(path, QStringLiteral("app"))) &&
        path.endsWith(QLatin1String(".cpp")))
      QTest::newRow(qPrintable(path)) << path;
}

void TestProject::textsOfStrangersAreNoRichText() {
  QFETCH(QString, path);
  if (path == QLatin1String("ui/features/help.cpp")) return;  // shows rich text of the program's own words
  const QString found = richTextIn(textOf(path));
  QVERIFY2(found.isEmpty(), qPrintable(found + QStringLiteral(": see ui/widgets/plain_text.h")));
}

void TestProject::theRulesOfTextsForbidWhatTheyShould_data() {
  QTest::addColumn<QString>("text");
  QTest::addColumn<bool>("allowed");
  const auto row = [](const char* text, bool allowed) {
    QTest::newRow(text) << QString::fromLatin1(text) << allowed;
  };
  row("a->setToolTip(tr(\"Close\"));", true);
  row("a->setToolTip(0, toolTipOf(pathText(path)));", true);
  row("a->setToolTip(pathText(path));", false);
  row("a->setToolTip(0, tr(\"%1 goes\").arg(name));", false);
  row("a->setToolTip(tip);", false);
  row("auto* label = plainLabel(name);", true);
  row("auto* label = new QLabel(name);", false);
  row("class Badge : public QLabel {", false);
  row("new QMessageBox(QMessageBox::Question, name)", false);
  row("QMessageBox::warning(this, name)", false);
  row("QToolTip::showText(at, name);", false);
}

void TestProject::theRulesOfTextsForbidWhatTheyShould() {
  QFETCH(QString, text);
  QFETCH(bool, allowed);
  QCOMPARE(richTextIn(text).isEmpty(), allowed);
}

void TestProject::longestFilesAndFunctions() {
  QVector<Length> files, functions;
  // In our layout the line before a function's body is at the margin (or inside a class) and ends in "{". The
  // body ends with "}" there.
  static const QRegularExpression head(QStringLiteral(
      "^( *)(?!namespace|class|struct|enum|if|for|while|switch|else|case|using|//)\\S.*\\).*\\{$"));
  for (const QString& path : sources()) {
    const QStringList lines = textOf(path).split(QLatin1Char('\n'));
    files.push_back({lines.size(), path});
    for (int n = 0; n < lines.size(); ++n) {
      const auto match = head.match(lines[n]);
      // A lambda's head looks like a function's, but its body ends otherwise.
      if (!match.hasMatch() || match.captured(1).size() > 2 || lines[n].contains(QLatin1String("](")) ||
          lines[n].contains(QLatin1String("[&]")))
        continue;
      const QString end = match.captured(1) + QLatin1Char('}');
      int last = n + 1;
      while (last < lines.size() && lines[last] != end) ++last;
      functions.push_back({last - n + 1, path + QLatin1Char(':') + QString::number(n + 1)});
      n = last;
    }
  }
  QVERIFY(!files.isEmpty() && !functions.isEmpty());
  printLongest("file", files);
  printLongest("function", functions);
}

VOLUMEN_TEST(TestProject);
#include "tst_project.moc"
