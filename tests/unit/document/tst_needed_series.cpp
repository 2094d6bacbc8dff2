// Guards which series have to be read, and in which order: a workspace and requests in, keys out.
#include <QTest>

#include "tests/ui/test_series.h"
#include "tests/unit/suite.h"
#include "tests/unit/workspace/hung_series.h"
#include "ui/workspace/needed_series.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

// Four days of one CT, "1" to "4", and time points "a" to "d" of a series.
Series oneNamed(char name) {
  Series series = madeFor({"CT", "Head"}, name);
  series.path = "/data", series.id = name;
  series.studyUid = series.frameOfReferenceUid = "1.2";
  series.seriesUid = name >= 'a' ? "1.3" : std::string("1.4.") + name;
  if (name >= 'a') series.timePoint = std::string(1, char(name - 'a' + '1'));
  return series;
}

struct GivenScreen {
  Workspace workspace;
  Requests requests;
  SeriesPool inMemory{std::size_t(100) << 20};

  GivenScreen() { workspace.layout = Layout::two; }
  // Shows a series in a comparison view.
  void show(int cell, char name) {
    workspace = withSeries(std::move(workspace), firstComparedId + cell, oneNamed(name), {});
    workspace.editView(firstComparedId + cell).kind = ViewKind::axial;
  }
  void know(char name) {
    const Series series = oneNamed(name);
    workspace.series.editOrAdd(keyOf(series)).series = std::make_shared<const Series>(series);
  }
  void hold(char name) {
    auto series = std::make_shared<LoadedSeries>(*ballSeries(8, 2));
    series->series = oneNamed(name);
    inMemory.put({keyOf(series->series), {}}, series);
  }
  void request(char name) { requests.show = {std::make_shared<const Series>(oneNamed(name))}; }
  SeriesState& stateOf(char name) { return workspace.series.edit(keyOf(oneNamed(name))); }
};

using ScreenChange = std::function<void(GivenScreen&)>;

}  // namespace

class TestNeededSeries : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void whatIsNeeded_data();
  void whatIsNeeded();
};

void TestNeededSeries::whatIsNeeded_data() {
  QTest::addColumn<ScreenChange>("change");
  QTest::addColumn<QString>("needed");
  const auto row = [](const char* name, const ScreenChange& change, const char* needed) {
    QTest::newRow(name) << change << QString::fromLatin1(needed);
  };
  const auto both = [](GivenScreen& g) {
    g.workspace.focus = firstComparedId + 1;
    g.show(0, '1');
    g.show(1, '2');
  };
  const auto timePoints = [](GivenScreen& g) {
    g.workspace.focus = firstComparedId;
    g.show(0, 'b');
    for (const char name : {'a', 'c', 'd'}) g.know(name);
    g.hold('b');
    g.inMemory.setOnScreen({{keyOf(oneNamed('b')), {}}});
  };
  row(
      "an empty workspace", [](GivenScreen&) {}, "");
  row("the view in focus first", both, "2 screen, 1 screen");
  row(
      "nothing that is in memory", [=](GivenScreen& g) { both(g), g.hold('2'); }, "1 screen");
  row(
      "nothing that is not found", [=](GivenScreen& g) { both(g), g.stateOf('1').missing.emplace(); },
      "2 screen");
  row(
      "no volume of frames",
      [=](GivenScreen& g) { both(g), g.workspace.editView(firstComparedId).kind = ViewKind::frames; },
      "2 screen");
  row(
      "nothing of which the whole is in memory",
      [=](GivenScreen& g) { both(g), g.stateOf('2').mask.tableRemoved = true, g.hold('2'); }, "1 screen");
  row(
      "an overlay",
      [=](GivenScreen& g) {
        both(g);
        g.know('3');
        FlatLook& look = g.workspace.editView(firstComparedId).flats.editOrAdd(keyOf(oneNamed('1')));
        look.overlay = keyOf(oneNamed('3'));
      },
      "2 screen, 1 screen, 3 screen");
  row(
      "what is off screen is not",
      [=](GivenScreen& g) { both(g), g.workspace.layout = Layout::one, g.workspace.focus = sceneViewId; },
      "");
  row(
      "a request before all", [=](GivenScreen& g) { both(g), g.request('4'); },
      "4 request, 2 screen, 1 screen");
  row(
      "a request for what is on screen once", [=](GivenScreen& g) { both(g), g.request('1'); },
      "1 request, 2 screen");
  row(
      "a request for what is in memory is read anew",
      [=](GivenScreen& g) { both(g), g.hold('1'), g.request('1'); }, "1 request, 2 screen");
  row("the next time point, then the one before", timePoints, "c later, a later");
  row(
      "the first time point after the last",
      [=](GivenScreen& g) { timePoints(g), g.show(0, 'd'), g.hold('d'); }, "a later, c later");
  row(
      "no time point before its neighbour is there", [=](GivenScreen& g) { timePoints(g), g.show(0, 'd'); },
      "d screen");
  row(
      "no time points of a view that is not in focus",
      [=](GivenScreen& g) { timePoints(g), g.workspace.focus = firstComparedId + 1; }, "");
  row(
      "no time point without room", [=](GivenScreen& g) { timePoints(g), g.inMemory.setBudget(1); }, "");
}

void TestNeededSeries::whatIsNeeded() {
  QFETCH(ScreenChange, change);
  QFETCH(QString, needed);
  GivenScreen given;
  change(given);
  QStringList found;
  const char* reasons[] = {"request", "screen", "later"};
  for (const NeededSeries& n : neededSeries(given.workspace, given.requests, given.inMemory))
    found << QStringLiteral("%1 %2").arg(QString::fromStdString(n.series->id),
                                         QLatin1String(reasons[int(n.reason)]));
  QCOMPARE(found.join(QStringLiteral(", ")), needed);
}

VOLUMEN_TEST(TestNeededSeries);
#include "tst_needed_series.moc"
