#include "viewer/measure/scaled.h"

namespace volumen {

namespace {

void scale(std::optional<ValueStatistics>& values, double factor) {
  if (!values) return;
  for (double* number : {&values->mean, &values->sd, &values->min, &values->max}) *number *= factor;
}

}  // namespace

Result<Measured> scaled(Result<Measured> measured, double factor) {
  if (!measured) return measured;
  if (measured->voxel) measured->number *= factor;
  scale(measured->values, factor);
  if (measured->peak) measured->peak->mean *= factor;
  return measured;
}

void scaleOther(Measured& measured, double factor) {
  if (!measured.other) return;
  scale(measured.other->values, factor);
  if (measured.other->peak) measured.other->peak->mean *= factor;
}

}  // namespace volumen
