#pragma once

#include <string>

#include "viewer/paper/paper.h"

namespace volumen {

/// `bench --paper`: the paper's tables, figures and comparison on this machine, into `folder`. `data`: a
/// folder of test data in which stand-ins for the paper's scans are looked for; empty: the phantoms alone.
/// Returns the exit status.
int benchPaper(const std::string& folder, const std::string& data, const PaperOptions& options,
               const CancelToken& cancel);

}  // namespace volumen
