#pragma once

#include <tbb/parallel_for.h>

#include <atomic>
#include <cstddef>
#include <thread>

#include "io/study/progress.h"
#include "io/worker/serve.h"
#include "viewer/volume/cancel.h"

namespace volumen::dicom {

/// Runs work(0) .. work(count - 1) on all cores, or in a worker (io/worker) on its only thread, where
/// `cancel` and `progress` are ignored. Elsewhere it stops early when cancelled. Progress is reported on the
/// calling thread, which takes part in the work.
template <class Work>
void forEachParallel(std::size_t count, const char* what, const Progress& progress, const CancelToken& cancel,
                     const Work& work) {
  if (worker::inside()) {
    for (std::size_t n = 0; n < count; ++n) work(n);
    return;
  }
  const std::thread::id caller = std::this_thread::get_id();
  std::atomic<std::size_t> done{0};
  tbb::parallel_for(std::size_t(0), count, [&](std::size_t n) {
    if (cancel.cancelled()) return;
    work(n);
    const std::size_t finished = ++done;
    if (progress && std::this_thread::get_id() == caller) progress(what, finished, count);
  });
  if (progress && !cancel.cancelled()) progress(what, count, count);
}

}  // namespace volumen::dicom
