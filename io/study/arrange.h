#pragma once

#include <vector>

namespace volumen {

struct Image;
struct Study;

/// Sorts the parts of `study` and appends "#1", "#2", ... to ids that occur more than once. Counts for each
/// derived object the pictures it refers to that the study does not hold.
void arrange(Study& study);

/// Sorts images as arrange() does.
void sortImages(std::vector<Image>& images);

}  // namespace volumen
