// Guards ui/workspace/hanging_queue.h: which study is hung by itself, when and by which protocol, in all
// orders in which studies are opened, shown and closed, and which protocol is next.
#include <functional>

#include "tests/unit/suite.h"
#include "tests/unit/workspace/hung_series.h"
#include "ui/workspace/hanging_queue.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

// Returns a protocol that shows two series of a modality in a row.
HangingProtocol pairOf(const char* name, const char* modality, bool automatic) {
  HangingProtocol protocol;
  protocol.name = name, protocol.when.rule.modality = modality, protocol.automatic = automatic;
  protocol.series.resize(1), protocol.cells.resize(2);
  protocol.series[0].name = "any";
  for (ProtocolCell& cell : protocol.cells) cell.series = "any";
  return protocol;
}

const std::vector<HangingProtocol> threeProtocols{pairOf("MR by hand", "MR", false), pairOf("MR", "MR", true),
                                                  pairOf("CT by hand", "CT", false)};

// Returns study `number`, with the ID of its patient.
Series seriesOf(int number, const char* modality = "MR", const char* patient = "7") {
  Series series = madeFor({modality, "T1", "", "", "", "20260301"}, number);
  series.studyUid = "1.2." + std::to_string(number);
  series.patientId = patient;
  return series;
}

// Holds what the events of a row change: the views on screen, the open series and the queue.
struct Hanging {
  Workspace workspace{};
  std::vector<Series> open{};
  HangingQueue queue{};

  std::vector<const Series*> pictures() const { return pointersTo(open); }
};

// Something that happens. Returns the name of the protocol that is hung, if one is asked for.
using Event = std::function<std::string(Hanging&)>;

Event opened(const Series& series, const std::shared_ptr<bool>& isAnyShown = {}) {
  return [=](Hanging& h) {
    h.open.push_back(series);
    const auto study = std::make_shared<Study>();
    study->volumes.push_back(series);
    h.queue = withOpened(h.queue, study, isAnyShown);
    return std::string();
  };
}
// Opens pictures that are no volume.
Event openedPictures(const Series& series) {
  return [=](Hanging& h) {
    h.open.push_back(series);
    const auto study = std::make_shared<Study>();
    study->images.emplace_back().studyUid = series.studyUid;
    h.queue = withOpened(h.queue, study, {});
    return std::string();
  };
}
// Opens one series, not the study as a whole.
Event openedAlone(const Series& series) {
  return [=](Hanging& h) {
    h.open.push_back(series);
    return std::string();
  };
}
Event shown(const Series& series) {
  return [=](Hanging& h) {
    h.workspace = withSeries(h.workspace, h.workspace.focus, series, {});
    return std::string();
  };
}
Event shownInSecond(const Series& series) {
  return [=](Hanging& h) {
    h.workspace.second.shown = true, h.workspace.focus = firstSecondId;
    h.workspace = withSeries(h.workspace, firstSecondId, series, {});
    return std::string();
  };
}
Event closed(const Series& series) {
  return [=](Hanging& h) {
    std::erase_if(h.open, [&](const Series& s) { return keyOf(s) == keyOf(series); });
    h.queue = withoutClosed(h.queue, h.pictures());
    return std::string();
  };
}
Event notLoaded(const Series& series) {
  return [=](Hanging& h) {
    h.queue = withoutSeries(h.queue, keyOf(series));
    return std::string();
  };
}
Event grid(Layout layout) {
  return [=](Hanging& h) {
    h.workspace = withLayout(h.workspace, layout);
    return std::string();
  };
}
Event hungByHand(const HangingProtocol& protocol) {
  return [=](Hanging& h) {
    h.workspace.layout = protocol.layout;
    h.queue = withHung(h.queue, protocol, "", false);
    return std::string();
  };
}
Event next() {
  return [](Hanging& h) {
    const NextHanging next = nextHanging(h.queue, h.workspace, h.pictures(), threeProtocols);
    h.queue = next.queue;
    if (!next.protocol) return std::string("none");
    h.workspace.layout = next.protocol->layout;
    h.queue = withHung(h.queue, *next.protocol, seriesIn(h.workspace, h.workspace.focus)->studyUid, true);
    return next.protocol->name;
  };
}

}  // namespace

class TestHangingQueue : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void studiesAreHung_data();
  void studiesAreHung();
  void theNextProtocolIsFound_data();
  void theNextProtocolIsFound();
  void theLastProtocolIsOfOneStudy();
};

void TestHangingQueue::studiesAreHung_data() {
  QTest::addColumn<std::vector<Event>>("events");
  QTest::addColumn<QStringList>("hung");  // the answers of next()
  const auto row = [](const char* name, const QStringList& hung, const std::vector<Event>& events) {
    QTest::newRow(name) << events << hung;
  };
  const QString none = QStringLiteral("none"), mr = QStringLiteral("MR");
  const Series a = seriesOf(1), b = seriesOf(2), ofAnother = seriesOf(3, "MR", "8");
  const auto group = [](bool isAnyShown) { return std::make_shared<bool>(isAnyShown); };
  row("once it is shown", {none, mr}, {opened(a), next(), shown(a), next()});
  row("pictures that are no volume", {mr}, {openedPictures(a), shown(a), next()});
  row("shown but not opened as a whole", {none}, {openedAlone(a), shown(a), next()});
  row("only once", {mr, none}, {opened(a), shown(a), next(), next()});
  row("not again if it is opened again", {mr, none},
      {opened(a), shown(a), next(), opened(a), shown(a), next()});
  row("again once it was closed", {mr, mr}, {opened(a), shown(a), next(), closed(a), opened(a), next()});
  row("another one was closed", {mr, none},
      {opened(b), opened(a), shown(a), next(), closed(b), opened(a), next()});
  row("closed while it waited", {none}, {opened(a), closed(a), openedAlone(a), shown(a), next()});
  row("another one is closed while it waits", {mr}, {opened(a), opened(b), closed(b), shown(a), next()});
  row("pictures wait while others are closed", {mr},
      {openedPictures(a), opened(b), closed(b), shown(a), next()});
  row("not loaded", {none}, {opened(a), notLoaded(a), shown(a), next()});
  row("another one is not loaded", {mr}, {opened(a), notLoaded(b), shown(a), next()});
  row("another one is shown first", {none, mr}, {opened(a), shown(b), next(), shown(a), next()});
  row("two that were opened one by one", {mr, mr},
      {opened(a), opened(b), shown(b), next(), shown(a), next()});
  const auto one = group(true), two = group(true);
  row("of two opened together only the first", {mr, none},
      {opened(a, one), opened(b, one), shown(a), next(), shown(b), next()});
  row("one each of two groups", {mr, mr},
      {opened(a, one), opened(b, two), shown(a), next(), shown(b), next()});
  row("none of a group before any is shown", {none}, {opened(a, group(false)), shown(a), next()});
  row("over a chosen grid of the patient", {none},
      {shown(b), grid(Layout::four), opened(a), shown(a), next()});
  row("over a chosen grid of empty views", {none}, {grid(Layout::two), opened(a), shown(a), next()});
  row("over a chosen grid of another patient", {mr},
      {shown(ofAnother), grid(Layout::two), shown(ofAnother),
       [](Hanging& h) { return h.workspace.focus = firstComparedId + 1, std::string(); }, opened(a), shown(a),
       next()});
  row("over the grid that was hung by itself", {mr, mr},
      {opened(b), shown(b), next(), opened(a), shown(a), next()});
  row("over another grid chosen since", {mr, none},
      {opened(b), shown(b), next(), grid(Layout::four), opened(a), shown(a), next()});
  row("over a grid hung by hand", {mr, none},
      {opened(b), shown(b), next(), hungByHand(threeProtocols[1]), opened(a), shown(a), next()});
  row("not in the second window", {none}, {opened(a), shownInSecond(a), next()});
  const Series ct = seriesOf(4, "CT");
  row("no automatic protocol fits", {none, none}, {opened(ct), shown(ct), next(), next()});
  Series nameless = a;
  nameless.studyUid = "";
  row("a study without UID", {none}, {opened(nameless), shown(nameless), next()});
}

void TestHangingQueue::studiesAreHung() {
  QFETCH(std::vector<Event>, events);
  QFETCH(QStringList, hung);
  Hanging hanging;
  QStringList found;
  for (const Event& event : events)
    if (const std::string name = event(hanging); !name.empty()) found << QString::fromStdString(name);
  QCOMPARE(found, hung);
}

void TestHangingQueue::theNextProtocolIsFound_data() {
  QTest::addColumn<QByteArray>("last");
  QTest::addColumn<int>("by");
  QTest::addColumn<int>("index");
  const auto row = [](const char* name, const char* last, int by, int index) {
    QTest::newRow(name) << QByteArray(last) << by << index;
  };
  row("the first at the beginning", "", 1, 0);
  row("the last one backwards", "", -1, 2);
  row("the next", "MR by hand", 1, 1);
  row("the one before", "MR", -1, 0);
  row("the first after the last", "CT by hand", 1, 0);
  row("the last before the first", "MR by hand", -1, 2);
  row("the first if the last one does not fit any more", "Mammograms", 1, 0);
}

void TestHangingQueue::theNextProtocolIsFound() {
  QFETCH(QByteArray, last);
  QFETCH(int, by);
  std::vector<const HangingProtocol*> all;
  for (const HangingProtocol& protocol : threeProtocols) all.push_back(&protocol);
  QTEST(int(indexFrom(all, last.toStdString(), by)), "index");
}

void TestHangingQueue::theLastProtocolIsOfOneStudy() {
  const HangingQueue queue = withHung({}, threeProtocols[1], "1.2.1", true);
  QCOMPARE(lastNameFor(queue.last, "1.2.1"), std::string("MR"));
  QCOMPARE(lastNameFor(queue.last, "1.2.2"), std::string());
  QCOMPARE(lastNameFor(queue.last, ""), std::string());
}

VOLUMEN_TEST(TestHangingQueue);
#include "tst_hanging_queue.moc"
