#pragma once

#include "io/export/film_file.h"

namespace volumen {

/// Begin the formats of FilmFile::create().
Result<std::unique_ptr<FilmFile>> beginAnimatedPng(const std::string& path, int pictures, int perSecond);
Result<std::unique_ptr<FilmFile>> beginMp4(const std::string& path, int pictures, int perSecond);

}  // namespace volumen
