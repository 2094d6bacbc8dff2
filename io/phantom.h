#pragma once

#include <string>

#include "io/study/loaded.h"
#include "io/study/progress.h"
#include "io/study/study.h"

namespace volumen {

/// True if a path is a phantom: "phantom:NAME[:SIZE]".
bool isPhantom(const std::string& path);

/// Opens a phantom. The Error: the name is unknown.
Result<Study> openPhantom(const std::string& path);

/// Computes the volume; the sample study is kept in the user's cache.
Result<Loaded> loadPhantom(const Series& series, const Progress& progress = {});

}  // namespace volumen
