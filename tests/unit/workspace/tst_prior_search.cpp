// Guards ui/workspace/prior_search.h: what is shown, opened and told after each event, in all orders in which
// sources, files and the user's acts can come.
#include <functional>

#include "results/text/text.h"
#include "tests/unit/suite.h"
#include "tests/unit/workspace/hung_series.h"
#include "ui/workspace/prior_search.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

const char *const now = "20260102", *const of25 = "20250102", *const of24 = "20240102",
                  *const of23 = "20230102", *const of22 = "20220102", *const of21 = "20210102";

const QString asks = QStringLiteral("asks"), waits = QStringLiteral("waits"), ends = QStringLiteral("ends"),
              opens = QStringLiteral("Opening an earlier study of this patient from the list of studies."),
              away = QStringLiteral(
                  "The files of an earlier study of this patient are not there now: connect the disk or "
                  "network folder that holds them, or import the folder from where they are."),
              none = QStringLiteral(
                  "No earlier study of this patient with such a series is open or in the list of studies: "
                  "open one from its folder (Ctrl+O), or import it (Ctrl+I)."),
              unread = QStringLiteral(
                  "The list of studies could not be read: it may hold an earlier study of this patient. Open "
                  "one from its folder (Ctrl+O)."),
              unreadLater = QStringLiteral(
                  "The list of studies could not be read: it may hold a later prior of this patient."),
              later = QStringLiteral(
                  "The list of studies holds a later prior, of 2025-01-02: Alt+7 again opens it."),
              laterHoldsNone = QStringLiteral("The later study of this patient holds no such series."),
              passedOver = QStringLiteral(
                  "A later study of this patient was not looked into, as its description names something "
                  "else: it can be opened from the list of studies (Ctrl+B)."),
              threeHoldNone = QStringLiteral(
                  "The 3 earlier studies of this patient that were looked into hold no such series: open "
                  "another one from the list of studies (Ctrl+B)."),
              withoutId = QStringLiteral(
                  "No earlier study of this patient is open, and without a patient ID none is opened from "
                  "the list of studies: open one there (Ctrl+B), or from its folder (Ctrl+O).");

Series headOf(const char* day, const char* part = "HEAD") {
  return madeFor({"MR", "T2 head", part, "", "", day}, 1);
}

// Holds what the acts of a row change. At first the series of today is open and shown.
struct Desk {
  std::vector<Series> open{headOf(now)};
  Workspace workspace = withSeries(withLayout({}, Layout::two), firstComparedId, open[0], {});
  int sources = 1;
  PriorSearch search{};

  std::vector<const Series*> pictures() const { return pointersTo(open); }
  void show(const Series& series, int cell) {
    workspace = withSeries(workspace, firstComparedId + cell, series, {});
  }
};

// Changes the desk, or takes the search one step on.
using Act = std::function<PriorStep(Desk&)>;

Act desk(const std::function<void(Desk&)>& change) {
  return [change](Desk& d) {
    change(d);
    return PriorStep{d.search};
  };
}
Act sources(int count) {
  return desk([count](Desk& d) { d.sources = count; });
}
Act prior(const char* day) {
  return desk([day](Desk& d) { d.open.push_back(headOf(day)); });
}
Act priorOnScreen(const char* day) {
  return desk([day](Desk& d) {
    d.open.push_back(headOf(day));
    d.show(d.open.back(), 1);
  });
}
Act noId() {
  return desk([](Desk& d) {
    for (Series& series : d.open) series.patientId = "";
  });
}
Act another() {
  return desk([](Desk& d) { d.show(headOf("20260505"), 0); });
}
Act back() {
  return desk([](Desk& d) { d.show(d.open[0], 0); });
}
Act compare() {
  return [](Desk& d) { return begunSearch(d.workspace, {&d.open[0]}, d.pictures(), d.sources); };
}

struct Listed {
  const char* day;
  const char* description = "Head";
  bool offline = false;
};
Act lists(int source, const std::vector<Listed>& all, const char* patient = "7",
          const char* name = "Doe^Jane") {
  PriorAnswer answer{source, patient, name, std::vector<IndexedStudy>()};
  for (const Listed& each : all) {
    IndexedStudy study;
    study.patientId = patient, study.patientName = name, study.modalities = "MR";
    study.date = each.day, study.studyUid = std::string("1.2.") + each.day;
    study.description = each.description, study.offline = each.offline;
    answer.studies->push_back(study);
  }
  return [answer](Desk& d) { return withAnswer(d.search, d.workspace, d.pictures(), answer); };
}
Act unreadable(int source) {
  return [source](Desk& d) {
    return withAnswer(d.search, d.workspace, d.pictures(), {source, "7", "Doe^Jane", {}});
  };
}
Act found() {
  return [](Desk& d) { return PriorStep{withFilesFound(d.search, false)}; };
}
Act openedByUser() {
  return [](Desk& d) { return PriorStep{withFilesFound(d.search, true)}; };
}
Act missing() {
  return [](Desk& d) { return withoutFiles(d.search); };
}
Act idle() {
  return [](Desk& d) { return PriorStep{withReadingOver(d.search)}; };
}
Act read(const Series& series) {
  return [series](Desk& d) { return withStudyRead(d.search, d.workspace, {&series}); };
}
Act read(const char* day) { return read(headOf(day)); }
Act readKnee(const char* day) { return read(headOf(day, "KNEE")); }
Act readOfAnother(const char* day) {
  Series series = headOf(day);
  series.patientId = "8";
  return read(series);
}

// Returns what is to be done: days shown and opened with sentences, or how the search goes on.
QStringList doneIn(const PriorStep& step) {
  QStringList all;
  if (step.shown) all << QStringLiteral("shows ") + QString::fromStdString(step.shown.series->studyDate);
  for (const QString& sentence : {step.told, step.warned})
    if (!sentence.isEmpty()) all << sentence;
  const PriorCandidate& candidate = step.search.candidate;
  if (step.opensCandidate)
    all << QStringLiteral("%1 of %2").arg(QString::fromStdString(candidate.study.date)).arg(candidate.source);
  else if (!step.search.asked.empty())
    all << asks;
  else if (step.search.stage != PriorSearch::Stage::none)
    all << waits;
  return all.isEmpty() ? QStringList(ends) : all;
}
QStringList shows(const char* day, const QStringList& more = {}) {
  return QStringList(QStringLiteral("shows ") + QLatin1String(day)) + more;
}
QStringList opensOf(const char* day, int source = 0) {
  return {opens, QStringLiteral("%1 of %2").arg(QLatin1String(day)).arg(source)};
}

struct Turn {
  Act act;
  QStringList expected;  // empty: a change of the desk
};
using Turns = std::vector<Turn>;

void row(const char* name, const Turns& turns) { QTest::newRow(name) << turns; }

}  // namespace

class TestPriorSearch : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void oneSourceAnswers_data();
  void oneSourceAnswers() { play(); }
  void openPriorsComeFirst_data();
  void openPriorsComeFirst() { play(); }
  void candidatesFollowEachOther_data();
  void candidatesFollowEachOther() { play(); }
  void severalSourcesAnswer_data();
  void severalSourcesAnswer() { play(); }
  void theUserActsMeanwhile_data();
  void theUserActsMeanwhile() { play(); }
  void thePictureOfAStackIsKept();
  void hiddenNamesHideTheDay();

 private:
  static void play();
};

void TestPriorSearch::play() {
  QFETCH(Turns, turns);
  Desk d;
  for (std::size_t n = 0; n < turns.size(); ++n) {
    const PriorStep step = turns[n].act(d);
    d.search = step.search;
    if (turns[n].expected.isEmpty()) continue;
    const QStringList done = doneIn(step);
    QVERIFY2(done == turns[n].expected,
             qPrintable(QStringLiteral("turn %1: %2").arg(n).arg(done.join(QLatin1Char(' ')))));
  }
}

void TestPriorSearch::oneSourceAnswers_data() {
  QTest::addColumn<Turns>("turns");
  row("a listed study holds it", {{compare(), {asks}},
                                  {lists(0, {{of24}}), opensOf(of24)},
                                  {found(), {waits}},
                                  {read(of24), shows(of24)}});
  row("the latest of several", {{compare(), {asks}}, {lists(0, {{of22}, {of25}, {of24}}), opensOf(of25)}});
  row("none is listed", {{compare(), {asks}}, {lists(0, {}), {none}}});
  row("the list cannot be read", {{compare(), {asks}}, {unreadable(0), {unread}}});
  row("without a patient ID", {{noId(), {}}, {compare(), {withoutId}}, {lists(0, {{of24}}, ""), {ends}}});
  row("the answer to a question for another ID",
      {{compare(), {asks}}, {lists(0, {{of24}}, "8"), {asks}}, {lists(0, {}), {none}}});
  row("the answer to a question for another name",
      {{compare(), {asks}}, {lists(0, {{of24}}, "7", "Roe^Rick"), {asks}}, {lists(0, {}), {none}}});
  row("the answer comes twice",
      {{compare(), {asks}}, {lists(0, {{of24}}), opensOf(of24)}, {lists(0, {{of23}}), {waits}}});
  row("nothing was asked", {{lists(0, {{of24}}), {ends}},
                            {found(), {ends}},
                            {missing(), {ends}},
                            {read(of24), {ends}},
                            {idle(), {ends}}});
}

void TestPriorSearch::openPriorsComeFirst_data() {
  QTest::addColumn<Turns>("turns");
  row("no later one is listed",
      {{prior(of22), {}}, {compare(), shows(of22, {asks})}, {lists(0, {{of21}, {of22}}), {ends}}});
  row("a later one is told, not opened",
      {{prior(of22), {}}, {compare(), shows(of22, {asks})}, {lists(0, {{of24}, {of25}}), {later}}});
  row("a later one is opened if the open one is on screen", {{priorOnScreen(of22), {}},
                                                             {compare(), shows(of22, {asks})},
                                                             {lists(0, {{of25}}), opensOf(of25)},
                                                             {read(of25), shows(of25)}});
  row("files of a later one that hold an earlier day", {{priorOnScreen(of22), {}},
                                                        {compare(), shows(of22, {asks})},
                                                        {lists(0, {{of25}}), opensOf(of25)},
                                                        {read(of21), {away}}});
  row("the later one holds no such series", {{priorOnScreen(of22), {}},
                                             {compare(), shows(of22, {asks})},
                                             {lists(0, {{of25}}), opensOf(of25)},
                                             {readKnee(of25), {laterHoldsNone}}});
  row("on screen, none is listed",
      {{priorOnScreen(of22), {}}, {compare(), shows(of22, {asks})}, {lists(0, {}), {ends}}});
  row("the list cannot be read",
      {{prior(of22), {}}, {compare(), shows(of22, {asks})}, {unreadable(0), {unreadLater}}});
  row("on screen, the list cannot be read",
      {{priorOnScreen(of22), {}}, {compare(), shows(of22, {asks})}, {unreadable(0), {unreadLater}}});
  row("without a patient ID", {{prior(of22), {}}, {noId(), {}}, {compare(), shows(of22)}});
}

void TestPriorSearch::candidatesFollowEachOther_data() {
  QTest::addColumn<Turns>("turns");
  const Listed offline25{of25, "Head", true};
  row("the only one is offline", {{compare(), {asks}}, {lists(0, {offline25}), {away}}});
  row("the only one cannot be opened",
      {{compare(), {asks}}, {lists(0, {{of25}}), opensOf(of25)}, {missing(), {away}}});
  row("an older one instead of one offline", {{compare(), {asks}},
                                              {lists(0, {offline25, {of24}}), opensOf(of24)},
                                              {read(of24), shows(of24, {away})}});
  row("an older one instead of one that cannot be opened", {{compare(), {asks}},
                                                            {lists(0, {{of25}, {of24}}), opensOf(of25)},
                                                            {missing(), opensOf(of24)},
                                                            {found(), {waits}},
                                                            {read(of24), shows(of24, {away})}});
  row("files that went while they were read",
      {{compare(), {asks}}, {lists(0, {{of25}}), opensOf(of25)}, {found(), {waits}}, {missing(), {away}}});
  row("files of another patient",
      {{compare(), {asks}}, {lists(0, {{of25}}), opensOf(of25)}, {readOfAnother(of25), {away}}});
  row("files of another patient, then an older one", {{compare(), {asks}},
                                                      {lists(0, {{of25}, {of24}}), opensOf(of25)},
                                                      {readOfAnother(of25), opensOf(of24)},
                                                      {read(of24), shows(of24, {away})}});
  row("an older one, as the latest holds no such series", {{compare(), {asks}},
                                                           {lists(0, {{of25}, {of24}}), opensOf(of25)},
                                                           {readKnee(of25), opensOf(of24)},
                                                           {read(of24), shows(of24)}});
  const Turns threeKnees{{compare(), {asks}},
                         {lists(0, {{of25}, {of24}, {of23}}), opensOf(of25)},
                         {readKnee(of25), opensOf(of24)},
                         {readKnee(of24), opensOf(of23)},
                         {readKnee(of23), {none}}};
  row("all three hold no such series", threeKnees);
  Turns four = threeKnees;
  four[1].act = lists(0, {{of25}, {of24}, {of23}, {of22}});
  four[4].expected = {threeHoldNone};
  row("a fourth is not opened", four);
  four[1].act = lists(0, {{"20251231", "Head", true}, {of25}, {of24}, {of23}, {of22}});
  four[4].expected = {away};
  row("one offline does not count as opened", four);
  row("what sounds like it comes first, a later one is told",
      {{compare(), {asks}},
       {lists(0, {{of25, "Knee"}, {of24}}), opensOf(of24)},
       {read(of24), shows(of24, {passedOver})}});
  row("an earlier one that sounds otherwise is not told",
      {{compare(), {asks}}, {lists(0, {{of24, "Knee"}, {of25}}), opensOf(of25)}, {read(of25), shows(of25)}});
  row("what sounds otherwise is opened last", {{compare(), {asks}},
                                               {lists(0, {{of25, "Knee"}, {of24}}), opensOf(of24)},
                                               {readKnee(of24), opensOf(of25)},
                                               {read(of25), shows(of25)}});
}

void TestPriorSearch::severalSourcesAnswer_data() {
  QTest::addColumn<Turns>("turns");
  row("the later study is of the second", {{sources(2), {}},
                                           {compare(), {asks}},
                                           {lists(0, {{of24}}), {asks}},
                                           {lists(1, {{of25}}), opensOf(of25, 1)},
                                           {missing(), opensOf(of24, 0)}});
  row("the second answers first", {{sources(2), {}},
                                   {compare(), {asks}},
                                   {lists(1, {{of25}}), {asks}},
                                   {lists(0, {{of24}}), opensOf(of25, 1)},
                                   {missing(), opensOf(of24, 0)}});
  row("one cannot be read, the other has none",
      {{sources(2), {}}, {compare(), {asks}}, {unreadable(0), {asks}}, {lists(1, {}), {unread}}});
  row("one has none, the other cannot be read",
      {{sources(2), {}}, {compare(), {asks}}, {lists(0, {}), {asks}}, {unreadable(1), {unread}}});
  row("one cannot be read, the other has one", {{sources(2), {}},
                                                {compare(), {asks}},
                                                {unreadable(0), {asks}},
                                                {lists(1, {{of25}}), opensOf(of25, 1)},
                                                {read(of25), shows(of25)}});
  row("one cannot be read, the other's holds no such series", {{sources(2), {}},
                                                               {compare(), {asks}},
                                                               {unreadable(0), {asks}},
                                                               {lists(1, {{of25}}), opensOf(of25, 1)},
                                                               {readKnee(of25), {unread}}});
  row("one that cannot be read tells nothing beside a later one", {{sources(2), {}},
                                                                   {prior(of22), {}},
                                                                   {compare(), shows(of22, {asks})},
                                                                   {unreadable(0), {asks}},
                                                                   {lists(1, {{of25}}), {later}}});
  row("asked twice, the first answers twice before the second", {{sources(2), {}},
                                                                 {compare(), {asks}},
                                                                 {compare(), {asks}},
                                                                 {lists(0, {{of24}}), {asks}},
                                                                 {lists(0, {{of24}}), {asks}},
                                                                 {lists(1, {{of25}}), opensOf(of25, 1)},
                                                                 {lists(1, {{of25}}), {waits}},
                                                                 {readKnee(of25), opensOf(of24, 0)},
                                                                 {readKnee(of24), {none}}});
}

void TestPriorSearch::theUserActsMeanwhile_data() {
  QTest::addColumn<Turns>("turns");
  row("another series is shown before the answer", {{compare(), {asks}},
                                                    {another(), {}},
                                                    {lists(0, {{of24}}), {ends}},
                                                    {back(), {}},
                                                    {lists(0, {{of24}}), {ends}}});
  row("another series is shown while the study is read", {{compare(), {asks}},
                                                          {lists(0, {{of24}, {of23}}), opensOf(of24)},
                                                          {found(), {waits}},
                                                          {another(), {}},
                                                          {read(of24), {ends}}});
  row("the series went to another view", {{compare(), {asks}},
                                          {another(), {}},
                                          {desk([](Desk& d) { d.show(d.open[0], 1); }), {}},
                                          {lists(0, {{of24}}), opensOf(of24)},
                                          {read(of24), shows(of24)}});
  row("the listed study is opened before the answer",
      {{compare(), {asks}}, {prior(of24), {}}, {lists(0, {{of24}}), {none}}});
  row("the user opens the candidate", {{compare(), {asks}},
                                       {lists(0, {{of24}, {of23}}), opensOf(of24)},
                                       {openedByUser(), {ends}},
                                       {read(of24), {ends}}});
  row("the user opens the candidate while it is read", {{compare(), {asks}},
                                                        {lists(0, {{of24}, {of23}}), opensOf(of24)},
                                                        {found(), {waits}},
                                                        {openedByUser(), {ends}},
                                                        {missing(), {ends}}});
  row("the load is cancelled", {{compare(), {asks}},
                                {lists(0, {{of24}, {of23}}), opensOf(of24)},
                                {found(), {waits}},
                                {idle(), {ends}},
                                {missing(), {ends}},
                                {read(of24), {ends}}});
  row("other loads end before the files are found", {{compare(), {asks}},
                                                     {idle(), {asks}},
                                                     {lists(0, {{of24}}), opensOf(of24)},
                                                     {idle(), {waits}},
                                                     {found(), {waits}},
                                                     {read(of24), shows(of24)}});
  row("other loads end before the next candidate is found", {{compare(), {asks}},
                                                             {lists(0, {{of25}, {of24}}), opensOf(of25)},
                                                             {found(), {waits}},
                                                             {readKnee(of25), opensOf(of24)},
                                                             {idle(), {waits}},
                                                             {read(of24), shows(of24)}});
  row("asked again while a study is opened", {{compare(), {asks}},
                                              {lists(0, {{of24}}), opensOf(of24)},
                                              {compare(), {asks}},
                                              {read(of24), {asks}},
                                              {lists(0, {{of24}}), opensOf(of24)},
                                              {read(of24), shows(of24)}});
  row("asked again once the prior is shown", {{compare(), {asks}},
                                              {lists(0, {{of24}}), opensOf(of24)},
                                              {read(of24), shows(of24)},
                                              {priorOnScreen(of24), {}},
                                              {compare(), shows(of24, {asks})},
                                              {lists(0, {{of24}}), {ends}}});
}

void TestPriorSearch::thePictureOfAStackIsKept() {
  const OpenPictures stacks =
      OpenPictures::stacked({mammogramOf("R", "CC"), mammogramOf("L", "CC"), mammogramOf("L", "CC", of24),
                             mammogramOf("R", "CC", of24)});
  Desk d;
  d.show(stacks.series[0], 0);
  PriorSearch search = begunSearch(d.workspace, {&stacks.series[0], 1}, {&stacks.series[0]}, 1).search;
  search.stage = PriorSearch::Stage::reading;
  const PriorStep step = withStudyRead(search, d.workspace, {&stacks.series[1]});
  QCOMPARE(step.search.frame, 1);
  QCOMPARE(step.shown.frame, 0);
}

void TestPriorSearch::hiddenNamesHideTheDay() {
  const HidingNames hidden(true);
  Desk d;
  for (const Act& act : {prior(of22), compare(), lists(0, {{of25}})}) {
    const PriorStep step = act(d);
    d.search = step.search;
    if (!step.told.isEmpty())
      QCOMPARE(step.told, QStringLiteral("The list of studies holds a later prior: Alt+7 again opens it."));
  }
  QVERIFY(d.search.asked.empty());
}

VOLUMEN_TEST(TestPriorSearch);
#include "tst_prior_search.moc"
