#pragma once

#include <optional>
#include <string>

#include "viewer/volume/result.h"

namespace volumen {

/// The samples of a pair of files, as Analyze 7.5 and NIfTI keep them: a header NAME.hdr, samples in
/// NAME.img; each may be gzipped (.gz behind its name).
struct PairedSamples {
  std::string path;
  bool compressed = false;
};

/// The samples that belong to a header. Refused: what resolveBeside() refuses.
Result<PairedSamples> samplesOfPair(const std::string& headerPath);

/// The header that lies beside the samples of a pair; nothing where none does, or the name is not of samples.
std::optional<std::string> headerOfPair(const std::string& samplesPath);

}  // namespace volumen
