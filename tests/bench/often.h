#pragma once

#include <benchmark/benchmark.h>

namespace volumen {

/// Nine times, by real time, in ms: medians and how far times are apart; all cores' work beside it.
inline void often(benchmark::internal::Benchmark* bench) {
  bench->MeasureProcessCPUTime()
      ->UseRealTime()
      ->Unit(benchmark::kMillisecond)
      ->Repetitions(9)
      ->ReportAggregatesOnly();
}

}  // namespace volumen
