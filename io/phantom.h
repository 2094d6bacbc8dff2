#pragma once

#include <string>

#include "io/study/loaded.h"
#include "io/study/progress.h"
#include "io/study/study.h"

namespace volumen {

/// Whether a path means a phantom: "phantom:NAME[:SIZE]".
bool isPhantom(const std::string& path);

/// What such a path holds. An Error where there is no phantom of this name.
Result<Study> openPhantom(const std::string& path);

/// Makes it; the sample study is kept in the user's cache.
Result<Loaded> loadPhantom(const Series& series, const Progress& progress = {});

}  // namespace volumen
