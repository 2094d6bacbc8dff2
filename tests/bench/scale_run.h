#pragma once

#include <functional>
#include <string>
#include <vector>

namespace volumen::bench {

/// What a program took.
struct Taken {
  double seconds = 0;    ///< of processor time, of all its threads and workers
  double mebibytes = 0;  ///< the most memory that one of its processes had at once
  std::string out;       ///< what it wrote to stdout
};

/// Runs a program to its end. Throws where it fails.
Taken runTimed(std::vector<std::string> words);

/// Does `work` in a process of its own: programs that are started count the memory of this one as theirs.
/// Throws where it fails.
void apart(const std::function<void()>& work);

// Each in a process of its own, which prints the seconds of processor time if not said otherwise.

/// Shows a head in planes and 3D, `measurements` lengths and ellipses in its series, and turns the wheel:
/// seconds of a step.
int turnTheWheel(int measurements);

/// Opens a radiograph until it is seen.
int showRadiograph(const std::string& path);

/// Opens a folder of mammograms until all four are seen: seconds on the clock since `startMs` (wallMs()), as
/// a user waits.
int showMammograms(const std::string& folder, double startMs);

/// Shows `series` phantoms, one after the other.
int showInTurn(int series);

}  // namespace volumen::bench
