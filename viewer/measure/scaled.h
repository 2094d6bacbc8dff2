#pragma once

#include "viewer/measure/measure.h"

namespace volumen {

/// The same of values that are `factor` times as large: what probes and regions say of them.
Result<Measured> scaled(Result<Measured> measured, double factor);

/// Likewise what Measured::other says.
void scaleOther(Measured& measured, double factor);

}  // namespace volumen
