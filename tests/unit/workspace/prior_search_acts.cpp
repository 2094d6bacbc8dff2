#include "tests/unit/workspace/prior_search_acts.h"

#include "tests/unit/suite.h"

namespace volumen::tests {

namespace {

const QString opensPrior =
    QStringLiteral("Opening an earlier study of this patient from the list of studies.");

Act readSeries(const Series& series) {
  return [series](Desk& d) { return withStudyRead(d.search, d.workspace, {&series}); };
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
  return all.isEmpty() ? QStringList(stops) : all;
}

}  // namespace

Series headOf(const char* day, const char* part) { return madeFor({"MR", "T2 head", part, "", "", day}, 1); }

Act desk(const std::function<void(Desk&)>& change) {
  return [change](Desk& d) {
    change(d);
    return PriorStep{d.search};
  };
}
Act sources(int count) {
  return desk([count](Desk& d) {
    for (int n = 0; n < count; ++n) d.sources.insert(n);
  });
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

Act lists(int source, const std::vector<Listed>& all, const char* patient, const char* name) {
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
Act read(const char* day) { return readSeries(headOf(day)); }
Act readKnee(const char* day) { return readSeries(headOf(day, "KNEE")); }
Act readOfAnother(const char* day) {
  Series series = headOf(day);
  series.patientId = "8";
  return readSeries(series);
}

QStringList shows(const char* day, const QStringList& more) {
  return QStringList(QStringLiteral("shows ") + QLatin1String(day)) + more;
}
QStringList opensOf(const char* day, int source) {
  return {opensPrior, QStringLiteral("%1 of %2").arg(QLatin1String(day)).arg(source)};
}

void row(const char* name, const Turns& turns) { QTest::newRow(name) << turns; }

void playTurns() {
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

}  // namespace volumen::tests
