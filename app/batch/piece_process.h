#pragma once

#include <sys/types.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/batch/piece.h"
#include "io/worker/channel.h"
#include "viewer/volume/cancel.h"

namespace volumen {

/// How a piece of work ended.
struct PieceResult {
  std::optional<int> exitStatus;  ///< empty: its process ended
  std::string end;                ///< then why: "was ended by signal 9"
  std::optional<double> seconds;  ///< empty: not known
  /// Most memory of the process, without workers that read files; empty: not known.
  std::optional<std::uint64_t> peakBytes;
  std::string out, error;  ///< what it wrote to stdout and stderr
};

/// What a piece of work may take; 0: all there is.
struct PieceLimits {
  std::uint64_t bytes = 0;  ///< of memory (ulimit -d), besides what its process has at the start
  double seconds = 0;       ///< then its process is killed
};

/// A process that does pieces of work of one series, which it reads once. Whatever happens to it, the program
/// goes on.
class PieceProcess {
 public:
  /// Forks. There must be no threads and no workers.
  PieceProcess(const std::vector<Piece>& pieces, const PieceLimits& limits, const CancelToken& cancel);
  ~PieceProcess();
  PieceProcess(const PieceProcess&) = delete;
  PieceProcess& operator=(const PieceProcess&) = delete;

  /// Does a piece by its index. After one without exit status, none can be done.
  PieceResult run(std::size_t index);

 private:
  bool waitForAnswer();
  std::string end();

  std::optional<std::uint64_t> peakBytes_;  // of the last piece, once the process has ended
  bool restartsWorkers_;
  PieceLimits limits_;
  CancelToken cancel_;
  worker::Descriptor socket_, out_, error_;
  pid_t pid_ = -1;
  bool isLate_ = false;
};

}  // namespace volumen
