#include "viewer/volume/listed_first.h"

#include <algorithm>

namespace volumen {

std::string listedFirst(std::span<const std::string> names, std::size_t most) {
  std::string text;
  for (const std::string& name : names.first(std::min(most, names.size())))
    text += (text.empty() ? "" : ", ") + name;
  return names.size() > most ? text + " and " + std::to_string(names.size() - most) + " more" : text;
}

}  // namespace volumen
