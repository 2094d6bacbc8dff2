#pragma once

#include <vector>

namespace volumen {

struct Image;
struct Study;

/// Puts what was found into the order of a Study, tells those of one id apart by "#1", "#2", ... behind it,
/// and counts what its objects refer to and it does not hold.
void arrange(Study& study);

/// The order in which arrange() puts images.
void sortImages(std::vector<Image>& images);

}  // namespace volumen
