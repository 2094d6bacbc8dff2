#pragma once

#include <cstdint>

#include "io/study/progress.h"

namespace volumen::worker {

/// The activity that tellRead() reports.
inline constexpr const char* readingPicture = "reading the picture";

/// Reports how many bytes of the requested picture are read: in a worker to the program, else to the
/// ReadListener of this thread.
void tellRead(std::uint64_t done, std::uint64_t all);

/// Passes the reports of tellRead() on this thread to `progress` while it lives. `progress` may be empty.
class ReadListener {
 public:
  explicit ReadListener(const Progress& progress);
  ~ReadListener();
  ReadListener(const ReadListener&) = delete;
  ReadListener& operator=(const ReadListener&) = delete;

 private:
  const Progress* before_;
};

}  // namespace volumen::worker
