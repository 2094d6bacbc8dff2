#pragma once

#include <optional>
#include <string>

#include "viewer/volume/result.h"

namespace volumen {

/// The samples of a file pair of Analyze 7.5 or NIfTI: the header is NAME.hdr, the samples are NAME.img. Each
/// may be gzipped (.gz after its name).
struct PairedSamples {
  std::string path;
  bool compressed = false;
};

/// Returns the samples that belong to a header. The Error is that of resolveBeside().
Result<PairedSamples> samplesOfPair(const std::string& headerPath);

/// Returns the header beside the samples of a pair. Empty if there is none, or if the name is not that of
/// samples.
std::optional<std::string> headerOfPair(const std::string& samplesPath);

}  // namespace volumen
