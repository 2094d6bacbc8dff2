#pragma once

#include <string>

#include "viewer/paper/paper.h"

namespace volumen {

/// Runs `bench --paper`: writes the paper's tables, figures and comparison for this machine into `folder`.
/// `data` is a folder of test data with stand-ins for the paper's scans; if empty, only phantoms are used.
/// Returns the exit status.
int benchPaper(const std::string& folder, const std::string& data, const PaperOptions& options,
               const CancelToken& cancel);

}  // namespace volumen
