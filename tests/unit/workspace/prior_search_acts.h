#pragma once

#include <functional>

#include "tests/unit/workspace/hung_series.h"
#include "ui/workspace/prior_search.h"

namespace volumen::tests {

inline const char *const today = "20260102", *const of25 = "20250102", *const of24 = "20240102",
                         *const of23 = "20230102", *const of22 = "20220102", *const of21 = "20210102";

/// Expected of a turn that shows, tells and opens nothing: the search asks sources, waits or has stopped.
inline const QString asks = QStringLiteral("asks"), waits = QStringLiteral("waits"),
                     stops = QStringLiteral("stops");

/// Sentences for the user. Both test classes expect them.
inline const QString
    filesAway = QStringLiteral(
        "The files of an earlier study of this patient are not there now: connect the disk or network folder "
        "that holds them, or import the folder from where they are."),
    noneHeld = QStringLiteral(
        "No earlier study of this patient with such a series is open or in the list of studies: open one "
        "from its folder (Ctrl+O), or import it (Ctrl+I).");

/// Returns a series of the patient's head.
Series headOf(const char* day, const char* part = "HEAD");

/// Holds what the acts of a row change. At first the series of today is open and shown.
struct Desk {
  std::vector<Series> open{headOf(today)};
  Workspace workspace = withSeries(withLayout({}, Layout::two), firstComparedId, open[0], {});
  std::set<int> sources{0};
  PriorSearch search{};

  std::vector<const Series*> pictures() const { return pointersTo(open); }
  void show(const Series& series, int cell) {
    workspace = withSeries(workspace, firstComparedId + cell, series, {});
  }
};

/// What happens in a turn: the desk changes, or the search is told something and goes on.
using Act = std::function<PriorStep(Desk&)>;

// Acts that change the desk.
Act desk(const std::function<void(Desk&)>& change);
Act sources(int count);
Act prior(const char* day);
Act priorOnScreen(const char* day);
Act noId();
Act another();
Act back();

// Acts that take the search one step on.
struct Listed {
  const char* day;
  const char* description = "Head";
  bool offline = false;
};
Act compare();
Act lists(int source, const std::vector<Listed>& all, const char* patient = "7",
          const char* name = "Doe^Jane");
Act unreadable(int source);
Act found();
Act openedByUser();
Act missing();
Act idle();
Act read(const char* day);
Act readKnee(const char* day);
Act readOfAnother(const char* day);

/// Expected of a turn that shows the prior of a day, and does more.
QStringList shows(const char* day, const QStringList& more = {});
/// Expected of a turn that opens the study of a day from a source.
QStringList opensOf(const char* day, int source = 0);

struct Turn {
  Act act;
  QStringList expected;  ///< empty: a change of the desk
};
using Turns = std::vector<Turn>;

/// Adds a row to the column "turns".
void row(const char* name, const Turns& turns);
/// Plays the turns of the current row and checks what each does.
void playTurns();

}  // namespace volumen::tests
