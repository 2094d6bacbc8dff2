// Guards ui/workspace/prior_search.h: what is shown, opened and told after sources answer. Rows cover every
// order of answers, and a prior that is or is not open.
#include "results/text/text.h"
#include "tests/unit/suite.h"
#include "tests/unit/workspace/prior_search_acts.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

const QString listUnread = QStringLiteral(
                  "A list of studies could not be read: it may hold an earlier study of this patient. Open "
                  "one from its folder (Ctrl+O)."),
              unreadLater = QStringLiteral(
                  "A list of studies could not be read: it may hold a later prior of this patient."),
              later = QStringLiteral(
                  "The list of studies holds a later prior, of 2025-01-02: Alt+7 again opens it."),
              laterHoldsNone = QStringLiteral("The later study of this patient holds no such series."),
              withoutId = QStringLiteral(
                  "No earlier study of this patient is open, and without a patient ID none is opened from "
                  "the list of studies: open one there (Ctrl+B), or from its folder (Ctrl+O).");

}  // namespace

class TestPriorAnswers : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void oneSourceAnswers_data();
  void oneSourceAnswers() { playTurns(); }
  void severalSourcesAnswer_data();
  void severalSourcesAnswer() { playTurns(); }
  void openPriorsComeFirst_data();
  void openPriorsComeFirst() { playTurns(); }
  void hiddenNamesHideTheDay();
};

void TestPriorAnswers::oneSourceAnswers_data() {
  QTest::addColumn<Turns>("turns");
  row("a listed study holds it", {{compare(), {asks}},
                                  {lists(0, {{of24}}), opensOf(of24)},
                                  {found(), {waits}},
                                  {read(of24), shows(of24)}});
  row("the latest of several", {{compare(), {asks}}, {lists(0, {{of22}, {of25}, {of24}}), opensOf(of25)}});
  row("none is listed", {{compare(), {asks}}, {lists(0, {}), {noneHeld}}});
  row("the list cannot be read", {{compare(), {asks}}, {unreadable(0), {listUnread}}});
  row("without a patient ID", {{noId(), {}}, {compare(), {withoutId}}, {lists(0, {{of24}}, ""), {stops}}});
  row("the answer to a question for another ID",
      {{compare(), {asks}}, {lists(0, {{of24}}, "8"), {asks}}, {lists(0, {}), {noneHeld}}});
  row("the answer to a question for another name",
      {{compare(), {asks}}, {lists(0, {{of24}}, "7", "Roe^Rick"), {asks}}, {lists(0, {}), {noneHeld}}});
  row("the answer comes twice",
      {{compare(), {asks}}, {lists(0, {{of24}}), opensOf(of24)}, {lists(0, {{of23}}), {waits}}});
  row("nothing was asked", {{lists(0, {{of24}}), {stops}},
                            {found(), {stops}},
                            {missing(), {stops}},
                            {read(of24), {stops}},
                            {idle(), {stops}}});
}

void TestPriorAnswers::severalSourcesAnswer_data() {
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
  row("a study of both is opened from the first", {{sources(2), {}},
                                                   {compare(), {asks}},
                                                   {lists(1, {{of25}, {of24}}), {asks}},
                                                   {lists(0, {{of25}}), opensOf(of25, 0)},
                                                   {missing(), opensOf(of24, 1)}});
  row("a copy stands for files that are offline", {{sources(2), {}},
                                                   {compare(), {asks}},
                                                   {lists(0, {{of25, "Head", true}}), {asks}},
                                                   {lists(1, {{of25}}), opensOf(of25, 1)},
                                                   {read(of25), shows(of25)}});
  row("one cannot be read, the other has none",
      {{sources(2), {}}, {compare(), {asks}}, {unreadable(0), {asks}}, {lists(1, {}), {listUnread}}});
  row("one has none, the other cannot be read",
      {{sources(2), {}}, {compare(), {asks}}, {lists(0, {}), {asks}}, {unreadable(1), {listUnread}}});
  row("one cannot be read, the other has one", {{sources(2), {}},
                                                {compare(), {asks}},
                                                {unreadable(0), {asks}},
                                                {lists(1, {{of25}}), opensOf(of25, 1)},
                                                {read(of25), shows(of25)}});
  row("one cannot be read, the other's holds no such series", {{sources(2), {}},
                                                               {compare(), {asks}},
                                                               {unreadable(0), {asks}},
                                                               {lists(1, {{of25}}), opensOf(of25, 1)},
                                                               {readKnee(of25), {listUnread}}});
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
                                                                 {readKnee(of24), {noneHeld}}});
}

void TestPriorAnswers::openPriorsComeFirst_data() {
  QTest::addColumn<Turns>("turns");
  row("no later one is listed",
      {{prior(of22), {}}, {compare(), shows(of22, {asks})}, {lists(0, {{of21}, {of22}}), {stops}}});
  row("a later one is told, not opened",
      {{prior(of22), {}}, {compare(), shows(of22, {asks})}, {lists(0, {{of24}, {of25}}), {later}}});
  row("a later one is opened if the open one is on screen", {{priorOnScreen(of22), {}},
                                                             {compare(), shows(of22, {asks})},
                                                             {lists(0, {{of25}}), opensOf(of25)},
                                                             {read(of25), shows(of25)}});
  row("files of a later one that hold an earlier day", {{priorOnScreen(of22), {}},
                                                        {compare(), shows(of22, {asks})},
                                                        {lists(0, {{of25}}), opensOf(of25)},
                                                        {read(of21), {filesAway}}});
  row("the later one holds no such series", {{priorOnScreen(of22), {}},
                                             {compare(), shows(of22, {asks})},
                                             {lists(0, {{of25}}), opensOf(of25)},
                                             {readKnee(of25), {laterHoldsNone}}});
  row("on screen, none is listed",
      {{priorOnScreen(of22), {}}, {compare(), shows(of22, {asks})}, {lists(0, {}), {stops}}});
  row("the list cannot be read",
      {{prior(of22), {}}, {compare(), shows(of22, {asks})}, {unreadable(0), {unreadLater}}});
  row("on screen, the list cannot be read",
      {{priorOnScreen(of22), {}}, {compare(), shows(of22, {asks})}, {unreadable(0), {unreadLater}}});
  row("without a patient ID", {{prior(of22), {}}, {noId(), {}}, {compare(), shows(of22)}});
}

void TestPriorAnswers::hiddenNamesHideTheDay() {
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

VOLUMEN_TEST(TestPriorAnswers);
#include "tst_prior_answers.moc"
