// Measures how errors fall with step, grid and pixel size on analytic fields. Prints CSV, a row per
// measurement. usage: bench_convergence. tst_convergence asserts the slopes.
#include <cstdio>

#include "tests/unit/promises/convergence.h"

namespace {

using namespace volumen;
using namespace volumen::tests;

void print(const Field& field, bool lit, const char* knob, const char* unit,
           const std::vector<ErrorAt>& all) {
  for (const ErrorAt& e : all)
    std::printf("%s,%s,%s,%s,%.9g,%.6g,%.6g,%.6g,%.3f\n", field.name, lit ? "lit" : "unlit", knob, unit, e.h,
                e.error.maximum, e.error.percentile99, e.error.rmse, slopeOf(all));
  std::fflush(stdout);
}

}  // namespace

int main() {
  std::printf("field,shading,knob,unit,h,maximum,percentile99,rmse,slope\n");
  RenderOptions fine;
  fine.step = 1.0 / 64;
  for (const Field& field : closedFormFields())
    for (bool lit : {false, true}) {
      print(field, lit, "step", "voxel", errorOverStep(field, lit));
      print(field, lit, "grid", "mm", errorOverGrid(field, lit));
      print(field, lit, "pixel", "mm", errorOverPixel(field, lit, fine));
    }
  return 0;
}
