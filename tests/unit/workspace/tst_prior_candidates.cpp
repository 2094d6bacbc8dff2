// Guards ui/workspace/prior_search.h: which listed studies are opened one after another, and what becomes of
// them as files are read or missing and the user acts meanwhile.
#include "tests/unit/suite.h"
#include "tests/unit/workspace/prior_search_acts.h"

using namespace volumen;
using namespace volumen::tests;

namespace {

const QString passedOver = QStringLiteral(
                  "A later study of this patient was not looked into, as its description names something "
                  "else: it can be opened from the list of studies (Ctrl+B)."),
              threeHoldNone = QStringLiteral(
                  "The 3 earlier studies of this patient that were looked into hold no such series: open "
                  "another one from the list of studies (Ctrl+B).");

}  // namespace

class TestPriorCandidates : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void candidatesFollowEachOther_data();
  void candidatesFollowEachOther() { playTurns(); }
  void theUserActsMeanwhile_data();
  void theUserActsMeanwhile() { playTurns(); }
  void thePictureOfAStackIsKept();
};

void TestPriorCandidates::candidatesFollowEachOther_data() {
  QTest::addColumn<Turns>("turns");
  const Listed offline25{of25, "Head", true};
  row("the only one is offline", {{compare(), {asks}}, {lists(0, {offline25}), {filesAway}}});
  row("the only one cannot be opened",
      {{compare(), {asks}}, {lists(0, {{of25}}), opensOf(of25)}, {missing(), {filesAway}}});
  row("an older one instead of one offline", {{compare(), {asks}},
                                              {lists(0, {offline25, {of24}}), opensOf(of24)},
                                              {read(of24), shows(of24, {filesAway})}});
  row("an older one instead of one that cannot be opened", {{compare(), {asks}},
                                                            {lists(0, {{of25}, {of24}}), opensOf(of25)},
                                                            {missing(), opensOf(of24)},
                                                            {found(), {waits}},
                                                            {read(of24), shows(of24, {filesAway})}});
  row("files that went while they were read", {{compare(), {asks}},
                                               {lists(0, {{of25}}), opensOf(of25)},
                                               {found(), {waits}},
                                               {missing(), {filesAway}}});
  row("files of another patient",
      {{compare(), {asks}}, {lists(0, {{of25}}), opensOf(of25)}, {readOfAnother(of25), {filesAway}}});
  row("files of another patient, then an older one", {{compare(), {asks}},
                                                      {lists(0, {{of25}, {of24}}), opensOf(of25)},
                                                      {readOfAnother(of25), opensOf(of24)},
                                                      {read(of24), shows(of24, {filesAway})}});
  row("an older one, as the latest holds no such series", {{compare(), {asks}},
                                                           {lists(0, {{of25}, {of24}}), opensOf(of25)},
                                                           {readKnee(of25), opensOf(of24)},
                                                           {read(of24), shows(of24)}});
  const Turns threeKnees{{compare(), {asks}},
                         {lists(0, {{of25}, {of24}, {of23}}), opensOf(of25)},
                         {readKnee(of25), opensOf(of24)},
                         {readKnee(of24), opensOf(of23)},
                         {readKnee(of23), {noneHeld}}};
  row("all three hold no such series", threeKnees);
  Turns four = threeKnees;
  four[1].act = lists(0, {{of25}, {of24}, {of23}, {of22}});
  four[4].expected = {threeHoldNone};
  row("a fourth is not opened", four);
  four[1].act = lists(0, {{"20251231", "Head", true}, {of25}, {of24}, {of23}, {of22}});
  four[4].expected = {filesAway};
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

void TestPriorCandidates::theUserActsMeanwhile_data() {
  QTest::addColumn<Turns>("turns");
  row("another series is shown before the answer", {{compare(), {asks}},
                                                    {another(), {}},
                                                    {lists(0, {{of24}}), {stops}},
                                                    {back(), {}},
                                                    {lists(0, {{of24}}), {stops}}});
  row("another series is shown while the study is read", {{compare(), {asks}},
                                                          {lists(0, {{of24}, {of23}}), opensOf(of24)},
                                                          {found(), {waits}},
                                                          {another(), {}},
                                                          {read(of24), {stops}}});
  row("the series went to another view", {{compare(), {asks}},
                                          {another(), {}},
                                          {desk([](Desk& d) { d.show(d.open[0], 1); }), {}},
                                          {lists(0, {{of24}}), opensOf(of24)},
                                          {read(of24), shows(of24)}});
  row("the listed study is opened before the answer",
      {{compare(), {asks}}, {prior(of24), {}}, {lists(0, {{of24}}), {noneHeld}}});
  row("the user opens the candidate", {{compare(), {asks}},
                                       {lists(0, {{of24}, {of23}}), opensOf(of24)},
                                       {openedByUser(), {stops}},
                                       {read(of24), {stops}}});
  row("the user opens the candidate while it is read", {{compare(), {asks}},
                                                        {lists(0, {{of24}, {of23}}), opensOf(of24)},
                                                        {found(), {waits}},
                                                        {openedByUser(), {stops}},
                                                        {missing(), {stops}}});
  row("the load is cancelled", {{compare(), {asks}},
                                {lists(0, {{of24}, {of23}}), opensOf(of24)},
                                {found(), {waits}},
                                {idle(), {stops}},
                                {missing(), {stops}},
                                {read(of24), {stops}}});
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
                                              {lists(0, {{of24}}), {stops}}});
}

void TestPriorCandidates::thePictureOfAStackIsKept() {
  const OpenPictures stacks =
      OpenPictures::stacked({mammogramOf("R", "CC"), mammogramOf("L", "CC"), mammogramOf("L", "CC", of24),
                             mammogramOf("R", "CC", of24)});
  Desk d;
  d.show(stacks.series[0], 0);
  PriorSearch search = begunSearch(d.workspace, {&stacks.series[0], 1}, {&stacks.series[0]}, {0}).search;
  search.stage = PriorSearch::Stage::reading;
  const PriorStep step = withStudyRead(search, d.workspace, {&stacks.series[1]});
  QCOMPARE(step.search.frame, 1);
  QCOMPARE(step.shown.frame, 0);
}

VOLUMEN_TEST(TestPriorCandidates);
#include "tst_prior_candidates.moc"
