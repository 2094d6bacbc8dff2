#pragma once

#include "viewer/measure/measure.h"

namespace volumen {

/// Scales values by `factor`: the values of probes and regions, and the peak.
Result<Measured> scaled(Result<Measured> measured, double factor);

/// Scales the values of Measured::other.
void scaleOther(Measured& measured, double factor);

}  // namespace volumen
