#include "viewer/measure/scaled.h"

namespace volumen {

Result<Measured> scaled(Result<Measured> measured, double factor) {
  if (!measured) return measured;
  if (measured->voxel) measured->number *= factor;
  if (!measured->values) return measured;
  ValueStatistics& values = *measured->values;
  for (double* number : {&values.mean, &values.sd, &values.min, &values.max}) *number *= factor;
  return measured;
}

}  // namespace volumen
