#pragma once

#include <benchmark/benchmark.h>

namespace volumen {

/// Measures nine times by real time, in ms, and reports median and spread, with the work of all cores.
inline void often(benchmark::internal::Benchmark* bench) {
  bench->MeasureProcessCPUTime()
      ->UseRealTime()
      ->Unit(benchmark::kMillisecond)
      ->Repetitions(9)
      ->ReportAggregatesOnly();
}

}  // namespace volumen
